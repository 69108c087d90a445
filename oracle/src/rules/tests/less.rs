//! Who knows less says less: a predicate that is unknown for a while never makes a rule broken that was kept, nor the other way.

use adsdv_spec::Truth::{self, False, True, Unknown};

use super::super::syntax::Form;
use super::super::track::RuleOutcome;
use super::bounds::outcomes;
use super::parse::numbers;

fn count(outcomes: &[RuleOutcome]) -> [usize; 2] {
    let of = |is: fn(&&RuleOutcome) -> bool| outcomes.iter().filter(is).count();
    [of(|one| matches!(one, RuleOutcome::Held)), of(|one| matches!(one, RuleOutcome::Broken(_)))]
}

#[test]
fn what_is_unknown_for_a_while_changes_no_verdict_to_its_opposite() {
    let forms = [
        Form::Always(()),
        Form::Never(()),
        Form::AtMost((), 7),
        Form::Within((), (), 7),
        Form::Throughout((), (), 7),
        Form::Until(Some(()), (), (), None),
        Form::Until(Some(()), (), (), Some(7)),
        Form::Until(None, (), (), None),
    ];
    let mut random = numbers(1);
    let (mut all, mut fewer) = ([0; 2], [0; 2]);
    for run in 0..40_000 {
        let form = &forms[run % forms.len()];
        let (mut t, mut whole, mut truths) = (0, Vec::new(), [False; 3]);
        for _ in 0..(2 + random(12)) {
            // What is known for no time at all is no beginning.
            t += i64::try_from(random(5) + usize::from(whole.len() == 1)).expect("little");
            for truth in &mut truths {
                if random(3) == 0 {
                    *truth = if random(2) == 0 { True } else { False };
                }
            }
            whole.push((t, truths));
        }
        let end = t + i64::try_from(random(9)).expect("little");
        // A recording that begins later is another recording, so the first moment is kept.
        let mut less: Vec<(i64, [Truth; 3])> = whole.clone();
        for _ in 0..=random(3) {
            let (which, from) = (random(3), 1 + random(whole.len()));
            let to = from + random(4);
            for (_, truths) in less.iter_mut().take(to).skip(from) {
                truths[which] = Unknown;
            }
        }
        let (of_whole, of_less) = (count(&outcomes(form, &whole, end)), count(&outcomes(form, &less, end)));
        for verdict in 0..2 {
            all[verdict] += of_whole[verdict];
            fewer[verdict] += of_less[verdict];
            assert!(of_less[verdict] <= of_whole[verdict], "{form:?}: {whole:?}\n{less:?}\nuntil {end}");
        }
    }
    for verdict in 0..2 {
        assert!(fewer[verdict] * 2 > all[verdict], "{fewer:?} of {all:?}: enough is still said");
    }
}
