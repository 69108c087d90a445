//! A sandbox that does not let a program have a CAN socket. The kernel itself asks nobody for a permission.

#![cfg(target_os = "linux")]

use std::thread;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter, SeccompRule,
};

/// `AF_CAN` and `socket` of Linux.
const AF_CAN: u64 = nix::libc::AF_CAN as u64;
const SOCKET: i64 = nix::libc::SYS_socket;

/// What comes of opening an interface where the system call fails with this error.
fn refused(errno: i32) -> String {
    let error = u32::try_from(errno).expect("errors have small numbers");
    // In a thread of its own, which ends with the filter.
    let opened = thread::spawn(move || {
        let is_can = SeccompCondition::new(0, SeccompCmpArgLen::Dword, SeccompCmpOp::Eq, AF_CAN);
        let rule = SeccompRule::new(vec![is_can.expect("a condition")]).expect("a rule");
        let filter = SeccompFilter::new(
            [(SOCKET, vec![rule])].into_iter().collect(),
            SeccompAction::Allow,
            SeccompAction::Errno(error),
            std::env::consts::ARCH.try_into().expect("an architecture that has filters"),
        );
        let program: BpfProgram = filter.expect("a filter").try_into().expect("a program");
        seccompiler::apply_filter(&program).expect("the kernel takes filters");
        adsdv_can::socket::open("vcan0").map(drop)
    });
    opened.join().expect("no panic").expect_err("the socket is refused").to_string()
}

#[test]
fn a_sandbox_that_refuses_the_socket_is_named() {
    for errno in [nix::libc::EPERM, nix::libc::EACCES] {
        let error = refused(errno);
        let (why, hint) = error.split_once('\n').expect("two lines");
        assert!(why.starts_with("vcan0: ") && why.contains("permi"), "{error}");
        assert!(hint.starts_with("hint: ") && hint.contains("sandbox"), "{error}");
    }
}

#[test]
fn a_kernel_without_can_is_something_else() {
    let error = refused(nix::libc::EAFNOSUPPORT);
    assert!(error.contains("has no CAN"), "{error}");
}
