//! `adsdv vcu`: the reference VCU and its car on a CAN interface.

use adsdv_can::live::Vcu;
use adsdv_can::scenario::Player;
use adsdv_can::socket;
use adsdv_spec::{Interface, Machine};

use crate::args::VcuArgs;
use crate::error::Error;
use crate::status::Status;
use crate::{demo, operate, pins, plain};

pub(crate) fn run(args: &VcuArgs) -> Result<Status, Error> {
    let machine = Machine::new(Interface::V3_0, pins::answers(&args.readings)?);
    let scenario = args.scenario.as_deref().map(demo::read).transpose()?;
    let bus = socket::open(&args.interface)?;
    let vcu = Vcu::new(bus, machine, scenario.as_ref().map(Player::new));
    if !args.plain && operate::has_screen() {
        operate::on_screen(vcu, args.color)?;
    } else {
        plain::run(vcu, args.color)?;
    }
    Ok(Status::Conforms)
}
