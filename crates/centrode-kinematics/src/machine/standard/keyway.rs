use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::StandardTable;

/// A keyway in the bore, along the body's x axis unless the body defines another direction.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Keyway {
    /// Width, mm.
    pub width: f64,
    /// Depth below the bore's circle, mm, measured on the middle of the keyway.
    pub depth: f64,
}

/// Width and height of a parallel key, room above it in the hub, minimum and maximum length, mm.
static KEYS: LazyLock<StandardTable<5>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../../data/din-6885-keys.csv")));

/// Upper end of a range of shaft diameters, width of the key, depth in the hub, mm.
static HUBS: LazyLock<StandardTable<3>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../../data/din-6885-hubs.csv")));

impl Keyway {
    /// Minimum and maximum length of the standard keys as wide as this keyway, mm; `None` if there are none. Source: DIN 6885-1.
    #[must_use]
    pub fn key_lengths(self) -> Option<[f64; 2]> {
        self.standard().map(|[.., short, long]| [short, long])
    }

    /// The standard keys as wide as this keyway.
    fn standard(self) -> Option<[f64; 5]> {
        KEYS.of(self.width)
    }

    /// Pressure between a hub and the key in this keyway of it, N/mm², for a torque (N mm) on a shaft of a diameter and a key
    /// that carries load over a length (mm): 2 T / (d t l), with t the depth of the keyway minus the room above the key.
    ///
    /// Source: DIN 6892, method C.
    #[must_use]
    pub fn pressure(self, torque: f64, diameter: f64, length: f64) -> f64 {
        let room = self.sizes().2;
        2.0 * torque / (diameter * (self.depth - room) * length)
    }

    /// The keyway of a hub on a shaft of a diameter (mm), for parallel keys to ISO/R 773 and DIN 6885-1; `None` up to 6 mm and
    /// beyond 110 mm.
    #[must_use]
    pub fn of_bore(diameter: f64) -> Option<Self> {
        let [_, width, depth] = *HUBS.up_to(diameter).filter(|_| diameter > 6.0)?;
        Some(Self { width, depth })
    }

    /// How much deeper than its nominal depth the keyway of a standard parallel key may be, in hub and shaft, mm; `None` for
    /// other widths. Source: DIN 6885-1.
    #[must_use]
    pub fn depth_tolerance(self) -> Option<f64> {
        let [width, ..] = self.standard()?;
        Some(if width <= 6.0 { 0.1 } else { 0.2 })
    }

    /// The keyway of a hub that mates with this one of a shaft: as wide, and as deep as DIN 6885-1 requires for keys of this
    /// width; for other widths, for a square key with room above it.
    #[must_use]
    pub fn of_hub(self) -> Self {
        self.mate()
    }

    /// The keyway of a shaft that mates with this one of a hub, by the same sizes.
    #[must_use]
    pub fn of_shaft(self) -> Self {
        self.mate()
    }

    /// Height of the key in it, mm: that of the standard for its width, or as high as wide.
    pub(super) fn key_height(self) -> f64 {
        self.sizes().1
    }

    /// Width and height of its key, and the room above the key, mm.
    fn sizes(self) -> (f64, f64, f64) {
        self.standard().map_or(
            (self.width, self.width, 0.06 * self.width),
            |[width, height, room, ..]| (width, height, room),
        )
    }

    /// The keyway on the other side of the key: both depths together are the key's height plus the room above it.
    fn mate(self) -> Self {
        let Self { width, depth } = self;
        let (_, height, room) = self.sizes();
        Self {
            width,
            depth: (height - depth + room).max(room),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_those_of_the_standard() {
        let of = |bore: f64| Keyway::of_bore(bore).map(|key| (key.width, key.depth));
        for (bore, keyway) in [
            (6.0, None),
            (8.0, Some((2.0, 1.0))),
            (16.0, Some((5.0, 2.3))),
            (17.0, Some((5.0, 2.3))),
            (17.5, Some((6.0, 2.8))),
            (40.0, Some((12.0, 3.3))),
            (110.0, Some((28.0, 6.4))),
            (111.0, None),
            (f64::NAN, None),
        ] {
            assert_eq!(of(bore), keyway, "{bore}");
        }
        let lengths = |width: f64| Keyway { width, depth: 2.0 }.key_lengths();
        assert_eq!((lengths(5.0), lengths(5.5)), (Some([10.0, 56.0]), None));
        let room = |width: f64| Keyway { width, depth: 2.0 }.depth_tolerance();
        assert_eq!([6.0, 8.0, 5.5].map(room), [Some(0.1), Some(0.2), None]);
    }

    #[test]
    fn the_pressure_on_a_key_turns_the_shaft() {
        // 2 mm of a key of 5 x 5 mm stand in the hub: forces of 100 N/mm² on 2 x 8 mm at 8 mm from the axis.
        let hub = Keyway {
            width: 5.0,
            depth: 2.3,
        };
        assert!((hub.pressure(12_800.0, 16.0, 8.0) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_keyway_of_a_bore_is_as_deep_as_its_key_and_the_shaft_leave_it() {
        // Depths in the shaft, DIN 6885-1.
        for (bore, depth) in [
            (12.0, 2.5),
            (16.0, 3.0),
            (20.0, 3.5),
            (25.0, 4.0),
            (35.0, 5.0),
            (100.0, 10.0),
        ] {
            let hub = Keyway::of_bore(bore).expect("a keyway");
            let shaft = Keyway { depth, ..hub };
            assert!((shaft.of_hub().depth - hub.depth).abs() < 1e-12, "{bore}");
        }
    }
}
