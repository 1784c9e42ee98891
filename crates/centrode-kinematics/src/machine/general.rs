use std::sync::LazyLock;

use super::StandardTable;

/// Symmetric deviations by class and range of lengths, mm.
static CLASSES: LazyLock<StandardTable<5>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../data/iso-2768-1.csv")));
/// Column of class m.
const MEDIUM: usize = 2;

/// Symmetric deviation that general tolerances allow a length (mm), mm: by the class that they name, m in "ISO 2768-mK", or by
/// class m if they name none.
///
/// Source: ISO 2768-1, table 1; lengths above 4 m count as 4 m.
#[must_use]
pub fn general_deviation(words: &str, length: f64) -> f64 {
    let named = words.split_once("2768-").and_then(|(_, class)| {
        let class = class.chars().find(char::is_ascii_alphabetic)?;
        CLASSES.column(&class.to_string())
    });
    let row = CLASSES.up_to(length).or(CLASSES.rows.last());
    row.map_or(0.0, |row| row[named.unwrap_or(MEDIUM)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_those_of_the_class_that_is_named() {
        for (words, length, deviation) in [
            ("ISO 2768-mK", 6.0, 0.1),
            ("ISO 2768-mK", 15.0, 0.2),
            ("ISO 2768-mK", 42.0, 0.3),
            ("ISO 2768-fH", 42.0, 0.15),
            ("ISO 2768-cL", 3.0, 0.2),
            ("ISO 2768-v", 500.0, 4.0),
            ("ISO 22081", 15.0, 0.2),
            ("", 5000.0, 2.0),
        ] {
            assert_eq!(
                general_deviation(words, length),
                deviation,
                "{words} {length}"
            );
        }
    }
}
