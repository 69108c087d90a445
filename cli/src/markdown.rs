//! Text in Markdown, as GitHub renders it.

/// A piece of text as it is, in a cell of a table or beside other words. Underscores stay: inside a word they are not emphasis.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '|' | '\\' | '*' | '`' => escaped.extend(['\\', character]),
            _ => push_html(&mut escaped, character),
        }
    }
    escaped
}

/// A piece of text as it is, between tags of HTML.
pub(crate) fn escaped_html(text: &str) -> String {
    let mut escaped = String::new();
    text.chars().for_each(|character| push_html(&mut escaped, character));
    escaped
}

fn push_html(out: &mut String, character: char) {
    match character {
        '<' => out.push_str("&lt;"),
        '&' => out.push_str("&amp;"),
        _ => out.push(character),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_be_markup_is_escaped() {
        assert_eq!(escaped("a | <b> & `c`*"), "a \\| &lt;b> &amp; \\`c\\`\\*");
        assert_eq!(escaped_html("a | <b> & `c`*"), "a | &lt;b> &amp; `c`*");
    }
}
