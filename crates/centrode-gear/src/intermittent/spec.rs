use std::f64::consts::FRAC_PI_4;

use crate::GearPairError;
use crate::design::GearPairDesign;
use centrode_spec::SpecError;
use centrode_spec::rule::{count_in_range, in_range, not_negative, positive};

/// Intermittent gear pair as requested.
#[derive(Clone, Debug, PartialEq)]
pub struct IntermittentPairSpec {
    /// The complete pair: any pitch curve; the mean ratio is that of the pitches of the complete gears.
    pub pair: GearPairDesign,
    /// Pitches by which the driver turns the driven gear in one turn of its own, from the polar angle 0 of its curve.
    pub teeth: u32,
    /// Driver angle over which the driven gear comes to speed, and to rest, rad; 0 for none.
    pub entry: f64,
    /// Radius of the locking arc, mm; default: that of the driver's pitch point at rest.
    pub lock_radius: Option<f64>,
    /// Clearance between locking arc and notch, mm.
    pub lock_clearance: f64,
    /// Normal backlash of the teeth, mm.
    pub backlash: f64,
    /// The pins of the cams.
    pub pins: Pins,
}

/// The pins of the driven gear that run on the driver's cams of entry and exit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pins {
    /// Diameter, mm; default: two and a half modules.
    pub diameter: Option<f64>,
    /// Diameter of the circle through their centres, mm; default: three quarters of the pitch circle's.
    pub circle: Option<f64>,
    /// Angle of each from the line of centres at rest, rad.
    pub angle: f64,
}

impl Default for Pins {
    fn default() -> Self {
        Self {
            diameter: None,
            circle: None,
            angle: FRAC_PI_4,
        }
    }
}

impl IntermittentPairSpec {
    /// Makes an intermittent pair with every other value at its default.
    #[must_use]
    pub fn new(pair: GearPairDesign, teeth: u32, entry: f64) -> Self {
        Self {
            pair,
            teeth,
            entry,
            lock_radius: None,
            lock_clearance: 0.05,
            backlash: 0.1,
            pins: Pins::default(),
        }
    }

    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        self.pair.validate()?;
        count_in_range("teeth", self.teeth, 1, 10_000)?;
        in_range("entry_deg", self.entry.to_degrees(), [0.0, 180.0], " deg")?;
        if let Some(radius) = self.lock_radius {
            positive("lock_radius", radius)?;
        }
        not_negative("lock_clearance", self.lock_clearance)?;
        not_negative("backlash", self.backlash)?;
        for (key, value) in [
            ("pin_diameter", self.pins.diameter),
            ("pin_circle", self.pins.circle),
        ] {
            if let Some(value) = value {
                positive(key, value)?;
            }
        }
        in_range(
            "pin_angle_deg",
            self.pins.angle.to_degrees(),
            [5.0, 85.0],
            " deg",
        )
    }
}

/// Reason why there is no intermittent gear pair.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntermittentPairError {
    /// A value breaks a rule of its own.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// There is no complete pair to begin with.
    #[error(transparent)]
    Pair(#[from] GearPairError),
    /// The driven gear does not come to rest where it can be locked again.
    #[error(
        "{kept} teeth move the driven gear by {kept}/{driven} of a turn: for stops at equal angles one of the two numbers must be a multiple of the other"
    )]
    Stops {
        /// Pitches driven in one turn of the driver.
        kept: u32,
        /// Teeth of a complete driven gear.
        driven: u32,
    },
    /// Several stops in a turn of a driven gear that is not round.
    #[error(
        "with {kept} teeth the driven gear stops {} times per turn: only circular gears have the same pose at each stop", .driven / .kept
    )]
    StopsNeedCircles {
        /// Pitches driven in one turn of the driver.
        kept: u32,
        /// Teeth of a complete driven gear.
        driven: u32,
    },
    /// The toothed arc leaves no room for a dwell.
    #[error(
        "{kept} teeth with entry and exit take {motion} rad of the driver's turn, which leaves no dwell: the driver needs more than {kept} pitches"
    )]
    NoDwell {
        /// Pitches driven in one turn of the driver.
        kept: u32,
        /// Driver angle of the motion, rad.
        motion: f64,
    },
    /// Entry and exit are longer than the motion.
    #[error("entry and exit of {entry} rad each do not fit into the {motion} rad of the motion")]
    Entry {
        /// Angle as given, rad.
        entry: f64,
        /// Driver angle of the motion, rad.
        motion: f64,
    },
    /// A locking arc that does not reach the driven gear.
    #[error(
        "the locking arc of radius {radius} mm does not reach the driven gear, whose nearest point is {minimum} mm from the driver's axis"
    )]
    LockTooSmall {
        /// Its radius, mm.
        radius: f64,
        /// Distance at which the driven gear begins, mm.
        minimum: f64,
    },
    /// A locking arc that overlaps the bore of the driven gear.
    #[error(
        "the locking arc of radius {radius} mm overlaps the driven gear's bore, whose nearest point is {maximum} mm from the driver's axis"
    )]
    LockOverlaps {
        /// Its radius, mm.
        radius: f64,
        /// Distance at which the bore begins, mm.
        maximum: f64,
    },
    /// No tooth reaches above the locking arc.
    #[error(
        "none of the {kept} teeth reaches above the locking arc of radius {lock_radius} mm: use more teeth, or a smaller arc"
    )]
    NoTeethLeft {
        /// Pitches to be driven.
        kept: u32,
        /// Radius of the locking arc, mm.
        lock_radius: f64,
    },
    /// The pins would pass the driver's bore.
    #[error(
        "the pins come within {nearest} mm of the driver's axis, but the radius of its bore is {hub} mm"
    )]
    PinMeetsHub {
        /// Distance of a pin's nearest point, mm.
        nearest: f64,
        /// Radius of the bore, mm.
        hub: f64,
    },
    /// A module too small for a contour.
    #[error("the module is too small for a locking arc")]
    NoLock,
}

impl IntermittentPairError {
    /// Key at fault.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            Self::Pair(error) => error.key(),
            Self::Stops { .. }
            | Self::StopsNeedCircles { .. }
            | Self::NoDwell { .. }
            | Self::NoTeethLeft { .. } => "teeth".into(),
            Self::Entry { .. } => "entry_deg".into(),
            Self::LockTooSmall { .. } | Self::LockOverlaps { .. } => "lock_radius".into(),
            Self::PinMeetsHub { .. } => "pin_circle".into(),
            Self::NoLock => "module".into(),
        }
    }
}
