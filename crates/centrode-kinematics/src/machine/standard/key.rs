use centrode_geometry::{Outline, Point, Solid};

use super::Keyway;

/// Parallel key, DIN 6885-1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
    /// Length, mm.
    pub length: f64,
    /// Whether its ends are square, form B; form A has round ones.
    pub has_square_ends: bool,
}

/// Lengths of parallel keys, mm; DIN 6885-1.
const LENGTHS: [u16; 33] = [
    6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110,
    125, 140, 160, 180, 200, 220, 250, 280, 320, 360,
];
/// Minimum length of a key that is cut from key steel, as a share of its width.
const STUBBIEST: f64 = 0.5;

impl Key {
    /// The longest key with round ends, form A, for a hub with a keyway and a face width, mm; `None` where no standard key is
    /// as wide as the keyway, or as short as the hub.
    #[must_use]
    pub fn round(hub: Keyway, face: f64) -> Option<Self> {
        let [minimum, maximum] = hub.key_lengths()?;
        let mut fitting = LENGTHS.into_iter().rev().map(f64::from);
        let length = fitting.find(|&length| length <= face && length <= maximum)?;
        (length >= minimum).then_some(Self {
            width: hub.width,
            height: hub.key_height(),
            length,
            has_square_ends: false,
        })
    }

    /// The longest key with square ends, form B, for such a hub: it carries load over its whole length. For a hub thinner than
    /// the shortest standard key it is cut from key steel, to whole millimetres; `None` if it would be shorter than half its
    /// width.
    #[must_use]
    pub fn square(hub: Keyway, face: f64) -> Option<Self> {
        hub.key_lengths()?;
        let length = Self::round(hub, face).map_or(face.floor(), |standard| standard.length);
        (length >= STUBBIEST * hub.width).then_some(Self {
            width: hub.width,
            height: hub.key_height(),
            length,
            has_square_ends: true,
        })
    }

    /// The longest key for such a hub: form A, or form B if one with round ends would carry load over no more than half its
    /// length.
    #[must_use]
    pub fn fitting(hub: Keyway, face: f64) -> Option<Self> {
        let round = Self::round(hub, face);
        let round = round.filter(|key| key.bearing_length() > 0.5 * key.length);
        round.or_else(|| Self::square(hub, face))
    }

    /// Designation: "Key DIN 6885-1 A 5 x 5 x 14", or of one that is cut from key steel "Key DIN 6880 B 5 x 5 x 8".
    #[must_use]
    pub fn name(self) -> String {
        let form = if self.has_square_ends { 'B' } else { 'A' };
        let [width, height, length] = [self.width, self.height, self.length];
        let size = format!("{form} {width} x {height} x {length}");
        let hub = Keyway { width, depth: 0.0 };
        match hub.key_lengths() {
            Some([minimum, _]) if length < minimum => format!("Key DIN 6880 {size}"),
            _ => format!("Key DIN 6885-1 {size}"),
        }
    }

    /// Length over which its sides carry load, mm: without round ends.
    #[must_use]
    pub fn bearing_length(self) -> f64 {
        match self.has_square_ends {
            true => self.length,
            false => self.length - self.width,
        }
    }

    /// Its body, without chamfers, along y from the origin and upwards from z = 0.
    #[must_use]
    pub fn solid(self) -> Option<Solid> {
        let half = 0.5 * self.width;
        let outline = match self.has_square_ends {
            true => {
                let corners = [
                    [-half, 0.0],
                    [half, 0.0],
                    [half, self.length],
                    [-half, self.length],
                ];
                Outline::polygon(&corners.map(Point::from))
            }
            false => {
                let ends = [half, self.length - half].map(|y| (Point::new(0.0, y), half));
                Outline::hull(&ends)?
            }
        };
        Solid::new(outline, Vec::new(), 0.0, self.height).ok()
    }
}

/// Share of the yield strength of the weakest of key, shaft and hub that the pressure on a key may reach; DIN 6892, method C.
const SHARE: f64 = 0.9;
/// Yield strength of the weakest structural steel, S235, N/mm²; EN 10025-2, up to 16 mm thick.
const WEAKEST: f64 = 235.0;

/// Permitted pressure on the side of a key by the material, N/mm²: 0.9 of its yield strength, read from names such as S355 or
/// E335, or that of S235 for a steel without such a name. `None` for other materials: the design does not state their strength.
///
/// Source: DIN 6892, method C; EN 10025-2.
#[must_use]
pub fn allowed_pressure(material: &str) -> Option<f64> {
    let words = material.split(|c: char| !c.is_ascii_alphanumeric());
    let grade = words.filter_map(|word| {
        let number = word.strip_prefix(['S', 'E'])?;
        let digits = number.get(..3)?;
        digits.parse::<f64>().ok()
    });
    let named = grade.fold(None, |minimum: Option<f64>, yielding| {
        Some(minimum.map_or(yielding, |known| known.min(yielding)))
    });
    let weakest = material.contains("steel").then_some(WEAKEST);
    named.or(weakest).map(|yielding| SHARE * yielding)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_key_is_named_by_its_standard_and_is_as_large_as_that() {
        let hub = Keyway {
            width: 8.0,
            depth: 3.3,
        };
        let [round, square] = [Key::round(hub, 30.0), Key::square(hub, 30.0)].map(Option::unwrap);
        assert_eq!(round.name(), "Key DIN 6885-1 A 8 x 7 x 28");
        assert_eq!(square.name(), "Key DIN 6885-1 B 8 x 7 x 28");
        assert_eq!(
            (round.bearing_length(), square.bearing_length()),
            (20.0, 28.0)
        );
        let volume = |key: Key| key.solid().expect("a body").volume();
        assert!((volume(square) - 8.0 * 7.0 * 28.0).abs() < 1e-9);
        assert!((volume(round) - 7.0 * (8.0 * 20.0 + 16.0 * PI)).abs() < 1e-9);
        assert_eq!(
            (Key::round(hub, 17.9), Key::round(hub, f64::NAN)),
            (None, None)
        );
        let fitting = |face: f64| Key::fitting(hub, face).map(Key::name);
        for (face, name) in [
            (500.0, "Key DIN 6885-1 A 8 x 7 x 90"),
            (18.0, "Key DIN 6885-1 A 8 x 7 x 18"),
            (17.9, "Key DIN 6880 B 8 x 7 x 17"),
            (4.0, "Key DIN 6880 B 8 x 7 x 4"),
        ] {
            assert_eq!(fitting(face).as_deref(), Some(name), "{face}");
        }
        assert_eq!((fitting(3.9), fitting(f64::NAN)), (None, None));
        let odd = Keyway {
            width: 5.5,
            depth: 2.0,
        };
        assert_eq!(Key::round(odd, 30.0), None);
    }

    #[test]
    fn a_material_bears_nine_tenths_of_its_yield_strength() {
        for (material, bears) in [
            ("steel", Some(211.5)),
            ("spring steel", Some(211.5)),
            ("steel S355J2", Some(319.5)),
            ("E335", Some(301.5)),
            ("S355 on S235JR", Some(211.5)),
            ("aluminium alloy", None),
            ("Steel", None),
            ("", None),
            ("SIS", None),
        ] {
            let found = allowed_pressure(material);
            let same = match (found, bears) {
                (Some(found), Some(bears)) => (found - bears).abs() < 1e-9,
                (found, bears) => found == bears,
            };
            assert!(same, "{material}: {found:?}");
        }
    }
}
