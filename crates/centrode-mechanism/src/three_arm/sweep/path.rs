use std::f64::consts::{PI, TAU};

use super::SweepError;
use super::circle::Circle;
use super::stage::{Spot, Stage};
use crate::three_arm::Extreme;
use crate::three_arm::design::ThreeArmDesign;

/// Inputs followed side by side, each from its own start: none waits for another's division.
const LANES: usize = 4;

/// What of a design, beside its pitch curve, moves the tip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Machine {
    sign: f64,
    carrier_start: f64,
    bend: f64,
    /// The arm's zero less phi + bend, at polar angle zero of the planet.
    zero: f64,
    mounting: f64,
    pub(super) clamp_mounting: f64,
    tip_distance: f64,
    /// Distance and direction of the planet's axis, from the carrier's direction.
    leg: f64,
}

/// Where the tip is at an input.
#[derive(Clone, Copy, Debug)]
struct Tip {
    position: [f64; 2],
    velocity: [f64; 2],
}

impl Machine {
    pub(super) fn of(design: &ThreeArmDesign, stage: &Stage) -> Self {
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

    /// The tip at an input, from spots nearby.
    fn near(&self, stage: &Stage, input: f64, sun: Spot, planet: Spot) -> Tip {
        let (sun, planet) = self.mesh(stage, input, sun, planet);
        self.tip(stage, input, sun, planet)
    }

    /// Spots in mesh at an input, from spots nearby.
    fn mesh(&self, stage: &Stage, input: f64, sun: Spot, planet: Spot) -> (Spot, Spot) {
        let psi = self.sign * input;
        let settled = |mut spot: Spot, nearer: &dyn Fn(Spot) -> (Spot, f64)| {
            (0..6).find_map(|_| {
                let (next, step) = nearer(spot);
                spot = next;
                Stage::settled(step).then_some(spot)
            })
        };
        let sun = settled(sun, &|spot| stage.nearer_angle(spot, psi));
        let sun = sun.unwrap_or_else(|| stage.at_angle(psi));
        let met = stage.driven(sun).value - self.bend - PI;
        let planet = settled(planet, &|spot| stage.nearer_driven(spot, met));
        (sun, planet.unwrap_or_else(|| stage.at_driven(met)))
    }

    fn tip(&self, stage: &Stage, input: f64, sun: Spot, planet: Spot) -> Tip {
        let chi = stage.angle(planet);
        let forward = stage.driven(sun).rate / stage.angle(sun).rate;
        let backward = chi.rate / stage.driven(planet).rate;
        let carrier = self.carrier_start + self.sign * input;
        let arm = carrier + self.bend + self.zero - chi.value;
        let turn = self.sign * (1.0 - forward * backward);
        let (sin, cos) = (carrier + 0.5 * self.bend).sin_cos();
        let (s, c) = (arm + self.mounting).sin_cos();
        let (leg, length) = (self.leg, self.tip_distance);
        Tip {
            position: [leg * cos + length * c, leg * sin + length * s],
            velocity: [
                -leg * self.sign * sin - length * turn * s,
                leg * self.sign * cos + length * turn * c,
            ],
        }
    }
}

/// The tip's path over one turn of the carrier at even inputs.
#[derive(Clone, Debug)]
pub(super) struct Path {
    circle: Circle,
    /// Cosine and sine of each input.
    turns: Vec<[f64; 2]>,
    /// Spots in mesh, of sun and planet.
    sun: Vec<Spot>,
    planet: Vec<Spot>,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Path {
    pub(super) fn new(inputs: usize) -> Self {
        let turn = |i: usize| TAU * i as f64 / inputs as f64;
        Self {
            circle: Circle::new(),
            turns: (0..inputs)
                .map(|i| [turn(i).cos(), turn(i).sin()])
                .collect(),
            sun: vec![Spot::default(); inputs],
            planet: vec![Spot::default(); inputs],
            x: vec![0.0; inputs],
            y: vec![0.0; inputs],
        }
    }

    fn step(&self) -> f64 {
        TAU / self.x.len() as f64
    }

    /// Walks the path of a machine.
    pub(super) fn follow(&mut self, stage: &Stage, machine: &Machine) -> Result<(), SweepError> {
        let quarter = self.x.len() / LANES;
        let step_of_input = self.step();
        let input = |i: usize| step_of_input * i as f64;
        // From the last spot on by the step there, and half the change of the step.
        let ahead = |[step, before]: [f64; 2]| step + 0.5 * (step - before);
        let met = |driven: f64| driven - machine.bend - PI;
        let mut sun: [Spot; LANES] =
            std::array::from_fn(|lane| stage.at_angle(machine.sign * input(lane * quarter)));
        let mut planet = sun.map(|spot| stage.at_driven(met(stage.driven(spot).value)));
        // The last step and the one before it.
        let (mut sun_steps, mut planet_steps) = ([[0.0; 2]; LANES], [[0.0; 2]; LANES]);
        let (half_sin, half_cos) = (machine.carrier_start + 0.5 * machine.bend).sin_cos();
        for i in 0..quarter {
            let psi: [f64; LANES] =
                std::array::from_fn(|lane| machine.sign * input(lane * quarter + i));
            let mut miss = [0.0_f64; LANES];
            for lane in 0..LANES {
                let ahead = stage.moved(sun[lane], ahead(sun_steps[lane]));
                (sun[lane], miss[lane]) = stage.nearer_angle(ahead, psi[lane]);
            }
            for lane in 0..LANES {
                let driven = stage.driven(sun[lane]);
                let ahead = stage.moved(planet[lane], ahead(planet_steps[lane]));
                let look = stage.driven(ahead);
                let step = look.step(met(driven.value));
                planet[lane] = stage.moved(ahead, step);
                miss[lane] = miss[lane].abs().max(step.abs());
                // What the next input needs.
                let next = machine.sign * step_of_input / stage.angle(sun[lane]).rate;
                sun_steps[lane] = [next, if i == 0 { next } else { sun_steps[lane][0] }];
                let next = next * driven.rate / (look.rate + look.change * step);
                planet_steps[lane] = [next, if i == 0 { next } else { planet_steps[lane][0] }];
            }
            for lane in 0..LANES {
                let index = lane * quarter + i;
                if !Stage::settled(miss[lane]) {
                    (sun[lane], planet[lane]) =
                        machine.mesh(stage, input(index), sun[lane], planet[lane]);
                }
                self.sun[index] = sun[lane];
                self.planet[index] = planet[lane];
                let chi = stage.angle(planet[lane]).value;
                let arm = machine.carrier_start + psi[lane] + machine.bend + machine.zero - chi;
                let [c, s] = self.circle.at(arm + machine.mounting);
                let [cos, sin] = self.turns[index];
                let sin = machine.sign * sin;
                self.x[index] =
                    machine.leg * (half_cos * cos - half_sin * sin) + machine.tip_distance * c;
                self.y[index] =
                    machine.leg * (half_sin * cos + half_cos * sin) + machine.tip_distance * s;
            }
        }
        if self.y.iter().all(|y| y.is_finite()) {
            Ok(())
        } else {
            Err(SweepError::NoClosure)
        }
    }

    pub(super) fn points(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        self.x.iter().zip(&self.y).map(|(&x, &y)| [x, y])
    }

    /// Direction of the arm's zero at an input.
    pub(super) fn arm(&self, stage: &Stage, machine: &Machine, input: f64) -> f64 {
        let input = input.rem_euclid(TAU);
        let index = (input / self.step()) as usize % self.x.len();
        let (_, planet) = machine.mesh(stage, input, self.sun[index], self.planet[index]);
        machine.carrier_start + machine.sign * input + machine.bend + machine.zero
            - stage.angle(planet).value
    }

    /// The tip near a known place of the path.
    fn near(&self, stage: &Stage, machine: &Machine, index: usize, input: f64) -> Tip {
        machine.near(stage, input, self.sun[index], self.planet[index])
    }

    /// The tip at any input.
    pub(super) fn tip(&self, stage: &Stage, machine: &Machine, input: f64) -> [f64; 2] {
        let input = input.rem_euclid(TAU);
        let index = (input / self.step()) as usize % self.x.len();
        self.near(stage, machine, index, input).position
    }

    /// Where the path reaches farthest in a direction.
    pub(super) fn farthest(
        &self,
        stage: &Stage,
        machine: &Machine,
        direction: [f64; 2],
    ) -> Extreme {
        let [across, up] = direction;
        let count = self.x.len();
        let reach = |i: usize| across * self.x[i] + up * self.y[i];
        let best = (0..count).map(reach).fold(f64::NEG_INFINITY, f64::max);
        // Between two inputs the path strays from its chord by the square of their distance.
        let margin = 4.0 * (machine.leg.abs() + machine.tip_distance) * self.step() * self.step();
        let mut found = Extreme {
            input: 0.0,
            reach: f64::NEG_INFINITY,
        };
        for i in 0..count {
            let here = reach(i);
            if here < best - margin {
                continue;
            }
            let around = [(i + count - 1) % count, (i + 1) % count].map(reach);
            if here < around[0] || here < around[1] {
                continue;
            }
            let crest = self.crest(stage, machine, i, direction, [around[0], here, around[1]]);
            if crest.reach > found.reach {
                found = crest;
            }
        }
        Extreme {
            input: found.input.rem_euclid(TAU),
            ..found
        }
    }

    /// The crest near an input, by secants of the slope from the crest of a parabola through three points.
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
        let look = |input: f64| {
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
            let (reach, slope) = look(input);
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
            // A crest is flat: its height is right to the square of this.
            if !next.is_finite() || (next - input).abs() < 1e-8 {
                break;
            }
            input = next;
        }
        best
    }

    /// Where the reach in a direction last grows past a distance before an input.
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
            let index = (input / step).round().rem_euclid(count as f64) as usize % count;
            let turns = ((input - step * index as f64) / TAU).round();
            let tip = self.near(stage, machine, index, input - turns * TAU);
            tip.position[0] * direction[0] + tip.position[1] * direction[1] - distance
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
