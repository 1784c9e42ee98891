use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, PolySegment, Segment, Tolerance};

use crate::bore;

use crate::design::{DrawingSpec, MechanismError};

use super::{
    design::{BodySpec, GearPairDesign, SpecError, ToolSpec},
    pitch::PitchError,
    profile::{Cutter, Profile, ProfileError, Role, Tooth},
    rolling::{Member, Rolling, RollingError},
    teeth::{Counts, TeethError, TeethParameters, layout},
    tool::{Tool, ToolKind},
};

/// Greatest distance of a stored outline from the exact curve, as a share of the module.
const OUTLINE_TOLERANCE: f64 = 1e-10;

/// A non-circular gear pair, resolved: exact pitch curves, finished teeth.
///
/// The driver is centred at the origin, the driven gear at (a, 0). At the driver polar angle phi the
/// driver has turned by -phi and the driven gear by +`driven_angle(phi)`.
#[derive(Clone, Debug)]
pub struct GearPair {
    design: GearPairDesign,
    definition: String,
    rolling: Rolling,
    module: f64,
    teeth: TeethParameters,
    phase: f64,
    backlash: f64,
    congruent: bool,
    driver: Gear,
    driven: Gear,
}

/// One gear of a pair, in its own frame: axes parallel to the world's at phi = 0.
#[derive(Clone, Debug)]
pub struct Gear {
    member: Member,
    tooth_count: u32,
    pitch_length: f64,
    outline: Outline,
    roles: Vec<Role>,
    owners: Vec<u32>,
    pitch_curve: Outline,
    teeth: Vec<Tooth>,
    body: BodySpec,
}

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
    /// Neither the pair nor the curve says how many teeth the driver has.
    #[error(
        "tooth_count is missing: give it to the pair, or module and tooth_count to the pitch curve"
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
    #[error("mean_ratio is {}:{} but the pitch curve's law makes it {}:{}", written.0, written.1, implied.0, implied.1)]
    MeanRatio {
        /// Ratio as written.
        written: (u32, u32),
        /// Ratio of the law.
        implied: (u32, u32),
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
    /// The wanted centre distance is not the one at which the curves roll.
    #[error(
        "center_distance is {wanted} mm, but this pitch curve rolls on a closed conjugate only at {needed} mm"
    )]
    CenterDistance {
        /// Distance as written, mm.
        wanted: f64,
        /// Distance that closes the driven curve, mm.
        needed: f64,
    },
    /// The bore, with its keyway, cuts into the teeth.
    #[error("the {}'s bore reaches {reach} mm from the axis, but its teeth leave only {root} mm", .member.name())]
    Bore {
        /// Gear at fault.
        member: Member,
        /// Radius reached by bore and keyway, mm.
        reach: f64,
        /// Least radius of the outline, mm.
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
            Self::Rolling(_) | Self::Corner { .. } => "pitch".into(),
            Self::Teeth(TeethError::TipRadius { .. }) => "tool.tip_radius_coefficient".into(),
            // Without the play there would be a tooth.
            Self::Teeth(TeethError::NoWidth { width, play, .. }) if width + play > 0.0 => {
                "teeth.backlash".into()
            }
            Self::Teeth(TeethError::NoWidth { .. }) => "teeth.thickness_split".into(),
            Self::Teeth(TeethError::NotCongruent { .. }) => "teeth.phase".into(),
            Self::Profile(_) | Self::NoToothCount | Self::DrivenTeeth { .. } => {
                "tooth_count".into()
            }
            Self::CenterDistance { .. } => "center_distance".into(),
            Self::Bore { member, .. } => format!("{}.bore", member.name()),
        }
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

impl GearPair {
    /// Rolls the pitch curves, lays out the teeth and cuts both gears.
    ///
    /// # Errors
    /// [`GearPairError`] naming the rule broken and its numbers.
    pub fn resolve(design: &GearPairDesign) -> Result<Self, GearPairError> {
        design.validate()?;
        let ratio = (design.mean_ratio[0], design.mean_ratio[1]);
        let (definition, rolling) = Self::roll(design)?;
        let driver = design
            .driver_tooth_count()
            .ok_or(GearPairError::NoToothCount)?;
        let driven = u64::from(driver) * u64::from(ratio.0);
        if !driven.is_multiple_of(u64::from(ratio.1)) || driven / u64::from(ratio.1) < 3 {
            return Err(GearPairError::DrivenTeeth { driver, ratio });
        }
        let counts = Counts {
            driver,
            driven: u32::try_from(driven / u64::from(ratio.1))
                .map_err(|_| GearPairError::DrivenTeeth { driver, ratio })?,
        };
        let module = rolling.pitch_length(Member::Driver) / (PI * f64::from(driver));
        let teeth = parameters(design, module);
        let plan = layout(&rolling, &counts, &teeth)?;
        let tolerance =
            Tolerance::new(OUTLINE_TOLERANCE * module).map_err(|_| GearPairError::NoToothCount)?;
        let cut = |member: Member| -> Result<Gear, GearPairError> {
            let (count, plans, body) = match member {
                Member::Driver => (counts.driver, &plan.driver, &design.driver),
                Member::Driven => (counts.driven, &plan.driven, &design.driven),
            };
            let cutter = Cutter {
                rolling: &rolling,
                member,
                tool: &teeth.tool,
                tolerance,
            };
            Gear::new(
                &rolling,
                member,
                count,
                cutter.cut(plans)?,
                body.clone(),
                tolerance,
            )
        };
        let (driver, driven) = (cut(Member::Driver)?, cut(Member::Driven)?);
        Ok(Self {
            design: design.clone(),
            definition,
            rolling,
            module,
            teeth,
            phase: plan.phase,
            backlash: plan.backlash,
            congruent: plan.congruent,
            driver,
            driven,
        })
    }

    /// The driver's pitch curve in words, and both pitch curves rolling, without any teeth.
    pub(crate) fn roll(design: &GearPairDesign) -> Result<(String, Rolling), GearPairError> {
        let pitch = design.pitch.resolve()?;
        let ratio = (design.mean_ratio[0], design.mean_ratio[1]);
        if let Some(implied) = pitch.implied_ratio
            && implied != ratio
        {
            return Err(GearPairError::MeanRatio {
                written: ratio,
                implied,
            });
        }
        let rolling = Rolling::of(pitch.curve, ratio)?;
        if let Some((turn, angle)) = rolling.corner() {
            return Err(GearPairError::Corner { turn, angle });
        }
        if let Some(wanted) = design.center_distance {
            let needed = rolling.center_distance();
            // A distance is written to a micrometre or so.
            if (wanted - needed).abs() > 1e-6 * needed {
                return Err(GearPairError::CenterDistance { wanted, needed });
            }
        }
        Ok((pitch.definition, rolling))
    }

    /// Makes the pair with another body of the driver.
    ///
    /// # Errors
    /// [`GearPairError::Bore`] where its bore cuts into the teeth, [`GearPairError::Spec`] for a bad value.
    pub fn with_driver_body(&self, body: &BodySpec) -> Result<Self, GearPairError> {
        body.validate().map_err(|e| e.inside("driver"))?;
        let mut pair = self.clone();
        pair.design.driver = body.clone();
        pair.driver.body = body.clone();
        pair.driver.clears_bore()?;
        Ok(pair)
    }

    /// Design of the pair.
    #[must_use]
    pub fn design(&self) -> &GearPairDesign {
        &self.design
    }

    /// Name, as written in the design.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.design.name
    }

    /// Title, as written in the design.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.design.title
    }

    /// The driver's pitch curve in words.
    #[must_use]
    pub fn definition(&self) -> &str {
        &self.definition
    }

    /// The rolling pitch curves.
    #[must_use]
    pub fn rolling(&self) -> &Rolling {
        &self.rolling
    }

    /// Distance between the shafts, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        self.rolling.center_distance()
    }

    /// Module, mm: pitch length / (pi x tooth count).
    #[must_use]
    pub fn module(&self) -> f64 {
        self.module
    }

    /// Greatest distance of the stored outlines from the exact ones, mm: no finer tolerance is meaningful.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        OUTLINE_TOLERANCE * self.module
    }

    /// Turns of driver : turns of driven.
    #[must_use]
    pub fn mean_ratio(&self) -> (u32, u32) {
        self.rolling.mean_ratio()
    }

    /// Tool, addendum, backlash and the like, resolved to mm and rad.
    #[must_use]
    pub fn teeth(&self) -> &TeethParameters {
        &self.teeth
    }

    /// Pitches from phi = 0 to the middle of driver tooth 0.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Normal backlash, mm.
    #[must_use]
    pub fn backlash(&self) -> f64 {
        self.backlash
    }

    /// Whether both gears are the same part.
    #[must_use]
    pub fn congruent(&self) -> bool {
        self.congruent
    }

    /// Driven angle at a driver angle, rad.
    #[must_use]
    pub fn driven_angle(&self, phi: f64) -> f64 {
        self.rolling.driven_angle(phi)
    }

    /// Driven turn per driver turn at a driver angle.
    #[must_use]
    pub fn ratio(&self, phi: f64) -> f64 {
        self.rolling.ratio(phi)
    }

    /// Change of the ratio per radian of driver angle.
    #[must_use]
    pub fn ratio_slope(&self, phi: f64) -> f64 {
        self.rolling.ratio_slope(phi)
    }

    /// Entries and layout of the drawing sheets.
    #[must_use]
    pub fn drawing(&self) -> &DrawingSpec {
        &self.design.drawing
    }

    pub(crate) fn written_pin_diameter(&self) -> Option<f64> {
        self.design.teeth.pin_diameter
    }

    /// The gear that is turned.
    #[must_use]
    pub fn driver(&self) -> &Gear {
        &self.driver
    }

    /// The gear that is driven.
    #[must_use]
    pub fn driven(&self) -> &Gear {
        &self.driven
    }

    /// Either gear.
    #[must_use]
    pub fn gear(&self, member: Member) -> &Gear {
        match member {
            Member::Driver => &self.driver,
            Member::Driven => &self.driven,
        }
    }

    /// Driver angle of a whole cycle, after which both gears are as they were, rad.
    #[must_use]
    pub fn cycle(&self) -> f64 {
        TAU * f64::from(self.mean_ratio().0)
    }
}

impl Gear {
    fn new(
        rolling: &Rolling,
        member: Member,
        tooth_count: u32,
        profile: Profile,
        body: BodySpec,
        tolerance: Tolerance,
    ) -> Result<Self, GearPairError> {
        let Profile {
            outline,
            roles,
            owners,
            teeth,
        } = profile;
        let gear = Self {
            member,
            tooth_count,
            pitch_length: rolling.pitch_length(member),
            outline,
            roles,
            owners,
            pitch_curve: pitch_curve(rolling, member, tolerance)?,
            teeth,
            body,
        };
        gear.clears_bore()?;
        Ok(gear)
    }

    fn clears_bore(&self) -> Result<(), GearPairError> {
        let reach = bore::reach(&self.body);
        let (root, _) = self.radii();
        if reach >= root {
            return Err(GearPairError::Bore {
                member: self.member,
                reach,
                root,
            });
        }
        Ok(())
    }

    /// Driver or driven.
    #[must_use]
    pub fn member(&self) -> Member {
        self.member
    }

    /// Number of teeth.
    #[must_use]
    pub fn tooth_count(&self) -> u32 {
        self.tooth_count
    }

    /// Length of the pitch curve, mm.
    #[must_use]
    pub fn pitch_length(&self) -> f64 {
        self.pitch_length
    }

    /// The toothed contour, counter-clockwise.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Role of each segment of the outline.
    #[must_use]
    pub fn roles(&self) -> &[Role] {
        &self.roles
    }

    /// Tooth that each segment of the outline belongs to; a space belongs to the tooth before it.
    #[must_use]
    pub fn owners(&self) -> &[u32] {
        &self.owners
    }

    /// The pitch curve, counter-clockwise.
    #[must_use]
    pub fn pitch_curve(&self) -> &Outline {
        &self.pitch_curve
    }

    /// The teeth in the order they mesh.
    #[must_use]
    pub fn teeth(&self) -> &[Tooth] {
        &self.teeth
    }

    /// Width, bore and material.
    #[must_use]
    pub fn body(&self) -> &BodySpec {
        &self.body
    }

    /// Least and greatest distance of the outline from the axis, mm.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
        for segment in self.outline.segments() {
            for i in 0..=8 {
                let r = segment.at(-1.0 + 0.25 * f64::from(i)).point.coords.norm();
                least = least.min(r);
                greatest = greatest.max(r);
            }
        }
        (least, greatest)
    }

    /// The bore with its keyway, counter-clockwise; `None` for a gear without one.
    #[must_use]
    pub fn bore(&self) -> Option<Outline> {
        bore::outline(&self.body)
    }
}

pub(super) fn parameters(design: &GearPairDesign, module: f64) -> TeethParameters {
    let spec = &design.tool;
    let kind = match spec {
        ToolSpec::Rack(_) => ToolKind::Rack,
        ToolSpec::Shaper(shaper) => ToolKind::Shaper {
            radius: 0.5 * module * f64::from(shaper.tooth_count),
        },
    };
    let [addendum, dedendum, tip_radius, shift] = match spec {
        ToolSpec::Rack(t) => [
            t.addendum_coefficient,
            t.dedendum_coefficient,
            t.tip_radius_coefficient,
            t.profile_shift_coefficient,
        ],
        ToolSpec::Shaper(t) => [
            t.addendum_coefficient,
            t.dedendum_coefficient,
            t.tip_radius_coefficient,
            t.profile_shift_coefficient,
        ],
    };
    TeethParameters {
        tool: Tool {
            pressure_angle: spec.pressure_angle(),
            addendum: addendum * module,
            dedendum: dedendum * module,
            tip_radius: tip_radius * module,
            profile_shift: shift * module,
            kind,
        },
        addendum: design.teeth.addendum,
        phase: design.teeth.phase,
        backlash: design.teeth.backlash,
        backlash_angle: design.teeth.backlash_angle,
        thickness_split: design.teeth.thickness_split,
        least_tip_width: design.teeth.least_tip_width_coefficient * module,
    }
}

fn pitch_curve(
    rolling: &Rolling,
    member: Member,
    tolerance: Tolerance,
) -> Result<Outline, GearPairError> {
    let (from, to) = (
        rolling.parameter(0.0),
        rolling.parameter(rolling.pitch_length(member)),
    );
    let mut ends = vec![from];
    ends.extend(rolling.breaks_between(from, to));
    ends.push(to);
    let mut polys: Vec<PolySegment> = Vec::new();
    for pair in ends.windows(2) {
        polys.extend(PolySegment::fit(
            |t| rolling.frame(member, t).point,
            pair[0],
            pair[1],
            tolerance,
        ));
    }
    for i in 0..polys.len() {
        let end = polys[i].end();
        let next = (i + 1) % polys.len();
        polys[next] = polys[next].pinned(end, polys[next].end());
    }
    let mut segments: Vec<Segment> = polys.into_iter().map(Segment::Poly).collect();
    if member == Member::Driven {
        segments = segments.iter().rev().map(Segment::reversed).collect();
    }
    Ok(Outline::new(segments).map_err(ProfileError::from)?)
}
