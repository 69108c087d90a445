//! Nothing at all comes from the AI Computer any more, and the VCU goes on as if all were well (section 2.4): either the AI Computer has
//! stopped, and then the VCU is at fault as well; or only the recording lacks its frames, which one that is complete does not.

use adsdv_spec::{Atom, Truth};

use crate::judge::book::Book;
use crate::judge::estimator::base::{Estimator, is_active};
use crate::judge::estimator::silences::{Silences, WATCHED};
use crate::judge::exercised::{ANSWERS, UNANSWERED};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::sampler::places::{AI_STATUS, STATUS};
use crate::judge::time::{MS, milliseconds};

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct Silence {
    /// The last frame of the AI Computer, and whether the judge has reported that none came behind it.
    last: i64,
    reported: bool,
    /// Since when the VCU has let it pass: the last frame of the AI Computer, or the last time when nobody had to answer.
    since: i64,
    /// How often 520h has come since then: a recorder that pauses, or whose clock is set, hears neither.
    shown: i64,
}

impl Silence {
    /// 520h came: has anything come from the AI Computer?
    pub(super) fn judge(&mut self, est: &mut Estimator, book: &mut Book, t: i64) {
        let heard = (0..WATCHED.len()).filter_map(|place| Silences::heard_at(place, &est.sampler));
        let Some(last) = heard.max() else { return };
        if std::mem::replace(&mut self.last, last) != last {
            (self.reported, self.since, self.shown) = (false, last, 0);
        }
        let goes_on = is_active(est.state_seen()) && !est.shows_comms_lost();
        if !goes_on || est.known.of(Atom::Tsms) != Truth::True {
            (self.since, self.shown) = (t, 0);
            return;
        }
        self.shown += 1;
        let limit = est.handshake_limit().max(est.silences.limit.unwrap_or_default());
        let patience = limit + est.patience();
        if t - self.since <= patience || 2 * self.shown * est.cycle() < patience {
            return;
        }
        book.margins.gap(AI_STATUS, t - last, t);
        if std::mem::replace(&mut self.reported, true) || est.handshake.reported_ai {
            return;
        }
        let complete = est.options.complete;
        let since = format!("no frame of the AI Computer from {:.3} s on", milliseconds(last) / 1e3);
        let severity = if complete { Severity::Violation } else { Severity::Warning };
        let finding = Finding::new(severity, Party::Ai, "2.4", Rule::AiSilent, last)
            .against(&[ANSWERS])
            .seen(format!("{since}, while those of the VCU come, and AI_COMMS_LOST is 0"))
            .expected(format!("an answer to HANDSHAKE within {} ms", est.handshake_limit() / MS))
            .shown_by(est.sampler.last_frames(&[AI_STATUS, STATUS]));
        book.found(finding);
        if complete && !std::mem::replace(&mut est.handshake.reported_vcu, true) {
            let due = self.since + limit + est.deadline;
            let finding = Finding::violation(Party::Vcu, "2.4", Rule::CommsLostDue, due)
                .against(UNANSWERED)
                .seen(format!("AI_COMMS_LOST is 0, but {since}"))
                .expected(format!("1 after {} ms", limit / MS));
            book.found(finding.shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS])));
        }
    }
}
