//! A node on a bus follows the edition that it is given, and its status says which that is.

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::car::Car;
use adsdv_can::live::{AiComputer, Vcu};
use adsdv_can::status::{HappeningKind, Status};
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Node;
use adsdv_spec::{AiMessages, Edition, Machine, Rules, Timing};

use super::{Bench, count, happenings, ms, run};

/// An edition with a slower cycle, in which an answer to the handshake may take longer.
const SLOW: Edition = Edition {
    version: "test",
    rules: Rules {
        timing: Timing { cycle_ms: 20, handshake_ms: 200, ..Edition::V3_0.rules.timing },
        ..Edition::V3_0.rules
    },
    ..Edition::V3_0
};

fn vcu(bench: &Bench, edition: &Edition) -> Vcu<Bench> {
    Vcu::new(bench.clone(), Machine::new(*edition, edition.readings), None)
}

#[test]
fn the_status_says_the_edition_and_its_limit_for_answers() {
    for (edition, limit) in [(&Edition::V3_0, 50), (&SLOW, 200)] {
        let vcu = vcu(&Bench::new(), edition);
        let ai = AiComputer::new(Bench::new(), Ai::new(edition, Plan::DEFAULT));
        for status in [vcu.status(), ai.status()] {
            assert_eq!((status.edition, status.answer_limit_ms), (edition.version, limit));
        }
    }
}

#[test]
fn the_cycle_is_that_of_the_edition() {
    for (edition, cycles) in [(&Edition::V3_0, 100), (&SLOW, 50)] {
        let (of_vcu, of_ai) = (Bench::new(), Bench::new());
        let mut vcu = vcu(&of_vcu, edition);
        let mut ai = AiComputer::new(of_ai.clone(), Ai::new(edition, Plan::DEFAULT));
        while of_vcu.time() < ms(1000) {
            vcu.turn();
        }
        while of_ai.time() < ms(1000) {
            ai.turn();
        }
        for status in [vcu.status(), ai.status()] {
            assert!(
                status.cycles.count.abs_diff(cycles) <= 1,
                "{}: {}",
                edition.version,
                status.cycles.count
            );
            assert_eq!(count(status, |what| matches!(what, HappeningKind::Late(_))), 0);
        }
    }
}

/// What was said of the partner's edition: when, and the editions that it may speak.
fn said(status: &Status, of: Node) -> Vec<(u64, Vec<&'static str>)> {
    let all = happenings(status).into_iter().filter_map(|(time_ms, what)| match what {
        HappeningKind::OtherEdition { node, spoken, own } => {
            assert_eq!((*node, *own), (of, status.edition));
            assert!(!spoken.evidence.is_empty(), "{spoken}");
            let own_said = format!("{own}: ");
            assert!(spoken.evidence.iter().all(|fact| fact.contains(&own_said)), "{spoken}");
            let versions = std::iter::once(spoken.edition).chain(spoken.alike.iter().copied());
            Some((time_ms, versions.map(|edition| edition.version).collect()))
        }
        _ => None,
    });
    all.collect()
}

/// The lengths of what an AI Computer sends.
fn lens(edition: &Edition) -> Vec<(u16, u8)> {
    let messages = edition.bus.messages.iter().filter(|message| AiMessages::IDS.contains(&message.id));
    messages.map(|message| (message.id, message.len)).collect()
}

fn ai(edition: &'static Edition) -> Ai {
    Ai::new(edition, Plan::DEFAULT)
}

#[test]
fn a_vcu_says_once_which_other_edition_its_ai_computer_speaks() {
    for (own, other) in
        Edition::ALL.iter().flat_map(|own| Edition::ALL.iter().map(move |other| (*own, *other)))
    {
        let bench = Bench::new();
        bench.plug_in_other(ai(other));
        let mut vcu = vcu(&bench, own);
        run(&mut vcu, &bench, ms(5000));
        let said = said(vcu.status(), Node::Ai);
        if lens(own) == lens(other) {
            assert_eq!(said, [], "{} with {}", own.version, other.version);
        } else {
            let [(when, versions)] = &said[..] else {
                panic!("{} with {}: {said:?}", own.version, other.version)
            };
            assert!(versions.contains(&other.version) && !versions.contains(&own.version), "{versions:?}");
            assert!((1000..1100).contains(when), "{when} ms");
        }
    }
}

#[test]
fn an_ai_computer_says_once_which_other_edition_its_vcu_speaks() {
    for (own, other) in
        Edition::ALL.iter().flat_map(|own| Edition::ALL.iter().map(move |other| (*own, *other)))
    {
        let bench = Bench::new();
        let mut car = Car::new(Machine::new(*other, other.readings));
        for cycle in 0..500 {
            for frame in car.cycle(10).frames {
                bench.frame_comes(ms(10 * cycle + 3), FrameKind::Standard, frame.id.into(), frame.data());
            }
        }
        let mut ai = AiComputer::new(bench.clone(), ai(own));
        while bench.time() < ms(5000) {
            ai.turn();
        }
        let said = said(ai.status(), Node::Vcu);
        if own.bus == other.bus {
            assert_eq!(said, []);
        } else {
            let [(when, versions)] = &said[..] else {
                panic!("{} with {}: {said:?}", own.version, other.version)
            };
            // Of editions with the same bus the newest comes first.
            let alike = Edition::ALL.iter().rev().filter(|edition| edition.bus == other.bus);
            let mut alike: Vec<&str> = alike.map(|edition| edition.version).collect();
            alike[1..].reverse();
            assert_eq!(versions, &alike, "a VCU shows it");
            assert!((1000..1100).contains(when), "{when} ms");
        }
    }
}

#[test]
fn a_partner_that_is_exchanged_is_noticed_and_an_odd_frame_is_outweighed() {
    let bench = Bench::new();
    bench.plug_in(ai(&Edition::V3_0));
    let mut vcu = vcu(&bench, &Edition::V3_0);
    bench.frame_comes(ms(500), FrameKind::Standard, 0x511, &[0; 4]);
    run(&mut vcu, &bench, ms(3000));
    assert_eq!(said(vcu.status(), Node::Ai), []);
    bench.plug_in_other(ai(&Edition::V4_0));
    run(&mut vcu, &bench, ms(8000));
    let said = said(vcu.status(), Node::Ai);
    assert!(matches!(&said[..], [(3000..5100, versions)] if versions.contains(&"4.0")), "{said:?}");
}

/// Frames of the node itself, which somebody else sends, are reported otherwise, and are not its partner's.
#[test]
fn another_node_of_the_same_kind_is_no_partner() {
    let bench = Bench::new();
    bench.plug_in(ai(&Edition::V3_0));
    let mut vcu = vcu(&bench, &Edition::V3_0);
    for cycle in 0..200 {
        bench.frame_comes(ms(10 * cycle + 3), FrameKind::Standard, 0x521, &[0; 6]);
    }
    run(&mut vcu, &bench, ms(3000));
    assert_eq!(said(vcu.status(), Node::Ai), []);
    assert_eq!(vcu.status().foreign, 200);
}
