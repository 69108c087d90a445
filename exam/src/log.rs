//! What was on the bus of a scenario, as a log.

use std::io::{self, Write};

use adsdv_oracle::candump::{Direction, FrameKind, Record, write_record};

use crate::session::Sent;

/// The name of the bus in logs.
const BUS: &str = "exam";

/// Writes a log as the AI Computer would have recorded it: what it sent itself is marked so.
///
/// # Errors
///
/// Fails if it cannot be written.
pub fn write_log(mut out: impl Write, sent: &[Sent]) -> io::Result<()> {
    for Sent { t_ns, by_ai, frame } in sent {
        let direction = Some(if *by_ai { Direction::Tx } else { Direction::Rx });
        let (kind, id) = (FrameKind::Standard, frame.id.into());
        let record = Record {
            line: 0,
            time_ns: *t_ns,
            interface: BUS,
            kind,
            id,
            data: frame.data(),
            direction,
            terminated: true,
        };
        write_record(&mut out, &record)?;
    }
    out.flush()
}
