//! `adsdv ai`: a small AI Computer on a CAN interface.

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::live::AiComputer;
use adsdv_can::socket;

use crate::args::AiArgs;
use crate::error::Error;
use crate::plain;
use crate::status::Status;

pub(crate) fn run(args: &AiArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let bus = socket::open(&args.interface)?;
    plain::run(AiComputer::new(bus, Ai::new(chosen.edition(), Plan::DEFAULT)), chosen, args.color)?;
    Ok(Status::Conforms)
}
