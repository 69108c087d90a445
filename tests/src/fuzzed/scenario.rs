//! The scenario file: read, written, and played.

use adsdv_can::car::{Action, Switch};
use adsdv_can::scenario::{MAX_ERRORS, Player, Scenario, Unreadable};
use adsdv_spec::messages::AsState;

use super::Bytes;
use crate::world::Chance;

/// The body: what the text is, and behind its last 0 byte how it is played.
pub fn body(bytes: &[u8]) {
    let end = bytes.iter().rposition(|&byte| byte == 0);
    let (text, played) = bytes.split_at(end.unwrap_or(bytes.len()));
    match Scenario::read(text) {
        Ok(scenario) => {
            let written = scenario.to_string();
            assert_eq!(written.parse::<Scenario>().ok().as_ref(), Some(&scenario), "{written}");
            assert!(!scenario.lines().is_empty());
            play(&scenario, &mut Bytes::new(played));
        }
        Err(error) => wrong(text, &error),
    }
    for words in String::from_utf8_lossy(text).split(['\n', ',']) {
        action(words);
    }
}

/// What is wrong is reported in lines that a terminal can show, each of a place that there is.
fn wrong(text: &[u8], error: &Unreadable) {
    let message = error.to_string();
    assert!(
        message.lines().all(|line| !line.is_empty() && !line.contains(|c: char| c.is_control())),
        "{message:?}"
    );
    if let Unreadable::Lines { errors, more } = error {
        assert!(errors.len() <= MAX_ERRORS && (*more == 0 || errors.len() == MAX_ERRORS));
        assert!(errors.is_sorted_by_key(|error| error.line));
        let lines: Vec<&[u8]> = text.split(|&byte| byte == b'\n').collect();
        for error in errors {
            let line = usize::try_from(error.line - 1).ok().and_then(|place| lines.get(place));
            // What is missing altogether is missing behind the last line.
            let end = line.map_or(0, |line| line.len());
            assert!(error.line <= lines.len() as u64 + 1 && error.column <= end + 1, "{error}");
        }
    }
}

fn action(words: &str) {
    match words.parse::<Action>() {
        Ok(action) => {
            let written = action.to_string();
            assert_eq!(written.parse(), Ok(action), "{written}");
            if let Action::Set(switch, raw) = action {
                assert_eq!(Switch::named(switch.key()), Some(switch));
                assert!(switch.positions().contains(&raw));
            }
        }
        Err(error) => {
            let message = error.to_string();
            assert!(!message.contains(|c: char| c.is_control()), "{message:?}");
            assert!(words.get(error.at..).is_some_and(|rest| rest.starts_with(&error.found)), "{error:?}");
        }
    }
}

/// Lines take place in their order, each once, whatever the car does.
fn play(scenario: &Scenario, bytes: &mut Bytes<'_>) {
    let mut player = Player::new(scenario);
    let mut time_ms: u64 = 0;
    let mut done = Vec::new();
    while bytes.are_left() && !player.is_done() {
        let step = if bytes.one_in(4) { u64::from(bytes.any::<u32>()) } else { bytes.below(2000) };
        time_ms = time_ms.saturating_add(step);
        let state = (!bytes.one_in(8)).then(|| bytes.pick(&AsState::ALL));
        done.extend(player.due(time_ms, state));
        assert_eq!(player.next().is_none(), player.is_done());
        assert!(player.waiting_for().is_none_or(|waiting| waiting.since_ms <= time_ms));
    }
    let all = scenario.lines().iter().flat_map(|line| line.actions.iter().copied());
    assert!(all.clone().zip(&done).all(|(one, other)| one == *other));
    assert_eq!(player.is_done(), player.next().is_none());
    if player.is_done() {
        assert_eq!(all.count(), done.len());
        assert_eq!(player.is_over(), scenario.lines().last().is_some_and(|line| line.ends));
    }
}
