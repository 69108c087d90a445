//! Why a recording decides nothing of a rule, for the person who can do something about it.

use std::fmt::Write as _;

use adsdv_spec::{Choice, Edition};

use super::predicate::{Predicate, Subject, SubjectKind};
use super::syntax::Form;
use crate::remote::Remote;

/// Nothing shows whether "Go" is on, but where AS_DRIVING lasts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GoHidden {
    /// What is settled of the reading that would show it.
    pub(crate) settled: Option<Choice>,
}

/// How a rule went that was never decided.
#[derive(Debug)]
pub(super) struct Course<'a> {
    pub(super) form: &'a Form<Predicate>,
    /// What it is about.
    pub(super) about: Vec<Subject>,
    /// Whether what it begins with was ever true.
    pub(super) begun: bool,
    /// Which of its predicates were ever unknown for nothing but "Go".
    pub(super) up_to_go: [bool; 3],
    /// How many times it came up, and how many of them the end of the recording left undecided.
    pub(super) undecided: [u64; 2],
    /// Whether no frame can be missing.
    pub(super) complete: bool,
}

impl Course<'_> {
    /// Why nothing can be said of it.
    pub(super) fn why(&self, edition: &Edition, hidden: Option<GoHidden>) -> String {
        if let Some(GoHidden { settled }) = hidden.filter(|_| self.is_up_to_go()) {
            return go(edition, settled);
        }
        // It is not for "Go" that nothing was known, if that is hidden.
        let missing = |one: &&Subject| !(one.came || one.is_go() && hidden.is_some());
        match self.about.iter().find(missing).map(|subject| subject.what) {
            Some(SubjectKind::Signal(place)) => {
                return format!(
                    "{} ({:03X}h) never showed {}",
                    place.message.name, place.message.id, place.signal.name
                );
            }
            Some(SubjectKind::Atom(atom)) => {
                return format!("it was never known whether {} ({atom})", edition.rules.text(atom, true));
            }
            None => {}
        }
        let [undecided, ended] = self.undecided;
        let why = match self.form {
            _ if undecided > ended && self.complete => "something that it goes by was unknown each time",
            _ if undecided > ended => {
                "something that it goes by was unknown each time: a frame may be missing; if none is, say --complete"
            }
            _ if undecided > 0 => "the recording ends before it is decided",
            Form::AtMost(..) if !self.begun => "what must not last never began",
            Form::Always(_) | Form::Never(_) | Form::AtMost(..) | Form::Until(None, ..) => {
                "what it goes by was never known"
            }
            _ if self.begun => "what it waits for was so from the beginning, and never became so",
            _ => "what it waits for never came",
        };
        why.to_owned()
    }

    /// Whether it would be known but for "Go": what it waits for, or where that came, the rest.
    fn is_up_to_go(&self) -> bool {
        let [first, rest @ ..] = self.up_to_go;
        let rest = rest.contains(&true);
        let waits = matches!(self.form, Form::Within(..) | Form::Throughout(..) | Form::Until(Some(_), ..));
        match self.undecided {
            [0, _] if waits => first,
            [undecided, ended] => (rest || !waits && first) && (undecided == 0 || undecided > ended),
        }
    }
}

/// That the bus did not show "Go", and what to do.
fn go(edition: &Edition, settled: Option<Choice>) -> String {
    let open = match settled {
        Some(_) => "is the edge that the VCU accepted (go-signal=accepted)",
        None => "may be the switch, or the edge that the VCU accepted",
    };
    let mut why = format!(
        "only AS_DRIVING shows whether \"Go\" is on, for GO_SIGNAL (520h) {open}; if your VCU sends the switch, say --reading go-signal=raw, and if not, ask for GO_SIGNAL is GO"
    );
    if let Some(remote) = Remote::of(&edition.bus) {
        // Writing to a string does not fail.
        let _ = write!(why, ", or record the remote control ({:03X}h)", remote.message().id);
    }
    why
}
