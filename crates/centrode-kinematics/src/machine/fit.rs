use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LinkedMachine, StandardTable};

/// Upper end of the range of the smallest sizes, mm: some holes have limits of their own there. ISO 286-1:2010.
const SMALLEST: f64 = 3.0;

/// Standard tolerances by grade.
static GRADES: LazyLock<StandardTable<10>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../data/iso-286-grades.csv")));

/// Distances of the nearer limit from the nominal size by letter: of shafts below it from d to h, above it from k to p.
static DEVIATIONS: LazyLock<StandardTable<10>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../data/iso-286-deviations.csv")));

/// Lower deviation of shafts r.
static R: LazyLock<StandardTable<2>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../data/iso-286-r.csv")));

/// Lower and upper deviation of a size in a tolerance class, mm.
///
/// Holes have capital letters: D to H and JS in grades 5 to 13, N in grades 6 to 8 (for bearings pressed in), N and P in grade 9
/// (for keyways). Shafts have small ones: d to h and js in grades 5 to 13, k in grades 5 to 7, m to r in grades 5 to 9. `None`
/// for other classes, and for sizes that are not between 0 and 500 mm.
///
/// Source: ISO 286-1:2010, tables of standard tolerance grades and fundamental deviations.
#[must_use]
pub fn limits_of_size(size: f64, class: &str) -> Option<[f64; 2]> {
    let grades = GRADES.up_to(size).filter(|_| size > 0.0)?;
    let letters = class.trim_end_matches(|c: char| c.is_ascii_digit());
    let (_, grade) = class.split_at(letters.len());
    let number: u32 = grade.parse().ok()?;
    let is_smallest = size <= SMALLEST;
    let width = grades[GRADES.column(grade)?];
    let nearer = DEVIATIONS.column(&letters.to_lowercase());
    let from = nearer.and_then(|column| Some(DEVIATIONS.up_to(size)?[column]));
    let lower = match letters {
        "D" | "E" | "F" | "G" | "H" => from?,
        "d" | "e" | "f" | "g" | "h" => -from? - width,
        "JS" | "js" => -0.5 * width,
        // Shaft n mirrored, nearer to the line by the difference in width between this grade and the one before.
        "N" if (6..=8).contains(&number) => {
            let before = grades[GRADES.column(&(number - 1).to_string())?];
            -from? + if is_smallest { 0.0 } else { width - before } - width
        }
        // The upper deviation is -4 µm for holes up to 3 mm at this grade, 0 for larger ones.
        "N" if number == 9 => -width - if is_smallest { 4.0 } else { 0.0 },
        "P" if number == 9 => -width - from?,
        "k" if number <= 7 => from?,
        "m" | "n" | "p" if number <= 9 => from?,
        "r" if number <= 9 => R.up_to(size)?[1],
        _ => return None,
    };
    Some([lower / 1000.0, (lower + width) / 1000.0])
}

/// Letters of the fundamental deviations of holes; those of shafts are the same in lower case.
#[rustfmt::skip]
const LETTERS: [&str; 28] = [
    "A", "B", "C", "CD", "D", "E", "EF", "F", "FG", "G", "H", "JS", "J", "K", "M", "N", "P", "R", "S", "T", "U", "V", "X", "Y", "Z",
    "ZA", "ZB", "ZC",
];

/// Whether a word is a tolerance class of holes, or of shafts: letters of a fundamental deviation and a grade from 01 to 18.
///
/// Source: ISO 286-1:2010.
pub(crate) fn is_class(word: &str, of_hole: bool) -> bool {
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let grade = &word[letters.len()..];
    let known = |letter: &&str| match of_hole {
        true => *letter == letters,
        false => letter.to_lowercase() == letters,
    };
    let number: Option<u32> = grade.parse().ok();
    let graded = grade == "01"
        || (number.is_some_and(|n| n <= 18) && (grade == "0" || !grade.starts_with('0')));
    graded && LETTERS.iter().any(known)
}

/// Rounded preferred numbers from one to ten, series R''20.
const PREFERRED: [f64; 21] = [
    1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0, 8.0,
    9.0, 10.0,
];

/// Preferred size nearest to a size, by ratio: pins, reamers and plates are bought in such sizes.
///
/// At most 9 % off. A value that is not a positive number is returned unchanged. Source: ISO 497:1973, series R''20.
#[must_use]
pub fn preferred_size(size: f64) -> f64 {
    if !(size > 0.0 && size.is_finite()) {
        return size;
    }
    preferred(size, |ratio| ratio.ln().abs())
}

/// Largest preferred size up to a size; see [`preferred_size`]. At most 17 % less.
#[must_use]
pub fn preferred_size_below(size: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    if !(size > 0.0 && size.is_finite()) {
        return size;
    }
    preferred(size, |ratio| match ratio < 1.0 - ROUNDING {
        true => f64::INFINITY,
        false => ratio,
    })
}

/// Preferred size in the decade of a size for which `off`, a function of their ratio, is minimum.
fn preferred(size: f64, off: impl Fn(f64) -> f64) -> f64 {
    let power = size.log10().floor() as i32;
    let decade = 10_f64.powi(power);
    let off = |preferred: f64| off(size / (preferred * decade));
    let nearest = PREFERRED
        .into_iter()
        .min_by(|a, b| off(*a).total_cmp(&off(*b)));
    // Division by a whole power of ten gives the float nearest to the short decimal.
    let nearest = nearest.unwrap_or(1.0);
    if decade < 1.0 {
        nearest / 10_f64.powi(-power)
    } else {
        nearest * decade
    }
}

/// Fit of a hole and what runs or sits in it: one size, a tolerance class for either side.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// Name of the place: "pin of A".
    pub name: String,
    /// Nominal size, mm: a diameter, or the width of a slot.
    pub size: f64,
    /// Whether the size is a width, not a diameter.
    pub is_width: bool,
    /// Tolerance class of the hole or slot, ISO 286.
    pub hole: String,
    /// Tolerance class of what is in it, ISO 286.
    pub shaft: String,
}

/// A pin pressed in one part, on which another turns: one size, a tolerance class each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinFit {
    /// Nominal diameter of pin and holes, mm.
    pub size: f64,
    /// Tolerance class of the pin, ISO 286.
    pub pin: &'static str,
    /// Tolerance class of the hole that it is pressed in.
    pub pressed: &'static str,
    /// Tolerance class of the hole that turns on it.
    pub running: &'static str,
}

impl PinFit {
    /// The fit of the hole that it is pressed in, and of the one that turns on it, with these names.
    #[must_use]
    pub fn fits(&self, [pressed, running]: [&str; 2]) -> [Fit; 2] {
        [
            Fit::new(pressed, self.size, [self.pressed, self.pin]),
            Fit::new(running, self.size, [self.running, self.pin]),
        ]
    }
}

impl Fit {
    /// Fit of a diameter (mm), of a hole's and a shaft's class.
    #[must_use]
    pub fn new(name: &str, size: f64, [hole, shaft]: [&str; 2]) -> Self {
        Self {
            name: name.into(),
            size,
            is_width: false,
            hole: hole.into(),
            shaft: shaft.into(),
        }
    }

    /// Fit of a width (mm), as of a slot.
    #[must_use]
    pub fn of_width(name: &str, size: f64, classes: [&str; 2]) -> Self {
        Self {
            is_width: true,
            ..Self::new(name, size, classes)
        }
    }

    /// Minimum and maximum clearance, mm, below zero for interference: the hole's limits minus the shaft's. `None` if a class or
    /// the size is beyond the tables of [`limits_of_size`].
    #[must_use]
    pub fn clearance(&self) -> Option<[f64; 2]> {
        let [minimum, maximum] = limits_of_size(self.size, &self.hole)?;
        let [thin, thick] = limits_of_size(self.size, &self.shaft)?;
        Some([minimum - thick, maximum - thin])
    }
}

impl LinkedMachine {
    /// Adds a fit, or adds its name to an equal fit.
    pub fn fit(&mut self, fit: Fit) {
        let alike = |known: &&mut Fit| {
            let named = Fit {
                name: known.name.clone(),
                ..fit.clone()
            };
            **known == named
        };
        match self.fits.iter_mut().find(alike) {
            Some(known) if known.name.split(", ").any(|name| name == fit.name) => {}
            Some(known) => known.name = format!("{}, {}", known.name, fit.name),
            None => self.fits.push(fit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_letters_and_a_grade() {
        for (word, hole, shaft) in [
            ("H7", true, false),
            ("js6", false, true),
            ("ZC11", true, false),
            ("cd01", false, true),
            ("h0", false, true),
            ("ZZ99", false, false),
            ("H19", false, false),
            ("H07", false, false),
            ("Js6", false, false),
            ("H", false, false),
            ("7", false, false),
            ("H7²", false, false),
            ("", false, false),
        ] {
            assert_eq!(
                [is_class(word, true), is_class(word, false)],
                [hole, shaft],
                "{word}"
            );
        }
    }

    #[test]
    fn limits_are_those_of_the_standard() {
        let found = |size: f64, class: &str| {
            let micrometres = |mm: f64| (mm * 1e4).round() / 10.0;
            limits_of_size(size, class).map(|limits| limits.map(micrometres))
        };
        for (size, class, limits) in [
            (12.0, "H7", [0.0, 18.0]),
            (10.0, "G7", [5.0, 20.0]),
            (40.0, "E9", [50.0, 112.0]),
            (12.0, "N9", [-43.0, 0.0]),
            (2.0, "N9", [-29.0, -4.0]),
            (2.0, "N7", [-14.0, -4.0]),
            (8.0, "N7", [-19.0, -4.0]),
            (19.0, "N7", [-28.0, -7.0]),
            (40.0, "N7", [-33.0, -8.0]),
            (60.0, "N6", [-33.0, -14.0]),
            (16.0, "N8", [-30.0, -3.0]),
            (8.0, "P9", [-51.0, -15.0]),
            (40.0, "f7", [-50.0, -25.0]),
            (25.0, "g6", [-20.0, -7.0]),
            (60.0, "k6", [2.0, 21.0]),
            (100.0, "p6", [37.0, 59.0]),
            (30.0, "js6", [-6.5, 6.5]),
            (450.0, "h11", [-400.0, 0.0]),
            (23.9, "h12", [-210.0, 0.0]),
            (1.1, "H13", [0.0, 140.0]),
        ] {
            assert_eq!(found(size, class), Some(limits), "{size} {class}");
        }
        for (size, class) in [
            (12.0, ""),
            (12.0, "H"),
            (12.0, "K7"),
            (12.0, "k9"),
            (12.0, "7"),
            (0.0, "H7"),
            (501.0, "H7"),
            (f64::NAN, "H7"),
            (12.0, "é7"),
        ] {
            assert_eq!(found(size, class), None, "{size} {class}");
        }
    }

    #[test]
    fn shafts_r_press_in_holes_h7_up_to_the_largest_size() {
        // Limits of class r6, µm, as ISO 286-2:2010 tables them, at the ends of its ranges and just beyond.
        for (size, low, high) in [
            (1.0, 10.0, 16.0),
            (3.0, 10.0, 16.0),
            (3.1, 15.0, 23.0),
            (10.0, 19.0, 28.0),
            (16.0, 23.0, 34.0),
            (30.0, 28.0, 41.0),
            (50.0, 34.0, 50.0),
            (50.5, 41.0, 60.0),
            (65.5, 43.0, 62.0),
            (100.0, 51.0, 73.0),
            (120.0, 54.0, 76.0),
            (140.0, 63.0, 88.0),
            (160.0, 65.0, 90.0),
            (180.0, 68.0, 93.0),
            (200.0, 77.0, 106.0),
            (225.0, 80.0, 109.0),
            (250.0, 84.0, 113.0),
            (280.0, 94.0, 126.0),
            (315.0, 98.0, 130.0),
            (355.0, 108.0, 144.0),
            (400.0, 114.0, 150.0),
            (450.0, 126.0, 166.0),
            (500.0, 132.0, 172.0),
        ] {
            let found = limits_of_size(size, "r6").expect("a class");
            let off = (found[0] - 1e-3 * low).abs() + (found[1] - 1e-3 * high).abs();
            assert!(off < 1e-12, "{size}: {found:?}");
            let seat = Fit::new("seat", size, ["H7", "r6"]);
            assert!(seat.clearance().expect("classes")[1] <= 0.0, "{size}");
        }
        assert_eq!(limits_of_size(16.0, "r10"), None);
    }

    #[test]
    fn preferred_sizes_below_are_no_larger() {
        for (size, preferred) in [
            (3.022, 3.0),
            (2.99, 2.8),
            (0.375, 0.35),
            (0.2, 0.2),
            (9.99, 9.0),
            (0.0, 0.0),
        ] {
            assert_eq!(preferred_size_below(size), preferred, "{size}");
        }
        for k in 1..500 {
            let size = 0.013 * f64::from(k);
            let below = preferred_size_below(size);
            assert!(below <= size && below > 0.83 * size, "{size} {below}");
        }
    }

    #[test]
    fn preferred_sizes_are_near_and_their_own() {
        for (size, preferred) in [
            (3.022, 3.0),
            (4.029, 4.0),
            (5.036, 5.0),
            (16.115, 16.0),
            (8.057, 8.0),
            (0.97, 1.0),
            (0.31, 0.3),
            (1304.0, 1400.0),
            (0.0, 0.0),
        ] {
            assert_eq!(preferred_size(size), preferred, "{size}");
        }
        assert!(preferred_size(f64::NAN).is_nan());
        for i in 0..2000 {
            let size = 0.01 * 1.007_f64.powi(i);
            let found = preferred_size(size);
            assert!((found / size).ln().abs() < 0.09, "{size}");
            assert_eq!(preferred_size(found), found, "{size}");
        }
    }

    #[test]
    fn clearance_is_least_of_the_smallest_hole_and_the_thickest_shaft() {
        let fit = |hole: &str, shaft: &str| Fit::new("pin", 10.0, [hole, shaft]);
        let [minimum, maximum] = fit("H8", "f7").clearance().expect("known classes");
        assert!((minimum - 0.013).abs() < 1e-12 && (maximum - 0.05).abs() < 1e-12);
        let [minimum, maximum] = fit("H7", "p6").clearance().expect("known classes");
        assert!((minimum + 0.024).abs() < 1e-12 && maximum.abs() < 1e-12);
        assert_eq!(fit("H8", "").clearance(), None);
        let mut machine = LinkedMachine::default();
        let named = |name: &str| Fit {
            name: name.into(),
            ..fit("H8", "f7")
        };
        ["A", "B", "A"]
            .into_iter()
            .for_each(|name| machine.fit(named(name)));
        machine.fit(fit("H7", "p6"));
        let names: Vec<&str> = machine.fits.iter().map(|fit| &*fit.name).collect();
        assert_eq!(names, ["A, B", "pin"]);
    }
}
