//! Virtual buses, and a second socket on them.

use std::env;
use std::error::Error;
use std::fs;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::bus::{Event, Listen};
use libtest_mimic::Completion;
use socketcan::{
    CanDataFrame, CanErrorFrame, CanFrame, CanSocket, EmbeddedFrame as _, Id, Socket as _, StandardId,
};

/// What a test comes to.
pub(crate) type Outcome = Result<Completion, Box<dyn Error>>;
pub(crate) type Test = (&'static str, fn() -> Outcome);
pub(crate) type Tried<T = ()> = Result<T, Box<dyn Error>>;

/// Nothing here takes longer, unless it is broken.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// Fails with a text unless something holds.
macro_rules! ensure {
    ($holds:expr, $($text:tt)+) => {
        if !$holds {
            return Err(format!($($text)+).into());
        }
    };
}
pub(crate) use ensure;

/// Why there is no virtual bus here; `None` if there is. That its name is taken is no such reason, and an error.
pub(crate) fn missing() -> Result<Option<String>, String> {
    match Vcan::new().map_err(|error| error.to_string()) {
        Ok(_) => Ok(None),
        Err(error) if error.contains("File exists") => Err(error),
        Err(error) => Ok(Some(format!("no vcan here: {error}"))),
    }
}

/// Runs a program of iproute2.
fn run(variable: &str, default: &str, words: &str) -> Tried {
    let program = env::var_os(variable).unwrap_or_else(|| default.into());
    let output = Command::new(&program)
        .args(words.split_whitespace())
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("{}: {error}", program.display()))?;
    let stderr = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{default} {words}: {}", stderr.trim());
    Ok(())
}

pub(crate) fn ip(words: &str) -> Tried {
    run("IP", "ip", words)
}

pub(crate) fn tc(words: &str) -> Tried {
    run("TC", "tc", words)
}

/// A virtual bus of its own for each test, removed in the end.
pub(crate) struct Vcan(pub(crate) String);

impl Vcan {
    pub(crate) fn new() -> Tried<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        // Two runs at once are not in each other's way; with both numbers it has at most 15 bytes, as the kernel wants it.
        let name = format!("adsdv{:x}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        ip(&format!("link add {name} type vcan"))?;
        let vcan = Self(name);
        vcan.set("up")?;
        Ok(vcan)
    }

    pub(crate) fn set(&self, state: &str) -> Tried {
        ip(&format!("link set {} {state}", self.0))
    }

    pub(crate) fn delete(&self) -> Tried {
        ip(&format!("link delete {}", self.0))
    }

    pub(crate) fn add(&self) -> Tried {
        ip(&format!("link add {} type vcan", self.0))
    }

    /// The frames that were sent on it by whomever.
    pub(crate) fn sent(&self) -> Tried<u64> {
        let file = format!("/sys/class/net/{}/statistics/tx_packets", self.0);
        Ok(fs::read_to_string(file)?.trim().parse()?)
    }

    /// A second socket.
    pub(crate) fn other(&self) -> Tried<Other> {
        Ok(Other(CanSocket::open(&self.0)?))
    }
}

impl Drop for Vcan {
    fn drop(&mut self) {
        let _ = self.delete();
    }
}

/// A second socket on a bus.
pub(crate) struct Other(pub(crate) CanSocket);

impl Other {
    pub(crate) fn send(&self, id: impl Into<Id>, data: &[u8]) -> Tried {
        let frame = CanDataFrame::new(id, data).ok_or("no such frame")?;
        Ok(self.0.write_frame(&frame)?)
    }

    pub(crate) fn send_standard(&self, id: u16, data: &[u8]) -> Tried {
        self.send(StandardId::new(id).ok_or("no such identifier")?, data)
    }

    pub(crate) fn send_error(&self, class: u32, data: &[u8]) -> Tried {
        Ok(self.0.write_frame(&CanFrame::Error(CanErrorFrame::new_error(class, data)?))?)
    }
}

/// What comes next, within the patience.
pub(crate) fn next(bus: &mut impl Listen) -> Tried<Event> {
    match bus.receive(Instant::now() + PATIENCE) {
        Event::Nothing => Err("nothing came".into()),
        event => Ok(event),
    }
}

/// Waits until something holds.
pub(crate) fn wait_until(what: &str, mut holds: impl FnMut() -> bool) -> Tried {
    let begun = Instant::now();
    while !holds() {
        ensure!(begun.elapsed() < 3 * PATIENCE, "waited in vain until {what}");
        thread::sleep(Duration::from_millis(5));
    }
    Ok(())
}

/// Tries what depends on real time until the machine has time for it, at most three times. The VCU waits 50 ms for an answer: a
/// machine that does something else for so long has lost the mission, and nothing has been shown.
pub(crate) fn undisturbed(what: &str, mut try_it: impl FnMut() -> Tried<bool>) -> Outcome {
    for attempt in 1..=3 {
        if try_it()? {
            return Ok(Completion::Completed);
        }
        println!("{what}: the machine was too busy to answer in time (attempt {attempt})");
    }
    Err("the machine was too busy each time".into())
}
