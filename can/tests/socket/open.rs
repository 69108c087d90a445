//! What cannot be opened says why.

use adsdv_can::socket::{self, OpenError};
use libtest_mimic::Completion;

use super::vcan::{Outcome, Test, Tried, Vcan, ensure};

pub(crate) const TESTS: &[Test] = &[
    ("open::the_error_has_why_and_what_to_do", the_error_has_why_and_what_to_do),
    ("open::one_that_is_up_is_opened", is_opened),
];

fn refused(name: &str) -> Tried<OpenError> {
    socket::listen(name).err().ok_or_else(|| format!("{name:?} was opened").into())
}

fn the_error_has_why_and_what_to_do() -> Outcome {
    let (up, down) = (Vcan::new()?, Vcan::new()?);
    down.set("down")?;
    let cases = [
        ("adsdv-none".to_owned(), "there is no such interface", format!("{}, {} (down)", up.0, down.0)),
        ("lo".to_owned(), "is not a CAN interface", up.0.clone()),
        (down.0.clone(), "is down", format!("sudo ip link set {} up", down.0)),
        ("sixteen-bytes-xx".to_owned(), "16 bytes", up.0.clone()),
    ];
    for (name, why, hint) in cases {
        let error = refused(&name)?;
        ensure!(error.why.contains(why) && error.hint.contains(&hint), "{error}");
        ensure!(socket::open(&name).is_err(), "{name} was opened to send");
    }
    Ok(Completion::Completed)
}

fn is_opened() -> Outcome {
    let vcan = Vcan::new()?;
    socket::open(&vcan.0)?;
    socket::listen(&vcan.0)?;
    Ok(Completion::Completed)
}
