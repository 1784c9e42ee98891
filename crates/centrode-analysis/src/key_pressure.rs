use centrode_geometry::Extreme;
use centrode_kinematics::machine::{Key, Keyway, allowed_pressure};

use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

/// A key that transmits a torque from a shaft to a hub.
pub(crate) struct LoadedKey<'a> {
    pub(crate) key: Key,
    /// Keyway of the hub.
    pub(crate) hub: Keyway,
    /// Face width of the hub, mm.
    pub(crate) face: f64,
    /// Diameter of the shaft, mm.
    pub(crate) diameter: f64,
    /// Materials of shaft and hub; a material that the design does not give is omitted.
    pub(crate) materials: &'a [&'a str],
    /// Maximum torque, N mm, and the input at which it occurs.
    pub(crate) torque: Extreme,
    /// Part with the hub.
    pub(crate) part: &'a str,
}

impl LoadedKey<'_> {
    /// Maximum pressure on the key's sides, N/mm²; DIN 6892, method C.
    pub(crate) fn pressure(&self) -> f64 {
        let long = self.key.bearing_length().min(self.face);
        self.hub.pressure(self.torque.value, self.diameter, long)
    }

    /// Reports a pressure above the limit of the weakest material. Nothing is checked if the limit of a material is unknown.
    pub(crate) fn check(&self, report: &mut Report) {
        let allowed = self
            .materials
            .iter()
            .map(|material| allowed_pressure(material));
        let Some(allowed) = allowed.collect::<Option<Vec<f64>>>() else {
            return;
        };
        let allowed = allowed.into_iter().fold(f64::INFINITY, f64::min);
        let pressure = self.pressure();
        if !exceeds(pressure, allowed) {
            return;
        }
        let (name, part) = (self.key.name(), self.part);
        let Extreme { input, value } = self.torque;
        let message = format!(
            "the pressure on {name} in the {part} is {pressure:.1} N/mm² at {value:.0} N·mm: hub and shaft allow {allowed:.1} N/mm²"
        );
        Finding::new("key-pressure", Severity::Error, message)
            .measured(pressure, allowed, Unit::NewtonPerSquareMillimetre)
            .remedy("a thicker hub, or a wider bore with its key")
            .on(part)
            .at(input)
            .add_to(report);
    }
}
