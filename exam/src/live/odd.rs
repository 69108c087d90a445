//! Frames that are on the bus and not of the document: they are counted, as `adsdv watch` does it.

use std::collections::BTreeMap;

use adsdv_can::bus::Received;
use adsdv_can::socket::error_text;
use adsdv_oracle::candump::FrameKind;

/// The frames that are not judged, by what they are.
#[derive(Clone, Debug, Default)]
pub(super) struct OddFrames(BTreeMap<&'static str, (u64, String)>);

impl OddFrames {
    pub(super) fn count(&mut self, frame: &Received) {
        let (kind, first) = match frame.kind {
            FrameKind::Standard => return,
            FrameKind::Extended => ("with an extended identifier", format!("{:08X}h", frame.id)),
            FrameKind::Remote { .. } => ("of the remote kind", format!("{:03X}h", frame.id)),
            FrameKind::Error => ("of the error kind", error_text(frame)),
            FrameKind::Fd { .. } => ("of CAN FD", format!("{:03X}h", frame.id)),
            FrameKind::Xl => ("of CAN XL", format!("{:03X}h", frame.id)),
        };
        self.0.entry(kind).or_insert((0, first)).0 += 1;
    }

    /// A note for each sort.
    pub(super) fn notes<'a>(&'a self, scenario: &'a str) -> impl Iterator<Item = String> + 'a {
        self.0.iter().map(move |(kind, (count, first))| {
            let s = if *count == 1 { "" } else { "s" };
            format!("{scenario}: {count} frame{s} {kind}, which the document has not; the first: {first}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_sort_is_counted_with_its_first() {
        let frame = |kind, id| Received { time_ns: 0, kind, id, len: 0, data: [0; 8] };
        let mut odd = OddFrames::default();
        odd.count(&frame(FrameKind::Standard, 0x510));
        odd.count(&frame(FrameKind::Extended, 0x18FF_50E5));
        odd.count(&frame(FrameKind::Extended, 1));
        odd.count(&frame(FrameKind::Remote { extended: false, len: 0 }, 0x520));
        let notes: Vec<String> = odd.notes("ready").collect();
        assert_eq!(
            notes,
            [
                "ready: 1 frame of the remote kind, which the document has not; the first: 520h",
                "ready: 2 frames with an extended identifier, which the document has not; the first: 18FF50E5h",
            ]
        );
    }
}
