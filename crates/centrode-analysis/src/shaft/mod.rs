mod crossings;
mod figures;
mod moving_box;
mod tables;

use std::f64::consts::{FRAC_PI_6, TAU};

use centrode_geometry::{COMPUTED, Extreme};
use centrode_groove::{Pick, Schedule, SpiralShaft};
use centrode_kinematics::machine::{Key, Keyway};

use self::crossings::crossings;
use crate::key_pressure::LoadedKey;
use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};
pub use figures::FIGURES;

pub use moving_box::check_moving_box;

/// Maximum pressure angle, rad, of a follower in a straight guide: 30 deg.
const PRESSURE_ANGLE: f64 = FRAC_PI_6;
/// Misplacement, mm, up to which a hole counts as met: rounding.
const MET: f64 = 1e-6;

/// Checks a spiral shaft: its motion while picking, its crossings, slider and forces.
///
/// Lengths are mm, angles rad, forces N, torques N mm; speeds and accelerations of the slider are per radian of shaft turn
/// unless the name ends in a unit. Figures whose names end in `_min` and `_max` are extremes over the whole cycle, those of
/// the speed over the strokes.
#[must_use]
pub fn check_shaft(shaft: &SpiralShaft) -> Report {
    let mut report = Report {
        groups: FIGURES.to_vec(),
        ..Report::default()
    };
    let picks = shaft.schedule();
    moved(shaft, shaft.moved_in_window(), &picks, &mut report);
    motion(shaft, &mut report);
    schedule(shaft, &picks, &mut report);
    groove(shaft, &mut report);
    crossings(shaft, &mut report);
    slider(shaft, &mut report);
    forces(shaft, &mut report);
    report.tables = tables::published(shaft);
    report.worst_first();
    report
}

/// Checks the movement of the box while a seedling is picked, in full stroke and at the pick with the maximum movement. The
/// limit is a sixth of the pot.
fn moved(shaft: &SpiralShaft, moved: f64, picks: &Schedule, report: &mut Report) {
    let design = shaft.design();
    let widest = picks.widest().filter(|pick| pick.swept > moved + MET);
    let (most, theta) = widest.map_or((moved, design.pick), |pick| (pick.swept, pick.theta));
    let limit = design.pot_width / 6.0;
    let plain = shaft.law().mean_speed() * design.window;
    report.values.insert("moved_distance", moved);
    report.values.insert("moved_distance_plain", plain);
    report.values.insert("moved_distance_limit", limit);
    report.values.insert("moved_distance_of_cycle_max", most);
    if exceeds(most, limit) {
        let message = format!(
            "the box moves {most:.4} mm while a seedling is picked, more than a sixth of the pot, {limit:.4} mm"
        );
        let remedy = "a larger amplitude, moved_distance to solve for it, or picks at the slow points of the law";
        Finding::new("moved-distance", Severity::Error, message)
            .measured(most, limit, Unit::Millimetre)
            .remedy(remedy)
            .on("shaft")
            .at(theta)
            .add_to(report);
    }
}

fn motion(shaft: &SpiralShaft, report: &mut Report) {
    let (law, traverse) = (shaft.law(), shaft.traverse());
    let mean = law.mean_speed();
    let values = &mut report.values;
    values.insert("lead", law.lead());
    if let Some(amplitude) = shaft.amplitude() {
        values.insert("amplitude", amplitude);
    }
    values.insert("speed_ratio_min", law.slowest().value / mean);
    values.insert("speed_ratio_max", law.fastest().value / mean);
    values.insert("speed_min", law.slowest().value);
    values.insert("speed_max", law.fastest().value);
    values.insert("cycle_turns", f64::from(traverse.turns()));
    let [far, near] = traverse.overshoot();
    values.insert("overshoot_far", far);
    values.insert("overshoot_near", near);
    let range = shaft.groove().force_range(shaft.load());
    let omega = shaft.load().speed();
    values.insert("deceleration_max", range.deceleration.value);
    let metres = 1e-3 * omega * omega;
    let braking = range.deceleration_of_cycle.value * metres;
    values.insert("deceleration_max_m_s2", braking);
}

fn schedule(shaft: &SpiralShaft, schedule: &Schedule, report: &mut Report) {
    let limit = shaft.design().pot_width / 6.0;
    let worst = schedule.worst().map_or(0.0, |p| p.misplacement.abs());
    report.values.insert("misplacement_max", worst);
    if let Some(Pick {
        turn,
        hole,
        misplacement,
        theta,
        ..
    }) = schedule.worst()
        && misplacement.abs() > MET
    {
        let severity = if exceeds(misplacement.abs(), limit) {
            Severity::Error
        } else {
            Severity::of_deviation(misplacement.abs())
        };
        Finding::new(
            "misplaced-hole",
            severity,
            format!(
                "turn {turn} of the cycle picks {:.4} mm away from hole {hole}",
                misplacement.abs()
            ),
        )
        .measured(misplacement.abs(), limit, Unit::Millimetre)
        .remedy("a reversal of 360 deg, and no more return_offset than needed")
        .on("shaft")
        .at(*theta)
        .add_to(report);
    }
    let uneven: Vec<u32> = (0..)
        .zip(&schedule.visits)
        .filter(|(_, visits)| **visits != 2)
        .map(|(hole, _)| hole)
        .collect();
    if let Some(first) = uneven.first() {
        let message = format!(
            "{} of {} holes (the first is hole {first}) are not picked exactly once per stroke",
            uneven.len(),
            schedule.visits.len()
        );
        Finding::new("hole-not-picked-twice", Severity::Error, message)
            .measured(
                f64::from(schedule.visits[*first as usize]),
                2.0,
                Unit::Count,
            )
            .remedy("a reversal of 360 deg")
            .on("shaft")
            .at(shaft.design().pick)
            .add_to(report);
    }
}

fn groove(shaft: &SpiralShaft, report: &mut Report) {
    let groove = shaft.groove();
    let steepest = groove.steepest();
    let values = &mut report.values;
    let lead = |speed: f64| (speed / groove.radius()).atan();
    values.insert("lead_angle_min", lead(shaft.law().slowest().value));
    values.insert("lead_angle_max", lead(shaft.law().fastest().value));
    values.insert("pressure_angle_max", steepest.value);
    values.insert("bend_radius_min", 1.0 / groove.tightest().value);
    values.insert("wall_deviation_max", groove.wall_deviation());
    if exceeds(steepest.value, PRESSURE_ANGLE) {
        Finding::new(
            "pressure-angle",
            Severity::Warning,
            format!(
                "the pressure angle of the groove reaches {:.2} deg",
                steepest.value.to_degrees()
            ),
        )
        .measured(steepest.value, PRESSURE_ANGLE, Unit::Angle)
        .remedy("a larger radius, or a smaller lead or amplitude")
        .on("shaft")
        .at(steepest.input)
        .add_to(report);
    }
}

/// Distance of an angle from the nearest whole turn, rad.
fn from_turn(angle: f64) -> f64 {
    let within = angle.rem_euclid(TAU);
    within.min(TAU - within)
}

fn slider(shaft: &SpiralShaft, report: &mut Report) {
    let slider = shaft.slider();
    let needed = slider.needed_clearance(shaft.groove());
    report.values.insert("slider_clearance_min", needed);
    if exceeds(needed, slider.clearance) {
        let message = format!(
            "a straight slider {} mm long needs {needed:.4} mm of clearance at the tightest bend of the groove, but has {} mm",
            slider.length, slider.clearance
        );
        Finding::new(
            "slider-clearance",
            Severity::of_overlap(needed - slider.clearance),
            message,
        )
        .measured(slider.clearance, needed, Unit::Millimetre)
        .remedy("more clearance, a shorter slider, or a larger radius")
        .on("shaft")
        .at(shaft.groove().tightest().input)
        .add_to(report);
    }
    let guided = slider.guided_length(shaft.groove().radius());
    report.values.insert("slider_guided_length", guided);
    let gaps = shaft.groove().crossings().into_iter().map(|c| c.gap);
    let longest = gaps.fold(0.0, f64::max);
    if !exceeds(guided, longest) && exceeds(slider.length, longest) {
        let message = format!(
            "only {guided:.2} mm of a flat slider {} mm long is guided by the groove of a shaft of this diameter: to bridge {longest:.2} mm without walls the slider must be bent round the shaft",
            slider.length
        );
        Finding::new("flat-slider", Severity::Warning, message)
            .measured(guided, longest, Unit::Millimetre)
            .remedy("a thicker shaft, or a slider bent round it")
            .on("slider")
            .add_to(report);
    }
}

fn forces(shaft: &SpiralShaft, report: &mut Report) {
    let load = shaft.load();
    let range = shaft.groove().force_range(load);
    let values = &mut report.values;
    values.insert("speed_rpm", load.speed_rpm);
    values.insert("normal_force_min", range.normal[0].value);
    values.insert("normal_force_max", range.normal[1].value);
    let picking = shaft.force(shaft.design().pick, load);
    values.insert("normal_force_picking", picking.normal);
    values.insert("normal_force_reversal_max", range.normal_of_reversal.value);
    values.insert("torque_min", range.torque[0].value);
    values.insert("torque_max", range.torque[1].value);
    values.insert("jamming_angle", load.jamming_angle());
    let [minimum, maximum] = range.torque;
    let torque = match -minimum.value > maximum.value {
        true => Extreme {
            value: -minimum.value,
            ..minimum
        },
        false => maximum,
    };
    key(shaft, torque, report);
    let values = &mut report.values;
    let limit = contact_limit(shaft, range.deceleration.value);
    values.insert("contact_limit_rpm", limit);
    values.insert(
        "contact_limit_cycle_rpm",
        contact_limit(shaft, range.deceleration_of_cycle.value),
    );
    contact(limit, load.speed_rpm, report);
    let steepest = shaft.groove().steepest();
    if !exceeds(load.jamming_angle(), steepest.value) {
        Finding::new(
            "jamming",
            Severity::Error,
            format!(
                "the slider jams at a lead angle of {:.2} deg: friction requires less than {:.2} deg",
                steepest.value.to_degrees(),
                load.jamming_angle().to_degrees()
            ),
        )
        .measured(steepest.value, load.jamming_angle(), Unit::Angle)
        .remedy("a larger radius, or less friction in the groove")
        .on("shaft")
        .at(steepest.input)
        .add_to(report);
    }
}

/// Reports the pressure on the key of the near journal at a torque, and whether the key is overloaded.
fn key(shaft: &SpiralShaft, torque: Extreme, report: &mut Report) {
    let body = shaft.body();
    let hub = body.keyway.map(Keyway::of_hub);
    // If the keyway is shorter than any standard key, a key is cut to length: its end is square, that of the keyway half
    // round.
    let long = body.keyway_length;
    let cut = |hub: Keyway| Key::square(hub, long - 0.5 * hub.width);
    let key = hub.and_then(|hub| Some((hub, Key::round(hub, long).or_else(|| cut(hub))?)));
    let Some((hub, key)) = key else {
        return;
    };
    let loaded = LoadedKey {
        key,
        hub,
        face: body.keyway_length,
        diameter: body.journal_diameter,
        materials: &[&body.material],
        torque,
        part: "shaft",
    };
    let values = &mut report.values;
    values.insert("key_pressure_max", loaded.pressure());
    loaded.check(report);
}

/// Speed up to which the slider stays on one wall for a maximum deceleration (mm/rad^2), r/min. A deceleration within rounding
/// counts as zero.
fn contact_limit(shaft: &SpiralShaft, deceleration: f64) -> f64 {
    let is_even = deceleration <= COMPUTED * shaft.law().mean_speed();
    let deceleration = if is_even { 0.0 } else { deceleration };
    shaft.load().contact_limit_rpm(deceleration)
}

fn contact(limit: f64, speed: f64, report: &mut Report) {
    if exceeds(speed, limit) {
        let message = if limit > 0.0 {
            format!(
                "at {speed} r/min the box runs ahead and the slider changes walls on the stroke; it stays on one wall up to {limit:.2} r/min"
            )
        } else {
            "without friction on the rails the box runs ahead, and the slider changes walls on the stroke at any speed".into()
        };
        Finding::new("contact-lost", Severity::Warning, message)
            .measured(speed, limit, Unit::TurnsPerMinute)
            .remedy(if limit > 0.0 {
                "a lower speed, a smaller amplitude, or fewer waves per turn"
            } else {
                "friction on the rails (rail_friction), or a box with constant speed"
            })
            .on("slider")
            .add_to(report);
    }
}

#[cfg(test)]
mod tests;
