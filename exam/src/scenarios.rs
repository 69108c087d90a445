//! The scenarios of the exam.

use adsdv_can::car::{Physics, Switch};
use adsdv_spec::messages::AsState;

use crate::disturbance::{Disturbance, Effect, Onset, Sensors};
use crate::expectation::Expectation;
use crate::expectations::{
    ANSWERS, BRAKES, COMPLETES, CYCLES, GOES_FORWARD, HOLDS_STILL, SELECTS, SENDS, TELLS_STOP,
};
use crate::scenario::ExamScenario;

/// A vehicle whose brakes are weak, and answer slowly.
pub(crate) const WEAK_BRAKES: Physics =
    Physics { full_braking_mps2: 2.0, force_lag_ms: 400.0, ..Physics::DEFAULT };

/// What every AI Computer does at any time.
fn always() -> Vec<&'static Expectation> {
    SENDS.iter().chain(&CYCLES).chain([&ANSWERS, &SELECTS]).collect()
}

/// What it does where the car drives, and does not come to its end.
fn drives() -> Vec<&'static Expectation> {
    always().into_iter().chain([&HOLDS_STILL, &GOES_FORWARD]).collect()
}

/// What it does where the mission comes to its end.
pub(crate) fn completes() -> Vec<&'static Expectation> {
    drives().into_iter().chain([&COMPLETES, &BRAKES, &TELLS_STOP]).collect()
}

/// From the switches to AS_READY.
const READY: &str = "0 ebs ARMED, ami TRACK_DRIVE\n0.5 tsms on, asms on\n";
/// "Go" as soon as it may come.
const GO: &str = "AS_READY +5.5 go on\n";
/// The end of a mission.
const OVER: &str = "AS_FINISHED +1 go off, asms off\n+0.5 end\n";
/// Out of an emergency, and ready again.
const AGAIN: &str = "EMERGENCY_BRAKE +15.5 asms off, go off\n+0.2 remote_estop off, power cycle\n+2.5 asms on\n\
                     AS_READY +5.5 go on\nAS_DRIVING +1 end\n";

impl ExamScenario {
    fn new(name: &str, about: &str, operator: &[&str], expects: Vec<&'static Expectation>) -> Self {
        Self {
            name: name.to_owned(),
            about: about.to_owned(),
            operator: operator.concat(),
            disturbances: Vec::new(),
            expects,
            vcu_starts_ms: 0,
            ai_starts_ms: 0,
            physics: Physics::DEFAULT,
        }
    }

    fn with(mut self, from: Onset, after_ms: u64, for_ms: u64, effect: Effect) -> Self {
        self.disturbances.push(Disturbance { from, after_ms, for_ms, effect });
        self
    }
}

/// No scenario has a name that begins so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoScenario(pub String);

/// Those of these scenarios whose names begin with one of `only`, or all where it is empty; with `quick`, the few of them that show
/// most.
///
/// ```
/// use adsdv_exam::{chosen, scenarios};
///
/// let estops = chosen(scenarios(), &["estop".to_owned()], false).expect("there are some");
/// assert!(estops.iter().all(|one| one.name.starts_with("estop")));
/// assert!(chosen(scenarios(), &["etsop".to_owned()], false).is_err());
/// ```
///
/// # Errors
///
/// Fails if no name begins with one of `only`.
pub fn chosen(all: Vec<ExamScenario>, only: &[String], quick: bool) -> Result<Vec<ExamScenario>, NoScenario> {
    let begins = |scenario: &ExamScenario, name: &String| scenario.name.starts_with(name.as_str());
    if let Some(unknown) = only.iter().find(|name| !all.iter().any(|one| begins(one, name))) {
        return Err(NoScenario(unknown.clone()));
    }
    let is_asked = |one: &ExamScenario| {
        let named = only.is_empty() || only.iter().any(|name| begins(one, name));
        named && (!quick || one.is_quick())
    };
    Ok(all.into_iter().filter(is_asked).collect())
}

/// All scenarios, the simple ones first.
pub fn scenarios() -> Vec<ExamScenario> {
    let mut all = vec![
        ExamScenario::new(
            "no-mission",
            "everything is switched on, but no mission is selected",
            &["0 ebs ARMED\n0.5 tsms on, asms on\n3 end\n"],
            always(),
        ),
        ExamScenario::new(
            "ready",
            "a mission is selected, and nothing follows",
            &[READY, "4 end\n"],
            always(),
        ),
    ];
    all.extend(missions());
    all.extend(go());
    all.extend(switches());
    all.extend(stops());
    all.extend(power_cycles());
    all.extend(frames());
    all.extend(vehicle());
    all
}

/// Each mission of the AMI.
fn missions() -> Vec<ExamScenario> {
    let Some(ami) = Switch::named("ami") else { return Vec::new() };
    let selected = ami.positions().into_iter().filter(|raw| *raw != 0).map(|raw| ami.position(raw));
    let mut all: Vec<ExamScenario> = selected
        .map(|mission| {
            let name = format!("mission-{}", mission.to_ascii_lowercase().replace('_', "-"));
            let ready = format!("0 ebs ARMED, ami {mission}\n0.5 tsms on, asms on\n");
            ExamScenario::new(&name, &format!("the mission {mission}"), &[&ready, GO, OVER], completes())
        })
        .collect();
    all.push(ExamScenario::new(
        "two-missions",
        "a second mission without a power cycle, another one",
        &[
            READY,
            GO,
            "AS_FINISHED +1 go off, asms off\n+0.2 ami NOT_SELECTED\n+1 ami ACCELERATION\n+2.5 asms on\n",
            "AS_READY +5.5 go on\nAS_FINISHED +1 end\n",
        ],
        completes(),
    ));
    all
}

/// "Go" as it should not come.
fn go() -> Vec<ExamScenario> {
    vec![
        ExamScenario::new(
            "go-early",
            "\"Go\" is on before the five seconds of AS_READY are over, and once more behind them",
            &[READY, "AS_READY +2 go on\n+2 go off\n+2 go on\nAS_DRIVING +1 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "go-on-from-the-start",
            "\"Go\" is on before AS_READY, and has to be turned off and on again",
            &["0 go on\n", READY, "AS_READY +6 go off\n+0.5 go on\nAS_DRIVING +1 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "go-late",
            "\"Go\" comes half a minute late",
            &[READY, "AS_READY +35 go on\nAS_DRIVING +1 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "go-cycled",
            "\"Go\" is turned on, off and on again in AS_READY",
            &[
                READY,
                "AS_READY +1 go on\n+0.1 go off\n+0.1 go on\n+0.1 go off\n+5 go on\nAS_DRIVING +1 end\n",
            ],
            drives(),
        ),
        ExamScenario::new(
            "go-withdrawn",
            "\"Go\" is turned off while the car drives; a power cycle, and another start",
            &[READY, GO, "AS_DRIVING +3 go off\n", AGAIN],
            drives(),
        ),
        ExamScenario::new(
            "go-withdrawn-at-once",
            "\"Go\" is turned off 50 ms after AS_DRIVING began",
            &[READY, GO, "AS_DRIVING +0.05 go off\nEMERGENCY_BRAKE +2 end\n"],
            drives(),
        ),
    ]
}

/// Master switches and the AMI.
fn switches() -> Vec<ExamScenario> {
    vec![
        ExamScenario::new(
            "asms-off-in-ready",
            "ASMS is turned off and on again in AS_READY",
            &[READY, "AS_READY +2 asms off\nAS_OFF +2.5 asms on\nAS_READY +5.5 go on\nAS_DRIVING +1 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "asms-off-in-driving",
            "ASMS is turned off while the car drives",
            &[READY, GO, "AS_DRIVING +2 asms off\nEMERGENCY_BRAKE +2 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "asms-on-first",
            "ASMS is on long before TSMS",
            &["0 ebs ARMED, ami TRACK_DRIVE, asms on\n3 tsms on\nAS_READY +1 end\n"],
            always(),
        ),
        ExamScenario::new(
            "ami-changed",
            "another mission is selected on the AMI, none, and a third",
            &[
                "0 ebs ARMED, ami SKIDPAD\n3 ami ACCELERATION\n6 ami NOT_SELECTED\n7 ami AUTOCROSS\n",
                "10 tsms on, asms on\nAS_READY +5.5 go on\nAS_DRIVING +1 end\n",
            ],
            drives(),
        ),
        ExamScenario::new(
            "ami-late",
            "the mission is selected when all else is switched on already",
            &["0 ebs ARMED, tsms on, asms on\n3 ami SKIDPAD\nAS_READY +5.5 go on\nAS_DRIVING +1 end\n"],
            drives(),
        ),
    ]
}

/// An emergency stop in each state.
fn stops() -> Vec<ExamScenario> {
    let stop = "remote_estop on\nEMERGENCY_BRAKE +2 end\n";
    vec![
        ExamScenario::new(
            "estop-in-off",
            "the remote E-stop is pressed before all else",
            &["0 remote_estop on\n", READY, "4 end\n"],
            always(),
        ),
        ExamScenario::new(
            "estop-in-ready",
            "the remote E-stop in AS_READY",
            &[READY, "AS_READY +2 ", stop],
            always(),
        ),
        ExamScenario::new(
            "estop-in-driving",
            "the remote E-stop while the car drives; a power cycle, and another start",
            &[READY, GO, "AS_DRIVING +3 remote_estop on\n", AGAIN],
            drives(),
        ),
        ExamScenario::new(
            "estop-at-start",
            "an E-stop button on the vehicle, 100 ms after AS_DRIVING began",
            &[READY, GO, "AS_DRIVING +0.1 vehicle_estop on\nEMERGENCY_BRAKE +2 end\n"],
            drives(),
        ),
        ExamScenario::new(
            "estop-in-finished",
            "the remote E-stop behind a mission",
            &[READY, GO, "AS_FINISHED +0.5 ", stop],
            completes(),
        ),
    ]
}

/// The power of the VCU goes off and on in each state.
fn power_cycles() -> Vec<ExamScenario> {
    let then = "power cycle\n+4 asms off\n+2.5 asms on\nAS_READY +5.5 go on\nAS_DRIVING +1 end\n";
    vec![
        ExamScenario::new(
            "power-cycle-in-off",
            "the power of the VCU is cycled in AS_OFF",
            &[
                "0 ebs ARMED, ami TRACK_DRIVE\n2 power cycle\n+4 tsms on, asms on\n",
                GO,
                "AS_DRIVING +1 end\n",
            ],
            drives(),
        ),
        ExamScenario::new(
            "power-cycle-in-ready",
            "the power of the VCU is cycled in AS_READY",
            &[READY, "AS_READY +2 ", then],
            drives(),
        ),
        ExamScenario::new(
            "power-cycle-in-driving",
            "the power of the VCU is cycled while the car drives, which rolls out",
            &[
                READY,
                GO,
                "AS_DRIVING +3 go off, asms off, power cycle\n+30 asms on\n",
                GO,
                "AS_DRIVING +1 end\n",
            ],
            drives(),
        ),
        ExamScenario::new(
            "power-cycle-in-emergency",
            "the power of the VCU is cycled in EMERGENCY_BRAKE",
            &[
                READY,
                "AS_READY +1 remote_estop on\nEMERGENCY_BRAKE +2 remote_estop off, asms off, power cycle\n+4 asms on\n",
                GO,
                "AS_DRIVING +1 end\n",
            ],
            drives(),
        ),
        ExamScenario::new(
            "power-cycle-in-finished",
            "the power of the VCU is cycled behind a mission",
            &[
                READY,
                GO,
                "AS_FINISHED +1 go off, asms off, power cycle\n+4 asms on\n",
                GO,
                "AS_DRIVING +1 end\n",
            ],
            completes(),
        ),
    ]
}

/// Frames of the VCU that do not come as they should, and who starts first.
fn frames() -> Vec<ExamScenario> {
    const WHOLE: u64 = 600_000;
    let (driving, ready) = (Onset::State(AsState::Driving), Onset::State(AsState::Ready));
    let mission = |name, about| ExamScenario::new(name, about, &[READY, GO, OVER], completes());
    let short = |name, about| ExamScenario::new(name, about, &[READY, GO, "AS_DRIVING +4 end\n"], drives());
    let stopped =
        |name, about| ExamScenario::new(name, about, &[READY, GO, "EMERGENCY_BRAKE +2 end\n"], drives());
    vec![
        mission("frames-lost", "the VCU's messages of every third cycle are lost").with(
            Onset::Start,
            0,
            WHOLE,
            Effect::Loses(3),
        ),
        mission("frames-late", "the VCU's messages come 10 ms late").with(
            Onset::Start,
            0,
            WHOLE,
            Effect::Delays(10),
        ),
        mission("frames-in-bursts", "the VCU's messages of two cycles come together").with(
            Onset::Start,
            0,
            WHOLE,
            Effect::Gathers(20),
        ),
        short("handshake-held", "HANDSHAKE of the VCU stays as it is for 30 ms in AS_READY").with(
            ready,
            2000,
            30,
            Effect::HoldsHandshake,
        ),
        short("vcu-pauses", "the VCU says nothing for 30 ms while the car drives").with(
            driving,
            2000,
            30,
            Effect::Silences,
        ),
        stopped("vcu-silent", "the VCU says nothing for half a second while the car drives").with(
            driving,
            2000,
            500,
            Effect::Silences,
        ),
        ExamScenario {
            ai_starts_ms: 3000,
            ..short("vcu-first", "the VCU is on three seconds before the AI Computer")
        },
        ExamScenario {
            vcu_starts_ms: 3000,
            ..ExamScenario::new(
                "ai-first",
                "the AI Computer is on three seconds before the VCU",
                &["0 ebs ARMED, ami TRACK_DRIVE\n5 tsms on, asms on\n", GO, "AS_DRIVING +4 end\n"],
                drives(),
            )
        },
    ]
}

/// Wheels, speeds and brakes that are not as they should be.
fn vehicle() -> Vec<ExamScenario> {
    const WHOLE: u64 = 600_000;
    let mission = |name, about| ExamScenario::new(name, about, &[READY, GO, OVER], completes());
    vec![
        mission("wheel-stands", "the sensor of the front left wheel shows 0").with(
            Onset::Start,
            0,
            WHOLE,
            Effect::Sensors(Sensors::WheelStands),
        ),
        mission(
            "wheel-spins",
            "the front right wheel turns with 300 rpm for 4 s while the AI Computer brakes",
        )
        .with(Onset::Braking, 0, 4000, Effect::Sensors(Sensors::WheelSpins)),
        mission("speed-stays", "the wheels do not fall below 40 rpm for 4 s while the AI Computer brakes")
            .with(Onset::Braking, 0, 4000, Effect::Sensors(Sensors::SpeedStays)),
        ExamScenario {
            physics: WEAK_BRAKES,
            ..mission("slow-brakes", "the brakes are weak, and answer slowly")
        },
    ]
}
