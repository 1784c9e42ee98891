/// Unit of a figure, which decides the form in which it is shown.
#[derive(Clone, Copy)]
pub(super) enum Unit {
    Count,
    Number,
    Millimetre,
    PerMillimetre,
    /// Degrees shown, rad kept.
    Degree,
    /// Radians kept and shown: errors too small for degrees.
    Radian,
    RadianPerSecond,
    MillimetrePerSecond,
    Newton,
    NewtonMillimetre,
    TurnsPerMinute,
    Second,
    /// Lengths along a pitch curve in pitches of its teeth.
    Pitch,
}

impl Unit {
    /// Symbol; empty for a plain number.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Count | Self::Number => "",
            Self::Millimetre => "mm",
            Self::PerMillimetre => "1/mm",
            Self::Degree => "deg",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::MillimetrePerSecond => "mm/s",
            Self::Newton => "N",
            Self::NewtonMillimetre => "N mm",
            Self::TurnsPerMinute => "r/min",
            Self::Second => "s",
            Self::Pitch => "pitches",
        }
    }

    /// Figure in few enough digits to read; a smaller one keeps its leading digits.
    pub(super) fn show(self, value: f64) -> String {
        match self {
            Self::Count => format!("{value:.0}"),
            Self::Number | Self::PerMillimetre | Self::RadianPerSecond => figure(value, 6),
            Self::MillimetrePerSecond
            | Self::Newton
            | Self::NewtonMillimetre
            | Self::TurnsPerMinute => figure(value, 2),
            Self::Second | Self::Millimetre | Self::Pitch => figure(value, 4),
            Self::Degree => figure(value.to_degrees(), 4),
            Self::Radian => figure(value, 0),
        }
    }
}

/// A number with so many decimals, or in powers of ten where they would hide it; without decimals,
/// always in powers of ten.
pub(super) fn figure(value: f64, decimals: i32) -> String {
    let hidden = 50.0 * 0.1_f64.powi(decimals);
    if value == 0.0 {
        "0".into()
    } else if value.is_infinite() {
        if value > 0.0 { "infinite" } else { "-infinite" }.into()
    } else if value.is_nan() {
        "none".into()
    } else if value.abs() < hidden || value.abs() >= 1e9 {
        format!("{value:.1e}")
    } else {
        format!("{value:.0$}", usize::try_from(decimals).unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_keep_what_matters() {
        assert_eq!(Unit::Millimetre.show(52.709_221), "52.7092");
        assert_eq!(Unit::Millimetre.show(-3.2e-7), "-3.2e-7");
        assert_eq!(Unit::Degree.show(std::f64::consts::PI), "180.0000");
        assert_eq!(Unit::Count.show(23.0), "23");
        assert_eq!(Unit::Radian.show(f64::INFINITY), "infinite");
        assert_eq!(Unit::Radian.show(-0.0), "0");
        assert_eq!(Unit::Radian.show(2.489e-7), "2.5e-7");
    }
}
