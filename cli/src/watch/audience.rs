//! Who hears besides the judge: the log that is recorded, and pages.

use std::path::Path;

use adsdv_oracle::candump::{Dropped, Record};

use super::record::Recorder;
use super::web::Pages;

/// All of them, if there are any.
#[derive(Default)]
pub(super) struct Audience {
    pub(super) recorder: Option<Recorder>,
    pub(super) pages: Option<Pages>,
}

impl Audience {
    /// Where it is recorded.
    pub(super) fn log(&self) -> Option<&Path> {
        self.recorder.as_ref().map(Recorder::path)
    }

    /// A frame was heard.
    pub(super) fn frame(&mut self, frame: &Record<'_>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.frame(frame);
        }
        if let Some(pages) = &mut self.pages {
            pages.frame(frame);
        }
    }

    /// Frames were lost before the next one.
    pub(super) fn dropped(&mut self, dropped: &Dropped<'_>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.dropped(dropped);
        }
        if let Some(pages) = &mut self.pages {
            pages.dropped(dropped);
        }
    }

    /// Has what was heard reach the file, if it has waited for long.
    pub(super) fn flush_now_and_then(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.flush_now_and_then();
        }
    }
}
