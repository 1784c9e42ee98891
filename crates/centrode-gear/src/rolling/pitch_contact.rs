//! The two pitch curves where they touch.

use std::f64::consts::TAU;

use centrode_geometry::{Extreme, Jet, Vector, maximum_of_each};

use super::Rolling;

/// Minimum and maximum curvature of a member's pitch curve (1/mm), each with its arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureRange {
    /// Minimum curvature; negative for a curve with a concave part.
    pub minimum: (f64, f64),
    /// Maximum curvature.
    pub maximum: (f64, f64),
}

/// The two pitch curves where they touch, and the angles by which both gears have turned there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchContact {
    /// Parameter of the driver's pitch curve.
    pub parameter: f64,
    /// Driver angle, rad.
    pub input: f64,
    /// Driven angle, rad.
    pub driven_angle: f64,
    /// Unit vector from the driver's axis to the driven one, in the driver's axes.
    pub direction: Vector,
    /// Radius of the driver's pitch curve and of the driven gear's, mm.
    pub radii: [f64; 2],
    /// Cosine and sine of the angle mu from the circle about the driver's axis to the common tangent of the pitch curves:
    /// tan mu = r'/r.
    pub inclination: (f64, f64),
}

impl PitchContact {
    /// Driven turn per driver turn.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.radii[0] / self.radii[1]
    }
}

impl Rolling {
    /// The pitch curves where they touch at a parameter of the driver's.
    #[must_use]
    pub fn pitch_contact(&self, t: f64) -> PitchContact {
        let (inside, turns) = self.wrapped(t);
        let jet = self.curve.at(inside);
        let p = jet.point.coords;
        let r = p.norm();
        PitchContact {
            parameter: t,
            input: self.polar_angle(inside, &jet) + turns * TAU,
            driven_angle: self.driven.at(inside) + turns * self.driven.total(),
            direction: p / r,
            radii: [r, self.center_distance - r],
            inclination: inclination(&jet),
        }
    }

    /// Cosine and sine of the angle mu at a parameter, as in [`PitchContact`].
    pub(crate) fn inclination(&self, t: f64) -> (f64, f64) {
        inclination(&self.curve.at(self.wrapped(t).0))
    }

    /// Curvature of the driver's pitch curve and of the driven gear's at a parameter, 1/mm, positive where convex. By Euler and
    /// Savary their sum is that of circles about the axes, times cos mu.
    #[must_use]
    pub fn curvatures(&self, t: f64) -> [f64; 2] {
        let jet = self.curve.at(self.wrapped(t).0);
        let r = jet.point.coords.norm();
        let cos = jet.point.coords.perp(&jet.first) / (r * jet.first.norm());
        let curvature = jet.curvature();
        [
            curvature,
            cos / r + cos / (self.center_distance - r) - curvature,
        ]
    }

    /// Curvature of the driver's pitch curve and of the driven gear's over a whole cycle, to the float limit between breaks.
    #[must_use]
    pub fn curvature_ranges(&self) -> [CurvatureRange; 2] {
        *self.ranges.get_or_init(|| {
            let all = |t: f64| {
                let [driver, driven] = self.curvatures(t);
                [-driver, driver, -driven, driven]
            };
            let found = maximum_of_each(all, &self.pieces());
            let [a, b, c, d] =
                found.map(|Extreme { input, value }| (self.arc_length(input), value));
            [(a, b), (c, d)].map(|((arc, negative), maximum)| CurvatureRange {
                minimum: (arc, -negative),
                maximum,
            })
        })
    }
}

fn inclination(jet: &Jet) -> (f64, f64) {
    let p = jet.point.coords;
    let size = p.norm() * jet.first.norm();
    (p.perp(&jet.first) / size, p.dot(&jet.first) / size)
}
