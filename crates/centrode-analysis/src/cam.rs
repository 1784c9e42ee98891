//! Findings of a disc cam.

use centrode_gear::cam::Limits;

use crate::rounding::exceeds;
use crate::{Finding, Place, Report, Severity, Unit};

/// A cam of a machine and the words in which its findings are told.
pub(crate) struct CheckedCam<'a> {
    /// Name of the part.
    pub(crate) part: &'a str,
    /// Pressure angle up to which its follower runs well while it is lifted, rad.
    pub(crate) pressure_angle: f64,
    /// Message where the cam is undercut.
    pub(crate) undercut: String,
    /// Message where it pushes aside: before and behind the angle in degrees.
    pub(crate) pushes: [String; 2],
    /// Remedies of an undercut and of too great a pressure angle.
    pub(crate) remedies: [&'static str; 2],
    /// Input of the machine by the angle of the cam, rad.
    pub(crate) input: &'a dyn Fn(f64) -> Option<f64>,
}

impl CheckedCam<'_> {
    /// Reports undercut and pressure angle. The return is left to a spring, which no pressure angle hinders.
    pub(crate) fn report(self, limits: &Limits, report: &mut Report) {
        let place = |cam_angle: f64| Place {
            part: Some(self.part.into()),
            input: (self.input)(cam_angle),
            ..Place::default()
        };
        let pressure = limits.rise_pressure_angle;
        if limits.regularity.value <= 0.0 {
            report.findings.push(Finding {
                rule: "cam-undercut",
                severity: Severity::Error,
                message: self.undercut,
                measured: Some(limits.minimum_radius.value),
                required: Some(0.0),
                unit: Unit::Millimetre,
                remedy: Some(self.remedies[0]),
                place: place(limits.regularity.input),
            });
        }
        if exceeds(pressure.value, self.pressure_angle) {
            let [before, behind] = self.pushes;
            let degrees = pressure.value.to_degrees();
            report.findings.push(Finding {
                rule: "cam-pressure-angle",
                severity: Severity::of_pressure_angle(pressure.value),
                message: format!("{before} {degrees:.1} deg {behind}"),
                measured: Some(pressure.value),
                required: Some(self.pressure_angle),
                unit: Unit::Angle,
                remedy: Some(self.remedies[1]),
                place: place(pressure.input),
            });
        }
    }
}
