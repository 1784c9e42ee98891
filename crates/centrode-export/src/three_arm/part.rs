use std::fmt;

/// A part of a three-arm mechanism, or the whole.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
#[non_exhaustive]
pub enum ThreeArmPart {
    /// The gear fixed to the frame.
    Sun,
    /// The gear between sun and planet, one per arm.
    Intermediate,
    /// The gear that carries an arm.
    Planet,
    /// The cam on the carrier, one per arm.
    Cam,
    /// The fork between cam and push rod, one per arm.
    Fork,
    /// The roller on the fork, one per arm.
    Roller,
    /// The carrier's plate, on either side of the gears.
    Carrier,
    /// Tube that holds the carrier's plates apart.
    Spacer,
    /// The wall of an arm's housing.
    Housing,
    /// The cover of an arm's housing towards the gearbox.
    CoverRear,
    /// The cover of an arm's housing away from the gearbox.
    CoverFront,
    /// A flake of the clamp, two per arm.
    Clamp,
    /// The push rod with its pusher, one per arm.
    PushRod,
    /// The assembly.
    Assembly,
}

centrode_spec::words!(ThreeArmPart {
    Sun = "sun",
    Intermediate = "intermediate",
    Planet = "planet",
    Cam = "cam",
    Fork = "fork",
    Roller = "roller",
    Carrier = "carrier",
    Spacer = "spacer",
    Housing = "housing",
    CoverRear = "cover-rear",
    CoverFront = "cover-front",
    Clamp = "clamp",
    PushRod = "push-rod",
    Assembly = "assembly",
});

impl ThreeArmPart {
    /// Name of its drawing.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Sun => "Sun gear",
            Self::Intermediate => "Intermediate gear",
            Self::Planet => "Planet gear",
            Self::Cam => "Pusher cam",
            Self::Fork => "Fork",
            Self::Roller => "Cam roller",
            Self::Carrier => "Carrier plate",
            Self::Spacer => "Spacer of the carrier plates",
            Self::Housing => "Arm housing",
            Self::CoverRear => "Rear cover of the arm",
            Self::CoverFront => "Front cover of the arm",
            Self::Clamp => "Clamp flake",
            Self::PushRod => "Push rod, square bar",
            Self::Assembly => "Three-arm mechanism",
        }
    }

    /// Number of these parts in a machine with `arms` arms.
    #[must_use]
    pub fn quantity(self, arms: u32) -> u32 {
        match self {
            Self::Sun | Self::Assembly => 1,
            Self::Carrier => 2,
            Self::Clamp => 2 * arms,
            // An equal number per arm, at least three in total.
            Self::Spacer => arms * 3_u32.div_ceil(arms.max(1)),
            _ => arms,
        }
    }
}

impl fmt::Display for ThreeArmPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
