use std::sync::Arc;

use centrode_geometry::{Recent, Tolerance};
use centrode_kinematics::machine::limits_of_size;
use centrode_machines::feeder::{Feeder, GearsSpec};

use crate::gear_pair::tight_backlash;
use crate::rounding::exceeds;
use crate::{Finding, IntermittentContact, Report, Severity, Unit};

/// Number of inputs at which the contact of the intermittent gears is sampled. Fewer can miss the deepest penetration,
/// more take longer.
const GEAR_SAMPLES: u32 = 240;
/// Tolerance of the polygons that replace the contours of the gears, modules. It must be far below [`PENETRATION`]; a
/// smaller one takes longer.
const CONTOUR: f64 = 1e-4;
/// Penetration above which the gears do not run, modules. Ten times less reports the tolerance of the contours, ten
/// times more hides real interference.
const PENETRATION: f64 = 1e-3;
/// Backlash above which the gears are loose, as a multiple of the requested backlash.
const LOOSE: f64 = 2.0;

/// Cached contact of the gears of recently checked designs.
static PROVEN: Recent<GearsSpec, Arc<IntermittentContact>> = Recent::new();

/// Checks that the intermittent gears can be cut, do not penetrate each other, and hold the crank with at most about twice the
/// requested backlash.
pub(super) fn gears(feeder: &Feeder, report: &mut Report) {
    let about = |rule, severity, message: String| Finding::new(rule, severity, message).on("gears");
    let spec = &feeder.design().gears;
    let cut = feeder.gears();
    let pair = match cut {
        Ok(pair) => pair,
        Err(error) => {
            let finding = about("no-gears", Severity::Error, error.to_string());
            let finding = finding.measured(None, None, Unit::Count);
            report.findings.push(finding);
            return;
        }
    };
    let Ok(tolerance) = Tolerance::new(CONTOUR * spec.module) else {
        return;
    };
    let overlap = tight_backlash(pair.pair(), spec.backlash).map(|finding| finding.on("gears"));
    report.findings.extend(overlap);
    let contact = PROVEN.get(spec, || {
        Arc::new(IntermittentContact::analyse(&pair, GEAR_SAMPLES, tolerance))
    });
    let ([moving, resting], penetration) = (contact.free, contact.deepest);
    let values = &mut report.values;
    values.insert("gear_center_distance", pair.center_distance());
    values.insert("gear_teeth", f64::from(pair.teeth()));
    values.insert("gear_lock_radius", pair.lock_radius());
    values.insert("gear_play_moving_max", moving.value);
    values.insert("gear_play_resting_max", resting.value);
    values.insert("gear_penetration_max", penetration.value);
    let limit = PENETRATION * spec.module;
    if exceeds(penetration.value, limit) {
        let message = format!(
            "the intermittent gears penetrate each other by {:.4} mm",
            penetration.value
        );
        let severity = Severity::of_overlap(penetration.value);
        report.findings.push(
            about("gears-penetrate", severity, message)
                .measured(penetration.value, limit, Unit::Millimetre)
                .at(penetration.input),
        );
    }
    if let Some(nominal) = contact.pin_clearance {
        let (size, [_, class]) = (spec.cam_pin(), Feeder::CAM_PIN_FIT);
        let upper = limits_of_size(size, class).map_or(0.0, |[_, upper]| upper);
        let clearance = nominal.value - 0.5 * upper;
        report.values.insert("gear_pin_clearance_min", clearance);
        if clearance < 0.0 {
            let message = format!(
                "a pin of diameter {size} mm {class} at its upper limit of size overlaps its cam by {:.4} mm",
                -clearance
            );
            let severity = Severity::of_overlap(-clearance);
            report.findings.push(
                about("cam-pin-clearance", severity, message)
                    .measured(clearance, 0.0, Unit::Millimetre)
                    .at(nominal.input)
                    .remedy("more backlash, a larger pin_angle_deg, or smaller pins"),
            );
        }
    }
    let loose = if moving.value >= resting.value {
        moving
    } else {
        resting
    };
    let pitch = 0.5 * spec.module * f64::from(spec.driven_pitches);
    let requested = 0.5 * spec.backlash / pitch;
    // Pins on cams hold the driven gear as closely as teeth do. Without pins the locking arc leaves more backlash.
    let requested = if pair.cams().is_empty() {
        requested.max(pair.locked_backlash())
    } else {
        requested
    };
    let allowed = LOOSE * requested + 1e-4;
    if exceeds(loose.value, allowed) {
        let message = format!(
            "the intermittent gears leave the crank {:.3} deg of backlash",
            loose.value.to_degrees()
        );
        report.findings.push(
            about("gears-loose", Severity::Warning, message)
                .measured(loose.value, allowed, Unit::Angle)
                .at(loose.input)
                .remedy("an entry angle (adds cams), or pins nearer to the line of centres"),
        );
    }
}
