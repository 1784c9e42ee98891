use centrode_gear::design as spec;

use crate::table::table;

table! {
    /// The body of a gear: face width, bore, keyway and material.
    ///
    /// Args:
    ///     width: Face width, mm.
    ///     bore: Diameter of the bore, mm; 0: no bore.
    ///     keyway: Keyway in the bore.
    ///     density: Density, kg/m^3.
    ///     material: Material, for the drawing.
    ///     bore_fit: Tolerance class of the bore, ISO 286, for the drawing.
    ///     shaft_fit: Tolerance class of the shaft in the bore, ISO 286, for the drawing.
    ///     keyway_fit: Tolerance class of the keyway's width, ISO 286, for the drawing.
    ///     heat_treatment: Heat treatment, for the drawing.
    ///     shaft_heat_treatment: Heat treatment of the shaft in the bore, for the drawing.
    ///     accuracy: Accuracy class of the teeth, for the drawing.
    ///     keyway_angle: Direction of the keyway from the body's x axis, rad.
    ///
    /// >>> import centrode as ct
    /// >>> ct.Body(bore=12, keyway=ct.Keyway(width=4, depth=1.8)).keyway.depth
    /// 1.8
    "centrode" Body(spec::BodySpec) from spec::BodySpec::default(), keys "", rules spec::BodySpec::validate;
    needed {}
    usual {
        /// Face width, mm.
        width: f64,
        /// Diameter of the bore, mm; 0 for none.
        bore: f64,
        /// Keyway in the bore.
        keyway: Option<centrode_kinematics::machine::Keyway>,
        /// Density, kg/m^3.
        density: f64,
        /// Material, for the drawing.
        material: String,
        /// Tolerance class of the bore, for the drawing.
        bore_fit: String,
        /// Tolerance class of the shaft in the bore, for the drawing.
        shaft_fit: String,
        /// Tolerance class of the keyway's width, for the drawing.
        keyway_fit: String,
        /// Heat treatment, for the drawing.
        heat_treatment: String,
        /// Heat treatment of the shaft in the bore, for the drawing.
        shaft_heat_treatment: String,
        /// Accuracy class of the teeth, for the drawing.
        accuracy: String,
        /// Direction of the keyway from the body's x axis, rad.
        keyway_angle: f64,
    }
}

table! {
    /// A keyway in the bore, along the body's x axis. Its depth is measured from the circle of the bore.
    ///
    /// >>> import centrode as ct
    /// >>> ct.Keyway(width=4, depth=1.8)
    /// Keyway(width=4.0, depth=1.8)
    "centrode" Keyway(centrode_kinematics::machine::Keyway) from centrode_kinematics::machine::Keyway { width: 0.0, depth: 0.0 }, keys "keyway.", rules |_| Ok(());
    needed {
        /// Width, mm.
        width: f64,
        /// Depth below the bore's circle, mm.
        depth: f64,
    }
    usual {}
}
