//! A recording, decoded: first it tells its edition, then frame after frame goes to a sink.

use std::fmt;

use adsdv_oracle::candump::{Entries, Entry, LineError, ReadError, Record};
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{LogError, LogJudge, LogOptions};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::Edition;

use crate::kept::Kept;
use crate::{Catalog, Frame, Sink, SinkError};

/// How many lines are read between two calls of the progress function.
const PROGRESS_LINES: u64 = 1 << 16;

/// Which frames, and by which edition.
#[derive(Clone, Debug)]
pub struct Options {
    /// The edition; `None` if the frames are to tell.
    pub edition: Option<&'static Edition>,
    /// The edition of frames that do not tell.
    pub default: &'static Edition,
    /// The interface of which frames are decoded; `None` for all.
    pub interface: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self { edition: None, default: Edition::DEFAULT, interface: None }
    }
}

/// A recording of which the edition is known: see [`Recording::begin`].
pub struct Recording<'a> {
    // Any kind of log: what reads on is compiled here, once, and not with each caller for each kind.
    entries: Box<dyn Entries + 'a>,
    interface: Option<String>,
    /// What was read so far.
    kept: Vec<Kept>,
    recognised: Recognised,
    /// Why no more can be read.
    failure: Option<ReadError>,
    ended: bool,
}

/// What came of a recording.
#[derive(Debug, Default)]
pub struct Summary {
    /// How many frames were decoded, or handed on as bytes.
    pub frames: u64,
    /// How many of these nothing knows.
    pub unknown: u64,
    /// How many lines could not be read.
    pub broken: u64,
    /// The first of them.
    pub first_broken: Option<LineError>,
    /// How many frames the recording says were lost.
    pub dropped: u64,
    /// Why not all of it could be read.
    pub failure: Option<ReadError>,
}

/// Why a recording was not decoded to its end.
#[derive(Debug)]
pub enum DecodeError {
    /// It has no frame, or none that was asked for.
    Log(LogError),
    /// What was decoded could not be written.
    Sink(SinkError),
}

impl From<SinkError> for DecodeError {
    fn from(error: SinkError) -> Self {
        Self::Sink(error)
    }
}

impl<'a> Recording<'a> {
    /// Reads on until the edition is known; with one that is given, to the first frame.
    ///
    /// The edition is recognised as `adsdv check` recognises it: that takes a second of the recording, or up to ten.
    ///
    /// # Errors
    ///
    /// Fails if there is no frame, or the source fails before the first one.
    pub fn begin(entries: impl Entries + 'a, options: &Options) -> Result<Self, LogError> {
        Self::begins(Box::new(entries), options)
    }

    fn begins(mut entries: Box<dyn Entries + 'a>, options: &Options) -> Result<Self, LogError> {
        let edition = options.edition.unwrap_or(options.default);
        let judge = JudgeOptions::of(edition);
        let judging = LogOptions { judge, interface: options.interface.clone(), ..LogOptions::default() };
        let mut judge = LogJudge::recognising(judging);
        let (mut kept, mut first_broken, mut frames) = (Vec::new(), None, 0_u64);
        let (mut failure, mut ended) = (None, false);
        while judge.recognised().is_none() && !(options.edition.is_some() && frames > 0) {
            match entries.next_entry() {
                Ok(Some(entry)) => {
                    kept.push(Kept::of(&entry));
                    match entry {
                        Entry::Frame(record) => {
                            frames += 1;
                            judge.frame(&record);
                        }
                        Entry::Dropped(_) => {}
                        Entry::Broken(error) => {
                            first_broken.get_or_insert(error);
                            // Rubbish without end is not kept.
                            judge.broken(error);
                        }
                    }
                }
                Ok(None) => {
                    ended = true;
                    judge.decide();
                }
                Err(error) if frames == 0 => return Err(LogError::Read(error)),
                Err(error) => {
                    failure = Some(error);
                    judge.decide();
                }
            }
        }
        if frames == 0 && ended {
            return Err(LogError::NoFrame { lines: entries.count(), first: first_broken });
        }
        let recognised = match options.edition {
            Some(edition) => Recognised::named(edition),
            None => judge.recognised().cloned().unwrap_or_else(|| Recognised::named(edition)),
        };
        Ok(Self { entries, interface: options.interface.clone(), kept, recognised, failure, ended })
    }

    /// The edition, and how it was recognised.
    pub const fn recognised(&self) -> &Recognised {
        &self.recognised
    }

    /// Decodes every frame, and finishes the sink.
    ///
    /// Where the source fails in the middle, what came before is decoded, and the summary has the failure.
    ///
    /// # Errors
    ///
    /// Fails if the sink does, or if there is no frame of the interface that was asked for.
    pub fn decode(
        self,
        catalog: &Catalog,
        sink: &mut dyn Sink,
        mut progress: impl FnMut(u64),
    ) -> Result<Summary, DecodeError> {
        self.decodes(catalog, sink, &mut progress)
    }

    fn decodes(
        mut self,
        catalog: &Catalog,
        sink: &mut dyn Sink,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Summary, DecodeError> {
        let mut decoding = Decoding {
            catalog,
            sink,
            interface: self.interface.take(),
            others: Vec::new(),
            summary: Summary { failure: self.failure.take(), ..Summary::default() },
        };
        for kept in std::mem::take(&mut self.kept) {
            decoding.entry(&kept.entry())?;
        }
        let mut next_progress = PROGRESS_LINES;
        while !self.ended && decoding.summary.failure.is_none() {
            match self.entries.next_entry() {
                Ok(Some(entry)) => {
                    if let Entry::Frame(record) = &entry
                        && record.line >= next_progress
                    {
                        next_progress = record.line + PROGRESS_LINES;
                        progress(record.line);
                    }
                    decoding.entry(&entry)?;
                }
                Ok(None) => self.ended = true,
                Err(error) => decoding.summary.failure = Some(error),
            }
        }
        decoding.end(self.entries.count())
    }
}

impl fmt::Debug for Recording<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { entries: _, interface, kept, recognised, failure, ended } = self;
        f.debug_struct("Recording")
            .field("interface", interface)
            .field("kept", &kept.len())
            .field("recognised", recognised)
            .field("failure", failure)
            .field("ended", ended)
            .finish_non_exhaustive()
    }
}

/// A recording that is being decoded.
struct Decoding<'a> {
    catalog: &'a Catalog,
    sink: &'a mut dyn Sink,
    interface: Option<String>,
    /// The first few interfaces that were passed over.
    others: Vec<String>,
    summary: Summary,
}

impl Decoding<'_> {
    #[inline]
    fn entry(&mut self, entry: &Entry<'_>) -> Result<(), SinkError> {
        self.sink.heard(entry)?;
        match entry {
            Entry::Frame(record) => self.frame(record),
            Entry::Dropped(dropped) => {
                if self.interface.as_deref().is_some_and(|wanted| wanted != dropped.interface) {
                    return Ok(());
                }
                self.summary.dropped = self.summary.dropped.saturating_add(dropped.count);
                self.sink.dropped(dropped)
            }
            Entry::Broken(error) => {
                self.summary.broken += 1;
                self.summary.first_broken.get_or_insert(*error);
                Ok(())
            }
        }
    }

    #[inline]
    fn frame(&mut self, record: &Record<'_>) -> Result<(), SinkError> {
        if self.interface.as_deref().is_some_and(|wanted| wanted != record.interface) {
            self.pass_over(record);
            return Ok(());
        }
        self.summary.frames += 1;
        let place = self.catalog.place(record.kind, record.id);
        let message = place.and_then(|place| Some((place, self.catalog.messages().get(place)?)));
        self.summary.unknown += u64::from(message.is_none());
        self.sink.frame(&Frame { record, message })
    }

    #[cold]
    fn pass_over(&mut self, record: &Record<'_>) {
        const MOST: usize = 64;
        if self.others.len() < MOST && !self.others.iter().any(|other| other == record.interface) {
            self.others.push(record.interface.to_owned());
        }
    }

    fn end(self, lines: u64) -> Result<Summary, DecodeError> {
        if self.summary.frames == 0 && self.others.is_empty() {
            let first = self.summary.first_broken;
            return Err(DecodeError::Log(LogError::NoFrame { lines, first }));
        }
        self.sink.finish(lines)?;
        match self.interface {
            Some(wanted) if self.summary.frames == 0 => {
                Err(DecodeError::Log(LogError::NoSuchInterface { wanted, found: self.others }))
            }
            _ => Ok(self.summary),
        }
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Log(error) => error.fmt(f),
            Self::Sink(error) => write!(f, "cannot write what was decoded: {error}"),
        }
    }
}

impl std::error::Error for DecodeError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Log(error) => Some(error),
            Self::Sink(error) => Some(error),
        }
    }
}
