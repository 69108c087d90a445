//! Every message and signal through the C interface: the table, reading and writing.

mod common;

use std::ffi::CString;
use std::ptr::null_mut;

use adsdv::adsdv_status::{self, *};
use adsdv::*;
use adsdv_spec::messages::{DecodeError, Node, SignalDef};
use adsdv_spec::{Bus, Edition};

use adsdv_tests::world::{Chance, Random};
use common::{number, outcome, text};

/// An edition, and what it has on the bus.
struct Spoken {
    number: adsdv_edition,
    edition: &'static Edition,
    bus: &'static Bus,
}

fn editions() -> impl Iterator<Item = Spoken> {
    Edition::ALL.iter().map(|edition| Spoken { number: number(edition), edition, bus: &edition.bus })
}

/// The default edition.
fn default() -> Spoken {
    Spoken { number: adsdv_edition_default(), edition: Edition::DEFAULT, bus: &Edition::DEFAULT.bus }
}

impl Spoken {
    fn message_at(&self, index: usize) -> Result<adsdv_message, (adsdv_status, String)> {
        let mut message = std::mem::MaybeUninit::uninit();
        // SAFETY: the place is one of a message, and a function that succeeds fills it.
        outcome(|error| unsafe { adsdv_message_at_in(self.number, index, message.as_mut_ptr(), error) })
            .map(|()| unsafe { message.assume_init() })
    }

    fn init(&self, id: u16) -> Result<adsdv_frame, (adsdv_status, String)> {
        let mut frame = adsdv_frame::default();
        // SAFETY: the pointer is to what it is said to be.
        outcome(|error| unsafe { adsdv_frame_init_in(self.number, &raw mut frame, id, error) })
            .map(|()| frame)
    }

    fn set(&self, frame: &mut adsdv_frame, signal: &str, raw: i32) -> Result<(), (adsdv_status, String)> {
        let signal = CString::new(signal).unwrap();
        // SAFETY: the pointers are to what they are said to be.
        outcome(|error| unsafe { adsdv_frame_set_in(self.number, frame, signal.as_ptr(), raw, error) })
    }

    /// What a frame says, and whether it is refused.
    fn decode(&self, frame: &adsdv_frame) -> (Vec<adsdv_signal>, Result<(), (adsdv_status, String)>) {
        let mut signals = Vec::with_capacity(ADSDV_MOST_SIGNALS);
        let mut count = 0;
        let outcome = outcome(|error| {
            // SAFETY: the vector has room for as many, and the count is of those that were filled.
            unsafe {
                adsdv_decode_in(
                    self.number,
                    frame,
                    signals.as_mut_ptr(),
                    ADSDV_MOST_SIGNALS,
                    &raw mut count,
                    error,
                )
            }
        });
        // SAFETY: so many were filled.
        unsafe { signals.set_len(count) };
        (signals, outcome)
    }

    fn decode_one(
        &self,
        frame: &adsdv_frame,
        name: &str,
    ) -> (Option<adsdv_signal>, Result<(), (adsdv_status, String)>) {
        let name = CString::new(name).unwrap();
        // SAFETY: all its fields are numbers, of which 0 is one.
        let mut signal: adsdv_signal = unsafe { std::mem::zeroed() };
        // SAFETY: the pointers are to what they are said to be.
        let outcome = outcome(|error| unsafe {
            adsdv_decode_signal_in(self.number, frame, name.as_ptr(), &raw mut signal, error)
        });
        ((signal.scale_den != 0).then_some(signal), outcome)
    }
}

fn same(signal: &adsdv_signal, def: &SignalDef, data: &[u8]) {
    assert_eq!(text(&signal.name), def.name);
    assert_eq!(text(&signal.unit), def.unit);
    assert_eq!((signal.min, signal.max), (def.min, def.max));
    assert_eq!((signal.scale_num, signal.scale_den), (def.scale.num(), def.scale.den()));
    assert_eq!((signal.start, signal.width), (def.start, def.width));
    let raw = def.raw(data);
    assert_eq!(
        (signal.present == 1, signal.allowed == 1),
        (raw.is_some(), raw.is_some_and(|raw| def.allows(raw)))
    );
    assert_eq!(text(&signal.text), raw.map_or(String::new(), |raw| def.display(raw).to_string()));
    assert_eq!(
        (signal.raw, signal.physical.to_bits()),
        raw.map_or((0, 0), |raw| (raw, def.physical(raw).to_bits()))
    );
}

#[test]
fn a_signal_is_known_by_the_names_of_other_editions() {
    let frame = adsdv_frame { id: 0x513, len: 8, data: [0x9C, 0xFF, 0, 0, 0, 0, 0, 0] };
    for spoken in editions() {
        for name in ["STEER_REQUEST_deg", "STEER_REQUEST"] {
            let (signal, outcome) = spoken.decode_one(&frame, name);
            assert_eq!((signal.map(|signal| signal.raw), outcome), (Some(-100), Ok(())), "{name}");
        }
    }
}

#[test]
fn the_messages_are_those_of_the_edition() {
    for spoken in editions() {
        let messages = spoken.bus.messages;
        assert_eq!(adsdv_message_count(spoken.number), messages.len());
        for (index, def) in messages.iter().enumerate() {
            let message = spoken.message_at(index).unwrap();
            assert_eq!(
                (text(&message.name).as_str(), text(&message.section).as_str()),
                (def.name, def.section)
            );
            assert_eq!((message.id, message.len), (def.id, def.len));
            assert_eq!(message.from_vcu == 1, def.sender == Node::Vcu);
            assert_eq!(usize::from(message.signals), def.signals.len());
            assert!(def.signals.len() <= ADSDV_MOST_SIGNALS);
        }
        let count = messages.len();
        let refused = Err((ADSDV_BAD_VALUE, format!("index is {count}; expected less than {count}")));
        assert_eq!(spoken.message_at(count).map(|_| ()), refused);
        assert!(spoken.message_at(usize::MAX).is_err());
    }
    assert_eq!(adsdv_message_count(default().number), ADSDV_MESSAGES);
}

#[test]
fn version_4_0_has_shorter_frames_and_120h() {
    let newer = editions().find(|spoken| spoken.edition.version == "4.0").unwrap();
    assert_eq!((default().init(0x511).unwrap().len, newer.init(0x511).unwrap().len), (8, 4));
    assert_eq!((default().init(0x120).is_err(), newer.init(0x120).map(|frame| frame.len)), (true, Ok(8)));
}

#[test]
fn the_readings_are_those_of_the_edition() {
    for spoken in editions() {
        let choices: Vec<_> = spoken.edition.choices.iter().collect();
        assert_eq!(adsdv_reading_count(spoken.number), choices.len());
        for (index, choice) in choices.iter().enumerate() {
            // SAFETY: all its fields are numbers, of which 0 is one.
            let mut reading: adsdv_reading = unsafe { std::mem::zeroed() };
            // SAFETY: the pointer is to what it is said to be.
            outcome(|error| unsafe { adsdv_reading_at_in(spoken.number, index, &raw mut reading, error) })
                .unwrap();
            assert_eq!(text(&reading.name), choice.to_string());
            assert_eq!(text(&reading.text), choice.text());
            assert_eq!(text(&reading.question), choice.reading().question());
            assert_eq!(text(&reading.section), choice.reading().section());
            assert_eq!(reading.is_default == 1, spoken.edition.readings.is(*choice));
        }
        // SAFETY: NULL is refused.
        assert!(
            outcome(|error| unsafe { adsdv_reading_at_in(spoken.number, 0, null_mut(), error) }).is_err()
        );
    }
    assert_eq!(adsdv_reading_count(default().number), ADSDV_CHOICES);
}

#[test]
fn any_frame_is_read_as_the_specification_reads_it() {
    for spoken in editions() {
        frames_are_read(&spoken);
    }
}

fn frames_are_read(spoken: &Spoken) {
    let mut random = Random::with_seed(1);
    let mut outcomes = [0; 3];
    for _ in 0..20_000 {
        let id = random.pick(spoken.bus.messages).id;
        let len = random.pick(&[8, 8, 8, 0, 1, 2, 3, 4, 5, 6, 7]);
        let mask = random.pick(&[u64::MAX, 0x0101_0101_0101_0101, 0x0003_0003_0003_0003, 0x1111]);
        let frame = adsdv_frame { id, len, data: (random.bits() & mask).to_le_bytes() };
        let data = &frame.data[..usize::from(len)];
        let (signals, outcome) = spoken.decode(&frame);
        let expected = spoken.bus.decode(id, data);
        let said = outcome.as_ref().err().map(|(_, text)| text.clone());
        assert_eq!(said, expected.as_ref().err().map(ToString::to_string));
        let status = outcome.err().map_or(ADSDV_OK, |(status, _)| status);
        let (place, right) = match expected {
            Ok(_) => (0, ADSDV_OK),
            Err(DecodeError::TooShort { .. }) => (1, ADSDV_TOO_SHORT),
            Err(_) => (2, ADSDV_BAD_VALUE),
        };
        assert_eq!(status, right);
        outcomes[place] += 1;

        let def = spoken.bus.messages.iter().find(|def| def.id == id).unwrap();
        assert_eq!(signals.len(), def.signals.len());
        for (signal, row) in signals.iter().zip(def.signals) {
            same(signal, row, data);
            let (one, outcome) = spoken.decode_one(&frame, row.name);
            same(&one.expect("it is written all the same"), row, data);
            assert_eq!(outcome.is_ok(), signal.allowed == 1);
        }
    }
    assert!(outcomes.iter().all(|&count| count > 500), "{outcomes:?}");
}

#[test]
fn a_frame_begins_as_the_message_does_by_default() {
    use adsdv_spec::messages::*;
    macro_rules! each {
        ($($message:ident)+) => {$(
            for spoken in editions() {
                match spoken.bus.encode($message::default()) {
                    Some(frame) => assert_eq!(spoken.init($message::ID).unwrap(), frame.into()),
                    None => assert_eq!(spoken.init($message::ID).unwrap_err().0, ADSDV_UNKNOWN_ID),
                }
            }
        )+};
    }
    each! {
        VcuStatus Vcu2LogDynamics1 Ai2LogDynamics2 Vcu2LogStatus Ai2VcuStatus Ai2VcuDriveF Ai2VcuDriveR Ai2VcuSteer Ai2VcuBrake
        Vcu2AiStatus Vcu2AiDriveF Vcu2AiDriveR Vcu2AiSteer Vcu2AiBrake Vcu2AiWheelSpeeds Vcu2AiWheelCounts
    }
    assert_eq!(
        default().init(0x527),
        Err((ADSDV_UNKNOWN_ID, "527h is not the identifier of a message of section 2".to_owned()))
    );
}

#[test]
fn every_value_that_is_written_is_read() {
    for spoken in editions() {
        values_are_read(&spoken);
    }
    let spoken = default();
    let mut frame = spoken.init(0x513).unwrap();
    assert_eq!(
        spoken.set(&mut frame, "STEER", 0),
        Err((ADSDV_UNKNOWN_NAME, "AI2VCU_Steer has no signal \"STEER\"".to_owned()))
    );
    frame.len = 1;
    let (status, _) = spoken.set(&mut frame, "STEER_REQUEST_deg", 0).unwrap_err();
    assert_eq!(status, ADSDV_TOO_SHORT);
}

fn values_are_read(spoken: &Spoken) {
    for def in spoken.bus.messages {
        for signal in def.signals {
            let mut values: Vec<i32> = signal.values.iter().map(|&(value, _)| value).collect();
            values.extend([signal.min, signal.max]);
            for raw in values {
                let mut frame = spoken.init(def.id).unwrap();
                spoken.set(&mut frame, signal.name, raw).unwrap();
                let (read, outcome) = spoken.decode(&frame);
                assert_eq!(outcome, Ok(()));
                assert!(read.iter().any(|read| text(&read.name) == signal.name && read.raw == raw));
            }
            for raw in [signal.min.wrapping_sub(1), signal.max.wrapping_add(1), i32::MIN, i32::MAX] {
                let mut frame = spoken.init(def.id).unwrap();
                let before = frame;
                let refused = signal.check(raw).unwrap_err().to_string();
                assert_eq!(spoken.set(&mut frame, signal.name, raw), Err((ADSDV_BAD_VALUE, refused)));
                assert_eq!(frame, before);
            }
        }
    }
}

#[test]
fn an_array_that_is_too_small_is_left_alone() {
    let frame = default().init(0x520).unwrap();
    let mut count = 99;
    // SAFETY: all its fields are numbers, of which 0 is one.
    let mut signals: [adsdv_signal; 2] = unsafe { std::mem::zeroed() };
    // SAFETY: the pointers are to what they are said to be.
    let outcome = outcome(|error| unsafe {
        adsdv_decode(&raw const frame, signals.as_mut_ptr(), 2, &raw mut count, error)
    });
    assert_eq!(outcome, Err((ADSDV_NO_ROOM, "signals has room for 2; expected 23".to_owned())));
    assert_eq!((count, signals[0].scale_den), (99, 0));
}

#[test]
fn reserved_identifiers_are_those_of_the_edition() {
    for Spoken { number, bus, .. } in editions() {
        for id in 0..=u16::MAX {
            assert_eq!(adsdv_is_reserved_in(number, id.into()), bus.is_reserved(id), "{id:X}");
        }
        assert!(!adsdv_is_reserved_in(number, 0x1_0000));
    }
    assert!(!adsdv_is_reserved_in(adsdv_edition::MAX, 0));
}

/// What has no edition in it is about the default.
#[test]
fn functions_without_an_edition_are_about_the_default() {
    let spoken = default();
    for id in 0..0x800 {
        assert_eq!(adsdv_is_reserved(id), spoken.bus.is_reserved(u16::try_from(id).unwrap()));
    }
    for index in 0..=ADSDV_MESSAGES {
        // SAFETY: all its fields are numbers, of which 0 is one.
        let mut message: adsdv_message = unsafe { std::mem::zeroed() };
        // SAFETY: the pointer is to what it is said to be.
        let outcome = outcome(|error| unsafe { adsdv_message_at(index, &raw mut message, error) });
        assert_eq!(outcome.map(|()| message.id), spoken.message_at(index).map(|message| message.id));
    }
    for index in 0..=ADSDV_CHOICES {
        // SAFETY: all its fields are numbers, of which 0 is one.
        let mut reading: adsdv_reading = unsafe { std::mem::zeroed() };
        // SAFETY: the pointer is to what it is said to be.
        let outcome = outcome(|error| unsafe { adsdv_reading_at(index, &raw mut reading, error) });
        let choice = spoken.edition.choices.iter().nth(index);
        assert_eq!(outcome.ok().map(|()| text(&reading.name)), choice.map(|choice| choice.to_string()));
    }
    for id in [0x120, 0x511, 0x513] {
        let mut frame = adsdv_frame::default();
        // SAFETY: the pointers are to what they are said to be.
        let made = outcome(|error| unsafe { adsdv_frame_init(&raw mut frame, id, error) });
        assert_eq!(made.map(|()| frame), spoken.init(id));
    }
    // -22 degrees, which is too much for some editions, in a frame that is as long as the default has it.
    let mut frame = adsdv_frame { id: 0x513, len: 8, data: [0; 8] };
    let (name, mut count) = (c"STEER_REQUEST_deg".as_ptr(), 0);
    // SAFETY: all its fields are numbers, of which 0 is one.
    let mut signals: [adsdv_signal; 2] = unsafe { std::mem::zeroed() };
    let places = signals.as_mut_ptr();
    // SAFETY: the pointers are to what they are said to be.
    unsafe {
        outcome(|error| adsdv_frame_set(&raw mut frame, name, -220, error)).unwrap();
        outcome(|error| adsdv_decode_signal(&raw const frame, name, places, error)).unwrap();
        outcome(|error| adsdv_decode(&raw const frame, places.add(1), 1, &raw mut count, error)).unwrap();
    }
    assert_eq!((signals[0].raw, signals[1].raw, count), (-220, -220, 1));
}
