//! The network interfaces of this machine, as Linux shows them in `/sys/class/net`, and which of them a bus can be on.

use std::fs;
use std::path::{Path, PathBuf};

use super::OpenError;
use crate::BITRATE;

/// Where the interfaces stand.
const INTERFACES: &str = "/sys/class/net";
/// `ARPHRD_CAN` of `linux/if_arp.h`: the type of a CAN interface.
const TYPE_CAN: u32 = 280;
/// `IFF_UP` of `linux/if.h`: the flag of an interface that is up.
const FLAG_UP: u32 = 1;
/// The longest name, in bytes: `IFNAMSIZ` without the zero at its end.
const LONGEST_NAME: usize = 15;

/// How a virtual bus is made.
const MAKE_ONE: &str = "make a virtual one: sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up; or try `adsdv demo`, \
     which needs none";

/// The interfaces that a folder shows.
#[derive(Clone, Debug)]
pub(super) struct Interfaces {
    folder: PathBuf,
}

/// How an interface stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// There is none of this name, or it is not a CAN interface.
    Gone,
    /// It is down.
    Down {
        /// The number that the kernel knows it by. One that was made anew has another.
        index: u32,
    },
    /// It is up.
    Up {
        /// As above.
        index: u32,
    },
}

impl Default for Interfaces {
    fn default() -> Self {
        Self { folder: INTERFACES.into() }
    }
}

impl Interfaces {
    /// The number of the interface, if a bus can be on it, or why none can.
    pub(super) fn usable(&self, name: &str) -> Result<u32, OpenError> {
        self.check_name(name)?;
        let error = |why: &str, hint: String| OpenError { what: name.to_owned(), why: why.to_owned(), hint };
        if !self.folder.join(name).exists() {
            return Err(error("there is no such interface", self.others()));
        }
        if self.number(name, "type", 10) != Some(TYPE_CAN) {
            return Err(error("is not a CAN interface", self.others()));
        }
        match self.state(name) {
            State::Up { index } => Ok(index),
            State::Down { .. } => Err(error("is down; expected an interface that is up", self.set_up(name))),
            State::Gone => Err(error("has just been removed", self.others())),
        }
    }

    /// How an interface stands.
    pub(super) fn state(&self, name: &str) -> State {
        let is_can = self.number(name, "type", 10) == Some(TYPE_CAN);
        match (self.number(name, "ifindex", 10), self.number(name, "flags", 16)) {
            (Some(index), Some(flags)) if is_can && flags & FLAG_UP != 0 => State::Up { index },
            (Some(index), Some(_)) if is_can => State::Down { index },
            _ => State::Gone,
        }
    }

    /// The kernel's rules for names, so that nothing else is looked for in the folder.
    fn check_name(&self, name: &str) -> Result<(), OpenError> {
        let odd = |c: char| c.is_whitespace() || c.is_control() || matches!(c, '/' | ':');
        let why = if name.is_empty() {
            "the name of the interface is empty".to_owned()
        } else if name.len() > LONGEST_NAME {
            format!("the name has {} bytes; expected at most {LONGEST_NAME}", name.len())
        } else if let Some(odd) = name.chars().find(|&c| odd(c)) {
            format!("the name has {odd:?} in it, which no interface has")
        } else if matches!(name, "." | "..") {
            "is no name of an interface".to_owned()
        } else {
            return Ok(());
        };
        Err(OpenError { what: format!("interface {name:?}"), why, hint: self.others() })
    }

    /// The CAN interfaces that there are, those that are up first.
    fn others(&self) -> String {
        let names = |up: bool| {
            let mut names: Vec<String> = fs::read_dir(&self.folder)
                .into_iter()
                .flatten()
                .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
                .filter(|name| match self.state(name) {
                    State::Up { .. } => up,
                    State::Down { .. } => !up,
                    State::Gone => false,
                })
                .collect();
            names.sort();
            names
        };
        let down = names(false).into_iter().map(|name| name + " (down)");
        let names: Vec<String> = names(true).into_iter().chain(down).collect();
        match names.as_slice() {
            [] => format!("there is no CAN interface here; {MAKE_ONE}"),
            [one] => format!("the only CAN interface here is {one}"),
            names => format!("the CAN interfaces here are {}", names.join(", ")),
        }
    }

    /// How an interface is set up. One of hardware needs to know how fast its bus is.
    fn set_up(&self, name: &str) -> String {
        let hardware = self.folder.join(name).join("device").exists();
        let rate = if hardware { format!(" type can bitrate {BITRATE}") } else { String::new() };
        format!("sudo ip link set {name} up{rate}")
    }

    fn number(&self, name: &str, what: &str, radix: u32) -> Option<u32> {
        let text = fs::read_to_string(self.folder.join(Path::new(name)).join(what)).ok()?;
        let digits = text.trim().trim_start_matches("0x");
        u32::from_str_radix(digits, radix).ok()
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error;

    use super::*;

    /// A folder of interfaces, removed in the end.
    struct Machine(Interfaces);

    impl Machine {
        fn new(test: &str) -> std::io::Result<Self> {
            let folder = std::env::temp_dir().join(format!("adsdv-{test}-{}", std::process::id()));
            fs::create_dir_all(&folder)?;
            Ok(Self(Interfaces { folder }))
        }

        fn add(&self, name: &str, kind: u32, flags: &str, hardware: bool) -> std::io::Result<()> {
            let folder = self.0.folder.join(name);
            fs::create_dir_all(&folder)?;
            fs::write(folder.join("type"), format!("{kind}\n"))?;
            fs::write(folder.join("flags"), format!("{flags}\n"))?;
            fs::write(folder.join("ifindex"), "7\n")?;
            if hardware {
                fs::create_dir_all(folder.join("device"))?;
            }
            Ok(())
        }

        fn refuses(&self, name: &str) -> OpenError {
            self.0.usable(name).expect_err(name)
        }
    }

    impl Drop for Machine {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0.folder);
        }
    }

    #[test]
    fn an_interface_that_cannot_be_used_is_refused_with_why_and_what_to_do() -> Result<(), Box<dyn Error>> {
        let machine = Machine::new("interfaces")?;
        let none = machine.refuses("can0");
        assert_eq!((none.what.as_str(), none.why.as_str()), ("can0", "there is no such interface"));
        assert!(
            none.hint.starts_with("there is no CAN interface here; make a virtual one: sudo ip"),
            "{none}"
        );

        machine.add("lo", 772, "0x9", false)?;
        machine.add("can0", 280, "0x40080", true)?;
        machine.add("vcan1", 280, "0x80", false)?;
        assert_eq!(machine.refuses("lo").why, "is not a CAN interface");
        assert_eq!(machine.refuses("eth0").hint, "the CAN interfaces here are can0 (down), vcan1 (down)");
        assert_eq!(machine.refuses("can0").hint, "sudo ip link set can0 up type can bitrate 500000");
        assert_eq!(machine.refuses("vcan1").hint, "sudo ip link set vcan1 up");
        assert_eq!(machine.refuses("vcan1").why, "is down; expected an interface that is up");

        machine.add("vcan1", 280, "0x400c1", false)?;
        assert_eq!(machine.0.usable("vcan1"), Ok(7));
        assert_eq!(machine.refuses("vcan2").hint, "the CAN interfaces here are vcan1, can0 (down)");
        fs::write(machine.0.folder.join("vcan1/ifindex"), "rubbish")?;
        assert_eq!(machine.refuses("vcan1").why, "has just been removed");
        Ok(())
    }

    #[test]
    fn what_is_no_name_is_refused_before_it_is_looked_for() -> Result<(), Box<dyn Error>> {
        let machine = Machine::new("names")?;
        let cases = [
            ("", "is empty"),
            ("sixteen-bytes-xx", "16 bytes; expected at most 15"),
            ("ääääääää", "16 bytes"),
            ("can 0", "' ' in it"),
            ("can\n0", "'\\n' in it"),
            ("\u{1b}[2Jcan0", "'\\u{1b}' in it"),
            ("../can0", "'/' in it"),
            ("can0:1", "':' in it"),
            (".", "no name"),
            ("..", "no name"),
        ];
        for (name, why) in cases {
            let error = machine.refuses(name);
            assert!(error.why.contains(why), "{error}");
            assert_eq!(error.what, format!("interface {name:?}"));
        }
        machine.add("fifteen-bytes-x", 280, "0x1", false)?;
        assert_eq!(machine.0.usable("fifteen-bytes-x"), Ok(7));
        Ok(())
    }
}
