/// Material of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stock<'a> {
    /// Name.
    pub material: &'a str,
    /// Density, kg/m^3.
    pub density: f64,
    /// Heat treatment; empty for none.
    pub heat_treatment: &'a str,
}

impl<'a> Stock<'a> {
    /// A material of a density (kg/m^3), as it is supplied.
    #[must_use]
    pub const fn new(material: &'a str, density: f64) -> Self {
        Self {
            material,
            density,
            heat_treatment: "",
        }
    }

    /// Material with a heat treatment.
    #[must_use]
    pub const fn treated(self, heat_treatment: &'a str) -> Self {
        Self {
            heat_treatment,
            ..self
        }
    }
}
