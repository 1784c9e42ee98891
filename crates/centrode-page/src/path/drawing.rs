use super::stages::{STEPS, Stage};
use centrode_export::picture::{Curve, Mark, Motion, Path, Picture, PictureLink};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_kinematics::machine::LineRole;
use centrode_kinematics::transmission::{Inverse, Transmission as _, TransmissionError};
use centrode_synthesis::reverse::{AxisRange, RequiredPath, Split, TwoBar};
use std::f64::consts::{PI, TAU};

/// Samples of the path.
const SAMPLES: u32 = 360;
/// Steps of the motion.
const MOMENTS: u32 = 120;
/// Reciprocal of the step to which drawn numbers are rounded, for mm and for rad.
const DIGITS: [f64; 2] = [1e3, 1e5];

/// The path alone, with marked positions.
pub(super) fn path(required: &RequiredPath, marks: Vec<Mark>) -> Picture {
    let range = AxisRange::about(required);
    let at = |i: u32| {
        required
            .at(required.period() * f64::from(i) / f64::from(SAMPLES))
            .point
    };
    let points: Vec<Point> = (0..SAMPLES).map(at).collect();
    still(&points, LineRole::Trace, [range.x, range.y], marks)
}

/// A polygon through points that do not make a path, with marked positions.
pub(super) fn polygon(points: &[Point], marks: Vec<Mark>) -> Picture {
    let bounds: Bounds = points.iter().copied().collect();
    let [x, y] = [[bounds.min.x, bounds.max.x], [bounds.min.y, bounds.max.y]];
    still(points, LineRole::Adjacent, [x, y], marks)
}

fn still(points: &[Point], role: LineRole, [x, y]: [[f64; 2]; 2], marks: Vec<Mark>) -> Picture {
    Picture {
        links: vec![link("path", closed(role, points))],
        motion: Motion {
            input_name: "carrier".into(),
            input: vec![0.0, TAU],
            poses: vec![vec![0.0; 3]],
        },
        marks,
        extent: [x[0], y[0], x[1], y[1]],
        ..Picture::default()
    }
}

/// A point on the path with a name.
pub(super) fn mark(name: &str, at: Point) -> Mark {
    Mark {
        name: name.into(),
        link: 0,
        at: [at.x, at.y],
    }
}

/// A machine as it is drawn.
pub(super) struct Drawing<'a> {
    chain: &'a TwoBar,
    split: &'a Split,
    by_carrier: Inverse,
    stages: [Stage; 2],
    leg: f64,
    arms: u32,
}

/// Angles of the bodies of one arm, rad.
struct Angles {
    carrier: f64,
    /// Both gears of the intermediate body.
    idlers: [f64; 2],
    planet: f64,
    arm: f64,
}

impl<'a> Drawing<'a> {
    pub(super) fn new(
        chain: &'a TwoBar,
        split: &'a Split,
        arms: u32,
    ) -> Result<Self, TransmissionError> {
        let leg = chain.center_distance(split.bend());
        Ok(Self {
            chain,
            split,
            by_carrier: chain.by_carrier()?,
            stages: split.tables(STEPS).map(|law| Stage::new(&law, leg)),
            leg,
            arms,
        })
    }

    /// Direction of the carrier at an input; the input is the carrier's turn since the start of the path.
    fn carrier(&self, input: f64) -> f64 {
        let start = self.chain.at(0.0).carrier[0];
        match self.chain.direction().sign() < 0.0 {
            true => start - input,
            false => start + input,
        }
    }

    fn angles(&self, carrier: f64) -> Angles {
        let jet = self.chain.at(self.by_carrier.at(carrier).position);
        let bend = self.split.bend();
        let planet = -jet.elbow[0] + self.split.planet_offset();
        let turned = |law: &dyn Fn(f64) -> f64, polar: f64| law(polar) - law(0.0);
        let leg = carrier - 0.5 * bend;
        let back = leg + bend + PI;
        Angles {
            carrier,
            idlers: [
                leg + turned(&|x| self.split.first(x), carrier),
                back + turned(&|x| self.split.second(x), planet),
            ],
            planet: back - planet,
            arm: carrier + jet.elbow[0],
        }
    }

    /// Sun, and carrier, gears and arm as often as there are arms, moving over one turn of the carrier.
    pub(super) fn picture(&self) -> Picture {
        let (chain, leg, bend) = (self.chain, self.leg, self.split.bend());
        let mut picture = path(chain.path(), Vec::new());
        let axis = chain.axis();
        let inputs = (0..=MOMENTS).map(|i| TAU * f64::from(i) / f64::from(MOMENTS));
        picture.motion.input = inputs.collect();
        let [first, second] = &self.stages;
        let body = |points: &[Point]| closed(LineRole::Body, points);
        picture.links.push(link("sun", body(&first.curves[0])));
        picture.motion.poses.push(pose(axis, -0.5 * bend).to_vec());
        let bar = |points: &[Point]| Path::open(LineRole::Bar, points);
        let way = |length: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * length;
        let o = Point::origin();
        let links = [
            ("idler gear", body(&first.curves[1])),
            ("idler second gear", body(&second.curves[1])),
            ("planet", body(&second.curves[0])),
            (
                "carrier",
                bar(&[o, o + way(leg, -0.5 * bend), o + way(chain.carrier(), 0.0)]),
            ),
            ("arm", bar(&[o, o + way(chain.arm(), 0.0)])),
        ];
        for k in 0..self.arms {
            let mut poses: [Vec<f64>; 5] = Default::default();
            for &input in &picture.motion.input {
                let apart = TAU * f64::from(k) / f64::from(self.arms);
                let angles = self.angles(self.carrier(input) + apart);
                let middle = axis + way(leg, angles.carrier - 0.5 * bend);
                let end = axis + way(chain.carrier(), angles.carrier);
                let all = [
                    pose(middle, angles.idlers[0]),
                    pose(middle, angles.idlers[1]),
                    pose(end, angles.planet),
                    pose(axis, angles.carrier),
                    pose(end, angles.arm),
                ];
                for (poses, pose) in poses.iter_mut().zip(all) {
                    poses.extend(pose);
                }
            }
            for ((name, path), poses) in links.iter().zip(poses) {
                picture
                    .links
                    .push(link(&format!("{name} {}", k + 1), path.clone()));
                picture.motion.poses.push(poses);
            }
        }
        let [sun, idler] = first.reach();
        let [planet, second_idler] = second.reach();
        let reach = sun
            .max(leg + idler.max(second_idler))
            .max(chain.carrier() + planet);
        let [x0, y0, x1, y1] = picture.extent;
        picture.extent = [
            x0.min(axis.x - reach),
            y0.min(axis.y - reach),
            x1.max(axis.x + reach),
            y1.max(axis.y + reach),
        ];
        picture
    }

    /// Ratio, law and curvatures by the turn of the carrier.
    pub(super) fn curves(&self) -> Vec<Curve> {
        let inputs: Vec<f64> = (0..=SAMPLES)
            .map(|i| TAU * f64::from(i) / f64::from(SAMPLES))
            .collect();
        let mut columns: [Vec<f64>; 8] = Default::default();
        for &input in &inputs {
            let carrier = self.carrier(input);
            let jet = self.chain.at(self.by_carrier.at(carrier).position);
            let planet = -jet.elbow[0];
            let one = self.stages[0].at(carrier);
            let other = self.stages[1].at(planet + self.split.planet_offset());
            let lead = (planet - carrier).to_degrees();
            let ratio = -jet.elbow[1] / jet.carrier[1];
            let row = [
                ratio, lead, one[0], other[0], one[1], one[2], other[1], other[2],
            ];
            for (column, value) in columns.iter_mut().zip(row) {
                column.push(value);
            }
        }
        let mut columns = columns.into_iter();
        let heads = [
            ["Ratio", "", ""],
            ["Lead of the planet", "", "°"],
            ["Ratio of each stage", "first", ""],
            ["Ratio of each stage", "second", ""],
            ["Curvature, first stage", "sun", "1/mm"],
            ["Curvature, first stage", "idler", "1/mm"],
            ["Curvature, second stage", "planet", "1/mm"],
            ["Curvature, second stage", "idler", "1/mm"],
        ];
        heads
            .into_iter()
            .map(|head| Curve::new(head, &inputs, columns.next().unwrap_or_default()))
            .collect()
    }
}

fn link(name: &str, path: Path) -> PictureLink {
    PictureLink {
        name: name.into(),
        paths: vec![path],
    }
}

fn closed(role: LineRole, points: &[Point]) -> Path {
    let places = points
        .iter()
        .flat_map(|p| [short(p.x, 0), short(p.y, 0), 0.0]);
    Path {
        role,
        vertices: places.collect(),
        closed: true,
    }
}

fn pose(at: Point, angle: f64) -> [f64; 3] {
    [short(at.x, 0), short(at.y, 0), short(angle, 1)]
}

fn short(value: f64, kind: usize) -> f64 {
    (value * DIGITS[kind]).round() / DIGITS[kind]
}
