//! Purchased parts that are designated by a standard.

mod bearing;
mod key;
mod keyway;
mod rule;
mod screw;
mod table;

use std::sync::LazyLock;

use centrode_geometry::{Arc, Outline, Point, Segment, Solid};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::preferred_size;
pub use bearing::Bearing;
pub use key::{Key, allowed_pressure};
pub use keyway::Keyway;
pub use rule::{hole_class, screw_size, shaft_class};
pub use screw::Screw;
pub use table::StandardTable;

/// Diameters of parallel pins of hardened steel, mm; ISO 8734:1997.
const DOWELS: [f64; 14] = [
    1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0,
];
/// Lengths of parallel pins, mm; ISO 8734:1997.
const LENGTHS: [f64; 30] = [
    3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 24.0, 26.0, 28.0, 30.0,
    32.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 90.0, 100.0,
];

/// Parallel pin of hardened steel, tolerance class m6, ISO 8734.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dowel {
    /// Diameter, mm.
    pub diameter: f64,
    /// Length, mm.
    pub length: f64,
}

impl Dowel {
    /// Diameter of the pin nearest to a size by ratio, mm; the preferred size if that is beyond all pins.
    #[must_use]
    pub fn nearest_diameter(size: f64) -> f64 {
        let preferred = preferred_size(size);
        if !(DOWELS[0]..=DOWELS[DOWELS.len() - 1]).contains(&preferred) {
            return preferred;
        }
        let off = |diameter: f64| (diameter / size).ln().abs();
        let nearer = |a: f64, b: f64| if off(b) < off(a) { b } else { a };
        DOWELS.into_iter().reduce(nearer).unwrap_or(preferred)
    }

    /// The longest pin of a diameter that is no longer than `room`, mm; `None` if there is no such pin.
    #[must_use]
    pub fn for_diameter(diameter: f64, room: f64) -> Option<Self> {
        let known = DOWELS.contains(&diameter);
        let mut fitting = LENGTHS.into_iter().rev();
        // A sum of layers differs from a standard length by rounding.
        let length = fitting.find(|&length| length <= room * (1.0 + 1e-9))?;
        known.then_some(Self { diameter, length })
    }

    /// Designation: "Pin ISO 8734 - 8 x 32 - A".
    #[must_use]
    pub fn name(self) -> String {
        format!("Pin ISO 8734 - {} x {} - A", self.diameter, self.length)
    }
}

/// Retaining ring of a shaft, in a groove.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Circlip {
    /// Diameter of the shaft, mm.
    pub shaft: f64,
    /// Thickness of the ring, mm.
    pub thickness: f64,
    /// Diameter of the groove, mm.
    pub groove: f64,
    /// Width of the groove, mm.
    pub width: f64,
    /// Minimum length of the shaft beyond the groove, mm.
    pub land: f64,
    /// Radial width of the ring opposite its gap, mm.
    pub radial: f64,
}

/// Shaft, thickness, groove, width, land, radial width of the ring, mm.
static CIRCLIPS: LazyLock<StandardTable<6>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../../data/din-471.csv")));

impl Circlip {
    /// The ring of a shaft of a diameter, mm; `None` if there is no such ring.
    #[must_use]
    pub fn of_shaft(diameter: f64) -> Option<Self> {
        let [shaft, thickness, groove, width, land, radial] = CIRCLIPS.of(diameter)?;
        Some(Self {
            shaft,
            thickness,
            groove,
            width,
            land,
            radial,
        })
    }

    /// Designation: "Circlip DIN 471 - 10 x 1".
    #[must_use]
    pub fn name(self) -> String {
        format!("Circlip DIN 471 - {} x {}", self.shaft, self.thickness)
    }

    /// Tolerance class of the groove's diameter, ISO 286.
    #[must_use]
    pub fn class(self) -> &'static str {
        match self.shaft {
            d if d <= 10.0 => "h10",
            d if d <= 21.0 => "h11",
            _ => "h12",
        }
    }

    /// Length of a shaft that the groove with the land beyond it takes, mm.
    #[must_use]
    pub fn room(self) -> f64 {
        self.width + self.land
    }

    /// Distance from the axis to the ends of its ears, mm: the ears are about twice as wide as the ring.
    #[must_use]
    pub fn reach(self) -> f64 {
        0.5 * self.groove + 2.0 * self.radial
    }

    /// Its body at the bottom of its groove, from z = 0 upwards: of constant width, its gap as wide and along x, without its
    /// ears.
    #[must_use]
    pub fn solid(self) -> Option<Solid> {
        let (inner, half) = (0.5 * self.groove, 0.5 * self.radial);
        let outer = inner + self.radial;
        let at = |radius: f64, y: f64| Point::new((radius * radius - y * y).sqrt(), y);
        let arc = |start: Point, end: Point, turn: f64| {
            let bulge = (0.25 * turn).tan();
            Segment::Arc(Arc { start, end, bulge })
        };
        // Each circle in two arcs, less than half of it each.
        let turn = |radius: f64| std::f64::consts::PI - (half / radius).asin();
        let opposite = |radius: f64| Point::new(-radius, 0.0);
        let outline = Outline::new(vec![
            arc(at(outer, half), opposite(outer), turn(outer)),
            arc(opposite(outer), at(outer, -half), turn(outer)),
            Segment::Line(at(outer, -half), at(inner, -half)),
            arc(at(inner, -half), opposite(inner), -turn(inner)),
            arc(opposite(inner), at(inner, half), -turn(inner)),
            Segment::Line(at(inner, half), at(outer, half)),
        ]);
        Solid::new(outline.ok()?, Vec::new(), 0.0, self.thickness).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn designations_are_those_of_the_standards() {
        let pin = |diameter, room| Dowel::for_diameter(diameter, room).map(Dowel::name);
        let name = |diameter, room| pin(diameter, room).unwrap_or_default();
        assert_eq!(name(8.0, 32.0), "Pin ISO 8734 - 8 x 32 - A");
        assert_eq!(name(8.0, 31.9), "Pin ISO 8734 - 8 x 30 - A");
        assert_eq!(name(7.5, 32.0), "");
        assert_eq!(name(2.0, 2.0), "");
        let ring = Circlip::of_shaft(10.0).expect("a ring");
        assert_eq!(ring.name(), "Circlip DIN 471 - 10 x 1");
        assert_eq!((ring.groove, ring.class()), (9.6, "h10"));
        assert_eq!(Circlip::of_shaft(10.5), None);
    }

    #[test]
    fn a_ring_lies_in_its_groove_and_the_groove_in_the_shaft() {
        for [shaft, thickness, groove, width, land, radial] in CIRCLIPS.rows.iter().copied() {
            assert!(groove < shaft && groove > 0.9 * shaft, "{shaft}");
            assert!(thickness < width && width < thickness + 0.2, "{shaft}");
            // DIN 471 asks for a land of three times the groove's depth, rounded.
            let depth = 0.5 * (shaft - groove);
            assert!((land - 3.0 * depth).abs() < 0.16, "{shaft}");
            assert!(radial > depth && radial < 0.28 * shaft, "{shaft}");
            let ring = Circlip::of_shaft(shaft).expect("a ring");
            let body = ring.solid().expect("a body");
            let (inner, half) = (0.5 * groove, 0.5 * radial);
            let outer = inner + radial;
            // The ring less its gap, a strip between two circles.
            let sector = |r: f64| r * r * (half / r).asin() + half * (r * r - half * half).sqrt();
            let ring = std::f64::consts::PI * (outer * outer - inner * inner);
            let area = ring - (sector(outer) - sector(inner));
            assert!((body.volume() - thickness * area).abs() < 1e-9, "{shaft}");
        }
    }
}
