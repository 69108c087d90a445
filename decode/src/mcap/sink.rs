//! Takes decoded frames, and makes a file of them.

use std::io::BufWriter;

use adsdv_oracle::candump::{Dropped, Entry};

use super::judged::{Findings, State};
use super::topics::Topics;
use super::writer::McapWriter;
use crate::bus::Bus;
use crate::out::Writer;
use crate::{Catalog, Frame, Options, Sink, SinkError};

/// Writes MCAP.
pub(super) struct McapFile<'a> {
    writer: McapWriter<BufWriter<Writer<'a>>>,
    bus: Bus,
    topics: Topics<'a>,
    state: State,
    findings: Findings,
    before_1970: u64,
}

impl<'a> McapFile<'a> {
    pub(super) fn new(catalog: &'a Catalog, options: &Options, writer: Writer<'a>) -> Self {
        let mut writer = McapWriter::new(BufWriter::new(writer));
        let state = State::begin(catalog.edition(), &mut writer);
        let findings = Findings::begin(options, &mut writer);
        let topics = Topics::begin(catalog, &mut writer);
        Self { writer, bus: Bus::default(), topics, state, findings, before_1970: 0 }
    }
}

impl Sink for McapFile<'_> {
    fn heard(&mut self, entry: &Entry<'_>) -> Result<(), SinkError> {
        Ok(self.findings.heard(&mut self.writer, entry)?)
    }

    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        self.before_1970 += u64::from(frame.record.time_ns < 0);
        self.topics.frame(&mut self.writer, frame)?;
        let is_judged = self.bus.has(frame);
        self.topics.signals(&mut self.writer, frame, is_judged)?;
        if is_judged {
            self.state.frame(&mut self.writer, frame.record, self.bus.name())?;
        }
        Ok(())
    }

    fn dropped(&mut self, dropped: &Dropped<'_>) -> Result<(), SinkError> {
        self.state.dropped(dropped);
        Ok(())
    }

    fn finish(&mut self, lines: u64) -> Result<(), SinkError> {
        self.state.finish(&mut self.writer)?;
        self.findings.finish(&mut self.writer, lines)?;
        Ok(self.writer.finish()?)
    }

    fn notes(&self) -> Vec<String> {
        let counted = [
            (
                self.topics.frames_left_out,
                "frames are not in the file as they were: they are of CAN XL, or of too many interfaces",
            ),
            (
                self.topics.signals_left_out,
                "frames are in the file without their signals: there are too many interfaces",
            ),
            (
                self.before_1970,
                "frames have a time before 1970, which MCAP cannot tell; they stand at its begin",
            ),
        ];
        let counted = counted.iter().filter(|(count, _)| *count > 0);
        counted.map(|(count, what)| format!("{count} {what}")).collect()
    }
}
