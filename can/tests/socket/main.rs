//! SocketCAN as the kernel has it, on virtual buses that the tests make.
//!
//! They need root and the module vcan. Where there is none the tests report each as ignored, with the reason; with
//! `ADSDV_REQUIRE_VCAN=1` in the environment that is a failure. `ADSDV` names the command, for the tests that run it,
//! `ADSDV_SOCKETCAN_C` the stack in C that it examines, and `IP` and
//! `TC` name iproute2's programs if they are not called so. With `ADSDV_IDLE=1` the cycle has to be held as on an idle machine.

#[cfg(target_os = "linux")]
mod bus;
#[cfg(target_os = "linux")]
mod command;
#[cfg(target_os = "linux")]
mod exam;
#[cfg(target_os = "linux")]
mod load;
#[cfg(target_os = "linux")]
mod open;
#[cfg(target_os = "linux")]
mod run;
#[cfg(target_os = "linux")]
mod vcan;

#[cfg(target_os = "linux")]
fn main() {
    use libtest_mimic::{Arguments, Completion, Failed, Trial};

    let missing = vcan::missing();
    let required = std::env::var_os("ADSDV_REQUIRE_VCAN").is_some_and(|value| value == "1");
    let tests = open::TESTS
        .iter()
        .chain(bus::TESTS)
        .chain(run::TESTS)
        .chain(command::TESTS)
        .chain(exam::TESTS)
        .chain(load::TESTS);
    let trials = tests
        .map(|&(name, test)| {
            let missing = missing.clone();
            Trial::ignorable_test(name, move || match missing {
                Err(error) => Err(Failed::from(error)),
                Ok(None) => test().map_err(|error| Failed::from(error.to_string())),
                Ok(Some(why)) if required => Err(Failed::from(why)),
                Ok(Some(why)) => Ok(Completion::ignored_with(why)),
            })
        })
        .collect();
    // They measure time, and two of them would be in each other's way.
    let arguments = Arguments { test_threads: Some(1), ..Arguments::from_args() };
    libtest_mimic::run(&arguments, trials).exit();
}

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("skipped: only Linux has SocketCAN");
}
