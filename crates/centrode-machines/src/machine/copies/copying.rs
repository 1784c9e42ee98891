//! Machines with copies: built from the design with its copies written out, and compared with the originals.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Extreme, Point, bracketed_root, maximum, piece_ends, run_both};
use nalgebra::Rotation2;

use crate::machine::copies::expansion::Expansion;
use crate::machine::copies::{self, MachineCopiesSpec, Spin};
use crate::machine::resolve::Builder;
use crate::machine::{BodyPoint, Machine, MachineDesign, MachineError};
use centrode_kinematics::transmission::{FromFn, Transmission, sorted};
use centrode_spec::Named;

/// Inputs per turn at which copies are compared with their originals.
const SAMPLES: u32 = 120;
/// Number of parts of a turn of the input; in each a mismatch has few extremes.
const PARTS: u32 = 24;
/// Maximum mismatch due to rounding: in rad, and in mm per mm of the machine's size (at least 1 mm).
const ROUNDING: f64 = 1e-8;
/// Variation of a rate, as a share of its maximum, up to which the rotation counts as even.
const EVEN: f64 = 1e-12;

/// Relation of a copy to its original.
#[derive(Clone, Copy)]
struct CopyTurn {
    /// Index of the body about which the copies are spaced.
    about: usize,
    spin: Spin,
    /// Angle of the copy from the original, rad.
    turn: f64,
}

/// Pose of a body: position of its origin (mm) and angle (rad).
#[derive(Clone, Copy)]
struct Pose {
    at: Point,
    angle: f64,
}

/// A law shifted along the input: its value at an input is that of `law` at `by` later.
pub(in crate::machine) fn ahead(law: Arc<dyn Transmission>, by: f64) -> Arc<dyn Transmission> {
    let (period, advance) = (law.period(), law.advance());
    let breaks = law.breaks().into_iter();
    let breaks = sorted(breaks.map(|b| (b - by).rem_euclid(period)), period);
    Arc::new(FromFn::new(period, advance, breaks, move |input| {
        law.at(input + by)
    }))
}

impl Machine {
    /// Resolves a design with copies: first the design without them, then the one with the copies written out. `written` is the
    /// design with its parts in the order of its file.
    pub(in crate::machine) fn with_copies(
        design: &MachineDesign,
        written: &MachineDesign,
    ) -> Result<Self, MachineError> {
        let bare = MachineDesign {
            copies: Named::new(),
            // These tables may name copies.
            loads: Named::new(),
            obstacles: Named::new(),
            goals: Named::new(),
            vary: Named::new(),
            ..design.clone()
        };
        let none = Expansion::default();
        let mut first = Builder::assembled(&bare, &none, None)?;
        // Loads of copies may act on followers to which cams are cut: then the cams are cut first.
        let cut_before = !design.loads.is_empty();
        if cut_before {
            first.cut_cams()?;
        }
        let one = first.clone().so_far(&bare);
        let (mut whole, mut expansion) = (design.clone(), Expansion::default());
        let add = |(name, spec): (&String, &MachineCopiesSpec)| {
            let key = format!("copies.{name}");
            one.can_copy(design, &key, spec)?;
            let spin = one.spin(&key, &spec.about)?;
            copies::add(&mut whole, &mut expansion, &one.points, name, spin)
        };
        let added = design.copies.iter().try_for_each(add);
        whole.sort_parts();
        let cut = || {
            if !cut_before {
                first.cut_cams()?;
            }
            first.finished(&bare)
        };
        let copied = || {
            added?;
            let made = Builder::assembled(&whole, &expansion, Some(&one));
            made.map_err(|error| of_copy(error, &expansion))
        };
        // Cutting the cams takes as long as assembling the copies, and each is independent of the other.
        let (one, made) = run_both(cut, copied);
        let (one, mut made) = (one?, made?);
        made.bare = Some(&one);
        let made = made.cut_cams().and_then(|()| made.finished(written));
        let made = made.map_err(|error| of_copy(error, &expansion))?;
        for (name, spec) in &design.copies {
            made.check_copies(&format!("copies.{name}"), spec)?;
        }
        Ok(made)
    }

    /// Checks that the bodies to be copied exist, and that each is in one chain only.
    fn can_copy(
        &self,
        design: &MachineDesign,
        key: &str,
        spec: &MachineCopiesSpec,
    ) -> Result<(), MachineError> {
        let named = spec.bodies.iter().map(|body| (body, "bodies"));
        for (body, word) in named.chain([(&spec.about, "about")]) {
            self.body_of(&format!("{key}.{word}"), body)?;
        }
        let times = |body: &String| {
            let all = design.copies.values().flat_map(|copies| &copies.bodies);
            all.filter(|other| *other == body).count()
        };
        let wrong =
            |word: &str, why: String| Err(MachineError::refused(format!("{key}.{word}"), why));
        if let Some(body) = spec.bodies.iter().find(|body| times(body) > 1) {
            return wrong("bodies", format!("body {body} would be copied twice"));
        }
        if let Some(body) = spec
            .bodies
            .iter()
            .find(|body| *body == crate::machine::design::FRAME)
        {
            return wrong(
                "bodies",
                format!("the {body} is fixed and cannot be copied"),
            );
        }
        match times(&spec.about) {
            0 => Ok(()),
            _ => wrong(
                "about",
                format!(
                    "body {} is copied itself: there can be no copies about it",
                    spec.about
                ),
            ),
        }
    }

    /// Motion of the body about which copies are spaced.
    fn spin(&self, key: &str, about: &str) -> Result<Spin, MachineError> {
        let body = self.body_named(about).unwrap_or(0);
        let ends = self.parts();
        let rate = |input: f64| self.angle(body, input).velocity;
        let [low, high] = centrode_geometry::extremes(rate, &ends);
        let size = low.value.abs().max(high.value.abs());
        if high.value - low.value <= EVEN * size {
            return Ok(if size == 0.0 {
                Spin::Still
            } else {
                Spin::Even(high.value)
            });
        }
        if low.value * high.value > 0.0 {
            return Ok(Spin::Uneven(low.value.signum()));
        }
        let back = if high.value + low.value > 0.0 {
            low
        } else {
            high
        };
        Err(MachineError::refused(
            format!("{key}.about"),
            format!(
                "body {about} turns to and fro: at an input of {:.4} deg its speed is {:.6} times that of the input. Copies need a body about them that is fixed or turns in one direction",
                back.input.to_degrees(),
                back.value
            ),
        ))
    }

    /// Ends of the parts of a cycle within which all motion is smooth.
    fn parts(&self) -> Vec<f64> {
        let parts = PARTS * self.design.input.turns;
        piece_ends(0.0, self.period(), parts, self.linkage.breaks())
    }

    /// Checks that each copy has the pose that its original has after a further turn of the body in the middle.
    fn check_copies(&self, key: &str, spec: &MachineCopiesSpec) -> Result<(), MachineError> {
        let about = self.body_named(&spec.about).unwrap_or(0);
        let spin = self.spin(key, &spec.about)?;
        let size = self.points().map(|(_, point)| point.at.coords.norm());
        let size = size.fold(1.0, f64::max);
        let copied = |name: &str, piece: u32| format!("{name}-{}", piece + 1);
        let is_off = |piece: u32| {
            let both = spec.bodies.iter().filter_map(|name| {
                let copy = self.body_named(&copied(name, piece))?;
                Some((self.body_named(name)?, copy))
            });
            let both: Vec<_> = both.collect();
            let turn = spec.turn(piece);
            self.maximum_off(CopyTurn { about, spin, turn }, &both)
                .iter()
                .any(|[length, angle]| *length > ROUNDING * size || *angle > ROUNDING)
        };
        if !(1..spec.count).any(is_off) {
            return Ok(());
        }
        for (name, piece) in spec
            .bodies
            .iter()
            .flat_map(|name| (1..spec.count).map(move |k| (name, k)))
        {
            let (copied, turn) = (copied(name, piece), spec.turn(piece));
            let (Some(body), Some(copy)) = (self.body_named(name), self.body_named(&copied)) else {
                continue;
            };
            let off = |input: f64| self.off(CopyTurn { about, spin, turn }, body, copy, input);
            let [length, angle] = [0, 1].map(|i| maximum(|input| off(input)[i], &self.parts()));
            if length.value > ROUNDING * size || angle.value > ROUNDING {
                return Err(MachineError::refused(
                    key,
                    repeats(name, &copied, &spec.about, turn, [length, angle]),
                ));
            }
        }
        Ok(())
    }

    /// Maximum distance (mm) and angle (rad) of each copy from its required pose, at the sampled inputs.
    fn maximum_off(&self, by: CopyTurn, both: &[(usize, usize)]) -> Vec<[f64; 2]> {
        let count = SAMPLES * self.design.input.turns;
        let inputs = (0..count).map(|i| self.period() * f64::from(i) / f64::from(count));
        let inputs: Vec<f64> = inputs.collect();
        let later = |input: &f64| self.later(by, *input);
        let later: Vec<f64> = inputs.iter().map(later).collect();
        let origins = |bodies: Vec<usize>, inputs: &[f64]| {
            let at = Point::origin();
            let points = bodies.into_iter().map(|body| BodyPoint { body, at });
            self.places_each(&points.collect::<Vec<_>>(), inputs)
        };
        let (bodies, copies) = both.iter().copied().unzip();
        let (from, found) = (origins(bodies, &later), origins(copies, &inputs));
        let mut maximum = vec![[0.0_f64; 2]; both.len()];
        for (k, (from, found)) in from.into_iter().zip(found).enumerate() {
            let (number, look) = (k % both.len(), k / both.len());
            let (body, copy) = both[number];
            let pose = |body: usize, at: [f64; 2], input: f64| Pose {
                at: at.into(),
                angle: self.angle(body, input).position,
            };
            let from = pose(body, from, later[look]);
            let off = self.apart(by, inputs[look], from, pose(copy, found, inputs[look]));
            for (most, off) in maximum[number].iter_mut().zip(off) {
                *most = most.max(off);
            }
        }
        maximum
    }

    /// Distance (mm) and angle (rad) of a copy from the pose of its original after a further turn of the body in the middle.
    fn off(&self, by: CopyTurn, body: usize, copy: usize, input: f64) -> [f64; 2] {
        let pose = |body: usize, input: f64| Pose {
            at: self.place(body, Point::origin(), input),
            angle: self.angle(body, input).position,
        };
        let from = pose(body, self.later(by, input));
        self.apart(by, input, from, pose(copy, input))
    }

    /// Distance (mm) and angle (rad) between the required pose of a copy and the pose found.
    fn apart(&self, by: CopyTurn, input: f64, mut from: Pose, found: Pose) -> [f64; 2] {
        if by.spin == Spin::Still {
            let middle = self.place(by.about, Point::origin(), input);
            from.at = middle + Rotation2::new(by.turn) * (from.at - middle);
            from.angle += by.turn;
        }
        let off = found.angle - from.angle;
        let distance = (found.at - from.at).norm();
        [distance, (off - TAU * (off / TAU).round()).abs()]
    }

    /// Input at which the body in the middle has turned further by the angle of the copy, apart from whole turns.
    fn later(&self, by: CopyTurn, input: f64) -> f64 {
        let angle = |input: f64| self.angle(by.about, input).position;
        let sign = match by.spin {
            Spin::Even(rate) | Spin::Uneven(rate) => rate.signum(),
            Spin::Still => return input,
        };
        let required = angle(input) + if sign > 0.0 { by.turn } else { by.turn - TAU };
        let end = input + self.period();
        let off = |input: f64| angle(input) - required;
        bracketed_root(off, input, end, off(input), off(end))
    }
}

/// Replaces the keys of copies in an error by those of the originals.
fn of_copy(error: MachineError, expansion: &Expansion) -> MachineError {
    match expansion.written(&error.key()) {
        key if key == error.key() => error,
        key => MachineError::Copy {
            key,
            error: Box::new(error),
        },
    }
}

/// Message about a chain that does not repeat.
fn repeats(name: &str, copy: &str, about: &str, turn: f64, off: [Extreme; 2]) -> String {
    let [length, angle] = off;
    let degrees = turn.to_degrees();
    let what = match about {
        crate::machine::design::FRAME => {
            format!("in the pose of {name} turned by {degrees:.4} deg")
        }
        _ => {
            format!("in the pose that {name} has when {about} has turned {degrees:.4} deg further")
        }
    };
    format!(
        "the train does not repeat: {copy} is not {what}; it is up to {:.6} mm off (at an input of {:.4} deg) and {:.6} deg (at {:.4} deg)",
        length.value,
        length.input.to_degrees(),
        angle.value.to_degrees(),
        angle.input.to_degrees()
    )
}
