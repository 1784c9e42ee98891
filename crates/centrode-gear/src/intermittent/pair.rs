use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Point, Tolerance, Vector, checkpoint};
use nalgebra::{Isometry2, Rotation2};

use super::cams::Cam;
use super::law::IntermittentLaw;
use super::radial::{Chain, Radial};
use super::{IntermittentPairError, IntermittentPairSpec};
use crate::pitch::PitchSpec;
use crate::{GearPair, Member};
use centrode_kinematics::transmission::Transmission;

/// Number of steps per driver turn while the driven gear passes through the driver's blank: a twentieth of a degree
/// each. Fewer leave ridges between the steps, more take longer.
const STEPS: u32 = 7200;
/// Maximum distance of a written contour from the computed one, in modules. A coarser one uses up backlash, a finer one
/// writes more corners.
const ACCURACY: f64 = 1e-4;
/// Minimum height of a tooth above the locking arc, in modules, for it to count.
const TOOTH: f64 = 0.2;

/// Intermittent gear pair: the driver has teeth on only an arc, and holds the driven gear with a locking arc for the rest of its
/// turn.
///
/// The driven gear has the teeth that its tool cuts, with a notch for the driver's locking arc at each stop. The driver is the
/// remainder of a complete gear after the driven gear has moved through it by its law: the tips of its first and last teeth and
/// the ends of its locking arc are cut back by the amount by which they would interfere during entry and exit. Pins of the driven
/// gear on two cams next to the teeth, one for entry and one for exit, bring it to speed and to rest: with teeth alone it starts
/// with an impact.
///
/// The driver turns clockwise about the origin by the input, the driven gear counter-clockwise about (centre
/// distance, 0). Contours are polygons within a ten-thousandth of the module.
#[derive(Clone, Debug)]
pub struct IntermittentPair {
    pair: GearPair,
    law: IntermittentLaw,
    lock_radius: f64,
    locked_backlash: f64,
    driver: Outline,
    driven: Outline,
    cams: Vec<Cam>,
    teeth: u32,
    stops: u32,
    accuracy: Tolerance,
}

impl IntermittentPair {
    /// Cuts both gears, and the cam where there is an entry angle.
    ///
    /// # Errors
    /// [`IntermittentPairError`] naming the violated rule and its numbers.
    pub fn resolve(spec: &IntermittentPairSpec) -> Result<Self, IntermittentPairError> {
        spec.validate()?;
        let pair = GearPair::resolve(&spec.pair)?;
        let law = Self::law_of(&pair, spec)?;
        let stops = (pair.driven().tooth_count() / spec.teeth).max(1);
        let lock_radius = Self::lock(&pair, spec)?;
        let accuracy =
            Tolerance::new(ACCURACY * pair.module()).map_err(|_| IntermittentPairError::NoLock)?;
        let mut made = Self {
            law,
            lock_radius,
            locked_backlash: 0.0,
            driver: Outline::polygon(&[]),
            driven: Outline::polygon(&[]),
            cams: Vec::new(),
            teeth: 0,
            stops,
            accuracy,
            pair,
        };
        let whole = Radial::new(&made.pair.driven().outline().flatten(accuracy));
        // The driver is cut by a driven gear whose notch fits; the finished one has its clearance.
        let tool = made.notched(&whole, lock_radius).polygon(accuracy);
        let backlash = spec.backlash / (2.0 * made.base_radius());
        let blank = made.blank(accuracy);
        let driver = made.swept(blank, std::slice::from_ref(&tool), backlash, false);
        made.teeth = teeth(&driver, lock_radius + TOOTH * made.pair.module());
        if made.teeth == 0 {
            return Err(IntermittentPairError::NoTeethLeft {
                kept: spec.teeth,
                lock_radius,
            });
        }
        made.driver = Outline::polygon(&driver.polygon(accuracy));
        let finished = made.notched(&whole, lock_radius + spec.lock_clearance);
        made.driven = Outline::polygon(&finished.polygon(accuracy));
        made.locked_backlash = made.worked_locked_backlash(accuracy);
        if spec.entry > 0.0 {
            made.cams = made.cut_cams(&spec.pins, backlash, accuracy)?;
        }
        Ok(made)
    }

    fn law_of(
        pair: &GearPair,
        spec: &IntermittentPairSpec,
    ) -> Result<IntermittentLaw, IntermittentPairError> {
        let (driver, driven) = (pair.driver().tooth_count(), pair.driven().tooth_count());
        let kept = spec.teeth;
        if !kept.is_multiple_of(driven) && !driven.is_multiple_of(kept) {
            return Err(IntermittentPairError::Stops { kept, driven });
        }
        let round = matches!(spec.pair.pitch, PitchSpec::Circle(_));
        if kept < driven && !round {
            return Err(IntermittentPairError::StopsNeedCircles { kept, driven });
        }
        let pitch = pair.rolling().pitch_length(Member::Driver) / f64::from(driver);
        let rolling = pair.shared_rolling();
        let arc = rolling.angle(rolling.parameter(pitch * f64::from(kept)));
        let law = IntermittentLaw {
            arc,
            entry: spec.entry,
            driven: rolling.driven_angle(arc) - rolling.driven_angle(0.0),
            pair: rolling,
        };
        let motion = law.motion_angle();
        if kept >= driver || motion >= TAU {
            return Err(IntermittentPairError::NoDwell { kept, motion });
        }
        if 2.0 * spec.entry > motion {
            return Err(IntermittentPairError::Entry {
                entry: spec.entry,
                motion,
            });
        }
        Ok(law)
    }

    /// Radius of the locking arc: as written, or that of the driver's pitch point at rest.
    fn lock(pair: &GearPair, spec: &IntermittentPairSpec) -> Result<f64, IntermittentPairError> {
        let a = pair.center_distance();
        let rolling = pair.rolling();
        let pitch_point = rolling.frame(Member::Driver, rolling.parameter(0.0)).point;
        let radius = spec.lock_radius.unwrap_or(pitch_point.coords.norm());
        let (_, tip) = pair.driven().radii();
        let hub = 0.5 * spec.pair.driven.bore;
        if radius <= a - tip {
            return Err(IntermittentPairError::LockTooSmall {
                radius,
                minimum: a - tip,
            });
        }
        if radius >= a - hub {
            return Err(IntermittentPairError::LockOverlaps {
                radius,
                maximum: a - hub,
            });
        }
        Ok(radius)
    }

    /// Driven gear with a notch for a locking arc of a radius at each stop.
    fn notched(&self, whole: &Radial, radius: f64) -> Radial {
        let mut notched = whole.clone();
        for stop in 0..self.stops {
            let turned = self.law.driven * f64::from(stop);
            notched.cut_circle(self.driver_axis(turned), radius);
        }
        notched
    }

    /// The driver's axis in the driven gear's own axes when that has turned.
    fn driver_axis(&self, turned: f64) -> Point {
        Rotation2::new(-turned) * Point::new(-self.pair.center_distance(), 0.0)
    }

    /// Base radius of the driven gear: normal backlash is angular backlash times this.
    fn base_radius(&self) -> f64 {
        let mean = self.pair.rolling().pitch_length(Member::Driven) / TAU;
        mean * self.pair.pressure_angle().cos()
    }

    /// The driver's blank: a complete driver, turned forward by the half entry angle that the entry loses, and filled up to the
    /// locking arc over the dwell.
    fn blank(&self, accuracy: Tolerance) -> Radial {
        let turned = Rotation2::new(0.5 * self.law.entry);
        let corners = self.pair.driver().outline().flatten(accuracy);
        let corners: Vec<Point> = corners.iter().map(|p| turned * p).collect();
        let mut blank = Radial::new(&corners);
        blank.fill(self.law.motion_angle(), TAU, self.lock_radius);
        blank
    }

    /// Pose of the driven gear when the driver has turned by `input`, in the driver's axes.
    pub(super) fn mate(&self, input: f64, driven: f64) -> Isometry2<f64> {
        let placed = Isometry2::new(Vector::new(self.pair.center_distance(), 0.0), driven);
        Isometry2::rotation(input) * placed
    }

    /// The `blank` minus the region swept by `bodies` over one driver turn, with the driven gear offset by +-`backlash` while it
    /// moves (throughout if `always`).
    pub(super) fn swept(
        &self,
        mut blank: Radial,
        bodies: &[Vec<Point>],
        backlash: f64,
        always: bool,
    ) -> Radial {
        let reach = blank.maximum();
        let motion = self.law.motion_angle();
        let sides: &[f64] = if backlash > 0.0 { &[-1.0, 1.0] } else { &[0.0] };
        let mut inputs: Vec<f64> = (0..=STEPS)
            .map(|i| TAU * f64::from(i) / f64::from(STEPS))
            .collect();
        inputs.extend(self.law.breaks());
        inputs.sort_by(f64::total_cmp);
        let chains: Vec<Chain> = bodies.iter().flat_map(|body| Chain::new(body)).collect();
        for &side in sides {
            let placed = |input: f64| {
                let off = if always || (input > 0.0 && input < motion) {
                    side * backlash
                } else {
                    0.0
                };
                self.mate(input, self.law.at(input.min(TAU)).position + off)
            };
            let mut before = placed(0.0);
            for &input in &inputs[1..] {
                checkpoint();
                let now = placed(input);
                for chain in &chains {
                    if chain.is_near(&before, reach) || chain.is_near(&now, reach) {
                        let [before, now] = [&before, &now].map(|place| chain.placed(place, reach));
                        blank.cut_moving(&before, &now);
                    }
                }
                before = now;
            }
        }
        blank
    }

    /// Complete pair from which the gears are cut.
    #[must_use]
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// The driven angle as a function of the driver's turn.
    #[must_use]
    pub fn law(&self) -> &IntermittentLaw {
        &self.law
    }

    /// Distance between the shafts, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        self.pair.center_distance()
    }

    /// Radius of the driver's locking arc, mm.
    #[must_use]
    pub fn lock_radius(&self) -> f64 {
        self.lock_radius
    }

    /// The driver in its own axes, the input zero towards the driven gear.
    #[must_use]
    pub fn driver(&self) -> &Outline {
        &self.driver
    }

    /// The driven gear in its own axes.
    #[must_use]
    pub fn driven(&self) -> &Outline {
        &self.driven
    }

    /// Maximum distance of the contours' polygons from the exact curves.
    #[must_use]
    pub fn accuracy(&self) -> Tolerance {
        self.accuracy
    }

    /// The cams of entry and exit, where there is an entry angle.
    #[must_use]
    pub fn cams(&self) -> &[Cam] {
        &self.cams
    }

    /// Teeth of the driver.
    #[must_use]
    pub fn teeth(&self) -> u32 {
        self.teeth
    }

    /// Number of positions at which the driven gear stops in one of its turns.
    #[must_use]
    pub fn stops(&self) -> u32 {
        self.stops
    }

    /// Driver angle for which the driven gear rests, rad.
    #[must_use]
    pub fn dwell_angle(&self) -> f64 {
        TAU - self.law.motion_angle()
    }

    /// Jump of the driven gear's speed as it starts, per driver speed; zero with an entry angle.
    #[must_use]
    pub fn shock(&self) -> f64 {
        if self.law.entry > 0.0 {
            0.0
        } else {
            self.pair.ratio(0.0)
        }
    }

    /// Angle, rad, by which the driven gear can turn in either direction when the locking arc alone holds it: where the arc
    /// faces the whole notch, in the middle of the dwell. Pins on cams hold it closer.
    #[must_use]
    pub fn locked_backlash(&self) -> f64 {
        self.locked_backlash
    }

    /// Angle of [`locked_backlash`](Self::locked_backlash), computed on the finished contour. A corner of the driven gear at the
    /// distance p from its axis meets the locking arc where the cosine of its angle from the line of centres is
    /// (a² + p² - r²)/(2 a p).
    fn worked_locked_backlash(&self, accuracy: Tolerance) -> f64 {
        let (a, r) = (self.center_distance(), self.lock_radius);
        let corners = self.driven.flatten(accuracy);
        let free = |stop: u32| {
            let turned = self.law.driven * f64::from(stop);
            let towards = self.driver_axis(turned).coords;
            let mut free = [PI; 2];
            for corner in &corners {
                let p = corner.coords.norm();
                let cosine = (a * a + p * p - r * r) / (2.0 * a * p);
                // A corner nearer to its axis than a - r, or farther than a + r, cannot meet the arc.
                if !(-1.0..1.0).contains(&cosine) {
                    continue;
                }
                let off = towards
                    .perp(&corner.coords)
                    .atan2(towards.dot(&corner.coords));
                let side = usize::from(off > 0.0);
                free[side] = free[side].min(off.abs() - cosine.acos());
            }
            free[0].max(free[1])
        };
        (0..self.stops).map(free).fold(0.0, f64::max)
    }
}

/// Number of times a contour rises above a radius.
fn teeth(radial: &Radial, radius: f64) -> u32 {
    let count = 16_384_u32;
    let above = |i: u32| radial.at(TAU * f64::from(i) / f64::from(count)) > radius;
    (0..count)
        .filter(|&i| above(i) && !above((i + count - 1) % count))
        .count() as u32
}
