use std::f64::consts::PI;

use centrode_gear::design::Fit;
use centrode_gear::{Limits, Member, PlannedPair, ToolKind};
use centrode_geometry::Extreme;

use super::of_samples;
use super::remedy::remedy;
use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

/// Pressure angle, rad, above which it is reported, because friction is commonly considered a danger there.
const PRESSURE_ANGLE: f64 = 50.0 * PI / 180.0;

/// Figures and findings of the pitch curves, the tools and the layout of the teeth.
pub(super) fn pitch_curves(pair: &PlannedPair, limits: &Limits, report: &mut Report) {
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
        let radii = rolling.radii(member);
        let range = limits.ranges[usize::from(member == Member::Driven)];
        let figures = [
            f64::from(pair.tooth_count(member)),
            rolling.pitch_length(member),
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
    report.findings.extend(of_samples::corners(pair));
    report.findings.extend(of_samples::scaled_mean(pair));
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
}

/// The overlap of the pitch curves away from the point at which they roll, as a finding; `None` if they only roll.
#[must_use]
pub fn pitch_overlap(pair: &PlannedPair) -> Option<Finding> {
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
