//! A bus in a network namespace of its own, so that it takes neither root nor an interface that nobody else uses.
//!
//! A user who is not root needs a user namespace for it, in which the process is root; that one is made for the whole process,
//! while it is still a single thread ([`prepare`]). Each thread that has a bus then makes a network namespace ([`enter`]), and a
//! mount namespace in which `/sys` shows its interfaces. Programs that the thread starts are in them, and all of it is gone when
//! the last of these has ended.

use std::fs;
use std::io;
use std::process::{Command, Stdio};

use nix::errno::Errno;
use nix::mount::{MsFlags, mount};
use nix::sched::{CloneFlags, unshare};
use nix::unistd::{getgid, getuid};

use super::error::LiveError;

const OPTION: &str = "--namespace";
/// What else there is where there are no namespaces.
const OR: &str = "or make a bus as root, and name it: sudo modprobe vcan && sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up";

/// Lets this process make network namespaces. It has to be called before the process has a second thread.
///
/// # Errors
///
/// The kernel does not let this user have them.
pub fn prepare() -> Result<(), LiveError> {
    // A user who may do this may do the rest as well.
    match unshare(CloneFlags::CLONE_NEWNS) {
        Ok(()) => return Ok(()),
        Err(Errno::EPERM) => {}
        Err(error) => return Err(refused(error)),
    }
    let (user, group) = (getuid(), getgid());
    unshare(CloneFlags::CLONE_NEWUSER | CloneFlags::CLONE_NEWNS).map_err(refused)?;
    // Who maps a group has given up changing groups before.
    let mapped = fs::write("/proc/self/setgroups", "deny")
        .and_then(|()| fs::write("/proc/self/uid_map", format!("0 {user} 1\n")))
        .and_then(|()| fs::write("/proc/self/gid_map", format!("0 {group} 1\n")));
    mapped.map_err(|error| restricted(&format!("the user of a namespace cannot be mapped: {error}")))
}

/// Brings this thread into namespaces of its own, with a virtual bus of this name.
pub(super) fn enter(name: &str) -> Result<(), LiveError> {
    unshare(CloneFlags::CLONE_NEWNET | CloneFlags::CLONE_NEWNS).map_err(refused)?;
    let nothing: Option<&str> = None;
    // What is mounted here is of no concern to others.
    mount(nothing, "/", nothing, MsFlags::MS_REC | MsFlags::MS_PRIVATE, nothing)
        .and_then(|()| mount(Some("sysfs"), "/sys", Some("sysfs"), MsFlags::empty(), nothing))
        .map_err(|error| {
            let why = format!("the namespace's /sys cannot be mounted: {}", io::Error::from(error));
            LiveError::new(OPTION, why, format!("run it outside of a container; {OR}"))
        })?;
    ip(&["link", "set", "lo", "up"])?;
    ip(&["link", "add", name, "type", "vcan"])?;
    ip(&["link", "set", name, "up"])
}

/// Runs iproute2, which everybody has who sets up a CAN interface.
fn ip(words: &[&str]) -> Result<(), LiveError> {
    let run = |program: &str| {
        Command::new(program)
            .args(words)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .output()
    };
    let missing = |error: &io::Error| error.kind() == io::ErrorKind::NotFound;
    let mut ran = run("ip");
    // It is there for everyone, and not in everyone's PATH.
    for folder in ["/usr/sbin/ip", "/sbin/ip"] {
        if ran.as_ref().is_err_and(missing) {
            ran = run(folder);
        }
    }
    let output = ran.map_err(|error| {
        LiveError::new(
            OPTION,
            format!("cannot run ip: {error}"),
            "install iproute2: sudo apt install iproute2",
        )
    })?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let said = said.trim().replace('\n', "; ");
    let why = format!("ip {}: {said}", words.join(" "));
    if said.contains("not permitted") {
        return Err(restricted(&why));
    }
    let hint = "this kernel has no virtual CAN, or may not load it now: sudo modprobe vcan (Ubuntu has it in linux-modules-extra)";
    Err(LiveError::new(OPTION, why, format!("{hint}; adsdv exam --stdio needs no CAN")))
}

fn refused(error: Errno) -> LiveError {
    let why = match error {
        Errno::EPERM => "this user may not have a namespace".to_owned(),
        Errno::ENOSPC | Errno::EUSERS => {
            "the system allows no more namespaces (user.max_user_namespaces)".to_owned()
        }
        Errno::ENOSYS | Errno::EINVAL => "this kernel has no such namespaces".to_owned(),
        error => format!("no namespace: {}", io::Error::from(error)),
    };
    restricted(&why)
}

/// The kernel or the distribution keeps users from it.
fn restricted(why: &str) -> LiveError {
    /// What distributions keep users from namespaces with, the value with which they do, and how it is lifted.
    const SETTINGS: [(&str, &str, &str); 3] = [
        (
            "kernel/apparmor_restrict_unprivileged_userns",
            "1",
            "sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0",
        ),
        ("kernel/unprivileged_userns_clone", "0", "sudo sysctl kernel.unprivileged_userns_clone=1"),
        ("user/max_user_namespaces", "0", "sudo sysctl user.max_user_namespaces=1000"),
    ];
    let set = SETTINGS.iter().find(|(file, value, _)| {
        fs::read_to_string(format!("/proc/sys/{file}")).is_ok_and(|is| is.trim() == *value)
    });
    let first = set.map_or("run it as root, outside of a container", |(_, _, lift)| lift);
    LiveError::new(OPTION, why, format!("{first}; {OR}"))
}
