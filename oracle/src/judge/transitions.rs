//! Transitions: those that were seen, and those that were due.

use adsdv_spec::messages::{Node, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Atoms, Fault, Knowledge, Observation, Rules, Term, Truth};

use super::events::{Pending, PendingKind};
use super::evidence::Frames;
use super::exercised::{ONLY_ARROWS, of_term};
use super::finding::{Finding, Party, Rule, Severity};
use super::likely::no_frame;
use super::report::Transition;
use super::variants::{Guard, Variant, Way};
use super::{Judge, LOG_STATUS, SILENCE_NS, STATUS};

/// A change of state that was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenChange {
    pub(super) from: AsState,
    pub(super) to: AsState,
    /// When the VCU last showed the old state.
    pub(super) before: i64,
    /// Whether a frame of the VCU may be missing in between.
    pub(super) gap: bool,
    /// What was shown when it was seen.
    pub(super) shown: Knowledge,
    /// For how long the state had lasted.
    pub(super) lasted: i64,
}

/// A way out of the current state that is certain to be open.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    pub(super) since: i64,
    pub(super) way: Way,
    /// The last frames when it came to be.
    frames: Frames,
    /// Whether the guard held in a step that is over: then it does not matter that it holds no more.
    held: bool,
    pub(super) reported: bool,
}

impl Due {
    /// Whether it need not be watched any more. What has been reported stays until it is certain to be over, however many
    /// frames are missing.
    fn is_over(&self, known: Knowledge) -> bool {
        if self.reported { self.way.term.truth(known) == Truth::False } else { !self.held }
    }
}

/// Behind a silence of that length no state is known: none that has to last fits into a gap.
const _: () = {
    let editions = adsdv_spec::Edition::ALL;
    let mut place = 0;
    while place < editions.len() {
        let timing = editions[place].rules.timing;
        assert!(SILENCE_NS < timing.ready_dwell_ms as i64 * super::MS);
        assert!(SILENCE_NS < timing.ebs_timer_ms as i64 * super::MS);
        place += 1;
    }
};

/// The atoms that the VCU's memory decides, or that it shows itself in the frame that shows the state: they count up to
/// the step that is judged, not behind it.
pub(super) const MEMORY: Atoms = Atoms::ALL.difference(Observation::SCOPE).with(Atom::SdcOpen);

/// What three-valued judgement says of one variant of the table.
struct Judged {
    truth: Truth,
    decided: Option<(Term, Knowledge)>,
}

impl Judge {
    /// The VCU shows another state; `at_step` is what was known in the step that led there.
    pub(super) fn transition_seen(
        &mut self,
        t: i64,
        from: AsState,
        to: AsState,
        before: i64,
        gap: bool,
        at_step: Knowledge,
    ) {
        let usual = self.slots.get(super::STATUS).map_or(0, |slot| slot.period);
        let gap = gap || !self.options.complete && t - before > usual + usual / 5;
        self.vcu.left = Some(super::status::Left { before, at: t, gap });
        self.notice_change(t, from, to, before, gap);
        let wait = self.wait_for(self.deciding(from));
        let lasted = self.why.now().map_or(0, |stay| t - stay.since_ns);
        self.suspend(
            t,
            wait,
            at_step,
            PendingKind::SeenChange(SeenChange { from, to, before, gap, shown: self.why.shown(), lasted }),
        );
    }

    pub(super) fn judge_seen(&mut self, pending: &Pending, seen: &SeenChange, now: i64) {
        let SeenChange { from, to, before, gap, shown, lasted } = *seen;
        let t = pending.t;
        let cycle = self.cycle();
        let start = before.min(t - self.window) - cycle;
        let inputs = self.throughout(start, t + self.window, now);
        let memory = self.history.throughout(start, t - 1).meet(pending.before);
        // Where the remote control shows the switch, an edge shows when it comes, and may be recorded late.
        let remembered = if self.has_remote() { MEMORY.without(Atom::GoEdge) } else { MEMORY };
        let known = remembered.intersection(memory.on().union(memory.off()));
        let window = inputs.forget(remembered).learn(known, memory.on());
        // 502h comes rarely: where the sample behind differs, or there is none, that before does not speak for now.
        let after = self.throughout(t, t + self.window, now);
        let between = self.scope(LOG_STATUS).difference(after.on().union(after.off()));
        let instants: Vec<Knowledge> = self
            .moments(start, t)
            .into_iter()
            .filter(|moment| moment.state == Some(from))
            .map(|moment| moment.known)
            .chain([pending.before])
            .map(|known| known.forget(between))
            .collect();
        let judged: Vec<Judged> = self
            .variants
            .of(from)
            .iter()
            .map(|variant| judge_variant(variant, to, window, &instants))
            .collect();
        let mut justified = judged.iter().map(|j| j.truth).reduce(Truth::agree).unwrap_or(Truth::False);
        let between_missed = justified == Truth::False && gap && self.leads_through_others(from, to, window);
        if between_missed {
            justified = Truth::Unknown;
        }
        let decided = judged.iter().find(|j| j.truth == justified).or(judged.first()).and_then(|j| j.decided);
        let decided = if justified == Truth::Unknown {
            self.reported_by_cause(from, to, window).or(decided)
        } else {
            decided
        };
        self.judged_change(t, justified);
        let deciding: Vec<_> = judged.iter().filter_map(|j| j.decided).chain(decided).collect();
        self.exercise_arrow((from, to), justified, &deciding, window);
        let arrow = self.variants.of(from).iter().flatten().find(|guard| guard.to == to).cloned();
        let section = arrow.as_ref().map_or("Figure 2", |guard| guard.section);
        let remote_estop = decided.is_some_and(|(term, _)| term.on.has(Atom::SdcOpen))
            && self.remote_pressed(start, t + self.window);
        if to == AsState::EmergencyBrake {
            // All other reasons have one.
            // That the remote E-stop has a cause of its own is not said.
            let certain = justified == Truth::True && !switched_off(window) && !remote_estop;
            if let Some(brake) = self.vcu.brake.as_mut().filter(|brake| brake.since == t) {
                brake.certain = certain;
            }
        }
        let found = |severity, rule| {
            let atoms = self.variants.atoms(from, to);
            let finding = Finding::new(severity, Party::Vcu, section, rule, t);
            finding.shown_by(self.deciding_frames(&pending.frames, atoms))
        };
        let finding = match (&arrow, justified) {
            _ if between_missed => {
                let gap = no_frame(Vcu2AiStatus::ID, before, t);
                let stays =
                    Wrong::stays(format!("by all that was recorded {from} -> {to}, without a reason"), from);
                let excuse = format!("a state between was missed ({gap})");
                Some(stays.told(found(Severity::Warning, Rule::Unjustified)).unless(excuse))
            }
            (None, Truth::False) => {
                let finding = found(Severity::Violation, Rule::NoArrow).against(&[ONLY_ARROWS]);
                Some(self.no_arrow(from, to).told(finding))
            }
            (Some(guard), Truth::False) => {
                let overtaking = judged.iter().find_map(|j| j.decided).map(|(term, _)| term);
                let wrong = unjustified(&self.edition.rules, (from, to), guard, window, overtaking);
                let broken = self.broken_by(from, to, &deciding, window);
                Some(wrong.told(found(Severity::Violation, Rule::Unjustified)).against(&broken))
            }
            (_, Truth::Unknown) => {
                self.likely_unjustified(t, (from, to), shown, lasted).map(|(wrong, excuse)| {
                    wrong.told(found(Severity::Warning, Rule::Unjustified)).unless(excuse)
                })
            }
            _ => None,
        };
        if let Some(finding) = finding {
            self.found(finding);
        }
        let or = decided.map(|(term, _)| self.reported_alike(from, to, &term, window)).unwrap_or_default();
        self.out.transition(Transition { t_ns: t, from, to, section, justified, decided, remote_estop, or });
    }

    /// Where the shutdown circuit decided: the alternatives that the VCU reports as the same fault (D-13), as far as they are
    /// possible.
    fn reported_alike(
        &self,
        from: AsState,
        to: AsState,
        decided: &Term,
        window: Knowledge,
    ) -> Vec<(Term, Knowledge)> {
        let cause = self.vcu.status.and_then(|status| Fault::of_cause(status.shutdown_cause));
        let Some(fault) = cause.filter(|_| decided.on.has(Atom::SdcOpen)) else { return Vec::new() };
        let terms = self.variants.of(from).iter().flatten().filter(|g| g.to == to).flat_map(|g| &g.terms);
        let mut alike: Vec<(Term, Knowledge)> = Vec::new();
        for term in terms.filter(|term| term.fault == Some(fault) && term.truth(window) != Truth::False) {
            if !alike.iter().any(|(known, _)| known == term) {
                alike.push((*term, window));
            }
        }
        alike
    }

    /// The alternative that the VCU itself gives as its reason, if that is possible.
    fn reported_by_cause(&self, from: AsState, to: AsState, window: Knowledge) -> Option<(Term, Knowledge)> {
        let fault = Fault::of_cause(self.vcu.status?.shutdown_cause)?;
        let mut terms = self.variants.of(from).iter().flatten().filter(|g| g.to == to).flat_map(|g| &g.terms);
        let term = terms.find(|term| term.fault == Some(fault) && term.truth(window) != Truth::False)?;
        Some((*term, window))
    }

    fn no_arrow(&self, from: AsState, to: AsState) -> Wrong {
        let ways: Vec<&str> = AsState::ALL
            .iter()
            .filter(|&&state| self.variants.has_arrow(from, state))
            .map(|state| state.name())
            .collect();
        let seen = format!("{from} -> {to}: there is no such arrow");
        Wrong { seen, expected: format!("{from} to stay, or one of its arrows to {}", ways.join(", ")) }
    }

    /// Whether several arrows, of which the log missed the states between, can lead there.
    fn leads_through_others(&self, from: AsState, to: AsState, window: Knowledge) -> bool {
        // What the VCU remembers was not seen; what it saw has to allow each arrow.
        let seen = window.forget(MEMORY);
        let open = |from: AsState, to: AsState| {
            self.variants.of(from).iter().any(|variant| {
                let mut earlier = variant.iter().take_while(|guard| guard.to != to);
                let mut guards = variant.iter().filter(|guard| guard.to == to);
                guards.any(|guard| guard.truth(seen) != Truth::False)
                    && !earlier.any(|guard| guard.truth(seen) == Truth::True)
            })
        };
        let mut reached = vec![from];
        let mut next = 0;
        while let Some(&state) = reached.get(next) {
            next += 1;
            for &then in &AsState::ALL {
                // A state that was entered in the gap and has to last for its time lasts for longer than any gap; READY may
                // be left at once to where no dwell is needed.
                let lasts = matches!(
                    (state, then),
                    (AsState::Ready, AsState::Driving) | (AsState::EmergencyBrake, _) if state != from
                );
                if !lasts && open(state, then) {
                    if then == to && state != from {
                        return true;
                    }
                    if !reached.contains(&then) {
                        reached.push(then);
                    }
                }
            }
        }
        false
    }

    /// What is known has changed: is a transition due now?
    pub(super) fn reconsider(&mut self, t: i64) {
        let known = self.known;
        self.reconsider_shown(t);
        let Some(state) = self.vcu.state.filter(|_| self.vcu_is_seen()) else {
            self.due = self.due.filter(|due| !due.is_over(known));
            return;
        };
        self.consider_speed(t, state);
        self.consider_requests(t, state);
        let over = |due: &Due| due.is_over(known);
        match self.variants.due(state, known) {
            None => self.due = self.due.filter(|due| !over(due)),
            Some(way)
                if self.due.is_none_or(|due| due.way.term.truth(known) != Truth::True && over(&due)) =>
            {
                self.due = Some(self.is_due(t, way, false));
            }
            Some(_) => {}
        }
    }

    /// This is known of a window on either side of `t`, and the VCU made a step in it: if a guard held, what the VCU saw later
    /// does not matter.
    pub(super) fn guard_held(&mut self, t: i64, state: AsState, known: Knowledge) {
        let Some(way) = self.variants.due(state, known) else { return };
        if self.due.is_none_or(|due| due.is_over(self.known)) {
            self.due = Some(self.is_due(t, way, true));
        }
    }

    fn is_due(&self, since: i64, way: Way, held: bool) -> Due {
        Due { since, way, frames: self.frames(), held, reported: false }
    }

    /// Whether the VCU has shown the conditions of a term again, a window after they held first: what it measures is only certain up
    /// to the last frame that shows it.
    pub(super) fn is_confirmed(&self, term: &Term, since: i64) -> bool {
        self.slots.iter().enumerate().all(|(index, slot)| {
            !slot.is_from(Node::Vcu)
                || !touches(term, self.scope(index))
                || slot.last.is_some_and(|last| last >= since + self.window)
        })
    }

    /// 520h still shows the old state: a transition that should have come by now is missing.
    pub(super) fn due_at_status(&mut self, t: i64) {
        let Some(due) = self.due.filter(|due| !due.reported && t > due.since + self.deadline) else { return };
        let Some(state) = self.vcu.state else { return };
        if !self.is_confirmed(&due.way.term, due.since) {
            return;
        }
        if let Some(due) = &mut self.due {
            due.reported = true;
        }
        self.likely.is_certain();
        let pressed = due.way.term.on.has(Atom::SdcOpen) && self.remote_pressed(due.since, t);
        let pressed = if pressed { " (remote E-stop pressed)" } else { "" };
        let so_long = format!("{pressed} for more than {} ms", self.options.deadline_ms);
        let finding = self.not_left(Severity::Violation, state, &due.way, due.since, &so_long);
        let mut evidence = self.deciding_frames(&due.frames, due.way.term.on.union(due.way.term.off));
        evidence.extend(self.last_frames(&[STATUS]));
        self.found(finding.shown_by(evidence));
    }

    /// A state was not left, though a way out has been open since `since`.
    pub(super) fn not_left(
        &self,
        severity: Severity,
        state: AsState,
        way: &Way,
        since: i64,
        so_long: &str,
    ) -> Finding {
        let Way { to, section, term } = way;
        let requirements = self.row(state, *to).map(|row| of_term(row, term)).unwrap_or_default();
        let conditions = conditions(&self.edition.rules, term, Knowledge::exact(term.on));
        Finding::new(severity, Party::Vcu, *section, Rule::Due, since + self.deadline)
            .against(&requirements)
            .seen(format!("{state} was not left, though {conditions}{so_long}"))
            .expected(format!("{state} -> {to}"))
    }
}

/// What was seen of a transition that is wrong, and what was expected.
pub(super) struct Wrong {
    pub(super) seen: String,
    pub(super) expected: String,
}

impl Wrong {
    fn stays(seen: String, state: AsState) -> Self {
        Self { seen, expected: format!("{state} to stay") }
    }

    fn told(self, finding: Finding) -> Finding {
        finding.seen(self.seen).expected(self.expected)
    }
}

/// Whether a switch that has no cause of its own may have been turned off.
fn switched_off(window: Knowledge) -> bool {
    window.of(Atom::Asms) != Truth::True || window.of(Atom::GoOn) != Truth::True
}

fn touches(term: &Term, scope: Atoms) -> bool {
    !term.on.union(term.off).intersection(scope).is_empty()
}

/// Judges a transition under one variant of the table.
fn judge_variant(variant: &Variant, to: AsState, window: Knowledge, instants: &[Knowledge]) -> Judged {
    let Some(place) = variant.iter().position(|guard| guard.to == to) else {
        return Judged { truth: Truth::False, decided: None };
    };
    let (earlier, rest) = variant.split_at(place);
    let Some(guard) = rest.first() else { return Judged { truth: Truth::False, decided: None } };
    let overtaken = |known: Knowledge| earlier.iter().find_map(|other| other.first(known, Truth::True));
    if let Some(term) = overtaken(window) {
        return Judged { truth: Truth::False, decided: Some((term, window)) };
    }
    if guard.truth(window) == Truth::False {
        return Judged { truth: Truth::False, decided: None };
    }
    let certain = instants.iter().rev().find_map(|&known| {
        let term = guard.first(known, Truth::True).filter(|_| overtaken(known).is_none())?;
        Some((term, known))
    });
    match certain {
        Some(decided) => Judged { truth: Truth::True, decided: Some(decided) },
        None => Judged {
            truth: Truth::Unknown,
            decided: guard
                .first(window, Truth::Unknown)
                .or(guard.terms.first().copied())
                .map(|term| (term, window)),
        },
    }
}

/// Why a transition was wrong: the condition that failed in each alternative, or the row that comes first.
pub(super) fn unjustified(
    rules: &Rules,
    (from, to): (AsState, AsState),
    guard: &Guard,
    window: Knowledge,
    overtaking: Option<Term>,
) -> Wrong {
    if let Some(term) = overtaking.filter(|_| guard.truth(window) != Truth::False) {
        let conditions = conditions(rules, &term, window);
        let seen = format!("{from} -> {to}, though {conditions}: another arrow comes first");
        return Wrong { seen, expected: "that one".to_owned() };
    }
    let all = |of: fn(&Term) -> Atoms| guard.terms.iter().fold(Atoms::NONE, |all, term| all.union(of(term)));
    let (off, on) =
        (all(|term| term.on).intersection(window.off()), all(|term| term.off).intersection(window.on()));
    let text = |value| move |atom| rules.text(atom, value).to_string();
    let failed: Vec<String> = off.iter().map(text(false)).chain(on.iter().map(text(true))).collect();
    Wrong::stays(format!("{from} -> {to}, but {}", failed.join(" and ")), from)
}

/// A term's conditions with their values, as far as they are known.
pub(super) fn conditions(rules: &Rules, term: &Term, known: Knowledge) -> String {
    let texts: Vec<String> = term
        .literals()
        .map(|(atom, value)| match known.of(atom) {
            Truth::True => rules.text(atom, true).to_string(),
            Truth::False => rules.text(atom, false).to_string(),
            Truth::Unknown => format!("{} (not certain)", rules.text(atom, value)),
        })
        .collect();
    texts.join(" and ")
}
