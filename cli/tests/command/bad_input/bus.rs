//! A CAN interface that is not there. What happens when it vanishes takes one: `can/tests/socket` has that.

use super::{refused, run};

#[test]
pub(super) fn an_interface_that_is_not_there() {
    for command in
        [&["ai"][..], &["vcu", "--plain"], &["watch"], &["watch", "--log", "no-such-folder/run.log"]]
    {
        // Why is a matter of the machine: there may be no CAN, no such interface, or no right to it.
        refused(&run(&[command, &["adsdv-none"]].concat()), "adsdv: adsdv-none: ", "");
    }
    for command in ["ai", "vcu", "watch"] {
        let outcome = run(&[command, "an-interface-of-no-kernel"]);
        refused(&outcome, "an-interface-of-no-kernel: ", "");
    }
}
