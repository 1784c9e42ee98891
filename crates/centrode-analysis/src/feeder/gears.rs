use std::sync::Arc;

use centrode_geometry::{Recent, Tolerance};
use centrode_mechanism::feeder::{Feeder, GearsSpec};

use crate::{Finding, IntermittentContact, Place, Report, Severity, Unit};

/// Number of inputs at which the intermittent gears are held against each other.
const GEAR_LOOKS: u32 = 240;
/// Distance of their contours from the polygons, in modules.
const CONTOUR: f64 = 1e-4;
/// Penetration above which they do not run, in modules.
const PENETRATION: f64 = 1e-3;
/// Backlash above which they are loose, as a multiple of the one asked for.
const LOOSE: f64 = 2.0;

/// Contact of the gears of the designs checked last.
static PROVEN: Recent<GearsSpec, Arc<IntermittentContact>> = Recent::new();

/// Checks that the intermittent gears can be cut, and hold the crank all the way: nothing penetrates, and the crank is
/// free by no more than the backlash asked for.
pub(super) fn gears(feeder: &Feeder, report: &mut Report) {
    let about_gears =
        |rule, severity, message, [measured, required]: [Option<f64>; 2], unit| Finding {
            rule,
            severity,
            message,
            measured,
            required,
            unit,
            remedy: None,
            place: Place {
                part: Some("gears".into()),
                ..Place::default()
            },
        };
    let spec = &feeder.design().gears;
    let cut = feeder.gears();
    let pair = match cut {
        Ok(pair) => pair,
        Err(error) => {
            let message = error.to_string();
            let none = [None, None];
            let finding = about_gears("no-gears", Severity::Error, message, none, Unit::Count);
            report.findings.push(finding);
            return;
        }
    };
    let Ok(tolerance) = Tolerance::new(CONTOUR * spec.module) else {
        return;
    };
    let contact = PROVEN.get(spec, || {
        Arc::new(IntermittentContact::analyse(&pair, GEAR_LOOKS, tolerance))
    });
    let most = |moving| {
        let [ahead, back] = [&contact.ahead, &contact.back];
        contact
            .greatest(ahead, moving)
            .max(contact.greatest(back, moving))
    };
    let (moving, resting, penetration) = (most(true), most(false), contact.deepest());
    let values = &mut report.values;
    values.insert("gear_center_distance", pair.center_distance());
    values.insert("gear_teeth", f64::from(pair.teeth()));
    values.insert("gear_lock_radius", pair.lock_radius());
    values.insert("gear_play_moving_max", moving);
    values.insert("gear_play_resting_max", resting);
    values.insert("gear_penetration_max", penetration);
    let limit = PENETRATION * spec.module;
    if penetration > limit {
        let message = format!("the intermittent gears penetrate each other by {penetration:.4} mm");
        let figures = [Some(penetration), Some(limit)];
        report.findings.push(about_gears(
            "gears-penetrate",
            Severity::Error,
            message,
            figures,
            Unit::Millimetre,
        ));
    }
    let loose = moving.max(resting);
    let pitch = 0.5 * spec.module * f64::from(spec.driven_pitches);
    let asked = 0.5 * spec.backlash / pitch;
    // Pins on cams hold it as closely as teeth do.
    let asked = if pair.cams().is_empty() {
        asked.max(pair.locked_backlash())
    } else {
        asked
    };
    let allowed = LOOSE * asked + 1e-4;
    if loose > allowed {
        let message = format!(
            "the intermittent gears leave the crank free by {:.3} deg",
            loose.to_degrees()
        );
        let figures = [Some(loose), Some(allowed)];
        let mut finding = about_gears(
            "gears-loose",
            Severity::Warning,
            message,
            figures,
            Unit::Angle,
        );
        finding.remedy =
            Some("an entry angle, for which cams are made, or pins nearer the line of centres");
        report.findings.push(finding);
    }
}
