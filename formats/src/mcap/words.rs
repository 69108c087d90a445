//! Whether a name speaks of CAN.

/// Whether one of the words of a name is CAN: `can_msgs/msg/Frame`, `RawCAN`, `vehicle.CanFrame`; not `LaserScan` or `CancelGoal`.
pub(super) fn speak_of_can(name: &str) -> bool {
    let mut word = String::new();
    let mut letters = name.chars().peekable();
    let mut before = ' ';
    while let Some(letter) = letters.next() {
        let next = letters.peek().copied().unwrap_or(' ');
        let begins =
            letter.is_ascii_uppercase() && (before.is_ascii_lowercase() || next.is_ascii_lowercase());
        if begins || !letter.is_ascii_alphabetic() {
            if is_can(&word) {
                return true;
            }
            word.clear();
        }
        // The longest word that is looked for has nine letters.
        if letter.is_ascii_alphabetic() && word.len() < 16 {
            word.push(letter.to_ascii_lowercase());
        }
        before = letter;
    }
    is_can(&word)
}

fn is_can(word: &str) -> bool {
    matches!(word, "can" | "canfd" | "socketcan" | "canbus")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn can_is_a_word_and_no_part_of_one() {
        for name in [
            "can_msgs/msg/Frame",
            "ros2_socketcan_msgs/msg/FdFrame",
            "RawCAN",
            "CANFrame",
            "vehicle.CanFrame",
            "my/CanFD",
            "can2/x",
            "CAN",
        ] {
            assert!(speak_of_can(name), "{name}");
        }
        for name in ["sensor_msgs/msg/LaserScan", "action_msgs/srv/CancelGoal", "Canvas", "scan", "ca_n", ""]
        {
            assert!(!speak_of_can(name), "{name}");
        }
    }
}
