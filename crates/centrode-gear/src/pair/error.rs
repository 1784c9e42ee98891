use crate::design::GearPairDesign;
use crate::pitch::PitchError;
use crate::profile::ProfileError;
use crate::rolling::{Member, RollingError};
use crate::teeth::TeethError;
use centrode_spec::digits::stated;
use centrode_spec::{MechanismError, SpecError};

use super::follow::{MAX_SWINGS, MAX_WORK};

/// Reason why a design gives no gear pair.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GearPairError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The pitch curve does not exist.
    #[error(transparent)]
    Pitch(#[from] PitchError),
    /// The pitch curves do not roll on each other.
    #[error(transparent)]
    Rolling(#[from] RollingError),
    /// No teeth can be laid out.
    #[error(transparent)]
    Teeth(#[from] TeethError),
    /// The teeth leave no contour.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// Neither the pair nor the curve gives the number of teeth of the driver.
    #[error(
        "tooth_count is missing: give tooth_count for the pair, or module and tooth_count for the pitch curve"
    )]
    NoToothCount,
    /// The driven gear has no whole number of teeth, or too few.
    #[error("{driver} driver teeth at mean ratio {}:{} give the driven gear {driver} x {}/{} teeth; that must be a whole number of at least 3", ratio.0, ratio.1, ratio.0, ratio.1)]
    DrivenTeeth {
        /// Teeth of the driver.
        driver: u32,
        /// Turns of driver : turns of driven.
        ratio: (u32, u32),
    },
    /// The pitch curve's law and the written mean ratio disagree.
    #[error("mean_ratio is {}:{}, but the law of the pitch curve gives {}:{}", written.0, written.1, implied.0, implied.1)]
    MeanRatio {
        /// Ratio as written.
        written: (u32, u32),
        /// Ratio of the law.
        implied: (u32, u32),
    },
    /// The pitch curve has so many waves that comparing those of each tooth with each other takes too long.
    #[error(
        "the pitch curves have {swings} waves for {teeth} teeth: waves times waves per tooth must be at most {MAX_WORK}. Smooth the law, or give fewer points or more digits"
    )]
    Waves {
        /// Number of waves of the radius per turn.
        swings: usize,
        /// Teeth of the driver.
        teeth: u32,
    },
    /// The pitch curve has many waves per tooth, on arcs too small for a tooth.
    #[error(
        "the pitch curves have {swings} waves for {teeth} teeth and a minimum radius of curvature of {radius:.4} mm. Below half a module (module {module:.4} mm) at most {MAX_SWINGS} waves per tooth are allowed. Smooth the law, or give fewer points or more digits"
    )]
    Swings {
        /// Number of waves of the radius per turn.
        swings: usize,
        /// Teeth of the driver.
        teeth: u32,
        /// Minimum radius of curvature of both pitch curves, mm.
        radius: f64,
        /// Module, mm.
        module: f64,
    },
    /// The pitch curve has a corner, where there can be no tooth.
    #[error(
        "the pitch curve has a corner of {turn} rad at a polar angle of {angle} rad; a toothed curve must be smooth"
    )]
    Corner {
        /// Change of direction, rad.
        turn: f64,
        /// Polar angle, rad.
        angle: f64,
    },
    /// The required centre distance is not the one at which the curves roll.
    #[error(
        "center_distance is {required} mm, but the driven pitch curve closes only at {needed} mm"
    )]
    CenterDistance {
        /// Distance as written, mm.
        required: f64,
        /// Distance that closes the driven curve, mm.
        needed: f64,
    },
    /// Profile shifts with a sum on pitch curves that are not circles.
    #[error("driver.shift + driven.shift is {}, but must be 0 unless both pitch curves are circles: a tool moved by x m along the normal makes the tooth 2 x m tan(alpha) thicker, and no common pitch curve fits both flanks of the thicker tooth. Give opposite shifts, driven.shift = {}, or an addendum per gear, driver.addendum and driven.addendum", stated(.shifts[0] + .shifts[1]), stated(-.shifts[0]))]
    ShiftSum {
        /// Profile shift coefficients of driver and driven gear.
        shifts: [f64; 2],
    },
    /// Fitted teeth with a sum of profile shifts.
    #[error("fitted teeth need driver.shift + driven.shift = 0, not {}: the tools must roll on the pitch curves of the pair. Give addendum = \"full\" and no fit, or opposite shifts", stated(*.sum))]
    FittedShift {
        /// Sum of the profile shift coefficients.
        sum: f64,
    },
    /// Profile shifts that leave no room for the teeth at any centre distance.
    #[error("driver.shift + driven.shift is {}, but must exceed {} for these teeth: below it there is no operating pressure angle", stated(*.sum), stated(*.minimum))]
    ShiftsTooSmall {
        /// Sum of the profile shift coefficients.
        sum: f64,
        /// Sum at which the operating pressure angle is zero.
        minimum: f64,
    },
    /// A centre distance other than that of both profile shifts.
    #[error(
        "center_distance is {required} mm, but driver.shift and driven.shift give {needed:.6} mm: omit one of the three"
    )]
    ShiftedDistance {
        /// Distance as written, mm.
        required: f64,
        /// Distance of the shifts, mm.
        needed: f64,
    },
    /// A centre distance within the base circles.
    #[error(
        "center_distance is {required} mm, but must exceed the sum of the base radii, {minimum:.6} mm"
    )]
    BaseCircles {
        /// Distance as written, mm.
        required: f64,
        /// Sum of the radii of the base circles, mm.
        minimum: f64,
    },
    /// The bore, with its keyway, cuts into the teeth.
    #[error("the bore of the {} reaches {reach} mm from the axis, but the minimum radius of its outline is {root} mm", .member.name())]
    Bore {
        /// Gear at fault.
        member: Member,
        /// Radius reached by bore and keyway, mm.
        reach: f64,
        /// Minimum radius of the outline, mm.
        root: f64,
    },
}

impl GearPairError {
    /// Key of the design file at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::Pitch(error) => format!("pitch.{}", error.key()),
            Self::Rolling(RollingError::MeanRatio { .. } | RollingError::NotPeriodic { .. })
            | Self::MeanRatio { .. } => "mean_ratio".into(),
            Self::Rolling(_) | Self::Corner { .. } | Self::Swings { .. } | Self::Waves { .. } => {
                "pitch".into()
            }
            Self::Teeth(TeethError::TipRadius { .. }) => "tool.tip_radius_coefficient".into(),
            Self::Teeth(TeethError::NoTip { .. }) => "tool.dedendum_coefficient".into(),
            // Without the backlash there would be a tooth.
            Self::Teeth(TeethError::NoWidth {
                width, backlash, ..
            }) if width + backlash > 0.0 => "teeth.backlash".into(),
            Self::Teeth(TeethError::NoWidth { .. }) => "teeth.thickness_split".into(),
            Self::Teeth(TeethError::NotCongruent { .. }) => "teeth.phase".into(),
            Self::Profile(_) | Self::NoToothCount | Self::DrivenTeeth { .. } => {
                "tooth_count".into()
            }
            Self::ShiftSum { .. } | Self::ShiftsTooSmall { .. } => "driven.shift".into(),
            Self::FittedShift { .. } => "teeth.addendum".into(),
            Self::CenterDistance { .. }
            | Self::ShiftedDistance { .. }
            | Self::BaseCircles { .. } => "center_distance".into(),
            Self::Bore { member, .. } => format!("{}.bore", member.name()),
        }
    }
}

impl GearPairError {
    /// Key at fault in the file of a design.
    #[must_use]
    pub fn key_in(&self, design: &GearPairDesign) -> String {
        let key = self.key();
        // A shift that leaves no width for a tooth or a space.
        if let Self::Teeth(TeethError::NoWidth { member, .. }) = self
            && key == "teeth.thickness_split"
            && design.shifts() != [0.0; 2]
        {
            return format!("{}.shift", member.name());
        }
        // Where the pitch curve gives the number of teeth of the driver, that number is at fault.
        if key == "tooth_count"
            && design.tooth_count.is_none()
            && design.pitch.tooth_count().is_some()
        {
            return "pitch.tooth_count".into();
        }
        key
    }

    /// The error of a design, with the key at fault.
    #[must_use]
    pub fn blamed(self, design: &GearPairDesign) -> MechanismError {
        let key = self.key_in(design);
        MechanismError { key, ..self.into() }
    }
}

impl From<GearPairError> for MechanismError {
    fn from(error: GearPairError) -> Self {
        let key = error.key();
        match error {
            GearPairError::Spec(error) => error.into(),
            GearPairError::Pitch(error) => Self::new(key, error),
            other => Self::new(key, other),
        }
    }
}
