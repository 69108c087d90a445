//! The names of other editions.

use adsdv_spec::{Bus, Edition};

const V3: Bus = Edition::V3_0.bus;
const V4: Bus = Edition::V4_0.bus;

//= MSG-101, MSG-103
#[test]
fn every_name_of_one_edition_is_understood_in_the_other() {
    for (ours, theirs) in [(V3, V4), (V4, V3)] {
        for message in theirs.messages {
            let known = ours.known_as(message.name);
            assert_eq!(known, ours.message(message.id), "{}", message.name);
            for (known, signal) in
                known.iter().flat_map(|known| message.signals.iter().map(move |s| (known, s)))
            {
                let found = known.signal_known_as(signal.name);
                assert_eq!(found, known.signal_of(signal.field), "{} {}", message.name, signal.name);
            }
        }
    }
}

#[test]
fn a_name_of_its_own_comes_first() {
    for bus in [V3, V4] {
        for message in bus.messages {
            assert_eq!(bus.known_as(message.name), Some(*message));
            for signal in message.signals {
                assert_eq!(message.signal_known_as(signal.name), Some(signal));
            }
        }
    }
}

#[test]
fn what_an_edition_does_not_have_has_no_name_there() {
    assert!(V4.known_as("VCU_STATUS").is_some() && V3.known_as("VCU_STATUS").is_none());
    let brake = |bus: Bus| bus.message(0x524).expect("524h");
    assert!(brake(V4).signal_known_as("STATUS_EBS").is_some());
    assert_eq!(brake(V3).signal_known_as("STATUS_EBS"), None);
    // A name of another message is none of this one.
    assert_eq!(brake(V4).signal_known_as("STEER_ANGLE_deg"), None);
}
