use std::f64::consts::TAU;

use centrode_geometry::{Extreme, WRITTEN, bracketed_root};
use centrode_kinematics::linkage::{Branch, FourBar};
use centrode_kinematics::machine::JointKind;
use centrode_kinematics::transmission::Transmission;
use centrode_machines::machine::{DyadKind, Machine};

use super::motion::Motion;
use crate::{Report, Table, Unit};

/// Maximum distance of a dead centre from the extreme found by positions alone, as a share of a turn. With a smaller
/// one the change of sign of the speed is outside, with a larger one another dead centre can be inside.
const NEAR: f64 = 1e-5;
/// Reports swings and strokes of joints that move back and forth, and the inputs of their dead centres.
pub(super) fn joints(composed: &Machine, motion: &Motion, report: &mut Report) {
    let (mut swings, mut centres) = (Vec::new(), Vec::new());
    let mut strokes = Vec::new();
    for (body, &[low, high]) in composed.bodies().iter().zip(&motion.joints) {
        let Some(mount) = &body.mount else { continue };
        let comes_back = mount.law.advance() == 0.0;
        if mount.kind == JointKind::Fixed || !comes_back {
            continue;
        }
        if high.value - low.value == 0.0 {
            continue;
        }
        let span = vec![low.value, high.value, high.value - low.value];
        let rows = match mount.kind {
            JointKind::Sliding(_) => &mut strokes,
            _ => &mut swings,
        };
        rows.push((body.name.clone(), span));
        let stroke = high.value - low.value;
        let period = composed.period();
        let dead = |found| dead_centre(mount.law.as_ref(), &found, stroke, period);
        let dead = [low, high].map(dead);
        centres.push((body.name.clone(), dead.to_vec()));
    }
    let swing = Table::new("swings", "Angle of joint that rocks", Unit::Angle);
    let stroke = Table::new("strokes", "Position of slide", Unit::Millimetre);
    let dead = "Input at the dead centres of joint";
    let dead = Table::new("dead-centres", dead, Unit::Angle);
    let span = ["minimum", "maximum", "span"];
    report.table(swing.columns(span).rows(swings));
    report.table(stroke.columns(span).rows(strokes));
    report.table(dead.columns(["minimum", "maximum"]).rows(centres));
}

/// Reports how every table of angles is read: the turn of the body over the table, its largest step and its last step.
pub(super) fn tables(composed: &Machine, report: &mut Report) {
    let bodies = composed.whole().bodies.iter();
    let read = bodies.filter_map(|(name, body)| {
        let reading = body.law.as_ref()?.table_reading()?;
        let turned = TAU * f64::from(reading.turns);
        let row = vec![turned, reading.largest_step, reading.last_step];
        Some((name.clone(), row))
    });
    let rows: Vec<_> = read.collect();
    report.table(
        Table::new("table-readings", "Table of angles of body", Unit::Angle)
            .columns(["turn over the table", "largest step", "last step"])
            .rows(rows),
    );
}

/// Input of an extreme of a motion, at which its speed is zero. Of several equal turns the first one counts.
fn dead_centre(law: &dyn Transmission, found: &Extreme, stroke: f64, period: f64) -> f64 {
    let alike = |input: &f64| {
        let off = law.at(*input).position - found.value;
        *input >= 0.0 && off.abs() <= WRITTEN * stroke
    };
    let turns = (found.input / TAU).floor() as u32;
    let mut earlier = (1..=turns)
        .rev()
        .map(|turn| found.input - TAU * f64::from(turn));
    let input = earlier.find(alike).unwrap_or(found.input);
    let speed = |input: f64| law.at(input).velocity;
    let [from, to] = [-1.0, 1.0].map(|side| input + side * NEAR * TAU);
    let [before, after] = [from, to].map(speed);
    if before * after >= 0.0 {
        // A dwell, or a corner.
        return input;
    }
    let root = bracketed_root(speed, from, to, before, after);
    match root.abs() <= WRITTEN {
        true => 0.0,
        false => root.rem_euclid(period),
    }
}

/// Reports Grashof's margin of every dyad RRR between a body that turns and the body that carries it.
pub(super) fn four_bars(composed: &Machine, report: &mut Report) {
    let mut rows = Vec::new();
    for (dyad, spec) in composed.dyads().iter().filter_map(|dyad| {
        let spec = composed.whole().dyads.get(&dyad.name)?;
        (dyad.kind == DyadKind::TwoBars).then_some((dyad, spec))
    }) {
        let [Some(from), Some(to)] = [&spec.from, &spec.to].map(|word| {
            let word = word.as_deref()?;
            composed.point_named(word)
        }) else {
            continue;
        };
        let mut four = None;
        // Either end may be that of the crank.
        for ([crank, ground], lengths) in [
            ([from, to], [spec.lengths[0], spec.lengths[1]]),
            ([to, from], [spec.lengths[1], spec.lengths[0]]),
        ] {
            let Some(mount) = &composed.bodies()[crank.body].mount else {
                continue;
            };
            if mount.kind == JointKind::Turning && mount.carrier == ground.body {
                let own = crank.at.coords.norm();
                let frame = (ground.at - mount.at).norm();
                let bar = FourBar::new(own, lengths[0], lengths[1], frame, Branch::Upper);
                four = bar.ok().map(|bar| bar.grashof_margin());
            }
        }
        rows.extend(four.map(|margin| (dyad.name.clone(), vec![margin])));
    }
    report.table(
        Table::new(
            "grashof",
            "Grashof's margin of the four-bar of dyad",
            Unit::Millimetre,
        )
        .columns(["margin"])
        .rows(rows),
    );
}
