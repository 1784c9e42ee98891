//! Characters that text of a design must not contain, and those that a message shows by their number.

/// Whether a file cannot contain a character in its text: a control character, U+FFFE or U+FFFF, which XML does not permit.
#[must_use]
pub fn is_control(c: char) -> bool {
    c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// Text as a message shows it: a control character, or one that changes the direction of writing, as its number, `\u{202e}`.
///
/// So a file cannot control a terminal, and every message is displayed as it is written.
#[must_use]
pub fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match is_control(c) || turns_direction(c) {
            true => shown.extend(c.escape_unicode()),
            false => shown.push(c),
        }
    }
    shown
}

/// Whether a character has the property `Bidi_Control` of Unicode.
fn turns_direction(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_shown_by_number() {
        assert_eq!(visible("a\u{202e}b"), r"a\u{202e}b");
        assert_eq!(visible("\u{2066}\t\u{ffff}"), r"\u{2066}\u{9}\u{ffff}");
        assert_eq!(visible("Zahnräder ≤ 5 °"), "Zahnräder ≤ 5 °");
    }
}
