//! Check of a feeder.

mod attainable;
mod figures;
mod forces;
mod gears;
mod goals;
mod plates;
mod swing_spread;
#[cfg(test)]
mod tests;

use std::f64::consts::{PI, TAU};

use centrode_kinematics::transmission::Transmission;
use centrode_machines::feeder::Feeder;

pub use attainable::Attainable;
pub use forces::{FeederForces, FeederForcesError};
pub use goals::{feeder_goals, six_bar_goals};
pub use swing_spread::{SixBarTolerances, SwingSpread};

use crate::no_screws::no_screws;
use crate::progress::filling;
use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Table, Unit};
pub use figures::FIGURES;

/// Number of random six-bars, Monte Carlo samples within the tolerances. With ten times fewer the reported spread is
/// three times less certain; more take longer.
const MADE: u32 = 2000;
/// Distance of the pivot from the chord, as a share of the frame, up to which the design counts as degenerate: the
/// swing is pi for any lengths. A larger one reports usable designs, a smaller one misses the case.
const ON_CHORD: f64 = 1e-3;

/// Checks a feeder: swing, transmission angle, strokes and speeds, dwell and feed rate, each goal with its margin.
///
/// Lengths are mm, angles rad, times s; speeds of the tip are mm/s, angular accelerations rad/s², torques N mm, forces N.
#[must_use]
pub fn check_feeder(feeder: &Feeder) -> Report {
    let mut report = filling([0.0, 0.2], || check_strokes(feeder));
    filling([0.2, 0.9], || gears::gears(feeder, &mut report));
    screws(feeder, &mut report);
    report.worst_first();
    report
}

/// Checks a feeder without the contact analysis of its intermittent gears, about ten times faster than [`check_feeder`].
#[must_use]
pub fn check_strokes(feeder: &Feeder) -> Report {
    let mut report = Report {
        goals: feeder_goals(feeder),
        groups: FIGURES.to_vec(),
        ..Report::default()
    };
    linkage(feeder, &mut report);
    motion(feeder, &mut report);
    spread(feeder, &mut report);
    forces::forces(feeder, &mut report);
    goals::unmet(feeder, &mut report);
    vacuous(feeder, &mut report);
    plates::plates(feeder, &mut report);
    report.worst_first();
    report
}

/// Reports a frame for whose plates no screws are found.
fn screws(feeder: &Feeder, report: &mut Report) {
    let found = feeder.frame_screws();
    report.findings.extend(no_screws(
        "frame",
        "the plates of the frame",
        found,
        "thicker plates (plates.thickness), or a smaller plates.screw",
    ));
}

/// Checks the figures that the lengths alone determine.
fn linkage(feeder: &Feeder, report: &mut Report) {
    let (six_bar, bar) = (feeder.six_bar(), feeder.six_bar().four_bar());
    let extremes = six_bar.extremes();
    let values = &mut report.values;
    values.insert("swing", six_bar.swing());
    values.insert("effector_angle_min", extremes.low.1);
    values.insert("effector_angle_max", extremes.high.1);
    values.insert("transmission_angle_min", bar.minimum_transmission_angle());
    let near = bar.transmission_angle(0.0);
    let far = bar.transmission_angle(PI);
    values.insert("coupler_rocker_angle_min", near.min(far));
    values.insert("coupler_rocker_angle_max", near.max(far));
    if let (Some(dead), Some(swing)) = (bar.dead_centers(), bar.rocker_swing()) {
        values.insert("dead_center_stretched", dead.stretched);
        values.insert("dead_center_folded", dead.folded);
        values.insert("slider_stretched_x", dead.stretched_at.x);
        values.insert("slider_stretched_y", dead.stretched_at.y);
        values.insert("slider_folded_x", dead.folded_at.x);
        values.insert("slider_folded_y", dead.folded_at.y);
        values.insert("rocker_swing", swing);
    }
    values.insert("slider_distance_min", six_bar.minimum_slider_distance());
    let slow = six_bar.extremes().longer_stroke();
    values.insert("feed_crank_angle", slow);
    values.insert("crank_quick_return", slow / (TAU - slow));
    if let Some(distance) = feeder.distance_from_chord() {
        values.insert("pivot_from_chord", distance);
    }
    let sensitivity = six_bar.swing_sensitivity();
    let [crank, coupler, rocker, frame] = sensitivity.lengths;
    let rows = [
        ("crank", crank),
        ("coupler", coupler),
        ("rocker", rocker),
        ("frame", frame),
        ("pivot, x", sensitivity.pivot.x),
        ("pivot, y", sensitivity.pivot.y),
    ];
    report.tables.push(Table {
        name: "sensitivities",
        title: "Change of the swing per millimetre of",
        unit: Unit::Angle,
        columns: vec!["swing".into()],
        rows: rows.map(|(name, by)| (name.into(), vec![by])).into(),
    });
}

/// Strokes, times and speeds at the design's speed.
fn motion(feeder: &Feeder, report: &mut Report) {
    let (drive, speed) = (feeder.drive(), feeder.speed());
    let [feed, back] = feeder.strokes();
    let reach = feeder.six_bar().effector_length();
    let values = &mut report.values;
    values.insert("driver_rpm", feeder.cycles_per_minute());
    values.insert("feed_rate", feeder.feed_rate());
    values.insert("arc_ratio", drive.ratio());
    values.insert("motion_angle", drive.motion_angle());
    values.insert("dwell_angle", drive.dwell_angle());
    values.insert("feed_time", (feed.to - feed.from) / speed);
    values.insert("return_time", (back.to - back.from) / speed);
    values.insert("dwell_time", feeder.dwell_time());
    let quick = (feed.to - feed.from) / (back.to - back.from);
    values.insert("quick_return", quick);
    values.insert("tip_speed_feed_max", feed.speed * speed * reach);
    values.insert("tip_speed_return_max", back.speed * speed * reach);
    // The speed left at the ends is rounding: the tip is at rest there.
    let rest =
        [feed.from, feed.to].map(|input| (feeder.effector(input).velocity * speed * reach).abs());
    values.insert("tip_speed_ends_max", rest[0].max(rest[1]));
    values.insert("crank_speed_jump", drive.shock() * speed);
    let maximum = drive.maximum_acceleration();
    if maximum.is_finite() {
        values.insert("crank_acceleration_max", maximum * speed * speed);
    }
    values.insert(
        "crank_rpm_driven",
        drive.ratio() * feeder.cycles_per_minute(),
    );
    let turned = drive.transmission().advance();
    values.insert("crank_turns_a_cycle", turned / TAU);
}

/// Reports the spread of the swing due to manufacturing tolerances.
fn spread(feeder: &Feeder, report: &mut Report) {
    let making = &feeder.design().making;
    let tolerances = SixBarTolerances {
        lengths: making.length_tolerance,
        pivot: making.pivot_tolerance,
    };
    let spread = SwingSpread::sample(feeder.six_bar(), tolerances, MADE, 1);
    let values = &mut report.values;
    values.insert("swing_made_deviation", spread.deviation);
    values.insert("swing_made_min", spread.minimum);
    values.insert("swing_made_max", spread.maximum);
    values.insert("swing_first_order_max", spread.first_order_maximum);
    let goals = &feeder.design().goals;
    let miss = (spread.maximum - goals.swing).max(goals.swing - spread.minimum);
    if exceeds(miss, goals.swing_tolerance) {
        let message = format!(
            "with tolerances of +-{} mm on the lengths and +-{} mm on the pivot the swing misses its goal by up to {:.3} deg",
            making.length_tolerance,
            making.pivot_tolerance,
            miss.to_degrees()
        );
        report.findings.push(
            Finding::new("swing-spread", Severity::Warning, message)
                .measured(miss, goals.swing_tolerance, Unit::Angle)
                .remedy("closer tolerances, or a pivot nearer the middle of the chord"),
        );
    }
}

/// Reports a pivot with which the swing is half a turn for any lengths.
fn vacuous(feeder: &Feeder, report: &mut Report) {
    let frame = feeder.six_bar().four_bar().lengths()[3];
    let Some(distance) = feeder.distance_from_chord() else {
        return;
    };
    if distance > ON_CHORD * frame {
        return;
    }
    let message = format!(
        "the effector's pivot lies {distance:.4} mm from the chord between the slider's dead centres: with the pivot on this chord, lengths of any size give a swing of 180 deg. Keep the pivot fixed in a search"
    );
    report.findings.push(
        Finding::new("pivot-on-chord", Severity::Note, message).measured(
            distance,
            None,
            Unit::Millimetre,
        ),
    );
}
