use Deviation::*;
use adsdv_diagnosis::*;
use adsdv_spec::AsState::*;
use adsdv_spec::Atom::*;
use adsdv_spec::mutation::{Change::*, TermChange::*, Threshold::*};
use adsdv_spec::*;
fn main() {
    let edition = if std::env::args().nth(2).as_deref() == Some("6") {
        &Edition::V2026
    } else if std::env::args().nth(2).as_deref() == Some("4") {
        &Edition::V4_0
    } else {
        &Edition::V3_0
    };
    let cases: Vec<Vec<Deviation>> = vec![
        vec![Joined { row: 1, one: 0, other: 1 }, Joined { row: 1, one: 1, other: 2 }],
        vec![
            Changed(Threshold(WheelSpeed, -4)),
            Changed(RowFirst(5)),
            Changed(Term(4, 1, LiteralDropped(GoOn))),
        ],
        vec![
            Changed(Term(6, 0, LiteralFlipped(EbsTimerComplete))),
            Deviation::Remembers(adsdv_diagnosis::Remembers::CauseUntilLeft),
            Needs { from: EmergencyBrake, to: Off, key: "vehicle_estop", raw: 0, is: true },
            Needs { from: EmergencyBrake, to: Off, key: "ami", raw: 0, is: true },
        ],
        vec![
            Late { from: EmergencyBrake, to: Off, steps: 3 },
            Changed(Term(4, 5, LiteralDropped(DirectionNeutral))),
            Deviation::Wheels(adsdv_diagnosis::Wheels::Only(0)),
            Deviation::Remembers(adsdv_diagnosis::Remembers::TimerWhileAsmsOff),
            Changed(Threshold(WheelSpeed, 1)),
            Needs { from: EmergencyBrake, to: Off, key: "mission_status", raw: 2, is: false },
            Deviation::Remembers(adsdv_diagnosis::Remembers::CauseUntilLeft),
            GoNeedsHandshake,
        ],
        vec![
            Changed(RowLeadsTo(4, Finished)),
            Shows { state: EmergencyBrake, key: "shutdown_cause", raw: 1 },
            Changed(Term(0, 0, LiteralFlipped(MissionSelected))),
            Deviation::Remembers(adsdv_diagnosis::Remembers::DwellOfAllVisits),
            Joined { row: 4, one: 1, other: 7 },
            Changed(Term(1, 2, InEveryReading)),
            Joined { row: 4, one: 0, other: 3 },
            Changed(RowFirst(8)),
        ],
        vec![
            Changed(RowLeadsTo(8, Finished)),
            Changed(RowLeadsTo(2, Ready)),
            Changed(Term(4, 8, LiteralFlipped(AiCommsLost))),
            Writes { key: "shutdown_cause", value: 3, raw: 4 },
            Changed(RowFirst(5)),
            Late { from: Driving, to: Finished, steps: 1 },
            Joined { row: 4, one: 2, other: 4 },
            Changed(Term(2, 0, LiteralFlipped(Asms))),
        ],
    ];
    let n: usize = std::env::args().nth(1).and_then(|x| x.parse().ok()).unwrap_or(0);
    let found = diagnose(&mut Model::new(edition, &cases[n]).running(), edition).unwrap();
    println!("{:?}\n{} unexplained", found.deviations, found.unexplained.len());
}
