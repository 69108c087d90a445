//! A page: one template that is built beforehand, and one object of data in it.

/// What the data takes the place of.
const PLACE: &str = "\"adsdv-data\"";

/// A template with data.
pub(crate) fn filled(template: &str, data: &str) -> String {
    let (before, after) = template.split_once(PLACE).unwrap_or((template, ""));
    [before, data, after].concat()
}

/// JSON that says the same, and in which nothing is markup: what stands in a log or in a name ends no script and begins none.
pub(crate) fn harmless(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for letter in json.chars() {
        // Only strings have any of these.
        match letter {
            '<' => text.push_str("\\u003c"),
            '>' => text.push_str("\\u003e"),
            '&' => text.push_str("\\u0026"),
            '\u{2028}' => text.push_str("\\u2028"),
            '\u{2029}' => text.push_str("\\u2029"),
            letter => text.push(letter),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_made_harmless_says_the_same() {
        let text = "</script><!--<script>alert(1)&amp;\u{2028}\u{2029}é";
        let json = serde_json::to_string(text).expect("text");
        let harmless = harmless(&json);
        assert!(!harmless.contains(['<', '>', '&', '\u{2028}', '\u{2029}']), "{harmless}");
        assert_eq!(serde_json::from_str::<String>(&harmless).expect("JSON"), text);
    }

    #[test]
    fn each_template_has_one_place_for_the_data() {
        for template in [crate::page::TEMPLATE, crate::outcome::TEMPLATE] {
            assert_eq!(template.matches(PLACE).count(), 1);
        }
    }
}
