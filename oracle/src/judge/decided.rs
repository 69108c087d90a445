//! What decided a transition, in words.

use adsdv_spec::{Atom, Knowledge, Rules, Term, Truth};

use super::report::Transition;

/// A condition of an arrow, as it was when the arrow was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decided {
    /// What it is about.
    pub atom: Atom,
    /// The value that it has to have.
    pub needed: bool,
    /// Whether it was as it has to be.
    pub held: Truth,
    /// It is the shutdown circuit, and the remote control shows that its E-stop was pressed, which tells more.
    pub remote_estop: bool,
}

impl Decided {
    /// The conditions of an alternative, in the order of the document.
    fn all(term: Term, known: Knowledge, remote_estop: bool) -> Vec<Self> {
        let one = |(atom, needed)| {
            let remote_estop = remote_estop && atom == Atom::SdcOpen;
            let held = match known.of(atom) {
                _ if remote_estop => Truth::True,
                Truth::Unknown => Truth::Unknown,
                seen => Truth::from(seen == Truth::from(needed)),
            };
            Self { atom, needed, held, remote_estop }
        };
        term.literals().map(one).collect()
    }

    /// What has to be, in the words of Figure 2; where the remote control tells more, what was.
    pub fn text(&self, rules: &Rules) -> String {
        if self.remote_estop {
            return "remote E-stop pressed".to_owned();
        }
        rules.text(self.atom, self.needed).to_string()
    }
}

impl Transition {
    /// The conditions that decided, or may have, each as it was; none where no alternative may have.
    ///
    /// ```
    /// use adsdv_oracle::judge::{Decided, Transition};
    /// use adsdv_spec::{AsState, Atom, Atoms, Edition, Knowledge, Term, Truth};
    ///
    /// let term = Term::on("3.1", &[Atom::Asms, Atom::Tsms, Atom::EbsArmed]);
    /// let known = Knowledge::NOTHING.learn(Atoms::of(&[Atom::Asms, Atom::Tsms]), Atoms::of(&[Atom::Asms]));
    /// let transition = Transition {
    ///     t_ns: 0, from: AsState::Off, to: AsState::Ready, section: "3.1", justified: Truth::Unknown,
    ///     decided: Some((term, known)), remote_estop: false, or: Vec::new(),
    /// };
    /// let held: Vec<_> = transition.conditions().iter().map(|one| (one.atom, one.held)).collect();
    /// assert_eq!(held, [(Atom::Asms, Truth::True), (Atom::Tsms, Truth::False), (Atom::EbsArmed, Truth::Unknown)]);
    /// let texts: Vec<_> = transition.conditions().iter().map(|one| one.text(&Edition::V3_0.rules)).collect();
    /// assert_eq!(texts, ["AS master switch ON", "TS master switch ON", "EBS_state == ARMED"]);
    /// ```
    pub fn conditions(&self) -> Vec<Decided> {
        self.decided.map(|(term, known)| Decided::all(term, known, self.remote_estop)).unwrap_or_default()
    }

    /// The alternatives that may have decided instead, each in the words of Figure 2.
    pub fn others(&self, rules: &Rules) -> Vec<String> {
        let text = |(atom, needed)| rules.text(atom, needed).to_string();
        let of = |term: &Term| term.literals().map(text).collect::<Vec<_>>().join(", ");
        self.or.iter().map(|(term, _)| of(term)).collect()
    }
}
