//! Every signal whose bits can hold a value that is not allowed.

use adsdv_oracle::judge::{JudgeOptions, Party, Rule, Severity};
use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuDriveF, Ai2VcuStatus, Node, SignalDef, Vcu2AiBrake, Vcu2AiDriveF,
};
use adsdv_spec::{Edition, Machine, Readings};
use adsdv_tests::bus::{BUS, def_of, encoded};
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::check::section_of;

/// The largest value that the bits can hold and that is not allowed.
fn refused(signal: &SignalDef) -> Option<i32> {
    let bits = u32::from(signal.width) - u32::from(signal.signed);
    let (lowest, highest) = (if signal.signed { -(1 << bits) } else { 0 }, (1 << bits) - 1);
    (lowest..=highest).rev().find(|&raw| !signal.allows(raw))
}

/// Version 3.0 with the bus of version 4.0.
const ON_THE_BUS_OF_4_0: Edition = Edition { bus: Edition::V4_0.bus, ..Edition::V3_0 };

/// A vehicle that drives, and since when, in a recording of an edition.
fn driving(edition: &'static Edition) -> (World, i64, JudgeOptions) {
    let mut world = World::new(Machine::new(*edition, Readings::DEFAULT));
    world.driving();
    let since = world.t;
    world.wait(500);
    (world, since, JudgeOptions { edition, ..JudgeOptions::default() })
}

#[test]
fn each_is_reported_once_with_its_name() {
    each_is_reported(Edition::DEFAULT, 20);
}

#[test]
fn each_of_version_4_0_is_reported_once_with_its_name() {
    each_is_reported(&ON_THE_BUS_OF_4_0, 30);
}

/// So many at least.
fn each_is_reported(edition: &'static Edition, least: u32) {
    let (mut world, since, options) = driving(edition);
    // The simulated AI Computer does not send the logger's 501h.
    let dynamics = encoded(Ai2LogDynamics2::default());
    world.log.extend((0..world.t / (100 * MS)).map(|n| Recorded { t: n * 100 * MS, frame: dynamics }));
    world.log.sort_by_key(|recorded| recorded.t);
    assert_eq!(judge(&world.log, options).findings, []);

    let mut count = 0;
    for message in edition.bus.messages {
        for signal in message.signals {
            let Some(raw) = refused(signal) else { continue };
            let mut log = world.log.clone();
            for recorded in &mut log {
                let lasts = (since..since + 250 * MS).contains(&recorded.t);
                if lasts && recorded.frame.id == message.id {
                    recorded.frame.data = signal.put(recorded.frame.data, raw);
                }
            }
            let report = judge(&log, options);
            let name = format!("{} {} = {raw}", message.name, signal.name);
            // Of 502h, the start value of the CAN database is a note.
            let (rule, severity) = if raw == 0 {
                (Rule::StartValue, Severity::Note)
            } else {
                (Rule::Value, Severity::Violation)
            };
            let [finding] = &report.findings[..] else { panic!("{name}: {:#?}", report.findings) };
            assert_eq!((finding.rule, finding.severity), (rule, severity), "{name}");
            assert_eq!(
                (finding.party, section_of(finding)),
                (message.sender.into(), message.section),
                "{name}"
            );
            let asked = signal.requirements.iter().filter(|id| edition.requirements.has(id));
            assert!(finding.requirements.iter().eq(asked), "{name}: {:?}", finding.requirements);
            let said = &finding.message();
            assert!(said.contains(message.name) && said.contains(signal.name), "{name}: {said}");
            count += 1;
        }
    }
    assert!(count >= least, "only {count} signals");
}

#[test]
fn the_start_value_of_the_ebs_is_a_note_in_524h_too() {
    let (mut world, _, options) = driving(&ON_THE_BUS_OF_4_0);
    let status = options.edition.bus.signal_of("status_ebs").expect("a signal of 524h");
    for recorded in world.log.iter_mut().filter(|recorded| recorded.frame.id == Vcu2AiBrake::ID) {
        recorded.frame.data = status.put(recorded.frame.data, 0);
    }
    let report = judge(&world.log, options);
    let [finding] = &report.findings[..] else { panic!("{:#?}", report.findings) };
    assert_eq!((finding.rule, finding.severity), (Rule::StartValue, Severity::Note));
    assert!(finding.message().contains(status.name), "{}", finding.message());
}

/// Behind a step back of time it is another recording: what is wrong there as well is reported again.
#[test]
fn what_is_still_wrong_in_another_recording_is_reported_again() {
    let mut world = World::reference();
    world.wait(2000);
    let signal = def_of::<Ai2VcuStatus>().signals.iter().find(|signal| refused(signal).is_some());
    let signal = signal.expect("510h has a signal that does not allow every value");
    let raw = refused(signal).expect("a value");
    for recorded in world.log.iter_mut().filter(|recorded| recorded.frame.id == Ai2VcuStatus::ID) {
        recorded.frame.data = signal.put(recorded.frame.data, raw);
    }
    let wrong = |log: &[Recorded]| {
        let findings = judge(log, JudgeOptions::default()).findings;
        findings.iter().filter(|finding| finding.rule == Rule::Value).count()
    };
    assert_eq!(wrong(&world.log), 1);
    let since = world.t / 2;
    world.log.iter_mut().filter(|recorded| recorded.t >= since).for_each(|recorded| recorded.t -= 500 * MS);
    assert_eq!(wrong(&world.log), 2);
}

/// A VCU that shows requests back tells also those that are out of range: they are the AI Computer's.
#[test]
fn the_vcu_is_not_blamed_for_returning_a_request_out_of_range() {
    let mut world = World::reference();
    world.driving();
    let refuse = |log: &mut [Recorded], id, name: &str| {
        let message = BUS.message(id).expect("a message");
        let is_it = |signal: &&SignalDef| signal.name.contains(name) && refused(signal).is_some();
        let signal = message.signals.iter().find(is_it).expect("a signal that does not allow every value");
        let raw = refused(signal).expect("a value");
        // The VCU shows back what it has received.
        let since = if message.sender == Node::Vcu { 500 * MS } else { 0 };
        for recorded in log.iter_mut().filter(|one| one.frame.id == id && one.t >= since) {
            recorded.frame.data = signal.put(recorded.frame.data, raw);
        }
    };
    let mut echo = world.log.clone();
    refuse(&mut echo, Vcu2AiDriveF::ID, "_REQ");
    let mut both = echo.clone();
    refuse(&mut both, Ai2VcuDriveF::ID, "");
    for (name, log, weighs) in
        [("a request", &echo, Severity::Violation), ("a request that is shown back", &both, Severity::Note)]
    {
        let findings = judge(log, JudgeOptions::default()).findings;
        let of_the_vcu: Vec<Severity> =
            findings.iter().filter(|one| one.party == Party::Vcu).map(|one| one.severity).collect();
        assert_eq!(of_the_vcu, [weighs], "{name}: {findings:#?}");
    }
}
