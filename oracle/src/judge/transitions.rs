//! Transitions: those that were seen, and those that were due.

use adsdv_spec::messages::Node;
use adsdv_spec::{AsState, Atom, Atoms, Fault, Knowledge, Observation, Rules, Term, Truth};

use super::events::{Pending, PendingKind};
use super::finding::{Finding, Party, Rule, Severity, Transition};
use super::variants::{Guard, Variant};
use super::{Judge, LOG_STATUS, SILENCE_NS};

/// A change of state that was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenChange {
    pub(super) from: AsState,
    pub(super) to: AsState,
    /// When the VCU last showed the old state.
    pub(super) before: i64,
    /// Whether a frame of the VCU may be missing in between.
    pub(super) gap: bool,
}

/// A way out of the current state that is certain to be open.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    since: i64,
    to: AsState,
    section: &'static str,
    term: Term,
    /// Whether the guard held in a step that is over: then it does not matter that it holds no more.
    held: bool,
    reported: bool,
}

impl Due {
    /// Whether it need not be watched any more. What has been reported stays until it is certain to be over, however many
    /// frames are missing.
    fn is_over(&self, known: Knowledge) -> bool {
        if self.reported { self.term.truth(known) == Truth::False } else { !self.held }
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
const MEMORY: Atoms = Atoms::ALL.difference(Observation::SCOPE).with(Atom::SdcOpen);

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
        let gap = gap || t - before > usual + usual / 5;
        self.vcu.left = Some(super::status::Left { before, at: t, gap });
        let wait = self.wait_for(self.deciding(from));
        self.suspend(t, wait, at_step, PendingKind::SeenChange(SeenChange { from, to, before, gap }));
    }

    pub(super) fn judge_seen(&mut self, pending: &Pending, seen: &SeenChange, now: i64) {
        let SeenChange { from, to, before, gap } = *seen;
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
        if justified == Truth::False && gap && self.leads_through_others(from, to, window) {
            justified = Truth::Unknown;
        }
        let decided = judged.iter().find(|j| j.truth == justified).or(judged.first()).and_then(|j| j.decided);
        let decided = if justified == Truth::Unknown {
            self.reported_by_cause(from, to, window).or(decided)
        } else {
            decided
        };
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
        if justified == Truth::False {
            let rules = &self.edition.rules;
            let (rule, message) = match &arrow {
                None => (Rule::NoArrow, self.no_arrow(from, to)),
                Some(guard) => (Rule::Unjustified, unjustified(rules, (from, to), guard, window, &judged)),
            };
            self.out.finding(Finding {
                t_ns: t,
                severity: Severity::Violation,
                party: Party::Vcu,
                section,
                rule,
                message,
            });
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

    fn no_arrow(&self, from: AsState, to: AsState) -> String {
        let ways: Vec<&str> = AsState::ALL
            .iter()
            .filter(|&&state| self.variants.has_arrow(from, state))
            .map(|state| state.name())
            .collect();
        format!("{from} -> {to}: there is no such arrow; from {from} there are arrows to {}", ways.join(", "))
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
        let Some(state) = self.vcu.state.filter(|_| self.vcu_is_seen()) else {
            self.due = self.due.filter(|due| !due.is_over(known));
            return;
        };
        self.consider_speed(t, state);
        self.consider_requests(t, state);
        match (self.variants.due(state, self.known), self.due) {
            (None, due) => self.due = due.filter(|due| !due.is_over(known)),
            (Some((guard, term)), due)
                if due
                    .as_ref()
                    .is_none_or(|due| due.term.truth(known) != Truth::True && due.is_over(known)) =>
            {
                let (to, section) = (guard.to, guard.section);
                self.due = Some(Due { since: t, to, section, term, held: false, reported: false });
            }
            (Some(_), _) => {}
        }
    }

    /// This is known of a window on either side of `t`, and the VCU made a step in it: if a guard held, what the VCU saw later
    /// does not matter.
    pub(super) fn guard_held(&mut self, t: i64, state: AsState, known: Knowledge) {
        let Some((guard, term)) = self.variants.due(state, known) else { return };
        if self.due.is_none_or(|due| due.is_over(self.known)) {
            let (to, section) = (guard.to, guard.section);
            self.due = Some(Due { since: t, to, section, term, held: true, reported: false });
        }
    }

    /// 520h still shows the old state: a transition that should have come by now is missing.
    pub(super) fn due_at_status(&mut self, t: i64) {
        let Some(due) = self.due.filter(|due| !due.reported && t > due.since + self.deadline) else { return };
        let Some(state) = self.vcu.state else { return };
        // What the VCU measures is only certain up to the last frame that shows it.
        let confirmed = self.slots.iter().enumerate().all(|(index, slot)| {
            !slot.is_from(Node::Vcu)
                || !touches(&due.term, self.scope(index))
                || slot.last.is_some_and(|last| last >= due.since + self.window)
        });
        if !confirmed {
            return;
        }
        if let Some(due) = &mut self.due {
            due.reported = true;
        }
        let pressed = due.term.on.has(Atom::SdcOpen) && self.remote_pressed(due.since, t);
        self.out.finding(Finding {
            t_ns: due.since + self.deadline,
            severity: Severity::Violation,
            party: Party::Vcu,
            section: due.section,
            rule: Rule::Due,
            message: format!(
                "{state} was not left, though {}{} for more than {} ms; expected {state} -> {}",
                conditions(&self.edition.rules, &due.term, Knowledge::exact(due.term.on)),
                if pressed { " (remote E-stop pressed)" } else { "" },
                self.options.deadline_ms,
                due.to
            ),
        });
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
fn unjustified(
    rules: &Rules,
    (from, to): (AsState, AsState),
    guard: &Guard,
    window: Knowledge,
    judged: &[Judged],
) -> String {
    let overtaking = judged.iter().find_map(|j| j.decided).filter(|_| guard.truth(window) != Truth::False);
    if let Some((term, _)) = overtaking {
        return format!(
            "{from} -> {to}, though {}: another arrow comes first; expected that one",
            conditions(rules, &term, window)
        );
    }
    let all = |of: fn(&Term) -> Atoms| guard.terms.iter().fold(Atoms::NONE, |all, term| all.union(of(term)));
    let (off, on) =
        (all(|term| term.on).intersection(window.off()), all(|term| term.off).intersection(window.on()));
    let text = |value| move |atom| rules.text(atom, value).to_string();
    let failed: Vec<String> = off.iter().map(text(false)).chain(on.iter().map(text(true))).collect();
    format!("{from} -> {to}, but {}; expected {from} to stay", failed.join(" and "))
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
