/// Upper ends of the ranges of nominal lengths, mm; ISO 2768-1, table 1.
const RANGES: [f64; 8] = [3.0, 6.0, 30.0, 120.0, 400.0, 1000.0, 2000.0, 4000.0];
/// Deviations either way by class and range, mm; those that the standard leaves out are of the next range it has.
const CLASSES: [(char, [f64; 8]); 4] = [
    ('f', [0.05, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.5]),
    ('m', [0.1, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0]),
    ('c', [0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.0, 4.0]),
    ('v', [0.5, 0.5, 1.0, 1.5, 2.5, 4.0, 6.0, 8.0]),
];

/// Deviation either way that general tolerances allow a length (mm): by the class that they name, as "ISO 2768-mK" names m, or by class m
/// where they name none.
///
/// Source: ISO 2768-1, table 1; lengths beyond 4 m as of 4 m.
#[must_use]
pub fn general_deviation(words: &str, length: f64) -> f64 {
    let named = words.split_once("2768-").and_then(|(_, class)| {
        let class = class.chars().find(char::is_ascii_alphabetic)?;
        CLASSES.iter().find(|(known, _)| *known == class)
    });
    let (_, deviations) = named.unwrap_or(&CLASSES[1]);
    let range = RANGES.iter().position(|most| length <= *most);
    deviations[range.unwrap_or(RANGES.len() - 1)]
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
