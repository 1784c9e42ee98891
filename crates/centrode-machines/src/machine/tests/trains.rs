//! Random trains, held against Newton's method on the rolling of their pitch curves.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{Point, Vector};
use nalgebra::Rotation2;

use super::made;
use super::random::Random;

/// A pitch curve r = b + c cos(n phi) that rolls on its mate.
struct Pair {
    mean: f64,
    swing: f64,
    lobes: f64,
    distance: f64,
}

impl Pair {
    fn new(random: &mut Random) -> Self {
        let mean = random.within(24.0, 36.0).round();
        let mut pair = Self {
            mean,
            swing: random.within(0.02, 0.12) * mean,
            lobes: 1.0 + random.below(3) as f64,
            distance: 2.0 * mean,
        };
        // The mate, too, closes after a turn: Newton's method with a slope by differences.
        for _ in 0..40 {
            let off = pair.rolled(TAU) - TAU;
            let nudged = Self {
                distance: pair.distance + 1e-4,
                ..pair
            };
            let slope = (nudged.rolled(TAU) - TAU - off) / 1e-4;
            pair.distance -= off / slope;
        }
        pair
    }

    fn ratio(&self, phi: f64) -> f64 {
        let radius = self.mean + self.swing * (self.lobes * phi).cos();
        radius / (self.distance - radius)
    }

    /// Turn of the mate while the pitch point goes from the direction zero to another, by three-point Gauss panels.
    fn rolled(&self, phi: f64) -> f64 {
        let panels = 240;
        let half = 0.5 * phi / f64::from(panels);
        let sum = |i: i32| {
            let middle = half * f64::from(2 * i + 1);
            let far = half * 0.6_f64.sqrt();
            let ends = self.ratio(middle - far) + self.ratio(middle + far);
            (5.0 * ends + 8.0 * self.ratio(middle)) / 9.0
        };
        half * (0..panels).map(sum).sum::<f64>()
    }

    fn turned(&self, phi: f64) -> f64 {
        let turns = (phi / TAU).floor();
        turns * TAU + self.rolled(phi - turns * TAU)
    }

    /// Direction of the pitch point for a turn of the mate.
    fn direction(&self, turned: f64) -> f64 {
        let mut phi = turned;
        for _ in 0..60 {
            phi -= (self.turned(phi) - turned) / self.ratio(phi);
        }
        phi
    }
}

/// A stage of a train: the moved gear is the driven one of its pair or the driver.
struct Stage {
    pair: Pair,
    is_driven: bool,
    direction: f64,
    mounts: [f64; 2],
    body: String,
}

/// Bodies and gears that stand, turn evenly and unevenly: the first gear's body, and the carrier.
const DRIVES: [(&str, &str, &str); 3] = [
    ("frame", "turner", "expression = \"phi + 0.2*sin(phi)\""),
    ("starter", "frame", "ratio = -1"),
    (
        "starter",
        "turner",
        "expression = \"-phi + 0.1*cos(2*phi)\"",
    ),
];

#[test]
fn random_trains_roll_as_newtons_method_finds() {
    for seed in 0..48 {
        let mut random = Random(77 + seed);
        let (first, carrier, law) = DRIVES[random.below(DRIVES.len())];
        let stages: Vec<Stage> = (0..1 + random.below(3))
            .map(|number| Stage {
                pair: Pair::new(&mut random),
                is_driven: random.below(2) == 0,
                direction: random.within(-170.0, 170.0).round(),
                mounts: [(); 2].map(|()| random.within(-180.0, 180.0).round()),
                body: random.name(number),
            })
            .collect();
        let mut text = String::from(
            "family = \"machine\"\n[plates]\nwidth = 12\n[frame.points]\nO = [0, 0]\n",
        );
        for name in ["starter", "turner"] {
            let law = if name == carrier || carrier == "frame" {
                law
            } else {
                "ratio = 1"
            };
            if [first, carrier].contains(&name) {
                text += &format!("[bodies.{name}]\non = \"frame.O\"\nlaw = {{ {law} }}\n");
            }
        }
        let (mut before, last) = (first.to_owned(), stages.len() - 1);
        for (i, stage) in stages.iter().enumerate() {
            let Pair {
                mean, swing, lobes, ..
            } = stage.pair;
            let roles = match stage.is_driven {
                true => ["driver", "driven"],
                false => ["driven", "driver"],
            };
            let points = if i == last {
                "points = { W = [15, 4] }\n"
            } else {
                ""
            };
            let (body, [one, other]) = (&stage.body, stage.mounts);
            let on = if before == "frame" {
                "frame.O"
            } else {
                &before
            };
            text += &format!(
                "[pairs.p{i}]\npitch = {{ kind = \"limacon\", mean_radius = {mean}, amplitude = {swing}, lobes = {lobes}, tooth_count = {mean} }}\n\
                 [gears.one{i}]\npair = \"p{i}\"\nrole = \"{}\"\non = \"{on}\"\nmount_deg = {one}\n\
                 [gears.two{i}]\npair = \"p{i}\"\nrole = \"{}\"\non = \"{body}\"\nmount_deg = {other}\n\
                 [bodies.{body}]\non = \"{carrier}\"\n{points}mesh = {{ gear = \"two{i}\", with = \"one{i}\", direction_deg = {} }}\n",
                roles[0], roles[1], stage.direction
            );
            before.clone_from(body);
        }
        text += &format!(
            "[dyads.push]\ntype = \"RRP\"\nfrom = \"{before}.W\"\nlengths = [700]\nline = \"frame.O\"\nline_deg = 0\nside = \"forward\"\nbodies = [\"rod\", \"ram\"]\njoint = \"B\"\n"
        );
        let train = made(&text);
        let angle = |name: &str, input: f64| {
            let body = train.body_named(name).expect("there");
            train.angle(body, input).position
        };
        for i in 0..8 {
            let input = 0.83 * f64::from(i) - 1.0;
            let carried = angle(carrier, input);
            let mut turned = angle(first, input);
            let mut axis = Vector::zeros();
            for stage in &stages {
                let [one, other] = stage.mounts.map(f64::to_radians);
                let direction = stage.direction.to_radians();
                let pair = &stage.pair;
                axis += Vector::new(direction.cos(), direction.sin()) * pair.distance;
                let with = turned + one;
                turned = if stage.is_driven {
                    let lambda = carried + direction;
                    lambda + pair.turned(lambda - with) - other
                } else {
                    let lambda = carried + direction + PI;
                    lambda - pair.direction(with - lambda) - other
                };
                let off = angle(&stage.body, input) - turned;
                let off = (off - TAU * (off / TAU).round()).abs();
                assert!(
                    off < 1e-10,
                    "{seed} {} at {input}: {off}\n{text}",
                    stage.body
                );
            }
            let tip =
                Rotation2::new(carried) * axis + Rotation2::new(turned) * Vector::new(15.0, 4.0);
            let ram = train.body_named("ram").expect("there");
            let reached = tip.x + (700.0_f64.powi(2) - tip.y * tip.y).sqrt();
            let off = train.place(ram, Point::origin(), input).x - reached;
            assert!(off.abs() < 1e-9, "{seed} ram at {input}: {off}");
            // Derivatives of all that moves, by Richardson's rule on central differences.
            let step = 2e-3;
            for body in 1..train.bodies().len() {
                let at = |k: f64| {
                    let turned = train.angle(body, input + k * step);
                    let place = train.point(body, Point::new(3.0, 2.0), input + k * step);
                    [
                        [turned.position, turned.velocity, turned.acceleration],
                        [place.point.x, place.first.x, place.second.x],
                    ]
                };
                let turned = train.angle(body, input);
                let place = train.point(body, Point::new(3.0, 2.0), input);
                let exact = [
                    [turned.velocity, turned.acceleration, turned.jerk],
                    [place.first.x, place.second.x, place.third.x],
                ];
                let (low, high, lower, higher) = (at(-1.0), at(1.0), at(-2.0), at(2.0));
                for (what, size) in [(0, 1.0), (1, 300.0)] {
                    for order in 0..3 {
                        let near = (high[what][order] - low[what][order]) / (2.0 * step);
                        let wide = (higher[what][order] - lower[what][order]) / (4.0 * step);
                        let off = ((near * 4.0 - wide) / 3.0 - exact[what][order]).abs();
                        let size = size * 8.0_f64.powi(order as i32);
                        assert!(off < 1e-6 * size, "{seed} {body} {what} {order}: {off}");
                    }
                }
            }
        }
    }
}
