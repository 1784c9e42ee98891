//! Exchange structure of ISO 10303-21: numbered entities, numbers and texts.

use std::fmt::{self, Display, Write};

/// Name of an entity in its file.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) struct Id(usize);

impl Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// A number with all digits and the decimal point that the format requires.
#[derive(Clone, Copy, Debug)]
pub(super) struct Real(pub(super) f64);

impl Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero removes the sign of a negative zero.
        let digits = format!("{:?}", self.0 + 0.0);
        match digits.split_once('e') {
            None => f.write_str(&digits),
            Some((mantissa, exponent)) => {
                let point = if mantissa.contains('.') { "" } else { "." };
                write!(f, "{mantissa}{point}E{exponent}")
            }
        }
    }
}

/// Text in quotes; characters beyond plain ASCII are written as their codes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Text<'a>(pub(super) &'a str);

impl Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('\'')?;
        for c in self.0.chars() {
            match (c, u32::from(c)) {
                ('\'' | '\\', _) => write!(f, "{c}{c}")?,
                (' '..='~', _) => f.write_char(c)?,
                (_, code @ ..=0xffff) => write!(f, "\\X2\\{code:04X}\\X0\\")?,
                (_, code) => write!(f, "\\X4\\{code:08X}\\X0\\")?,
            }
        }
        f.write_char('\'')
    }
}

/// A list in parentheses.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'a, T>(pub(super) &'a [T]);

impl<T: Display> Display for List<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('(')?;
        for (index, item) in self.0.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            write!(f, "{comma}{item}")?;
        }
        f.write_char(')')
    }
}

/// Data section under construction.
#[derive(Debug, Default)]
pub(super) struct Data {
    lines: String,
    count: usize,
}

impl Data {
    /// Writes one entity and returns its name.
    pub(super) fn add(&mut self, entity: impl Display) -> Id {
        centrode_geometry::checkpoint();
        self.count += 1;
        self.lines.push_str(&format!("#{}={entity};\n", self.count));
        Id(self.count)
    }

    /// All entities, one per line.
    pub(super) fn lines(&self) -> &str {
        &self.lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_a_point_and_texts_are_ascii() {
        let written = |x: f64| Real(x).to_string();
        assert_eq!(written(12.0), "12.0");
        assert_eq!(written(-0.0), "0.0");
        assert_eq!(written(1e-7), "1.E-7");
        assert_eq!(written(-2.5e-20), "-2.5E-20");
        assert_eq!(written(1e300), "1.E300");
        let text = Text("a'b\\c é 𝛼\n").to_string();
        assert_eq!(
            text,
            "'a''b\\\\c \\X2\\00E9\\X0\\ \\X4\\0001D6FC\\X0\\\\X2\\000A\\X0\\'"
        );
        assert_eq!(List(&[Real(1.0), Real(2.0)]).to_string(), "(1.0,2.0)");
    }
}
