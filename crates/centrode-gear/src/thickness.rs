//! Limits of tooth thickness.

use std::sync::LazyLock;

use centrode_kinematics::machine::StandardTable;

use super::design::BodySpec;
use super::{Member, PlannedPair};

/// Tolerances of tooth thickness, um, by series, for reference diameters up to a limit, mm.
static TOLERANCES: LazyLock<StandardTable<11>> =
    LazyLock::new(|| StandardTable::read(include_str!("../data/din-3967.csv")));
/// Series minus the accuracy class: series 26 for class 8. A tolerance is then at least twice the variation of tooth thickness on
/// one gear of the class, as DIN 3967 requires.
const ABOVE_CLASS: u32 = 18;
/// Minimum module of the standard, mm.
const MIN_MODULE: f64 = 1.0;

/// Upper and lower deviation of the thickness of a gear's teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThicknessDeviations {
    /// Upper and lower deviation, mm.
    pub limits: [f64; 2],
    /// Series of DIN 3967 of the tolerance, where the design states no deviations.
    pub series: Option<u32>,
}

impl PlannedPair {
    /// Deviations of the thickness of a gear's teeth from those designed: as the design states them, or from zero down by a
    /// tolerance of DIN 3967, whose deviation series h leaves the backlash as designed. The tolerance series is 18 + the accuracy
    /// class, 26 for class 8, by the circle as long as the pitch curve. `None` for a class of another system, a module below
    /// 1 mm, or a gear beyond the table.
    #[must_use]
    pub fn thickness_deviations(&self, member: Member) -> Option<ThicknessDeviations> {
        let written = self.design().teeth.thickness_deviations;
        written.map_or_else(
            || self.usual_deviations(member),
            |limits| {
                Some(ThicknessDeviations {
                    limits,
                    series: None,
                })
            },
        )
    }

    /// Minimum and maximum normal backlash, mm, of teeth designed for a normal `backlash`, by the deviations of both gears:
    /// `j - (E_1 + E_2) cos(alpha)` with the upper and the lower deviations E along the pitch curves and alpha the pressure angle
    /// of the pair. A negative backlash is an overlap.
    #[must_use]
    pub fn backlash_limits(&self, backlash: f64) -> [f64; 2] {
        let deviations = [Member::Driver, Member::Driven].map(|m| self.thickness_deviations(m));
        [0, 1].map(|end| {
            let both = deviations.iter().flatten().map(|one| one.limits[end]);
            backlash - both.sum::<f64>() * self.pressure_angle().cos()
        })
    }

    fn usual_deviations(&self, member: Member) -> Option<ThicknessDeviations> {
        let class: u32 = self.body(member).accuracy_class().parse().ok()?;
        let series = class.checked_add(ABOVE_CLASS)?;
        let tolerance = tolerance(self.reference_diameter(member), series)?;
        (self.module() >= MIN_MODULE).then_some(ThicknessDeviations {
            limits: [0.0, -tolerance],
            series: Some(series),
        })
    }
}

/// Tolerance of tooth thickness of a series by the reference diameter, mm.
fn tolerance(diameter: f64, series: u32) -> Option<f64> {
    let column = TOLERANCES.column(&series.to_string())?;
    TOLERANCES.up_to(diameter).map(|row| row[column] / 1000.0)
}

impl BodySpec {
    /// Accuracy class of the teeth in words: as written, or 8 of ISO 1328-1.
    #[must_use]
    pub fn accuracy_class(&self) -> &str {
        match self.accuracy.trim() {
            "" => "8",
            written => written,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_that_of_the_standard() {
        // The example of DIN 3967, 27cd at 100 mm: -70 and -170 um.
        assert_eq!(tolerance(100.0, 27), Some(0.1));
        // Ends of ranges belong to the smaller diameters.
        assert_eq!(tolerance(50.0, 26), Some(0.05));
        assert_eq!(tolerance(50.1, 26), Some(0.06));
        assert_eq!(tolerance(10_000.0, 30), Some(2.4));
        for (diameter, series) in [(10_001.0, 26), (f64::NAN, 26), (50.0, 20), (50.0, 31)] {
            assert_eq!(tolerance(diameter, series), None);
        }
    }

    #[test]
    fn tolerances_grow_with_diameter_and_series() {
        assert_eq!(TOLERANCES.rows.len(), 11);
        for row in &TOLERANCES.rows {
            assert!(row[1..].windows(2).all(|pair| pair[0] < pair[1]));
        }
        for pair in TOLERANCES.rows.windows(2) {
            assert!(pair[0].iter().zip(pair[1]).all(|(a, b)| *a < b));
        }
    }
}
