use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Tolerance, run_both};
use centrode_kinematics::machine::{
    Figure, Line, LinePath, LineRole, LinkedMachine, Quantity, Seat, Sketch,
};
use centrode_kinematics::transmission::Transmission;
use nalgebra::{Isometry2, Isometry3, Vector3};

use super::motion::within;
use super::rim::rim;
use super::still::Still;
use crate::picture::{Mark, Motion, Path, Picture, PictureLink, Rounding};

/// Minimum number of steps of a period: half of the samples of its curves, so that both use the cached values of the laws.
const FEWEST: f64 = 360.0;
/// Minimum number of steps per turn of the input: no link may turn by half a turn in one step.
const PER_TURN: f64 = 60.0;
/// Maximum error of figures between two steps, in tolerances: nobody measures moving figures.
const BETWEEN: f64 = 10.0;
/// Maximum number of steps of a period.
const MOST: f64 = 2e4;
/// Inputs at which the picture shows the positions around a jump: this far before it and this far after it, rad.
const BEFORE: f64 = 1e-6;
const AFTER: f64 = 1e-9;
/// Change of a law over [`BEFORE`], relative to one plus its speed, above which it counts as a jump.
const SUDDEN: f64 = 1e-3;
/// Minimum tolerance, relative to the reach of the largest figure: nobody sees a finer one, and a figure much larger than the
/// others would need too many points.
const FINEST: f64 = 1e-7;
/// Steps to which angles and inputs are rounded, rad.
const ANGLE: f64 = 1e-6;
const INPUT: f64 = 1e-7;

/// The machine as a moving picture. Lines and positions at the steps of the input are within the tolerance, positions between
/// steps within ten times the tolerance. The tolerance is at least 1e-7 of the reach of the largest figure.
#[must_use]
pub fn picture(machine: &LinkedMachine, tolerance: Tolerance) -> Picture {
    let rims: Vec<Vec<Point>> = machine.sketches.iter().map(rim).collect();
    let finest = Tolerance::new(FINEST * rims.iter().map(|rim| reach(rim)).fold(0.0, f64::max));
    let tolerance = finest.map_or(tolerance, |finest| tolerance.max(finest));
    let still = Still::new(machine, tolerance);
    // Contours take longer than the poses: the thread that finishes first continues with the remaining contours.
    let course = || {
        let course = Course::within(machine, &rims, tolerance);
        still.fit();
        course
    };
    let (course, ()) = run_both(course, || still.fit());
    let [length, angle, inputs] = [0.1 * tolerance.mm(), ANGLE, INPUT].map(Rounding::to);
    let paths = |(index, figure): (usize, &Figure)| PictureLink {
        name: figure.name.clone(),
        paths: machine.sketches[figure.sketch]
            .lines
            .iter()
            .filter_map(|line| match &line.path {
                LinePath::Trace(_) => course.way(line, index, tolerance),
                _ => still.path(line),
            })
            .collect(),
    };
    let rounded = |poses: &Vec<[f64; 3]>| {
        let rounded = |[x, y, turn]: &[f64; 3]| [length.of(*x), length.of(*y), angle.of(*turn)];
        let all: Vec<[f64; 3]> = poses.iter().map(rounded).collect();
        match all.first() {
            Some(first) if all.iter().all(|pose| pose == first) => first.to_vec(),
            _ => all.concat(),
        }
    };
    Picture {
        links: machine.figures.iter().enumerate().map(paths).collect(),
        motion: Motion {
            input_name: machine.input.name.clone(),
            input: course.input.iter().map(|&input| inputs.of(input)).collect(),
            poses: course.poses.iter().map(rounded).collect(),
        },
        handles: Vec::new(),
        marks: machine
            .marks
            .iter()
            .map(|mark| Mark {
                name: mark.name.clone(),
                link: mark.figure,
                at: mark.at,
            })
            .collect(),
        contacts: Vec::new(),
        extent: course.extent(machine, &rims),
    }
}

/// Poses of all figures over a period.
struct Course {
    input: Vec<f64>,
    /// For each figure: x, y and turn at every input.
    poses: Vec<Vec<[f64; 3]>>,
    /// For each point: its position at every input; empty if no line traces the point.
    points: Vec<Vec<Point>>,
}

impl Course {
    /// Poses at steps so short that straight lines between them are near enough; at most [`MOST`] steps.
    fn within(machine: &LinkedMachine, rims: &[Vec<Point>], tolerance: Tolerance) -> Self {
        let period = machine.input.period;
        let traced: Vec<bool> = (0..machine.points.len())
            .map(|point| machine.sketches.iter().any(|s| traces(s, point)))
            .collect();
        let required = required(machine, &traced);
        let sudden = sudden(machine, &required);
        let course = |steps: f64| {
            let input = inputs(period, steps.ceil() as u32, &sudden);
            Self::new(machine, &required, &traced, input)
        };
        let minimum = FEWEST.max(period / TAU * PER_TURN);
        let coarse = course(minimum);
        // The error of a chord over one step is a quarter of the deviation measured over two steps.
        let off = 0.25 * coarse.bend(machine, rims, &sudden) / (BETWEEN * tolerance.mm());
        let steps = (minimum * off.sqrt()).min(MOST.max(minimum));
        if off > 1.0 && steps > minimum {
            course(steps)
        } else {
            coarse
        }
    }

    fn new(machine: &LinkedMachine, required: &[bool], traced: &[bool], input: Vec<f64>) -> Self {
        let mut poses: Vec<Vec<[f64; 3]>> =
            vec![Vec::with_capacity(input.len()); machine.figures.len()];
        let mut points = vec![Vec::new(); machine.points.len()];
        for &now in &input {
            let places = machine.places(now, required);
            for (figure, poses) in machine.figures.iter().zip(&mut poses) {
                let before = poses.last().map(|pose| pose[2]);
                poses.push(pose(machine, figure, &places, now, before));
            }
            for (index, ways) in points.iter_mut().enumerate().filter(|(i, _)| traced[*i]) {
                let point = &machine.points[index];
                let at = places[point.link]
                    .map_or(point.at.into(), |p| p * nalgebra::Point3::from(point.at));
                ways.push(at.xy());
            }
        }
        Self {
            input,
            poses,
            points,
        }
    }

    /// Maximum distance of a figure's lines from the interpolation between the steps before and after, without jumps.
    fn bend(&self, machine: &LinkedMachine, rims: &[Vec<Point>], sudden: &[f64]) -> f64 {
        let smooth = |&i: &usize| {
            sudden
                .binary_search_by(|s| s.total_cmp(&self.input[i]))
                .is_err()
        };
        let smooth: Vec<usize> = (1..self.input.len() - 1).filter(smooth).collect();
        let of = |(figure, poses): (&Figure, &Vec<[f64; 3]>)| {
            let reach = reach(&rims[figure.sketch]);
            let off = |&i: &usize| {
                let (from, now, to) = (self.input[i - 1], self.input[i], self.input[i + 1]);
                let share = (now - from) / (to - from);
                let [x, y, turn] = [0, 1, 2].map(|k| {
                    let (a, b) = (poses[i - 1][k], poses[i + 1][k]);
                    poses[i][k] - (a + share * (b - a))
                });
                x.hypot(y) + reach * turn.abs()
            };
            smooth.iter().map(off).fold(0.0, f64::max)
        };
        let figures = machine.figures.iter().zip(&self.poses);
        figures.map(of).fold(0.0, f64::max)
    }

    /// The path of the point that a line traces, as seen from its figure.
    fn way(&self, line: &Line, figure: usize, tolerance: Tolerance) -> Option<Path> {
        let LinePath::Trace(point) = line.path else {
            return None;
        };
        let places = self.points[point].iter().zip(&self.poses[figure]);
        let seen: Vec<Point> = places.map(|(p, pose)| placed(pose).inverse() * p).collect();
        Some(Path::way(line.role, &seen, tolerance))
    }

    /// Minimum x and y, maximum x and y of the material of all figures, and of the traces, over the period.
    fn extent(&self, machine: &LinkedMachine, rims: &[Vec<Point>]) -> [f64; 4] {
        let mut extent = [
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ];
        let cover = |[left, low, right, high]: [f64; 4], x: f64, y: f64| {
            [left.min(x), low.min(y), right.max(x), high.max(y)]
        };
        for (figure, poses) in machine.figures.iter().zip(&self.poses) {
            let still = poses.iter().all(|pose| *pose == poses[0]);
            let count = if still { 1 } else { poses.len() };
            let reach = reach(&rims[figure.sketch]);
            for [x, y, turn] in &poses[..count] {
                let [left, low, right, high] = extent;
                if x - reach >= left && x + reach <= right && y - reach >= low && y + reach <= high
                {
                    continue;
                }
                let (sin, cos) = turn.sin_cos();
                for p in &rims[figure.sketch] {
                    let at = [x + cos * p.x - sin * p.y, y + sin * p.x + cos * p.y];
                    extent = cover(extent, at[0], at[1]);
                }
            }
            for line in &machine.sketches[figure.sketch].lines {
                if let (LineRole::Trace, LinePath::Trace(point)) = (line.role, &line.path) {
                    let places = self.points[*point].iter();
                    extent = places.fold(extent, |extent, p| cover(extent, p.x, p.y));
                }
            }
        }
        extent
    }
}

/// Maximum distance of a rim from the origin of its figure, mm.
fn reach(rim: &[Point]) -> f64 {
    rim.iter().map(|p| p.coords.norm()).fold(0.0, f64::max)
}

pub(super) fn placed([x, y, turn]: &[f64; 3]) -> Isometry2<f64> {
    Isometry2::new(nalgebra::Vector2::new(*x, *y), *turn)
}

/// Pose of a figure at an input; the turn of a link continues from the turn `before`.
pub(super) fn pose(
    machine: &LinkedMachine,
    figure: &Figure,
    places: &[Option<Isometry3<f64>>],
    input: f64,
    before: Option<f64>,
) -> [f64; 3] {
    let [x, y, turn] = figure.at;
    let seat = match &figure.seat {
        Seat::Free(by) => [0, 1, 2].map(|k| machine.value(&by[k], input)),
        Seat::Link(link) => {
            let place = places[*link].unwrap_or_else(Isometry3::identity);
            let along = place.rotation * Vector3::x();
            let at = place.translation.vector;
            let mut seen = along.y.atan2(along.x);
            if let Some(before) = before {
                let before = before - turn;
                seen = before + (seen - before + PI).rem_euclid(TAU) - PI;
            }
            [at.x, at.y, seen]
        }
    };
    let at = placed(&seat) * Point::new(x, y);
    [at.x, at.y, seat[2] + turn]
}

/// The links that figures and traces need, with those that carry them.
fn required(machine: &LinkedMachine, traced: &[bool]) -> Vec<bool> {
    let mut required = vec![false; machine.links.len()];
    let seats = machine
        .figures
        .iter()
        .filter_map(|figure| match figure.seat {
            Seat::Link(link) => Some(link),
            Seat::Free(_) => None,
        });
    let points = machine.points.iter().zip(traced);
    let points = points.filter(|(_, traced)| **traced).map(|(p, _)| p.link);
    for link in seats.chain(points) {
        required[link] = true;
        for joint in machine.carriers(link) {
            required[joint.parent] = true;
        }
    }
    required
}

fn traces(sketch: &Sketch, point: usize) -> bool {
    let mut lines = sketch.lines.iter();
    lines.any(|line| line.path == LinePath::Trace(point))
}

/// Inputs at which a speed jumps, and inputs just before and after each jump of a position, ascending.
fn sudden(machine: &LinkedMachine, required: &[bool]) -> Vec<f64> {
    let moved = machine.joints.iter().filter(|joint| required[joint.child]);
    let mut laws: Vec<&dyn Transmission> = moved.map(|joint| joint.law.as_ref()).collect();
    for figure in &machine.figures {
        let Seat::Free(by) = &figure.seat else {
            continue;
        };
        laws.extend(by.iter().filter_map(|quantity| match quantity {
            Quantity::Joint { joint, .. } => Some(machine.joints[*joint].law.as_ref()),
            Quantity::Law(law) => Some(law.as_ref()),
            _ => None,
        }));
    }
    let period = machine.input.period;
    let mut found = Vec::new();
    for law in laws {
        for at in within(law, machine) {
            let [before, after] = [at - BEFORE, at + AFTER].map(|input| law.at(input));
            let limit = SUDDEN * (1.0 + after.velocity.abs());
            let at = if at < BEFORE { period } else { at };
            if (after.position - before.position).abs() > limit && at <= period {
                found.extend([at - BEFORE, at + AFTER]);
            } else if (after.velocity - before.velocity).abs() > limit && at < period {
                found.push(at);
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found.dedup_by(|b, a| *b - *a < 0.5 * BEFORE);
    found
}

/// Equal steps of a period and the inputs of jumps, ascending.
fn inputs(period: f64, steps: u32, sudden: &[f64]) -> Vec<f64> {
    let alone = |input: &f64| {
        let after = sudden.partition_point(|s| s < input);
        let beside = sudden[after.saturating_sub(1)..].iter().take(2);
        beside.into_iter().all(|s| (s - input).abs() > 2.0 * BEFORE)
    };
    let even = (0..=steps).map(|i| period * f64::from(i) / f64::from(steps));
    let mut all: Vec<f64> = even.filter(alone).chain(sudden.iter().copied()).collect();
    all.sort_by(f64::total_cmp);
    all
}
