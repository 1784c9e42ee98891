use super::super::motion::within;
use super::axes::Axis;
use super::scene::Scene;
use centrode_formats::sheet::number;
use centrode_geometry::{Extreme, Point, Vector, maximum_of_each, piece_ends};
use centrode_kinematics::machine::{Axis as Along, LinkedMachine};

/// Number of pieces of a period in which the extremes of a path are searched.
const PIECES: u32 = 12;
/// Minimum distance worth a dimension, mm.
const MINIMUM: f64 = 1e-6;
/// Decimals of a dimension: a micrometre.
const PLACES: usize = 3;

/// A dimension at full size.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) ends: [Point; 2],
    pub(super) along: Along,
}

impl Measured {
    /// The distance, mm.
    pub(super) fn length(&self) -> f64 {
        let [a, b] = self.ends;
        (b - a).dot(&self.direction()).abs()
    }

    pub(super) fn direction(&self) -> Vector {
        match self.along {
            Along::X => Vector::x(),
            Along::Y => Vector::y(),
        }
    }

    pub(super) fn words(&self) -> String {
        number(self.length(), PLACES)
    }
}

/// Distances of the fixed axes, further dimensions of the machine, and the extent of the drawn paths of points.
pub(super) fn dimensions(scene: &Scene<'_>, axes: &[Axis]) -> Vec<Measured> {
    let mut all: Vec<Measured> = Vec::new();
    let mut add = |ends: [Point; 2], along: Along| {
        let new = Measured { ends, along };
        let same = |known: &Measured| {
            let ends = known.ends.iter().zip(&new.ends);
            known.along == along
                && ends
                    .into_iter()
                    .all(|(a, b)| (a - b).dot(&new.direction()).abs() < MINIMUM)
        };
        if new.length() > MINIMUM && !all.iter().any(same) {
            all.push(new);
        }
    };
    let mut standing = axes.iter().filter(|axis| axis.stands());
    if let Some(first) = standing.next() {
        for other in standing {
            add([first.at, other.at], Along::X);
            add([first.at, other.at], Along::Y);
        }
    }
    for dimension in &scene.machine.arrangement.dimensions {
        let ends = dimension.ends.each_ref().map(|place| scene.at(place));
        add(ends, dimension.along);
    }
    for point in scene.followed() {
        let [left, right, low, high] = travel(scene.machine, point);
        add([left, right], Along::X);
        add([low, high], Along::Y);
    }
    all
}

/// Positions of a point's path that are farthest left, right, down and up.
fn travel(machine: &LinkedMachine, point: usize) -> [Point; 4] {
    let laws = machine.joints.iter().map(|joint| joint.law.as_ref());
    let breaks: Vec<f64> = laws.flat_map(|law| within(law, machine)).collect();
    let ends = piece_ends(0.0, machine.input.period, PIECES, &breaks);
    let at = |input: f64| machine.point(point, input).position.xy();
    let found = maximum_of_each(
        |input| {
            let at = at(input);
            [-at.x, at.x, -at.y, at.y]
        },
        &ends,
    );
    found.map(|Extreme { input, .. }| at(input))
}
