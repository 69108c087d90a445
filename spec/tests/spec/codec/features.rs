//! What the optional features add: reading with serde, and generators that keep the ranges.

use super::*;

#[cfg(feature = "serde")]
mod with_serde {
    use super::*;
    use serde::Deserialize;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, MapDeserializer};

    #[test]
    fn a_quantity_is_read_as_its_raw_value_and_checked() {
        let read = |raw: i32| SteerAngle::deserialize(IntoDeserializer::<Error>::into_deserializer(raw));
        assert_eq!(read(-300), Ok(SteerAngle::MIN));
        assert!(read(301).is_err() && read(-301).is_err() && read(65_536).is_err());
    }

    #[test]
    fn an_enumeration_is_read_by_its_name() {
        let read = |name: &'static str| {
            MissionStatus::deserialize(IntoDeserializer::<Error>::into_deserializer(name))
        };
        for status in MissionStatus::ALL {
            assert_eq!(read(status.name()), Ok(status));
        }
        assert!(read("Running").is_err());
    }

    #[test]
    fn a_message_is_read_by_its_fields() {
        let read = |field: &'static str, raw: i32| {
            Ai2VcuSteer::deserialize(MapDeserializer::<_, Error>::new([(field, raw)].into_iter()))
        };
        assert_eq!(read("steer_request", 300), Ok(Ai2VcuSteer { steer_request: SteerAngle::MAX }));
        assert!(read("steer_request", 301).is_err());
        assert!(read("STEER_REQUEST_deg", 240).is_err());
    }
}

#[cfg(feature = "arbitrary")]
#[test]
fn arbitrary_messages_keep_their_ranges() {
    let mut numbers = Random::with_seed(0x5EED_0004);
    let mut seen = [false; AnyMessage::IDS.len()];
    for _ in 0..5_000 {
        let bytes: Vec<u8> =
            std::iter::repeat_with(|| numbers.next().to_le_bytes()).take(16).flatten().collect();
        let message: AnyMessage = arbitrary::Unstructured::new(&bytes).arbitrary().expect("enough bytes");
        round_trip(message);
        mark(&mut seen, &message);
    }
    assert_eq!(seen, [true; AnyMessage::IDS.len()]);
}

#[cfg(feature = "proptest")]
#[test]
fn proptest_messages_keep_their_ranges() {
    use proptest::prelude::{Strategy, any};
    use proptest::strategy::ValueTree;

    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut seen = [false; AnyMessage::IDS.len()];
    for _ in 0..5_000 {
        let message = any::<AnyMessage>().new_tree(&mut runner).expect("nothing is filtered").current();
        round_trip(message);
        mark(&mut seen, &message);
    }
    assert_eq!(seen, [true; AnyMessage::IDS.len()]);
}

/// What an edition can say is read as it was sent, and of what it cannot say it sends what it can.
#[cfg(any(feature = "arbitrary", feature = "proptest"))]
fn round_trip(message: AnyMessage) {
    for bus in buses() {
        let Some(frame) = bus.encode(message) else {
            assert_eq!((bus.message(message.id()), bus.holds(message)), (None, false));
            continue;
        };
        let read = bus.decode(frame.id, frame.data()).expect("what is sent is allowed");
        assert_eq!(read == message, bus.holds(message), "{message:?}");
        assert!(bus.holds(read));
    }
}

#[cfg(any(feature = "arbitrary", feature = "proptest"))]
fn mark(seen: &mut [bool; AnyMessage::IDS.len()], message: &AnyMessage) {
    let place = AnyMessage::IDS.iter().position(|&id| id == message.id());
    seen[place.expect("in the list")] = true;
}
