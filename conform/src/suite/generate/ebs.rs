//! The Emergency Braking System while driving: what the VCU shows as its status.

use adsdv_spec::messages::{AsState, EbsState};
use adsdv_spec::{Atom, Machine};

use super::{Walk, braking_by, test, walk_cycle};
use crate::suite::{Kind, Test};

/// The tests of an EBS that is no longer armed in AS_DRIVING; none where no arrow asks for it.
pub(super) fn tests(machine: &Machine) -> Option<Test> {
    let cycle = walk_cycle(machine);
    let term = braking_by(machine, Atom::EbsUnavailable).next()?;
    let walk = Walk::to(machine, AsState::Driving)
        .step(cycle, |inputs| inputs.ebs = EbsState::Triggered)
        .step(cycle, |inputs| inputs.ebs = EbsState::Unavailable)
        .step(cycle, |inputs| inputs.ebs = EbsState::Armed);
    let about = "an EBS that is triggered does nothing in AS_DRIVING, and one that is unavailable is a fault whose cause stays";
    let flag = term.fault.map(adsdv_spec::Fault::requirement);
    let ids = term.cites.requirements.iter().copied().chain(flag);
    Some(
        test(Kind::Fault, "ebs-status-in-AS_DRIVING", about, "3.7", walk)
            .checks(ids.chain(["MSG-64", "D-15", "D-17", "D-55"])),
    )
}
