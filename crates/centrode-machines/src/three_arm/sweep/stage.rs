use std::f64::consts::{PI, TAU};

use centrode_geometry::bracketed_root;

use super::SweepError;
use super::panel::{
    COEFFICIENTS, DrivenAngle, Evaluation, Monotone, NODES, Panel, PolarAngle, horner, twice,
};
use super::spline::SplinePair;
use super::track::Monotonicity;
use centrode_gear::pitch::{Bspline, HIGHEST_DEGREE};

/// Number of panels per piece.
const PANELS: usize = 3;
/// Halley step below which the iteration stops; the remaining error is below step^3/100.
pub(super) const LAST: f64 = 1e-3;

/// Parameter on the pitch curve: panel, position in the panel, and number of whole turns before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Param {
    pub(super) panel: usize,
    pub(super) s: f64,
    pub(super) turns: f64,
}

/// One stage of the gear train: the integral of r/(a - r) over the polar angle, forwards and backwards.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    spline: SplinePair,
    /// Nodes of a panel and their Fejér weights.
    nodes: [f64; NODES],
    weights: [f64; NODES],
    /// Linear map from values at the nodes to the coefficients of the antiderivative in powers; it is zero at the panel's start.
    antiderivative: [[f64; COEFFICIENTS]; NODES],
    panels: Vec<Panel>,
    /// Polar angle, and driven angle from parameter zero, at the start of each panel and at the end of the last.
    angles: Vec<f64>,
    before: Vec<f64>,
    /// Values at every node: radius, angle rate, and their product with the weight.
    radii: Vec<f64>,
    turns: Vec<f64>,
    parts: Vec<f64>,
    center_distance: f64,
    length: f64,
    extremes: (f64, f64),
    /// Integrals of the radius and of its square over a turn.
    moments: [f64; 2],
    /// Driven angle from parameter zero to polar angle zero.
    offset: f64,
}

impl Stage {
    pub(super) fn new(spline: SplinePair) -> Self {
        let angle = |j: usize| PI * (j as f64 + 0.5) / NODES as f64;
        let nodes: [f64; NODES] = std::array::from_fn(|j| -angle(j).cos());
        // Coefficients in powers of the polynomial that is 1 at node j and 0 at all other nodes.
        let through = |j: usize| {
            let mut c = [0.0; NODES];
            c[0] = 1.0;
            let others = nodes.iter().enumerate().filter(|(k, _)| *k != j);
            for (degree, (_, &node)) in (1..).zip(others) {
                let scale = 1.0 / (nodes[j] - node);
                for power in (0..=degree).rev() {
                    let lower = if power > 0 { c[power - 1] } else { 0.0 };
                    c[power] = (lower - node * c[power]) * scale;
                }
            }
            c
        };
        let mut antiderivative = [[0.0; COEFFICIENTS]; NODES];
        let mut weights = [0.0; NODES];
        for j in 0..NODES {
            for (power, c) in through(j).into_iter().enumerate() {
                let part = c / (power + 1) as f64;
                antiderivative[j][power + 1] = part;
                let sign = if power % 2 == 0 { 1.0 } else { -1.0 };
                antiderivative[j][0] += sign * part;
                weights[j] += part + sign * part;
            }
        }
        let count = spline.count() * PANELS;
        Self {
            spline,
            nodes,
            weights,
            antiderivative,
            panels: vec![Panel::EMPTY; count],
            angles: vec![0.0; count + 1],
            before: vec![0.0; count + 1],
            radii: vec![0.0; count * NODES],
            turns: vec![0.0; count * NODES],
            parts: vec![0.0; count * NODES],
            center_distance: 0.0,
            length: 0.0,
            extremes: (0.0, 0.0),
            moments: [0.0; 2],
            offset: 0.0,
        }
    }

    /// Loads a pitch curve: finds its centre distance and integrates it.
    pub(super) fn load(&mut self, spline: &Bspline) -> Result<(), SweepError> {
        self.spline.load(spline)?;
        let half = 0.5 / PANELS as f64;
        for (index, panel) in self.panels.iter_mut().enumerate() {
            let middle = half * (2 * (index % PANELS) + 1) as f64;
            [panel.angle, panel.radius] = self.spline.part(index / PANELS, middle, half);
        }
        if self.coefficients() <= 3 {
            self.evaluate_round::<3>()?;
        } else {
            self.evaluate_round::<{ HIGHEST_DEGREE + 1 }>()?;
        }
        self.find_extremes();
        self.center_distance = self.closure()?;
        self.integrate();
        self.offset = 0.0;
        self.offset = self.driven(self.at_angle(0.0)).value;
        Ok(())
    }

    /// Evaluates every panel, whose polynomials have `C` coefficients, at its nodes.
    fn evaluate_round<const C: usize>(&mut self) -> Result<(), SweepError> {
        let (mut length, mut first, mut second) = ([0.0; NODES], [0.0; NODES], [0.0; NODES]);
        let mut good = true;
        let nodes = self
            .radii
            .chunks_exact_mut(NODES)
            .zip(self.turns.chunks_exact_mut(NODES));
        let nodes = nodes.zip(self.parts.chunks_exact_mut(NODES));
        for (panel, ((radii, turns), parts)) in self.panels.iter().zip(nodes) {
            for j in 0..NODES {
                let s = self.nodes[j];
                let (mut turn, mut r, mut slope) = (0.0, 0.0, 0.0);
                for k in (1..C).rev() {
                    let power = k as f64;
                    turn = turn * s + power * panel.angle[k];
                    slope = slope * s + power * panel.radius[k];
                    r = r * s + panel.radius[k];
                }
                r = r * s + panel.radius[0];
                let across = r * turn;
                radii[j] = r;
                turns[j] = turn;
                parts[j] = self.weights[j] * across;
                length[j] += (across * across + slope * slope).sqrt();
                first[j] += parts[j];
                second[j] += parts[j] * r;
            }
            for j in 0..NODES {
                good &= radii[j] > 0.0 && turns[j] > 0.0;
            }
        }
        self.moments = [first.iter().sum(), second.iter().sum()];
        self.length = length.iter().zip(&self.weights).map(|(l, w)| l * w).sum();
        for (start, panel) in self.angles.iter_mut().zip(&self.panels) {
            *start = horner(&panel.angle, -1.0).0;
        }
        self.angles[self.panels.len()] = self.angles[0] + TAU;
        if good && self.length.is_finite() {
            Ok(())
        } else {
            Err(SweepError::NotAroundAxis)
        }
    }

    /// Finds the exact minimum and maximum radius: inside a panel at which the radius is stationary, or at the start of a panel.
    fn find_extremes(&mut self) {
        let (mut minimum, mut maximum) = (f64::INFINITY, 0.0_f64);
        for panel in &self.panels {
            let (radius, before) = horner(&panel.radius, -1.0);
            let (_, after) = horner(&panel.radius, 1.0);
            minimum = minimum.min(radius);
            maximum = maximum.max(radius);
            if before * after < 0.0 {
                let rate = |s: f64| horner(&panel.radius, s).1;
                let s = bracketed_root(rate, -1.0, 1.0, before, after);
                let radius = horner(&panel.radius, s).0;
                minimum = minimum.min(radius);
                maximum = maximum.max(radius);
            }
        }
        self.extremes = (minimum, maximum);
    }

    /// Centre distance a at which one driver turn gives one driven turn. Newton's method acts on the reciprocal of the driven
    /// turn, which for a circle is a straight line.
    fn closure(&self) -> Result<f64, SweepError> {
        let maximum = self.extremes.1;
        // First guess, for a nearly constant radius: twice the mean plus twice the variance over the mean.
        let mean = self.moments[0] / TAU;
        let variance = self.moments[1] / TAU - mean * mean;
        let mut a = (2.0 * (mean + variance / mean)).max(maximum * 1.001);
        for _ in 0..60 {
            let (mut turned, mut slope) = ([0.0; NODES], [0.0; NODES]);
            let parts = self.parts.chunks_exact(NODES);
            for (radii, parts) in self.radii.chunks_exact(NODES).zip(parts) {
                for k in 0..NODES {
                    let rest = 1.0 / (a - radii[k]);
                    let part = parts[k] * rest;
                    turned[k] += part;
                    slope[k] += part * rest;
                }
            }
            let (turned, slope): (f64, f64) = (turned.iter().sum(), slope.iter().sum());
            let step = turned * (turned / TAU - 1.0) / slope;
            a += step;
            if a <= maximum {
                a = 0.5 * (a - step + maximum);
            } else if step.abs() <= 1e-7 * a {
                // The relative change in the next step would be about the square of this one.
                return Ok(a);
            }
        }
        Err(SweepError::NoClosure)
    }

    fn integrate(&mut self) {
        let a = self.center_distance;
        let mut sum = 0.0;
        let nodes = self
            .radii
            .chunks_exact(NODES)
            .zip(self.turns.chunks_exact(NODES));
        let panels = self.panels.iter_mut().zip(&mut self.before);
        for ((panel, before), (radii, turns)) in panels.zip(nodes) {
            let mut out = [0.0; COEFFICIENTS];
            for j in 0..NODES {
                let value = turns[j] * radii[j] / (a - radii[j]);
                for (c, m) in out.iter_mut().zip(&self.antiderivative[j]) {
                    *c += m * value;
                }
            }
            let whole: f64 = out.iter().sum();
            out[0] += sum;
            panel.driven = out;
            *before = sum;
            sum += whole;
        }
        self.before[self.panels.len()] = sum;
    }

    pub(super) fn control_points(&self) -> usize {
        self.spline.count()
    }

    pub(super) fn center_distance(&self) -> f64 {
        self.center_distance
    }

    pub(super) fn length(&self) -> f64 {
        self.length
    }

    pub(super) fn radii(&self) -> (f64, f64) {
        self.extremes
    }

    /// Maximum convex and maximum concave curvature of both pitch curves, at the nodes and the ends of the panels, where it
    /// may jump.
    pub(super) fn curvatures(&self) -> [f64; 2] {
        let a = self.center_distance;
        let (mut convex, mut concave) = (0.0_f64, 0.0_f64);
        for panel in &self.panels {
            for s in self.nodes.into_iter().chain([-1.0, 1.0]) {
                let (r, r_rate, r_change) = twice(&panel.radius, s);
                let (_, rate, change) = twice(&panel.angle, s);
                let slope = r_rate / rate;
                let bend = (r_change - slope * change) / (rate * rate);
                // The driven curve R = a - r as a function of its own angle, whose rate is r/R of the driver's.
                let other = a - r;
                let ratio = other / r;
                let other_bend = ratio * (slope * slope * (1.0 + ratio) / r - bend * ratio);
                for (r, slope, bend) in [(r, slope, bend), (other, slope * ratio, other_bend)] {
                    let square = r * r + slope * slope;
                    let curvature = (square + slope * slope - r * bend) / (square * square.sqrt());
                    convex = convex.max(curvature);
                    concave = concave.max(-curvature);
                }
            }
        }
        [convex, concave]
    }

    /// Parameter moved on by a step.
    #[inline]
    pub(super) fn moved(&self, from: Param, by: f64) -> Param {
        let mut param = from;
        // Limits steps to one turn: for a curve that turns back they could be longer.
        let most = 2.0 * self.panels.len() as f64;
        param.s += by.clamp(-most, most);
        while param.s > 1.0 {
            param.s -= 2.0;
            param.panel += 1;
            if param.panel == self.panels.len() {
                param.panel = 0;
                param.turns += 1.0;
            }
        }
        while param.s < -1.0 {
            param.s += 2.0;
            if param.panel == 0 {
                param.panel = self.panels.len();
                param.turns -= 1.0;
            }
            param.panel -= 1;
        }
        param
    }

    /// Number of coefficients to compute with, from the degree of the spline: higher coefficients are zero and need not be
    /// summed.
    pub(super) fn coefficients(&self) -> usize {
        self.spline.degree() + 1
    }

    /// The polar angle as an increasing function along the panels.
    pub(super) fn angle_growth(&self) -> Monotonicity<'_, PolarAngle> {
        Monotonicity {
            of: PolarAngle,
            panels: &self.panels,
            ends: &self.angles,
        }
    }

    /// The driven angle, from parameter zero, as an increasing function along the panels.
    pub(super) fn driven_growth(&self) -> Monotonicity<'_, DrivenAngle> {
        Monotonicity {
            of: DrivenAngle {
                center_distance: self.center_distance,
            },
            panels: &self.panels,
            ends: &self.before,
        }
    }

    /// Polar angle at a parameter.
    #[inline]
    pub(super) fn angle(&self, param: Param) -> Evaluation {
        self.evaluate(self.angle_growth(), param)
    }

    /// Driven angle from polar angle zero at a parameter.
    #[inline]
    pub(super) fn driven(&self, param: Param) -> Evaluation {
        let mut evaluation = self.evaluate(self.driven_growth(), param);
        evaluation.value -= self.offset;
        evaluation
    }

    #[inline]
    fn evaluate<G: Monotone>(&self, growth: Monotonicity<'_, G>, param: Param) -> Evaluation {
        let panel = &self.panels[param.panel];
        let mut evaluation = if self.coefficients() <= 3 {
            growth.of.evaluate::<3, _>(panel, param.s)
        } else {
            growth
                .of
                .evaluate::<{ HIGHEST_DEGREE + 1 }, _>(panel, param.s)
        };
        evaluation.value += param.turns * growth.whole();
        evaluation
    }

    /// Parameter at any polar angle, without a first guess.
    pub(super) fn at_angle(&self, angle: f64) -> Param {
        self.angle_growth().param::<{ HIGHEST_DEGREE + 1 }>(angle)
    }

    /// Parameter at any driven angle from polar angle zero, without a first guess.
    pub(super) fn at_driven(&self, driven: f64) -> Param {
        let growth = self.driven_growth();
        growth.param::<{ HIGHEST_DEGREE + 1 }>(driven + self.offset)
    }

    /// One Halley step towards a polar angle from a parameter nearby: the new parameter, and the step's length.
    #[inline]
    pub(super) fn nearer_angle(&self, param: Param, angle: f64) -> (Param, f64) {
        let step = self.angle(param).step(angle);
        (self.moved(param, step), step)
    }

    /// One Halley step towards a driven angle from a parameter nearby: the new parameter, and the step's length.
    #[inline]
    pub(super) fn nearer_driven(&self, param: Param, driven: f64) -> (Param, f64) {
        let step = self.driven(param).step(driven);
        (self.moved(param, step), step)
    }
}

/// Whether no further step is needed after this one.
#[inline]
pub(super) fn settled(step: f64) -> bool {
    step.abs() < LAST
}
