use std::f64::consts::{PI, TAU};

use wide::f64x4;

use super::SweepError;
use super::panel::LANES;
use super::stage::{Param, Stage, settled};
use super::track::{Track, lanes};
use crate::three_arm::Extreme;
use crate::three_arm::design::ThreeArmDesign;
use centrode_gear::pitch::HIGHEST_DEGREE;

/// Dimensions, apart from the pitch curve, that determine the tip's path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Machine {
    sign: f64,
    carrier_start: f64,
    bend: f64,
    /// Angle from phi + bend to the arm's zero when the planet is at polar angle zero, rad.
    zero: f64,
    mounting: f64,
    pub(super) clamp_mounting: f64,
    tip_distance: f64,
    /// Distance of the planet's axis from the carrier's, mm.
    leg: f64,
}

/// Position of the tip at a polar angle of the sun, and its velocity per radian of that angle.
#[derive(Clone, Copy, Debug)]
struct Tip {
    position: [f64; 2],
    velocity: [f64; 2],
}

impl Machine {
    pub(super) fn new(design: &ThreeArmDesign, stage: &Stage) -> Self {
        let sign = design.direction.sign();
        let chi = stage.angle(stage.at_driven(-design.bend - PI)).value;
        let reference = design.planet_reference.unwrap_or_else(|| {
            let met = stage.at_angle(sign * design.bend.abs());
            -stage.driven(met).value
        });
        let arm = &design.arm;
        Self {
            sign,
            carrier_start: design.carrier_start,
            bend: design.bend,
            zero: chi - reference,
            mounting: arm.mounting_angle,
            clamp_mounting: arm.mounting_angle + (arm.pusher_offset / arm.tip_distance).asin(),
            tip_distance: arm.tip_distance,
            leg: 2.0 * stage.center_distance() * (0.5 * design.bend).cos(),
        }
    }

    /// Driven angle of the intermediate gear in the mesh with the planet, from that in the mesh with the sun.
    fn met(&self, driven: f64) -> f64 {
        driven - self.bend - PI
    }

    /// Direction of the arm's zero at polar angles of sun and planet.
    fn arm(&self, psi: f64, chi: f64) -> f64 {
        self.carrier_start + psi + self.bend + self.zero - chi
    }

    /// Parameters of sun and planet in mesh at a polar angle of the sun, from parameters nearby.
    fn mesh(&self, stage: &Stage, psi: f64, sun: Param, planet: Param) -> (Param, Param) {
        let closer = |mut param: Param, nearer: &dyn Fn(Param) -> (Param, f64)| {
            (0..6).find_map(|_| {
                let (next, step) = nearer(param);
                param = next;
                settled(step).then_some(param)
            })
        };
        let sun = closer(sun, &|param| stage.nearer_angle(param, psi));
        let sun = sun.unwrap_or_else(|| stage.at_angle(psi));
        let met = self.met(stage.driven(sun).value);
        let planet = closer(planet, &|param| stage.nearer_driven(param, met));
        (sun, planet.unwrap_or_else(|| stage.at_driven(met)))
    }

    fn tip(&self, stage: &Stage, psi: f64, sun: Param, planet: Param) -> Tip {
        let chi = stage.angle(planet);
        let forward = stage.driven(sun).rate / stage.angle(sun).rate;
        let backward = chi.rate / stage.driven(planet).rate;
        let turn = 1.0 - forward * backward;
        let (sin, cos) = (self.carrier_start + psi + 0.5 * self.bend).sin_cos();
        let (s, c) = (self.arm(psi, chi.value) + self.mounting).sin_cos();
        let (leg, length) = (self.leg, self.tip_distance);
        Tip {
            position: [leg * cos + length * c, leg * sin + length * s],
            velocity: [
                -leg * sin - length * turn * s,
                leg * cos + length * turn * c,
            ],
        }
    }
}

/// The tip's path over one turn of the carrier, at equal steps of the sun's polar angle. If the carrier turns clockwise, the
/// inputs run backwards.
#[derive(Clone, Debug)]
pub(super) struct Path {
    /// Polar angles of the sun, with room for the lanes beyond the last, and the cosines and sines of these angles.
    angles: Vec<f64>,
    turns: Vec<[f64; 2]>,
    /// Parameters of sun and planet in mesh, driven angles there, and polar angles of the planet.
    sun: Track,
    planet: Track,
    met: Vec<f64>,
    chi: Vec<f64>,
    sign: f64,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Path {
    pub(super) fn new(inputs: usize) -> Self {
        let turn = |i: usize| TAU * i as f64 / inputs as f64;
        let angles: Vec<f64> = (0..inputs + LANES).map(turn).collect();
        Self {
            turns: angles.iter().map(|a| [a.cos(), a.sin()]).collect(),
            angles,
            sun: Track::new(inputs),
            planet: Track::new(inputs),
            met: vec![0.0; inputs + LANES],
            chi: vec![0.0; inputs + LANES],
            sign: 1.0,
            x: vec![0.0; inputs],
            y: vec![0.0; inputs],
        }
    }

    fn step(&self) -> f64 {
        TAU / self.x.len() as f64
    }

    /// Computes the path of a machine.
    pub(super) fn follow(&mut self, stage: &Stage, machine: &Machine) -> Result<(), SweepError> {
        self.sign = machine.sign;
        let found = if stage.coefficients() <= 3 {
            self.mesh_round::<3>(stage, machine)
        } else {
            self.mesh_round::<{ HIGHEST_DEGREE + 1 }>(stage, machine)
        };
        if !found {
            return Err(SweepError::NoClosure);
        }
        let (half_sin, half_cos) = (machine.carrier_start + 0.5 * machine.bend).sin_cos();
        let (leg, length) = (machine.leg, machine.tip_distance);
        let start = machine.arm(0.0, 0.0) + machine.mounting;
        let tips = self.x.chunks_mut(LANES).zip(self.y.chunks_mut(LANES));
        let mut good = true;
        for ((x, y), first) in tips.zip((0..).step_by(LANES)) {
            let direction =
                lanes(&self.angles, first) - lanes(&self.chi, first) + f64x4::from(start);
            let (sin, cos) = direction.sin_cos();
            let turns = &self.turns[first..];
            for (lane, (x, y)) in x.iter_mut().zip(y).enumerate() {
                let ([c, s], [cos, sin]) =
                    (turns[lane], [cos.as_array()[lane], sin.as_array()[lane]]);
                *x = leg * (half_cos * c - half_sin * s) + length * cos;
                *y = leg * (half_sin * c + half_cos * s) + length * sin;
                good &= y.is_finite();
            }
        }
        if good {
            Ok(())
        } else {
            Err(SweepError::NoClosure)
        }
    }

    /// Solves both meshes at every polar angle of the sun; returns whether all have a solution.
    fn mesh_round<const C: usize>(&mut self, stage: &Stage, machine: &Machine) -> bool {
        let (angle, driven) = (stage.angle_growth(), stage.driven_growth());
        if !self.sun.find::<C, _>(angle, &self.angles) {
            return false;
        }
        // Driven angles from parameter zero, in both meshes.
        self.sun
            .map::<C, _>(driven, machine.met(0.0), &mut self.met);
        // Lanes beyond the last target get its value, so that no value of the design before is left in them.
        let count = self.x.len();
        let last = self.met[count - 1];
        self.met[count..].fill(last);
        if !self.planet.find::<C, _>(driven, &self.met) {
            return false;
        }
        self.planet.map::<C, _>(angle, 0.0, &mut self.chi);
        true
    }

    /// Points at equal steps of the input, from the start.
    pub(super) fn points(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        let count = self.x.len();
        let backwards = self.sign < 0.0;
        (0..count).map(move |i| {
            let place = if backwards { (count - i) % count } else { i };
            [self.x[place], self.y[place]]
        })
    }

    /// Polar angle of the sun at an input, in its first turn, and the index of the last point of the path before it.
    fn place(&self, input: f64) -> (f64, usize) {
        let psi = (self.sign * input).rem_euclid(TAU);
        (psi, (psi / self.step()) as usize % self.x.len())
    }

    /// Direction of the arm's zero at an input.
    pub(super) fn arm(&self, stage: &Stage, machine: &Machine, input: f64) -> f64 {
        let (psi, place) = self.place(input);
        let (_, planet) = machine.mesh(stage, psi, self.sun.param(place), self.planet.param(place));
        machine.arm(psi, stage.angle(planet).value)
    }

    /// The tip near a known point of the path.
    fn near(&self, stage: &Stage, machine: &Machine, place: usize, psi: f64) -> Tip {
        let (sun, planet) = (self.sun.param(place), self.planet.param(place));
        let (sun, planet) = machine.mesh(stage, psi, sun, planet);
        machine.tip(stage, psi, sun, planet)
    }

    /// The tip at any input.
    pub(super) fn tip(&self, stage: &Stage, machine: &Machine, input: f64) -> [f64; 2] {
        let (psi, place) = self.place(input);
        self.near(stage, machine, place, psi).position
    }

    /// Maximum reach of the path in a direction, and the input there.
    pub(super) fn farthest(
        &self,
        stage: &Stage,
        machine: &Machine,
        direction: [f64; 2],
    ) -> Extreme {
        let [across, up] = direction;
        let count = self.x.len();
        let reach = |i: usize| across * self.x[i] + up * self.y[i];
        let [across_all, up_all] = direction.map(f64x4::from);
        let tips = self.x.chunks_exact(LANES).zip(self.y.chunks_exact(LANES));
        let best = tips.fold(f64x4::from(f64::NEG_INFINITY), |best, (x, y)| {
            best.fast_max(across_all * lanes(x, 0) + up_all * lanes(y, 0))
        });
        let best = best
            .to_array()
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max);
        let mut found = Extreme {
            input: 0.0,
            reach: f64::NEG_INFINITY,
        };
        for i in 0..count {
            let here = reach(i);
            let around = [(i + count - 1) % count, (i + 1) % count].map(reach);
            if here < around[0] || here < around[1] {
                continue;
            }
            // A crest exceeds the middle of three points by at most about an eighth of their second difference.
            let bend = 2.0 * here - around[0] - around[1];
            if here + 0.5 * bend < best {
                continue;
            }
            let crest = self.crest(stage, machine, i, direction, [around[0], here, around[1]]);
            if crest.reach > found.reach {
                found = crest;
            }
        }
        Extreme {
            input: (self.sign * found.input).rem_euclid(TAU),
            ..found
        }
    }

    /// The crest near a point of the path, with the polar angle of the sun as its input. Starts from the crest of a parabola
    /// through three points, then uses secants of the slope.
    fn crest(
        &self,
        stage: &Stage,
        machine: &Machine,
        index: usize,
        direction: [f64; 2],
        [before, here, after]: [f64; 3],
    ) -> Extreme {
        let step = self.step();
        let middle = step * index as f64;
        let reach_at = |input: f64| {
            let tip = self.near(stage, machine, index, input);
            let along = |v: [f64; 2]| v[0] * direction[0] + v[1] * direction[1];
            (along(tip.position), along(tip.velocity))
        };
        let mut best = Extreme {
            input: middle,
            reach: here,
        };
        let mut curve = (before - 2.0 * here + after) / (step * step);
        let mut input = middle + 0.5 * (before - after) / (curve * step);
        let mut last: Option<(f64, f64)> = None;
        for _ in 0..20 {
            let inside = (input - middle).abs() <= step;
            if !inside {
                input = middle;
            }
            let (reach, slope) = reach_at(input);
            if reach >= best.reach {
                best = Extreme { input, reach };
            }
            if let Some((other, at_other)) = last
                && other != input
                && at_other != slope
            {
                curve = (slope - at_other) / (input - other);
            }
            last = Some((input, slope));
            let next = input - slope / curve;
            // The crest is flat: the error of its height is about the square of this error of the input.
            if !next.is_finite() || (next - input).abs() < 1e-8 {
                break;
            }
            input = next;
        }
        best
    }

    /// Input, before a given one, at which the reach in a direction last increases past a distance.
    pub(super) fn entering(
        &self,
        stage: &Stage,
        machine: &Machine,
        direction: [f64; 2],
        distance: f64,
        before: f64,
    ) -> Result<f64, SweepError> {
        let count = self.x.len();
        let step = self.step();
        let off = |input: f64| {
            let [x, y] = self.tip(stage, machine, input);
            x * direction[0] + y * direction[1] - distance
        };
        let mut high = before;
        let mut at_high = off(high);
        if at_high < 0.0 {
            return Err(SweepError::TrayOutOfReach);
        }
        let last = (before / step).ceil() as isize - 1;
        for i in 0..=count as isize {
            let low = step * (last - i) as f64;
            let at_low = off(low);
            if at_low <= 0.0 && at_high >= 0.0 {
                return Ok(centrode_geometry::bracketed_root(
                    off, low, high, at_low, at_high,
                ));
            }
            (high, at_high) = (low, at_low);
        }
        Err(SweepError::TrayOutOfReach)
    }
}
