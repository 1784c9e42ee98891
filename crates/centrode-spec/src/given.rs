use std::collections::BTreeSet;

use super::{Design, rule::same};

/// Numbers that a design gives, to mark figures of its check as given or found.
#[derive(Debug)]
pub struct Given {
    numbers: Vec<(String, f64)>,
    names: BTreeSet<String>,
}

/// Parts before the name of a key in the name of a figure: `driver_tooth_count`.
const PARTS: [&str; 3] = ["driver_", "driven_", "gear_"];

impl Given {
    /// The numbers of a design, and the names of all keys that its file may have.
    #[must_use]
    pub fn new(design: &dyn Design) -> Self {
        Self {
            numbers: design
                .numbered(&[])
                .map_or(Vec::new(), |numbered| numbered.all()),
            names: design.family().key_names(),
        }
    }

    /// Whether a figure, in the file's unit, is a number that the design gives; `Some(false)` if the design may give it but leaves
    /// it to the program, and `None` for a figure that no key can give.
    #[must_use]
    pub fn has(&self, figure: &str, value: f64) -> Option<bool> {
        let part = PARTS.into_iter().find_map(|part| figure.strip_prefix(part));
        let name = part.unwrap_or(figure);
        let names = [name.to_owned(), format!("{name}_deg")];
        let name_of = |key: &str| {
            let key = key.split('[').next().unwrap_or_default();
            key[key.rfind('.').map_or(0, |dot| dot + 1)..].to_owned()
        };
        let mut numbers = self.numbers.iter();
        let is_given =
            numbers.any(|(key, number)| names.contains(&name_of(key)) && same(*number, value));
        let may_be_given = || names.iter().any(|name| self.names.contains(name));
        (is_given || may_be_given()).then_some(is_given)
    }
}
