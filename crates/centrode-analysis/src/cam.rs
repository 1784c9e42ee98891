//! Findings of a disc cam.

use centrode_gear::cam::Limits;

use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

/// A cam of a machine and the texts of its findings.
pub(crate) struct CheckedCam<'a> {
    /// Name of the part.
    pub(crate) part: &'a str,
    /// Maximum pressure angle while the cam lifts its follower, rad.
    pub(crate) pressure_angle: f64,
    /// Message if the cam is undercut.
    pub(crate) undercut: String,
    /// Message if the pressure angle is too large: the text before and after the angle in degrees.
    pub(crate) pushes: [String; 2],
    /// Remedies of an undercut and of too large a pressure angle.
    pub(crate) remedies: [&'static str; 2],
    /// Maps the angle of the cam, rad, to the input of the machine, rad.
    pub(crate) input: &'a dyn Fn(f64) -> Option<f64>,
}

impl CheckedCam<'_> {
    /// Reports undercut and the pressure angle of the rise. On the return a spring moves the follower, whatever the pressure
    /// angle.
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
