use centrode_geometry::{Outline, Point, Solid};

use centrode_spec::digits::thousandths;

/// Inner and outer diameter of shims, mm; DIN 988.
#[rustfmt::skip]
const SHIMS: [[f64; 2]; 27] = [
    [3.0, 6.0], [4.0, 8.0], [5.0, 10.0], [6.0, 12.0], [7.0, 13.0], [8.0, 14.0], [9.0, 15.0], [10.0, 16.0], [11.0, 17.0],
    [12.0, 18.0], [13.0, 19.0], [14.0, 20.0], [15.0, 21.0], [16.0, 22.0], [17.0, 24.0], [18.0, 25.0], [19.0, 26.0],
    [20.0, 28.0], [22.0, 30.0], [25.0, 35.0], [26.0, 37.0], [28.0, 40.0], [30.0, 42.0], [32.0, 45.0], [36.0, 45.0],
    [40.0, 50.0], [50.0, 62.0],
];
/// Thicknesses of shims of every diameter, mm; DIN 988.
const THICKNESSES: [f64; 5] = [1.0, 0.5, 0.3, 0.2, 0.1];
/// Maximum number of shims in one gap; a sleeve fills a wider one.
const MOST: usize = 3;
/// Difference of lengths that is rounding, mm.
const ROUNDING: f64 = 1e-6;

/// Ring on a pin or shaft: it fills a gap between two parts there, or rolls on a cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacer {
    /// Diameter of the pin or shaft, mm.
    pub inner: f64,
    /// Outer diameter, mm.
    pub outer: f64,
    /// Length along the axis, mm.
    pub length: f64,
    /// Its use.
    pub kind: SpacerKind,
}

/// Use of a ring on a pin or shaft.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum SpacerKind {
    /// Shim of DIN 988, which is bought.
    Shim,
    /// Sleeve, which is made.
    Sleeve,
    /// Roller of a cam's follower, which is made.
    Roller,
}

impl Spacer {
    /// Tolerance class of the bore of a sleeve, which goes over a shaft of any of the usual classes.
    pub const BORE: &'static str = "D10";
    /// Minimum wall of a roller, as a share of its pin's diameter.
    pub const ROLLER_WALL: f64 = 0.1;
    /// Tolerance class of the rim of a roller.
    pub const RIM: &'static str = "h7";

    /// The roller of a radius that turns on a pin of a diameter, as wide as its cam, all in mm; `None` if its wall would be
    /// thinner than a tenth of the pin, as for a follower that is a point.
    #[must_use]
    pub fn roller(radius: f64, pin: f64, width: f64) -> Option<Self> {
        let roller = Self {
            inner: pin,
            outer: 2.0 * radius,
            length: width,
            kind: SpacerKind::Roller,
        };
        (pin > 0.0 && radius - 0.5 * pin >= Self::ROLLER_WALL * pin - ROUNDING).then_some(roller)
    }

    /// Rings for a gap on a diameter, mm: up to three shims of DIN 988, or a sleeve of their diameters. Empty if the standard has
    /// no shim of the diameter.
    #[must_use]
    pub fn filling(diameter: f64, gap: f64) -> Vec<Self> {
        let sizes = SHIMS.into_iter().find(|[inner, _]| *inner == diameter);
        let Some([inner, outer]) = sizes.filter(|_| gap > ROUNDING && gap.is_finite()) else {
            return Vec::new();
        };
        let ring = |length: f64, kind: SpacerKind| Self {
            inner,
            outer,
            length,
            kind,
        };
        let (mut left, mut shims) = (gap, Vec::new());
        while shims.len() < MOST
            && let Some(thickness) = THICKNESSES.into_iter().find(|t| *t <= left + ROUNDING)
        {
            shims.push(ring(thickness, SpacerKind::Shim));
            left -= thickness;
        }
        match left.abs() <= ROUNDING {
            true => shims,
            false => vec![ring(gap, SpacerKind::Sleeve)],
        }
    }

    /// The ring next to a roller on one pin: its outer diameter is reduced if it would cover more than half of the roller's wall.
    #[must_use]
    pub fn beside(self, roller: Self) -> Self {
        let most = 0.5 * (roller.inner + roller.outer);
        match self.outer <= most {
            true => self,
            false => Self {
                outer: most,
                kind: SpacerKind::Sleeve,
                ..self
            },
        }
    }

    /// Designation of a shim, "Shim DIN 988 - 6 x 12 x 1"; title of a sleeve or roller, "Sleeve 6 x 12 x 13".
    #[must_use]
    pub fn name(self) -> String {
        let sizes = self.sizes(" x ");
        match self.kind {
            SpacerKind::Shim => format!("Shim DIN 988 - {sizes}"),
            SpacerKind::Sleeve => format!("Sleeve {sizes}"),
            SpacerKind::Roller => format!("Cam roller {sizes}"),
        }
    }

    /// Name that the files of a sleeve or roller begin with; `None` for a shim.
    #[must_use]
    pub fn file(self) -> Option<String> {
        let word = match self.kind {
            SpacerKind::Shim => return None,
            SpacerKind::Sleeve => "sleeve",
            SpacerKind::Roller => "roller",
        };
        Some(format!("{word}-{}", self.sizes("x")).replace('.', "-"))
    }

    fn sizes(self, times: &str) -> String {
        let all = [self.inner, self.outer, self.length].map(thousandths);
        all.join(times)
    }

    /// Whether another ring is the same within rounding.
    #[must_use]
    pub fn is_like(self, other: Self) -> bool {
        let sizes = |ring: Self| [ring.inner, ring.outer, ring.length];
        let mut both = sizes(self).into_iter().zip(sizes(other));
        self.kind == other.kind && both.all(|(a, b)| (a - b).abs() < ROUNDING)
    }

    /// Its body, from z = 0 upwards.
    #[must_use]
    pub fn solid(self) -> Option<Solid> {
        let circle = |diameter: f64| Outline::circle(Point::origin(), 0.5 * diameter);
        let hole = vec![circle(self.inner)];
        Solid::new(circle(self.outer), hole, 0.0, self.length).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(diameter: f64, gap: f64) -> Vec<String> {
        let rings = Spacer::filling(diameter, gap).into_iter();
        rings.map(Spacer::name).collect()
    }

    #[test]
    fn a_gap_is_filled_by_shims_or_a_sleeve_as_long() {
        assert_eq!(names(6.0, 1.0), ["Shim DIN 988 - 6 x 12 x 1"]);
        let shims = ["Shim DIN 988 - 10 x 16 x 1", "Shim DIN 988 - 10 x 16 x 0.5"];
        assert_eq!(names(10.0, 1.5), shims);
        assert_eq!(names(6.0, 0.8 - 1e-9).len(), 2);
        for gap in [0.05, 1.05, 3.4, 13.0] {
            let made = Spacer::filling(6.0, gap);
            assert!(
                matches!(made[..], [ring] if ring.kind == SpacerKind::Sleeve && ring.length == gap)
            );
        }
        assert_eq!(names(6.0, 13.0), ["Sleeve 6 x 12 x 13"]);
        let file = Spacer::filling(6.0, 13.5)[0].file();
        assert_eq!(file.as_deref(), Some("sleeve-6x12x13-5"));
        assert_eq!(Spacer::filling(6.0, 1.0)[0].file(), None);
        for (diameter, gap) in [(6.5, 1.0), (6.0, 0.0), (6.0, -1.0), (6.0, f64::NAN)] {
            assert!(names(diameter, gap).is_empty());
        }
        let volume = std::f64::consts::PI * (36.0 - 9.0) * 13.0;
        let body = Spacer::filling(6.0, 13.0)[0].solid().expect("a body");
        assert!((body.volume() - volume).abs() < 1e-9);
    }

    #[test]
    fn a_roller_has_a_wall_of_a_tenth_of_its_pin_or_is_none() {
        let roller = Spacer::roller(6.0, 6.0, 10.5).expect("a roller");
        assert_eq!(roller.name(), "Cam roller 6 x 12 x 10.5");
        assert_eq!(roller.file().as_deref(), Some("roller-6x12x10-5"));
        assert!(Spacer::roller(3.6, 6.0, 10.0).is_some());
        // A shim of 12 mm would reach as far as the cam.
        let shim = Spacer::filling(6.0, 1.0)[0];
        assert_eq!(shim.beside(roller).name(), "Sleeve 6 x 9 x 1");
        let wide = Spacer::roller(10.0, 6.0, 10.0).expect("a roller");
        assert_eq!(shim.beside(wide), shim);
        for (radius, pin) in [(3.5, 6.0), (0.0, 6.0), (6.0, 0.0), (f64::NAN, 6.0)] {
            assert!(Spacer::roller(radius, pin, 10.0).is_none());
        }
    }

    #[test]
    fn shims_are_wider_than_rings_of_their_shaft() {
        for [inner, outer] in SHIMS {
            assert!(outer > 1.2 * inner && outer <= 2.0 * inner, "{inner}");
        }
    }
}
