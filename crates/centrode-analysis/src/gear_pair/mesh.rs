use centrode_gear::{GearPair, Member};
use centrode_geometry::Extreme;

use super::remedy::remedy;
use super::{PENETRATION, SLIGHT_TRANSMISSION_ERROR};
use crate::contact::oscillates_per_tooth;
use crate::{Contact, ContactExtremes, Finding, Report, Severity, Unit};

/// Transmission error, rad, above which contact is reported as lost. Ten times less reports rounding, ten times more
/// hides contact on edges.
const LOST: f64 = 1e-6;
/// Share of the cycle without contact of flanks above which `contact-lost` is always an error. Below it the severity
/// depends on the deviation.
const MAX_LOST_SHARE: f64 = 0.5;

/// Transmission error due to backlash, rad, at most [`SLIGHT_TRANSMISSION_ERROR`]. Backlash thins the flanks, so that edges
/// meet their mates as without backlash only to the first order.
pub(crate) fn thinned(pair: &GearPair) -> f64 {
    let a = pair.center_distance();
    let second = 2.0 * (pair.backlash() / a).powi(2) * a / pair.module();
    second.min(SLIGHT_TRANSMISSION_ERROR)
}

/// Figures and findings of the mesh along one cycle.
pub(super) fn mesh(
    pair: &GearPair,
    contact: &Contact,
    extremes: &ContactExtremes,
    report: &mut Report,
) {
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
    report.findings.extend(seat_jump(pair, contact));
    report.findings.extend(oscillations(pair, contact));
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
