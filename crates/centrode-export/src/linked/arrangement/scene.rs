use centrode_formats::sheet::Pen;
use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};
use centrode_kinematics::machine::{
    Figure, LinePath, LineRole, LinkPoint, LinkedMachine, Place, Quantity, Seat,
};
use nalgebra::{Isometry2, Isometry3};

use super::super::picture::{placed, pose};

/// Number of intervals of a period for the drawn path of a point.
const STEPS: u32 = 720;
/// Distance below which a path counts as running along itself, relative to its size.
const ALONG: f64 = 2e-4;

/// Margin around the ends of dimensions, relative to the machine's size.
const AIR: f64 = 0.01;

/// A line of the machine at its position, at full size.
pub(super) enum Drawn {
    /// A closed contour, and the mean length of its segments.
    Closed(Outline, f64),
    /// An open chain.
    Open(Vec<Point>),
}

/// The machine as it is drawn: every figure at its position.
pub(super) struct Scene<'a> {
    pub(super) machine: &'a LinkedMachine,
    /// Pose of each figure.
    poses: Vec<Isometry2<f64>>,
    /// Pose of each link.
    pub(super) places: Vec<Isometry3<f64>>,
    pub(super) lines: Vec<(Pen, Drawn)>,
    /// Bounds of the machine; ground lines are cut off there.
    pub(super) whole: Bounds,
}

/// Pen of a line on a sheet, ISO 128-2; `None` for an auxiliary line of the design that is no part of the machine.
fn pen(role: LineRole, seen_through: bool) -> Option<Pen> {
    match role {
        LineRole::Body | LineRole::Hole if seen_through => Some(Pen::Adjacent),
        LineRole::Body | LineRole::Hole | LineRole::Bar | LineRole::Clamp => Some(Pen::Outline),
        LineRole::Pitch | LineRole::Trace => Some(Pen::Axis),
        LineRole::Adjacent | LineRole::Pose => Some(Pen::Adjacent),
        LineRole::Ground | LineRole::Window => Some(Pen::Thin),
        _ => None,
    }
}

impl<'a> Scene<'a> {
    pub(super) fn new(machine: &'a LinkedMachine, tolerance: Tolerance) -> Self {
        let input = machine.arrangement.input;
        let places = machine.places(input, &vec![true; machine.links.len()]);
        let poses = machine.figures.iter().map(|figure| {
            let pose = pose(machine, figure, &places, input, None);
            placed(&pose)
        });
        let mut scene = Self {
            machine,
            poses: poses.collect(),
            places: places.into_iter().map(Option::unwrap_or_default).collect(),
            lines: Vec::new(),
            whole: Bounds::EMPTY,
        };
        let mut around = Vec::new();
        for (index, (figure, pose)) in machine.figures.iter().zip(&scene.poses).enumerate() {
            let seen_through = machine.arrangement.seen_through.contains(&index);
            for line in &machine.sketches[figure.sketch].lines {
                let Some(pen) = pen(line.role, seen_through) else {
                    continue;
                };
                let surrounds = line.role == LineRole::Ground;
                let drawn: Vec<Drawn> = match &line.path {
                    // Arcs first: turned polynomials would be fitted anew for every position.
                    LinePath::Contour(outline) if !surrounds => {
                        let mean = perimeter(outline) / outline.segments().len() as f64;
                        vec![Drawn::Closed(
                            outline.arcs(tolerance).transformed(pose),
                            mean,
                        )]
                    }
                    LinePath::Contour(outline) => {
                        let mut points = outline.flatten(tolerance);
                        points.extend(points.first().copied());
                        vec![Drawn::Open(points.iter().map(|p| pose * p).collect())]
                    }
                    LinePath::Chain(corners) => {
                        let corners = corners.iter().map(|at| pose * Point::from(*at));
                        vec![Drawn::Open(corners.collect())]
                    }
                    LinePath::Trace(point) => {
                        let way = way(machine, figure, &machine.points[*point]);
                        let way: Vec<Point> = way.iter().map(|p| pose * p).collect();
                        once(&way).into_iter().map(Drawn::Open).collect()
                    }
                };
                // Only traced paths are dash-dotted: short edges would disappear in the gaps.
                let pen = match line.path {
                    LinePath::Chain(_) if pen == Pen::Axis => Pen::Thin,
                    _ => pen,
                };
                if surrounds {
                    around.extend(drawn);
                    continue;
                }
                for line in drawn {
                    scene.whole = scene.whole.union(line.bounds());
                    scene.lines.push((pen, line));
                }
            }
        }
        let air = Vector::repeat(AIR * scene.whole.diagonal());
        for place in machine.arrangement.dimensions.iter().flat_map(|d| d.ends) {
            let end = scene.at(&place);
            scene.whole = scene.whole.with(end - air).with(end + air);
        }
        for line in &around {
            let Drawn::Open(points) = line else { continue };
            let cut = clipped(points, scene.whole);
            let cut = cut.into_iter().map(|line| (Pen::Thin, Drawn::Open(line)));
            scene.lines.extend(cut);
        }
        scene
    }

    /// Position on the sheet, at full size, of a point of a figure.
    pub(super) fn at(&self, place: &Place) -> Point {
        self.poses[place.figure] * Point::from(place.at)
    }

    /// Centres of rotation of the figures that are not fixed to a link.
    pub(super) fn centers(&self) -> impl Iterator<Item = Point> {
        let turns = |figure: &Figure| match &figure.seat {
            Seat::Free(by) => !matches!(by[2], Quantity::Law(_)),
            Seat::Link(_) => false,
        };
        let figures = self.machine.figures.iter().enumerate();
        figures
            .filter(move |(_, figure)| turns(figure))
            .map(|(figure, _)| {
                self.at(&Place {
                    figure,
                    at: [0.0; 2],
                })
            })
    }

    /// Whether a link is drawn at its position.
    pub(super) fn shows(&self, link: usize) -> bool {
        let mut figures = self.machine.figures.iter();
        figures.any(|figure| matches!(figure.seat, Seat::Link(own) if own == link))
    }

    /// Indices of the points whose paths are drawn.
    pub(super) fn followed(&self) -> Vec<usize> {
        let drawn = |point: &usize| {
            self.machine.figures.iter().any(|figure| {
                let mut lines = self.machine.sketches[figure.sketch].lines.iter();
                lines.any(|line| {
                    line.path == LinePath::Trace(*point) && line.role == LineRole::Trace
                })
            })
        };
        (0..self.machine.points.len()).filter(drawn).collect()
    }
}

impl Drawn {
    fn bounds(&self) -> Bounds {
        match self {
            Self::Closed(outline, _) => outline.bounds(),
            Self::Open(points) => points.iter().copied().collect(),
        }
    }
}

fn perimeter(outline: &Outline) -> f64 {
    let chord = |segment: &centrode_geometry::Segment| {
        let middle = segment.at(0.0).point;
        (middle - segment.start()).norm() + (segment.end() - middle).norm()
    };
    outline.segments().iter().map(chord).sum()
}

/// The path of a point over one period, as seen from a figure.
fn way(machine: &LinkedMachine, figure: &Figure, point: &LinkPoint) -> Vec<Point> {
    let mut required = vec![false; machine.links.len()];
    // A free seat's quantities find their links themselves.
    let seat = match figure.seat {
        Seat::Link(link) => Some(link),
        Seat::Free(_) => None,
    };
    for link in seat.into_iter().chain([point.link]) {
        required[link] = true;
        for joint in machine.carriers(link) {
            required[joint.parent] = true;
        }
    }
    let at = |i: u32| {
        let input = machine.input.period * f64::from(i) / f64::from(STEPS);
        let places = machine.places(input, &required);
        let own = places[point.link].unwrap_or_else(Isometry3::identity);
        let seen = placed(&pose(machine, figure, &places, input, None));
        seen.inverse() * (own * nalgebra::Point3::from(point.at)).xy()
    };
    (0..=STEPS).map(at).collect()
}

/// A path without the stretches on which it runs back along itself: dashes drawn twice fill each other's gaps.
fn once(way: &[Point]) -> Vec<Vec<Point>> {
    let near = ALONG * way.iter().copied().collect::<Bounds>().diagonal();
    let mut runs: Vec<Vec<Point>> = Vec::new();
    let mut drawn: Vec<[Point; 2]> = Vec::new();
    let mut before: Option<(Point, bool)> = None;
    for point in way {
        let covered = drawn.iter().any(|line| distance(*point, *line) < near);
        if let Some((last, was_covered)) = before
            && !(covered && was_covered)
        {
            drawn.push([last, *point]);
            match runs.last_mut() {
                Some(run) if run.last() == Some(&last) => run.push(*point),
                _ => runs.push(vec![last, *point]),
            }
        }
        before = Some((*point, covered));
    }
    runs
}

/// Distance of a point from a straight line between two others.
fn distance(point: Point, [from, to]: [Point; 2]) -> f64 {
    let along = to - from;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        ((point - from).dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (point - (from + along * share)).norm()
}

/// The stretches of a chain within a rectangle (Liang and Barsky's clipping).
fn clipped(chain: &[Point], Bounds { min, max }: Bounds) -> Vec<Vec<Point>> {
    let mut runs: Vec<Vec<Point>> = Vec::new();
    for ends in chain.windows(2) {
        let (from, along): (Point, Vector) = (ends[0], ends[1] - ends[0]);
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (a, step) = (from[axis], along[axis]);
            let shares = [(min[axis] - a) / step, (max[axis] - a) / step];
            if step != 0.0 {
                first = first.max(shares[0].min(shares[1]));
                last = last.min(shares[0].max(shares[1]));
            } else if a < min[axis] || a > max[axis] {
                last = -1.0;
            }
        }
        if first >= last {
            continue;
        }
        let [start, end] = [first, last].map(|share| from + along * share);
        match runs.last_mut() {
            Some(run) if run.last() == Some(&start) => run.push(end),
            _ => runs.push(vec![start, end]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_out_and_back_is_drawn_once_and_a_ring_is_closed() {
        let arc = |i: u32| {
            let turn = 1.5 * (f64::from(i) / 360.0 * std::f64::consts::TAU).sin();
            Point::new(50.0 * turn.cos(), 50.0 * turn.sin())
        };
        let way: Vec<Point> = (0..=360).map(arc).collect();
        let runs = once(&way);
        let length: f64 = runs
            .iter()
            .flat_map(|run| run.windows(2))
            .map(|w| (w[1] - w[0]).norm())
            .sum();
        assert!(
            (length - 150.0).abs() < 3.0,
            "{length} in {} runs",
            runs.len()
        );
        let ring = |i: u32| {
            let turn = f64::from(i) / 360.0 * std::f64::consts::TAU;
            Point::new(50.0 * turn.cos(), 50.0 * turn.sin())
        };
        let way: Vec<Point> = (0..=360).map(ring).collect();
        let runs = once(&way);
        assert_eq!((runs.len(), runs[0].len()), (1, 361));
    }

    #[test]
    fn what_lies_outside_a_rectangle_is_cut_off() {
        let whole = Bounds::EMPTY
            .with(Point::new(0.0, 0.0))
            .with(Point::new(10.0, 4.0));
        let p = Point::new;
        let chain = [p(-5.0, 2.0), p(5.0, 2.0), p(5.0, 9.0), p(-5.0, 9.0)];
        let want = vec![vec![p(0.0, 2.0), p(5.0, 2.0), p(5.0, 4.0)]];
        assert_eq!(clipped(&chain, whole), want);
        assert!(clipped(&[p(20.0, 0.0), p(20.0, 4.0)], whole).is_empty());
    }
}
