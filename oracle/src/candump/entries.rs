//! What every log comes down to, whatever its format: entries, one after the other.

use super::{Dropped, LineError, ReadError, Record, Unit};

/// What a log has in store: a frame, word of frames that are missing, or a line that is neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry<'a> {
    /// A line that was read.
    Frame(Record<'a>),
    /// Frames were lost before the next one.
    Dropped(Dropped<'a>),
    /// A line that was passed over.
    Broken(LineError),
}

/// A log that hands out its entries one after the other.
///
/// That of `candump -L` is a [`Reader`](super::Reader). Readers of other formats are in a crate of their own; the judge asks for no more
/// than this.
///
/// ```
/// use adsdv_oracle::candump::{Entries, Entry, FrameKind, ReadError, Record, Unit};
///
/// /// A log of three frames, from nowhere.
/// struct Three(u64);
///
/// impl Entries for Three {
///     fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
///         let kind = FrameKind::Standard;
///         let frame = |line: u64| Record {
///             line, time_ns: 0, interface: "can0", kind, id: 0x520, data: &[0, 0, 1], direction: None, terminated: true,
///         };
///         self.0 += 1;
///         Ok((self.0 <= 3).then(|| Entry::Frame(frame(self.0))))
///     }
///     fn count(&self) -> u64 {
///         self.0.min(3)
///     }
///     fn unit(&self) -> Unit {
///         Unit::Object
///     }
/// }
///
/// let report = adsdv_oracle::log::judge_entries(Three(0), &Default::default(), |_| {})?.0;
/// assert_eq!(report.frames, 3);
/// # Ok::<(), adsdv_oracle::log::LogError>(())
/// ```
pub trait Entries {
    /// The next entry; `None` at the end of the log.
    ///
    /// # Errors
    ///
    /// Fails when the source does, after every complete entry that it gave. What cannot be read though the source gave it is no
    /// failure but an [`Entry::Broken`].
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError>;

    /// Number of the last line, or of what the log is made of instead, that was read; 0 before the first.
    fn count(&self) -> u64;

    /// What the log is made of.
    fn unit(&self) -> Unit {
        Unit::Line
    }
}

impl<E: Entries + ?Sized> Entries for &mut E {
    #[inline]
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        (**self).next_entry()
    }

    fn count(&self) -> u64 {
        (**self).count()
    }

    fn unit(&self) -> Unit {
        (**self).unit()
    }
}
