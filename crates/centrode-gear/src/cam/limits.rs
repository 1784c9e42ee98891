//! Margins of a cam: pressure angle, radii of curvature, undercut.

use centrode_geometry::{Extreme, bracketed_root, maximum_of_each};

use super::disc::DiscCam;

/// Pressure angles and radii of curvature of a cam, over a whole turn, to the float limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Maximum size of the pressure angle while the cam lifts the follower, rad.
    pub rise_pressure_angle: Extreme,
    /// Maximum size of the pressure angle while the follower comes back, rad.
    pub return_pressure_angle: Extreme,
    /// Minimum radius of curvature of the path of the roller's centre where it is convex, mm: the largest
    /// roller the path allows without undercut. `None` for a flat face.
    pub largest_roller: Option<Extreme>,
    /// Minimum radius of curvature of the profile where it is convex, mm; at most zero where it is undercut.
    pub minimum_radius: Extreme,
    /// Minimum radius of curvature of the profile where it is concave, mm: the largest grinding wheel;
    /// infinite for a convex cam.
    pub largest_wheel: Extreme,
    /// Range of the contact along a flat face, from the minimum to the maximum position, mm.
    pub face: Option<(f64, f64)>,
    /// Minimum [`regularity`](super::Contact::regularity): the profile is undercut where it is not
    /// above zero.
    pub regularity: Extreme,
}

/// Ratio of each base radius tried to the one before. A larger ratio can skip a small radius that works, a smaller one
/// takes longer.
const STEP: f64 = 1.02;

impl DiscCam {
    /// Pressure angles and radii of curvature over a turn.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let flat = self.follower().roller_radius().is_none();
        let all = |input: f64| {
            let contact = self.contact(input);
            let pressure = |sign: f64| match sign * contact.motion.velocity > 0.0 {
                true => contact.pressure_angle.abs(),
                false => 0.0,
            };
            let either = if flat {
                contact.face
            } else {
                contact.pitch_curvature
            };
            let either = either.unwrap_or(0.0);
            let irregular = -contact.regularity;
            [pressure(1.0), pressure(-1.0), irregular, either, -either]
        };
        let [rise, fall, irregular, most, minimum] = maximum_of_each(all, &self.ends());
        let regularity = Extreme {
            value: -irregular.value,
            ..irregular
        };
        let radius_of = |curvature: Extreme| Extreme {
            input: curvature.input,
            value: 1.0 / curvature.value.max(0.0),
        };
        let roller = self.follower().roller_radius();
        let roller = roller.map(|roller| (roller, radius_of(most), radius_of(minimum)));
        let (minimum_radius, largest_wheel) = match roller {
            Some((roller, convex, concave)) => (
                Extreme {
                    value: convex.value - roller,
                    ..convex
                },
                Extreme {
                    value: concave.value + roller,
                    ..concave
                },
            ),
            None => (
                Extreme {
                    value: regularity.value * self.base_radius(),
                    ..regularity
                },
                Extreme {
                    value: f64::INFINITY,
                    ..regularity
                },
            ),
        };
        Limits {
            rise_pressure_angle: rise,
            return_pressure_angle: fall,
            largest_roller: roller.map(|(_, convex, _)| convex),
            minimum_radius,
            largest_wheel,
            face: flat.then_some((-minimum.value, most.value)),
            regularity,
        }
    }

    /// Minimum base radius, mm, at which the pressure angle stays below `rise` while the cam lifts and below `fall` while the
    /// follower returns, rad; for a return by a spring give a right angle, which sets no limit.
    ///
    /// Searched upwards in steps of 2 % from a thousandth of the follower's size, then solved. `None` if no base circle is
    /// possible: an arm far from the axis cannot touch a large one.
    #[must_use]
    pub fn minimum_base_radius(&self, rise: f64, fall: f64) -> Option<f64> {
        self.minimum_base(|cam| {
            let limits = cam.limits();
            let rising = limits.rise_pressure_angle.value - rise;
            rising.max(limits.return_pressure_angle.value - fall)
        })
    }

    /// Minimum base radius, mm, at which no convex part of the profile has a radius of curvature below `radius`, mm; with zero
    /// only undercut is excluded. `None` if no base circle is possible.
    #[must_use]
    pub fn minimum_regular_base_radius(&self, radius: f64) -> Option<f64> {
        self.minimum_base(|cam| radius - cam.limits().minimum_radius.value)
    }

    /// Minimum base radius at which `excess` is not above zero.
    fn minimum_base(&self, excess: impl Fn(&Self) -> f64) -> Option<f64> {
        /// Maximum number of base radii that are tried: each is 2 % larger than the one before, so the last is about a
        /// million times the first.
        const MOST: u32 = 700;
        let of = |radius: f64| match self.with_base_radius(radius) {
            // A radius without a cam is no solution, and infinity cannot be interpolated.
            Err(_) => f64::INFINITY,
            Ok(cam) => excess(&cam),
        };
        let roller = self.follower().roller_radius().unwrap_or(0.0);
        let size = self
            .peaks()
            .lift
            .value
            .max(roller)
            .max(1e-3 * self.base_radius());
        let mut low = 1e-3 * size.min(self.base_radius());
        let mut at_low = of(low);
        if at_low <= 0.0 {
            return Some(low);
        }
        for _ in 0..MOST {
            let high = STEP * low;
            let at_high = of(high);
            if at_high <= 0.0 {
                return Some(if at_low.is_finite() {
                    bracketed_root(of, low, high, at_low, at_high)
                } else {
                    halved(of, low, high)
                });
            }
            (low, at_low) = (high, at_high);
        }
        None
    }
}

/// Minimum value above `low` at which `excess` is not above zero, by bisection; `excess(high)` is not above zero.
fn halved(excess: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    while high - low > 4.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if excess(middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
