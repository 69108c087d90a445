//! The AI Computer stops altogether, or the recording does not have its frames, and the VCU goes on as if all were well.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{Ai2VcuStatus, Node};
use adsdv_spec::{AsState, Edition};
use adsdv_tests::world::{MS, World, judge};

use crate::check::by;

/// A mission of which all frames of the AI Computer are missing from `since` until `until`.
fn without_the_ai(edition: &'static Edition, since: i64, until: i64) -> World {
    let mut world = World::of(edition);
    world.driving();
    world.wait(3000);
    world.log.retain(|recorded| {
        let of_ai = edition.bus.message(recorded.frame.id).is_some_and(|message| message.sender == Node::Ai);
        !of_ai || !(since..until).contains(&recorded.t)
    });
    world
}

/// By the default options only frames that were not recorded could excuse it; where none is missing, both are at fault.
#[test]
fn an_ai_computer_that_stops_is_reported_though_the_vcu_drives_on() {
    for &edition in Edition::ALL {
        let since = 9000 * MS;
        for until in [11_000 * MS, i64::MAX] {
            let world = without_the_ai(edition, since, until);
            let name = format!("edition {}, until {until}", edition.version);
            let report = judge(&world.log, JudgeOptions::of(edition));
            let warnings: Vec<_> =
                report.findings.iter().filter(|finding| finding.severity == Severity::Warning).collect();
            assert!(
                by(&report, Party::Vcu).is_empty() && by(&report, Party::Ai).is_empty(),
                "{name}: {:#?}",
                report.findings
            );
            let [finding] = warnings[..] else { panic!("{name}: {:#?}", report.findings) };
            assert_eq!((finding.rule, finding.party), (Rule::AiSilent, Party::Ai), "{name}");
            assert!((finding.t_ns - since).abs() < 20 * MS, "{name}: {finding:?}");

            let report = judge(&world.log, JudgeOptions { complete: true, ..JudgeOptions::of(edition) });
            assert!(
                by(&report, Party::Ai).iter().any(|finding| finding.rule == Rule::AiSilent),
                "{name}: {:#?}",
                report.findings
            );
            let due = by(&report, Party::Vcu);
            assert!(
                due.iter().any(|finding| finding.rule == Rule::CommsLostDue),
                "{name}: {:#?}",
                report.findings
            );
        }
    }
}

/// It shows in the margins, too: the longest time without a frame of 510h.
#[test]
fn the_silence_is_a_margin() {
    let world = without_the_ai(&Edition::V4_0, 9000 * MS, i64::MAX);
    let report = judge(&world.log, JudgeOptions::of(&Edition::V4_0));
    let status = report.margins.iter().find(|margin| margin.message == Some(Ai2VcuStatus::ID));
    assert!(
        status.is_some_and(|margin| margin.left() < 0.0 && margin.value > 1000.0),
        "{:#?}",
        report.margins
    );
}

/// A VCU that says so, a pause that is shorter, and a car that is off: nothing of the kind is reported.
#[test]
fn a_silence_that_the_vcu_tells_of_or_that_is_short_is_not() {
    for &edition in Edition::ALL {
        let said = |world: &World| {
            let report = judge(&world.log, JudgeOptions::of(edition));
            report.findings.iter().any(|finding| finding.rule == Rule::AiSilent)
        };
        let limit = i64::from(edition.rules.timing.handshake_ms);
        assert!(
            !said(&without_the_ai(edition, 9000 * MS, (9000 + limit) * MS)),
            "{}: short",
            edition.version
        );
        let mut stops = World::of(edition);
        stops.driving();
        stops.ai_sends = false;
        stops.wait(2000);
        assert!(!said(&stops), "{}: the VCU tells of it", edition.version);
        let mut off = World::of(edition);
        off.wait(1000);
        off.ai_sends = false;
        off.wait(3000);
        assert!(!said(&off), "{}: AS_OFF", edition.version);
    }
}

/// An AI Computer that stopped while TSMS was off has to answer from when TSMS is on again; the VCU has its time from then, too.
#[test]
fn a_silence_from_before_tsms_was_on_is_the_vcus_fault_only_once_its_time_is_over() {
    for &edition in Edition::ALL {
        let mut world = World::of(edition);
        world.prepare();
        world.inputs.tsms = false;
        world.wait(200);
        world.ai_sends = false;
        world.wait(1000);
        world.inputs.asms = true;
        world.inputs.tsms = true;
        world.wait(2000);
        assert_eq!(world.control.state, AsState::EmergencyBrake, "{}: by AS_READY", edition.version);
        let report = judge(&world.log, JudgeOptions { complete: true, ..JudgeOptions::of(edition) });
        assert!(by(&report, Party::Vcu).is_empty(), "{}: {:#?}", edition.version, report.findings);
    }
}
