use std::f64::consts::{FRAC_PI_4, TAU};

use centrode_geometry::{extremes, piece_ends};
use centrode_groove::{MovingBox, SpiralShaft};
use centrode_kinematics::transmission::{MotionJet, Transmission};

use crate::{Table, Unit};

/// Scheme that moves the box on a stroke: the motion of the box as a function of the input, and the lead angle under the
/// slider.
struct Way<'a> {
    name: &'static str,
    at: Box<dyn Fn(f64) -> (MotionJet, f64) + 'a>,
}

/// Tables that compare a plain shaft, the groove alone, the gears alone and the design: the movement of the box while a
/// seedling is picked, its speeds, its acceleration and the force on the slider.
pub(super) fn schemes(machine: &MovingBox) -> Vec<Table> {
    let shaft = machine.shaft();
    let (radius, mean) = (shaft.groove().radius(), shaft.law().mean_speed());
    let plain = (mean / radius).atan();
    let lead = move |law: MotionJet| (law.velocity / radius).atan();
    let steady = move |turn: MotionJet| MotionJet {
        position: mean * turn.position,
        velocity: mean * turn.velocity,
        acceleration: mean * turn.acceleration,
        jerk: mean * turn.jerk,
    };
    let even = |input: f64| MotionJet::uniform(input, 1.0);
    let ways = [
        Way {
            name: "plain shaft",
            at: Box::new(move |input| (steady(even(input)), plain)),
        },
        Way {
            name: "groove only",
            at: Box::new(move |input| {
                let law = shaft.law().at(input);
                (law, lead(law))
            }),
        },
        Way {
            name: "gears only",
            at: Box::new(move |input| (steady(machine.shaft_turn(input)), plain)),
        },
        Way {
            name: "as designed",
            at: Box::new(move |input| {
                let law = shaft.law().at(machine.shaft_turn(input).position);
                (machine.stroke_at(input), lead(law))
            }),
        },
    ];
    let (load, design) = (shaft.load(), shaft.design());
    let metres = 1e-3 * load.speed() * load.speed();
    let (pick, half) = (design.pick, 0.5 * design.window);
    // Breaks of the groove alone and of the design: an extra break costs little.
    let both = [shaft.law().pieces(pick), machine.stroke_pieces()].concat();
    let ends = piece_ends(pick, pick + TAU, 1, &both);
    let range = |of: &dyn Fn(f64) -> f64| extremes(of, &ends).map(|extreme| extreme.value).to_vec();
    let rows = |of: &dyn Fn(&Way<'_>) -> Vec<f64>| {
        let row = |way: &Way<'_>| (way.name.into(), of(way));
        ways.iter().map(row).collect()
    };
    let acceleration = "Acceleration on a stroke";
    vec![
        Table::new(
            "schemes",
            "Movement of the box while a seedling is picked",
            Unit::Millimetre,
        )
        .columns(["movement", "limit"])
        .rows(rows(&|way| {
            let place = |input: f64| (way.at)(input).0.position;
            vec![
                place(pick + half) - place(pick - half),
                design.pot_width / 6.0,
            ]
        })),
        Table::new("scheme-speeds", "Speed over its mean", Unit::Number)
            .columns(["minimum", "maximum"])
            .rows(rows(&|way| {
                range(&|input| (way.at)(input).0.velocity / mean)
            })),
        Table::new(
            "scheme-accelerations",
            acceleration,
            Unit::MetrePerSecondSquared,
        )
        .columns(["minimum", "maximum"])
        .rows(rows(&|way| {
            range(&|input| metres * (way.at)(input).0.acceleration)
        })),
        Table::new("scheme-forces", "Normal force on the slider", Unit::Newton)
            .columns(["minimum", "maximum"])
            .rows(rows(&|way| {
                range(&|input| {
                    let (motion, lead) = (way.at)(input);
                    load.force(motion, lead, radius).normal
                })
            })),
    ]
}

/// Number of angles per turn at which the paper's equations are evaluated.
const EIGHTHS: u32 = 8;

fn eighths(of: impl Fn(f64) -> Vec<f64>) -> Vec<(String, Vec<f64>)> {
    let row = |i: u32| {
        let theta = FRAC_PI_4 * f64::from(i);
        (format!("at {} deg", 45 * i), of(theta))
    };
    (0..EIGHTHS).map(row).collect()
}

/// Acceleration and forces over one turn of a stroke by equilibrium, compared with equations (14) to (18) of Zhou et al. 2018,
/// which do not hold: see [`Load::published`](centrode_groove::Load::published).
///
/// Equations (16) to (18) are for sines; for another law they are omitted.
pub(super) fn published(shaft: &SpiralShaft) -> Vec<Table> {
    let (load, radius) = (shaft.load(), shaft.groove().radius());
    let printed = |theta: f64| shaft.published_acceleration(theta, load);
    let sine = printed(0.0).is_some();
    // Normal and transverse force: by equilibrium, and by the paper with the true acceleration and with that of (16).
    let forces = |theta: f64| -> Vec<[f64; 2]> {
        let motion = shaft.law().at(theta);
        let lead = (motion.velocity / radius).atan();
        let ours = load.force(motion, lead, radius);
        let true_one = Some(shaft.stroke_acceleration(theta, load));
        let theirs = [true_one, printed(theta)].into_iter().flatten().map(|x| {
            let force = load.published(x, lead);
            [force.normal, force.transverse]
        });
        std::iter::once([ours.normal, ours.transverse])
            .chain(theirs)
            .collect()
    };
    let of = |side: usize| eighths(|theta| forces(theta).iter().map(|force| force[side]).collect());
    let columns = if sine { 3 } else { 2 };
    let (normal, transverse) = (
        "Normal force compared with the paper's",
        "Transverse force compared with the paper's",
    );
    let mut tables = vec![
        Table::new("normal-forces", normal, Unit::Newton)
            .columns(["normal", "by (14)", "by (17)"].into_iter().take(columns))
            .rows(of(0)),
        Table::new("transverse-forces", transverse, Unit::Newton)
            .columns(
                ["transverse", "by (15)", "by (18)"]
                    .into_iter()
                    .take(columns),
            )
            .rows(of(1)),
    ];
    if sine {
        let accelerations = |theta: f64| {
            let ours = shaft.stroke_acceleration(theta, load);
            [Some(ours), printed(theta)].into_iter().flatten().collect()
        };
        let title = "Acceleration compared with the paper's";
        tables.push(
            Table::new("accelerations", title, Unit::MetrePerSecondSquared)
                .columns(["acceleration", "by (16)"])
                .rows(eighths(accelerations)),
        );
    }
    tables
}
