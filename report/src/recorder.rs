//! Keeps what the judge sees: a log that writes down its frames while somebody else reads it.

use adsdv_oracle::candump::{Entries, Entry, FrameKind, ReadError, Record, Unit};

use crate::clock::Clock;
use crate::recording::{Kept, Lost, Recording};

/// So many interfaces are kept apart; a log can name any number.
const MAX_INTERFACES: usize = 64;

/// A log that keeps its frames, in 24 bytes each, while the judge reads it.
///
/// ```
/// use adsdv_oracle::candump::Reader;
/// use adsdv_oracle::log::judge_recognised;
/// use adsdv_report::Recorder;
///
/// let log = "(1.0) can0 520#0000010000000000\n(1.01) can0 520#0000020000000000\n(1.02) can1 7FF#\n";
/// let mut recorder = Recorder::new(Reader::new(log.as_bytes()), 50);
/// let judged = judge_recognised(&mut recorder, &Default::default(), |_| {})?;
/// let recording = recorder.finish(judged.interface.as_deref());
/// assert_eq!((judged.report.frames, recording.frames.len()), (3, 2));
/// assert_eq!((recording.interface.as_deref(), recording.others), (Some("can0"), 1));
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
#[derive(Debug)]
pub struct Recorder<E> {
    entries: E,
    clock: Clock,
    interfaces: Vec<String>,
    frames: Vec<Kept>,
    drops: Vec<(String, Lost)>,
    /// Frames that are of no kind that the interface uses.
    others: u64,
}

impl<E> Recorder<E> {
    /// Nothing was read yet. `window_ms` is the judge's: frames that are shuffled by no more are not a clock that was set back.
    pub fn new(entries: E, window_ms: u32) -> Self {
        Self {
            entries,
            clock: Clock::new(window_ms),
            interfaces: Vec::new(),
            frames: Vec::new(),
            drops: Vec::new(),
            others: 0,
        }
    }

    /// What was kept of the interface that was judged, as [`Judged`](adsdv_oracle::log::Judged) says; of all where there is none.
    pub fn finish(self, judged: Option<&str>) -> Recording {
        let Self { interfaces, mut frames, drops, mut others, clock, .. } = self;
        let chosen = judged.and_then(|judged| interfaces.iter().position(|name| name == judged));
        let all = frames.len() as u64;
        // Where nothing is known, all that came is shown.
        if let Some(chosen) = chosen {
            frames.retain(|frame| usize::from(frame.interface) == chosen);
        }
        others += all - frames.len() as u64;
        let interface = chosen.and_then(|chosen| interfaces.get(chosen).cloned());
        let ours = |name: &String| interface.as_ref().is_none_or(|ours| ours == name);
        let drops = drops.into_iter().filter(|(name, _)| ours(name)).map(|(_, lost)| lost).collect();
        Recording { interface, frames, drops, others, end_ns: clock.now() }
    }
}

/// The place of a name among those that were heard of.
fn place(interfaces: &mut Vec<String>, name: &str) -> Option<u8> {
    let known = interfaces.iter().position(|known| known == name);
    let place = known.or_else(|| {
        let room = interfaces.len() < MAX_INTERFACES;
        room.then(|| {
            interfaces.push(name.to_owned());
            interfaces.len() - 1
        })
    });
    place.and_then(|place| u8::try_from(place).ok())
}

/// A frame, if the interface uses such.
fn kept(record: &Record<'_>, t_ns: i64, interface: u8) -> Option<Kept> {
    let (FrameKind::Standard, Ok(id), Ok(len)) =
        (record.kind, u16::try_from(record.id), u8::try_from(record.data.len()))
    else {
        return None;
    };
    let mut data = [0; 8];
    data.get_mut(..record.data.len())?.copy_from_slice(record.data);
    Some(Kept { t_ns, id, len, interface, data })
}

impl<E: Entries> Entries for Recorder<E> {
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        let entry = self.entries.next_entry()?;
        match &entry {
            Some(Entry::Frame(record)) => {
                let t_ns = self.clock.at(record.time_ns);
                let place = place(&mut self.interfaces, record.interface);
                match place.and_then(|place| kept(record, t_ns, place)) {
                    Some(frame) => self.frames.push(frame),
                    None => self.others += 1,
                }
            }
            Some(Entry::Dropped(dropped)) => {
                let lost = Lost { t_ns: self.clock.now(), count: dropped.count };
                self.drops.push((dropped.interface.to_owned(), lost));
            }
            Some(Entry::Broken(_)) | None => {}
        }
        Ok(entry)
    }

    fn count(&self) -> u64 {
        self.entries.count()
    }

    fn unit(&self) -> Unit {
        self.entries.unit()
    }
}
