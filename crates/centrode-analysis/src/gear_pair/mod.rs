//! Check of a gear pair.

mod after_cut;
mod circular;
mod figures;
mod remedies;
mod remedy;
mod teeth;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use centrode_gear::design::Fit;
use centrode_gear::{GearPair, Limits, Member, ToolKind};
use centrode_geometry::Extreme;

use self::remedy::remedy;
use self::teeth::teeth;
use crate::contact::{Meshing, oscillates_per_tooth};
use crate::progress::filling;
use crate::rounding::exceeds;
use crate::{Contact, ContactExtremes, Finding, Report, Severity, Unit};

pub(crate) use figures::FIGURES;
pub use remedies::{MAX_TEETH, PairRemedy, remedies};
pub(crate) use remedies::{flanks_transmit, minimum_count};

/// Penetration, in modules, above which two outlines are reported to interfere. It must be above the accuracy of the
/// outlines.
const PENETRATION: f64 = 1e-6;
/// Transmission error, rad, above which contact is reported as lost. Ten times less reports rounding, ten times more
/// hides contact on edges.
const LOST: f64 = 1e-6;
/// Transmission error, rad, below which lost contact is smaller than the accuracy of manufacture: a micrometre at 50 mm from
/// the axis.
pub const SLIGHT_TRANSMISSION_ERROR: f64 = 2e-5;

/// Checks a gear pair: its pitch curves, every tooth, and the mesh along one whole cycle.
///
/// Lengths are mm, angles rad. The name of a figure states its quantity; `*_min` and `*_max` are extremes over the whole
/// cycle.
#[must_use]
pub fn check(pair: &GearPair) -> Report {
    let mut ready = None;
    let contact = filling([0.0, 0.6], || Contact::analyse_with(pair, &mut ready));
    filling([0.6, 1.0], || {
        let mut report = checked(pair, &contact, ready);
        circular::name_remedy(pair, &mut report);
        report
    })
}

/// Checks a gear pair like [`check`], with a given contact analysis.
#[must_use]
pub fn check_contact(pair: &GearPair, contact: &Contact) -> Report {
    let mut report = checked(pair, contact, None);
    circular::name_remedy(pair, &mut report);
    report
}

/// The check of a pair with an analysis of its contact, and with the prepared pair if there is one. Remedies are the usual
/// ones.
fn checked<'a>(pair: &'a GearPair, contact: &'a Contact, ready: Option<Meshing<'a>>) -> Report {
    let mut report = Report {
        groups: FIGURES.to_vec(),
        ..Report::default()
    };
    let limits = pair.limits();
    pitch_curves(pair, &limits, &mut report);
    for gear in [pair.driver(), pair.driven()] {
        teeth(pair, gear, &limits, &mut report);
    }
    let extremes = contact.extremes_with(pair, ready);
    mesh(pair, contact, &extremes, &mut report);
    after_cut::check(pair, &mut report);
    report.worst_first();
    report
}

fn pitch_curves(pair: &GearPair, limits: &Limits, report: &mut Report) {
    let rolling = pair.rolling();
    let values = &mut report.values;
    values.insert("center_distance", pair.center_distance());
    values.insert("module", pair.module());
    values.insert("phase", pair.phase());
    let shifts = [Member::Driver, Member::Driven].map(|member| pair.shift(member));
    if shifts != [0.0; 2] {
        values.insert("driver_shift", shifts[0]);
        values.insert("driven_shift", shifts[1]);
    }
    if pair.tip_shortening() != 0.0 {
        values.insert("tip_shortening", pair.tip_shortening());
    }
    if pair.pressure_angle() != pair.teeth().pressure_angle() {
        values.insert("tool_pressure_angle", pair.teeth().pressure_angle());
    }
    // Values chosen by `teeth.fit` are reported nowhere else.
    for fit in &pair.design().teeth.fit {
        match fit {
            Fit::ThicknessSplit => {
                values.insert("thickness_split", pair.teeth().thickness_split);
            }
            Fit::PressureAngle => {
                values.insert("tool_pressure_angle", pair.teeth().pressure_angle());
            }
            Fit::Addendum | Fit::Phase => {}
        }
    }
    values.insert("closure_error", rolling.closure_error());
    if let Some(housing) = pair.housing() {
        values.insert("driver_chamber_radius", housing.radii[0]);
        values.insert("driven_chamber_radius", housing.radii[1]);
        values.insert("volume_per_turn", 1e-3 * pair.displacement());
    }
    let (minimum, maximum) = rolling.radii(Member::Driver);
    let a = pair.center_distance();
    values.insert("ratio_min", minimum / (a - minimum));
    values.insert("ratio_max", maximum / (a - maximum));
    let names = |member: Member| match member {
        Member::Driver => [
            "driver_tooth_count",
            "driver_pitch_length",
            "driver_radius_min",
            "driver_radius_max",
            "driver_curvature_min",
            "driver_curvature_max",
        ],
        Member::Driven => [
            "driven_tooth_count",
            "driven_pitch_length",
            "driven_radius_min",
            "driven_radius_max",
            "driven_curvature_min",
            "driven_curvature_max",
        ],
    };
    for member in [Member::Driver, Member::Driven] {
        let gear = pair.gear(member);
        let radii = rolling.radii(member);
        let range = limits.ranges[usize::from(member == Member::Driven)];
        let figures = [
            f64::from(gear.tooth_count()),
            gear.pitch_length(),
            radii.0,
            radii.1,
            range.minimum.1,
            range.maximum.1,
        ];
        report.values.extend(names(member).into_iter().zip(figures));
        let concave = -range.minimum.1;
        if let ToolKind::Shaper { radius } = pair.teeth().tool(member).kind
            && concave > 0.0
            && radius * concave >= 1.0
        {
            let message = format!(
                "the pitch radius of the shaper cutter is {radius:.4} mm, but the minimum radius of the {}'s concave arc is {:.4} mm",
                member.name(),
                1.0 / concave
            );
            Finding::new("shaper-radius", Severity::Error, message)
                .measured(radius, 1.0 / concave, Unit::Millimetre)
                .remedy(remedy("shaper-radius"))
                .on(member.name())
                .add_to(report);
        }
    }
    report.findings.extend(pitch_overlap(pair));
    report.findings.extend(sampled_corners(pair));
    let Extreme {
        input,
        value: steepest,
    } = pair.maximum_pressure_angle();
    report.values.insert("pressure_angle_max", steepest);
    if exceeds(steepest, PRESSURE_ANGLE) {
        let message = format!(
            "the pressure angle reaches {:.1} deg",
            steepest.to_degrees()
        );
        Finding::new(
            "pressure-angle",
            Severity::of_pressure_angle(steepest),
            message,
        )
        .measured(steepest, PRESSURE_ANGLE, Unit::Angle)
        .remedy(remedy("pressure-angle"))
        .at(input)
        .add_to(report);
    }
    report
        .values
        .insert("largest_module", limits.largest_module);
    report
        .values
        .insert("largest_addendum", limits.largest_addendum);
}

/// The corners of the law that the samples of the pitch curve follow, as findings.
fn sampled_corners(pair: &GearPair) -> impl Iterator<Item = Finding> {
    pair.rolling().sampled_corners().iter().map(|corner| {
        let unit = Unit::Angle;
        let message = format!(
            "the samples of the pitch curve have a corner of {} at {}: the curve through them rounds it off",
            unit.with_unit(corner.turn.abs()),
            unit.with_unit(corner.angle)
        );
        Finding::new("pitch-curve-corner", Severity::Warning, message)
            .measured(corner.turn.abs(), 0.0, unit)
            .remedy(remedy("pitch-curve-corner"))
            .on(Member::Driver.name())
            .at(corner.angle)
    })
}

/// The overlap of the pitch curves away from the point at which they roll, as a finding; `None` if they only roll.
#[must_use]
pub fn pitch_overlap(pair: &GearPair) -> Option<Finding> {
    let Extreme { input, value } = pair.rolling().overlap()?;
    let message = format!(
        "the pitch curves overlap by up to {value:.4} mm away from their rolling contact: teeth of any size collide there"
    );
    Some(
        Finding::new("pitch-curves-overlap", Severity::of_overlap(value), message)
            .measured(value, 0.0, Unit::Millimetre)
            .remedy(remedy("pitch-curves-overlap"))
            .at(input),
    )
}

/// Share of the cycle without contact of flanks above which `contact-lost` is always an error. Below it the severity
/// depends on the deviation.
const MAX_LOST_SHARE: f64 = 0.5;

/// Pressure angle, rad, above which it is reported, because friction is commonly considered a danger there.
const PRESSURE_ANGLE: f64 = 50.0 * PI / 180.0;

/// Transmission error due to backlash, rad, at most [`SLIGHT_TRANSMISSION_ERROR`]. Backlash thins the flanks, so that edges
/// meet their mates as without backlash only to the first order.
pub(crate) fn thinned(pair: &GearPair) -> f64 {
    let a = pair.center_distance();
    let second = 2.0 * (pair.backlash() / a).powi(2) * a / pair.module();
    second.min(SLIGHT_TRANSMISSION_ERROR)
}

fn mesh(pair: &GearPair, contact: &Contact, extremes: &ContactExtremes, report: &mut Report) {
    let module = pair.module();
    let error = extremes.transmission_error;
    let reverse = extremes.reverse_transmission_error;
    let penetration = extremes.penetration;
    let clearance = extremes.clearance;
    let fillet = extremes.fillet_clearance;
    let [fewest, most] = extremes.contacts;
    let values = &mut report.values;
    values.insert("transmission_error_max", error.value.max(reverse.value));
    values.insert("penetration_max", penetration.value);
    for (names, [minimum, maximum]) in [
        (["backlash_min", "backlash_max"], extremes.backlash),
        (
            ["normal_backlash_min", "normal_backlash_max"],
            extremes.normal_backlash,
        ),
    ] {
        values.insert(names[0], minimum.value);
        values.insert(names[1], maximum.value);
    }
    values.insert("pairs_in_contact_min", fewest.value);
    values.insert("pairs_in_contact_max", most.value);
    values.insert("contact_ratio_mean", extremes.contact_ratio);
    values.insert("clearance_min", clearance.value);
    values.insert("fillet_clearance_min", fillet.value);
    values.insert("sliding_max", extremes.sliding.value);
    // Extremes between the samples may show a gap that no sample shows.
    let samples = contact.backlash.iter().zip(&contact.input);
    let of_samples = samples.map(|(&value, &input)| Extreme { input, value });
    let loose = of_samples
        .chain([error, reverse, extremes.backlash[1]])
        .find(|figure| !figure.value.is_finite());
    if let Some(Extreme { input, .. }) = loose {
        Finding::new(
            "disengaged",
            Severity::Error,
            "the gears lose contact: no tooth of one gear reaches the other",
        )
        .remedy(remedy("disengaged"))
        .at(input)
        .add_to(report);
    }
    let interferes = contact.interferes(pair);
    let mm = |depth: f64| Unit::Millimetre.with_unit(depth);
    let overlap = |rule, depth: Extreme, message: String| {
        Finding::new(rule, Severity::of_overlap(depth.value), message)
            .measured(depth.value, 0.0, Unit::Millimetre)
            .remedy(remedy(rule))
            .at(depth.input)
    };
    if penetration.value > PENETRATION * module {
        let words = if interferes { "the gears jam: " } else { "" };
        let message = format!(
            "{words}the flanks on both sides of the teeth overlap by {}",
            mm(penetration.value)
        );
        report
            .findings
            .push(overlap("interference", penetration, message));
    }
    // The driven gear is in the middle of its backlash, so that no rotation of it makes room.
    let (gap, part) = if clearance.value < fillet.value {
        (clearance, "root")
    } else {
        (fillet, "fillet")
    };
    let deepest = Extreme {
        value: -gap.value,
        ..gap
    };
    if deepest.value > PENETRATION * module {
        let message = format!(
            "a tooth tip overlaps the {part} of the mating gear by {}",
            mm(deepest.value)
        );
        report
            .findings
            .push(overlap("tip-interference", deepest, message));
    }
    let worst = if error.value >= reverse.value {
        error
    } else {
        reverse
    };
    let share = extremes.lost;
    // If flanks transmit the motion everywhere, edges deviate by no more than the effect of thinned teeth.
    let allowed = if share == 0.0 {
        LOST.max(thinned(pair))
    } else {
        LOST
    };
    // Gears that interfere transmit no motion at all.
    if worst.value.is_finite() && worst.value > allowed && !interferes {
        let message = format!(
            "for {} % of the cycle contact is on a tooth edge, not on the flanks; the driven gear is {} {} off",
            match 100.0 * share {
                percent if percent < 0.1 => "less than 0.1".to_owned(),
                percent => format!("{percent:.1}"),
            },
            // For some gears figures are not searched between the samples.
            if contact.is_followed(pair) {
                "up to"
            } else {
                "at least"
            },
            Unit::Angle.with_unit(worst.value),
        );
        Finding::new(
            "contact-lost",
            if share > MAX_LOST_SHARE {
                Severity::Error
            } else {
                Severity::of_deviation(worst.value * pair.rolling().radii(Member::Driven).1)
            },
            message,
        )
        .measured(worst.value, allowed, Unit::Angle)
        .remedy(remedy("contact-lost"))
        .at(worst.input)
        .add_to(report);
    }
    report
        .findings
        .extend(tight_backlash(pair, pair.backlash()));
    report.findings.extend(seat_jump(pair, contact));
    report.findings.extend(oscillations(pair, contact));
}

/// Finding about teeth with a normal backlash, mm: they overlap at their maximum thickness, or they have no backlash although
/// both gears have a bore and so are to be made.
pub(crate) fn tight_backlash(pair: &GearPair, backlash: f64) -> Option<Finding> {
    let [minimum, _] = pair.backlash_limits(backlash);
    let (unit, rounding) = (Unit::Millimetre, PENETRATION * pair.module());
    if minimum.abs() <= rounding
        && [pair.driver(), pair.driven()]
            .iter()
            .all(|g| g.bore().is_some())
    {
        let message =
            "the teeth have no backlash: any error of thickness or centre distance jams them";
        return Some(
            Finding::new("zero-backlash", Severity::Note, message)
                .measured(minimum, 0.0, unit)
                .remedy(remedy("zero-backlash")),
        );
    }
    if minimum >= 0.0 {
        return None;
    }
    let message = format!(
        "teeth of maximum thickness overlap the mating teeth by {} along the normal: the backlash must be at least {}",
        unit.with_unit(-minimum),
        unit.with_unit(backlash - minimum),
    );
    Some(
        Finding::new("negative-backlash", Severity::of_overlap(-minimum), message)
            .measured(minimum, 0.0, unit)
            .remedy(remedy("negative-backlash")),
    )
}

/// Finding about pitch curves that oscillate so often that the figures of the mesh are those of the samples.
fn oscillations(pair: &GearPair, contact: &Contact) -> Option<Finding> {
    let (swings, teeth) = (pair.rolling().swings(), pair.driver().tooth_count());
    if !oscillates_per_tooth(pair) {
        return None;
    }
    let message = format!(
        "the pitch curves have {swings} waves for {teeth} teeth: the minimum and maximum of the mesh figures are those at {} samples, and values between the samples may exceed them",
        contact.input.len()
    );
    Some(
        Finding::new("pitch-curve-swings", Severity::Note, message)
            .measured(swings as f64, f64::from(2 * teeth), Unit::Count)
            .remedy(remedy("pitch-curve-swings")),
    )
}

/// The maximum jump of a seat, as a finding.
fn seat_jump(pair: &GearPair, contact: &Contact) -> Option<Finding> {
    let jumps = contact.seat_jumps(pair);
    let maximum = jumps.first()?;
    let (driver, driven) = maximum.teeth;
    let pushed = if maximum.is_reverse {
        "back"
    } else {
        "forward"
    };
    let others = match jumps.len() - 1 {
        0 => String::new(),
        others => format!("; also at {others} more inputs"),
    };
    let message = format!(
        "driver tooth {driver} hits driven tooth {driven} within the backlash: the driven gear pushed {pushed} can jump by {} or jam{others}",
        Unit::Angle.with_unit(maximum.turn)
    );
    Some(
        Finding::new(
            "seat-jump",
            Severity::of_deviation(maximum.turn * pair.rolling().radii(Member::Driven).1),
            message,
        )
        .measured(maximum.turn, 0.0, Unit::Angle)
        .remedy(remedy("seat-jump"))
        .at(maximum.input),
    )
}
