//! Findings of a disc cam.

use centrode_gear::cam::Limits;

use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

/// A cam of a machine and the words in which its findings are reported.
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
        let pressure = limits.rise_pressure_angle;
        if limits.regularity.value <= 0.0 {
            Finding::new("cam-undercut", Severity::Error, self.undercut)
                .measured(limits.minimum_radius.value, 0.0, Unit::Millimetre)
                .remedy(self.remedies[0])
                .on(self.part)
                .at((self.input)(limits.regularity.input))
                .add_to(report);
        }
        if exceeds(pressure.value, self.pressure_angle) {
            let [before, behind] = self.pushes;
            let degrees = pressure.value.to_degrees();
            Finding::new(
                "cam-pressure-angle",
                Severity::of_pressure_angle(pressure.value),
                format!("{before} {degrees:.1} deg {behind}"),
            )
            .measured(pressure.value, self.pressure_angle, Unit::Angle)
            .remedy(self.remedies[1])
            .on(self.part)
            .at((self.input)(pressure.input))
            .add_to(report);
        }
    }
}
