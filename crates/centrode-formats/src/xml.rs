//! Text within XML files: SVG, 3MF, URDF and MJCF.

/// Text for an element or an attribute in double quotes: reserved characters become entities, characters that XML forbids become
/// a space.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(held(c)),
        }
    }
    out
}

/// Text for a comment, which two hyphens would end.
pub(crate) fn comment(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '-' && out.ends_with('-') {
            out.push(' ');
        }
        out.push(held(c));
    }
    out
}

/// A character, or a space if XML forbids it.
fn held(c: char) -> char {
    match c {
        '\u{fffe}' | '\u{ffff}' => ' ',
        c if c.is_control() => ' ',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The production Char of XML 1.0, with a space for what HTML calls control characters.
    fn is_xml(c: char) -> bool {
        matches!(u32::from(c), 0x20..=0x7e | 0xa0..=0xd7ff | 0xe000..=0xfffd | 0x10000..=0x10ffff)
    }

    #[test]
    fn every_character_of_unicode_is_written_or_becomes_a_space() {
        for c in '\0'..=char::MAX {
            let one = c.to_string();
            let kept = if is_xml(c) { one.as_str() } else { " " };
            assert_eq!(comment(&one), kept);
            let reserved = ["&", "<", ">", "\""].contains(&kept);
            assert_eq!(escaped(&one) == kept, !reserved, "{c:?}");
        }
        assert_eq!(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
        assert_eq!(comment("a---b\u{ffff}"), "a- - -b ");
    }
}
