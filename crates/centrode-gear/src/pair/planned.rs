use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::Tolerance;
use centrode_spec::DrawingSpec;

use super::cutting::Cutting;
use super::follow::follow;
use super::{GearPair, GearPairError};
use crate::design::{BodySpec, Fit, GearPairDesign, GearSpec, TipShortening, ToolSpec};
use crate::fit::Fits;
use crate::generation::Generation;
use crate::pattern::Patterns;
use crate::rolling::{Member, Rolling};
use crate::teeth::{Counts, Layout, TeethParameters, layout};
use crate::tool::{Tool, ToolKind};

/// Maximum distance of a stored outline from the exact curve, as a share of the module. A coarser one comes near the
/// errors that the contact analysis reports, a finer one makes the outlines larger.
const OUTLINE_TOLERANCE: f64 = 1e-10;

/// A gear pair whose teeth are laid out, but not cut: exact pitch curves, tools, and the place of every tooth.
///
/// The driver is centred at the origin, the driven gear at (a, 0). At the driver polar angle phi the
/// driver has turned by -phi and the driven gear by +`driven_angle(phi)`.
#[derive(Clone, Debug)]
pub struct PlannedPair {
    pub(super) design: GearPairDesign,
    definition: String,
    rolling: Arc<Rolling>,
    generation: Generation,
    counts: Counts,
    module: f64,
    teeth: TeethParameters,
    plan: Layout,
}

impl PlannedPair {
    /// Rolls the pitch curves and lays out the teeth. A pair with free parameters (`teeth.fit`) is cut for their choice.
    ///
    /// # Errors
    /// [`GearPairError`] naming the rule broken and its numbers.
    pub fn new(design: &GearPairDesign) -> Result<Self, GearPairError> {
        design.validate()?;
        let ratio = (design.mean_ratio[0], design.mean_ratio[1]);
        let (definition, reference) = Self::reference(design)?;
        let (generation, rolling) = Generation::new(design, reference)?;
        let definition = generation.named(definition);
        let tools = &*generation.rolling;
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
        let module = tools.pitch_length(Member::Driver) / (PI * f64::from(driver));
        design.teeth.thickness_within(0.5 * module)?;
        let follows = follow(tools, driver, module);
        follows.map_err(|error| rolling.sampled().blamed(error))?;
        let planned = |settled: &GearPairDesign| -> Result<Self, GearPairError> {
            let teeth = parameters(settled, module);
            Ok(Self {
                plan: layout(tools, &counts, &teeth)?,
                design: design.clone(),
                definition: definition.clone(),
                rolling: Arc::clone(&rolling),
                generation: generation.clone(),
                counts,
                module,
                teeth,
            })
        };
        let cut = |design: &GearPairDesign| {
            let pair = planned(design).ok()?.cut().ok()?;
            Some(Member::ALL.map(|member| pair.gear(member).teeth().to_vec()))
        };
        let fits = Fits {
            rolling: tools,
            counts: &counts,
            module,
        };
        planned(&fits.settled(&generation.written(design), &cut))
    }

    /// Cuts the teeth of both gears.
    ///
    /// # Errors
    /// [`GearPairError`] if teeth cannot be cut, or a body does not fit them.
    pub fn cut(self) -> Result<GearPair, GearPairError> {
        let tolerance = Tolerance::new(OUTLINE_TOLERANCE * self.module)
            .map_err(|_| GearPairError::NoToothCount)?;
        let tools = &*self.generation.rolling;
        let plan = self.plan.clone().fitted(tools, &self.counts, &self.teeth);
        let patterns = Patterns::new(tools.symmetry(), &self.counts, &plan, PI * self.module);
        let cutting = Cutting {
            rolling: &self.rolling,
            generation: &self.generation,
            tools: &self.teeth.tools,
            plan: &plan,
            patterns: &patterns,
            bodies: Member::ALL.map(|member| self.body(member)),
            tolerance,
        };
        let [driver, driven] = cutting.gears()?;
        Ok(GearPair {
            planned: self,
            patterns,
            driver,
            driven,
        })
    }

    /// The driver's pitch curve in words, and both pitch curves rolling, without any teeth.
    ///
    /// # Errors
    /// [`GearPairError`] where the pitch curves do not roll.
    pub fn roll(design: &GearPairDesign) -> Result<(String, Rolling), GearPairError> {
        let (definition, reference) = Self::reference(design)?;
        let (generation, rolling) = Generation::new(design, reference)?;
        Ok((generation.named(definition), Arc::unwrap_or_clone(rolling)))
    }

    /// The driver's pitch curve in words, and the pitch curves on which the tools roll.
    fn reference(design: &GearPairDesign) -> Result<(String, Rolling), GearPairError> {
        let ratio = (design.mean_ratio[0], design.mean_ratio[1]);
        let pitch = design.pitch.resolve_for(ratio)?;
        if let Some(implied) = pitch.implied_ratio
            && implied != ratio
        {
            return Err(GearPairError::MeanRatio {
                written: ratio,
                implied,
            });
        }
        let rolling = Rolling::new(pitch.curve, ratio)?
            .with_symmetry(pitch.symmetry)
            .with_samples(pitch.sampled);
        if let Some((turn, angle)) = rolling.corner() {
            return Err(GearPairError::Corner { turn, angle });
        }
        Ok((pitch.definition, rolling))
    }

    /// Number of teeth of a member.
    #[must_use]
    pub fn tooth_count(&self, member: Member) -> u32 {
        self.counts.of(member)
    }

    /// Width, bore and material of a member, as written in the design.
    #[must_use]
    pub fn body(&self, member: Member) -> &BodySpec {
        match member {
            Member::Driver => &self.design.driver,
            Member::Driven => &self.design.driven,
        }
    }

    /// Design of the pair with the chosen values of its free parameters (`teeth.fit`) written into it: it gives the same pair.
    #[must_use]
    pub fn settled_design(&self) -> GearPairDesign {
        let mut design = self.design.clone();
        design.teeth.addendum = self.teeth.addendum;
        for fit in std::mem::take(&mut design.teeth.fit) {
            match fit {
                Fit::Addendum => {}
                Fit::ThicknessSplit => design.teeth.thickness_split = self.teeth.thickness_split,
                Fit::Phase => design.teeth.phase = self.teeth.phase,
                Fit::PressureAngle => design.set_pressure_angle(self.teeth.pressure_angle()),
            }
        }
        design
    }

    /// Design of the pair, as written.
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

    /// The rolling pitch curves, to be shared by everything that moves by them.
    pub fn shared_rolling(&self) -> Arc<Rolling> {
        Arc::clone(&self.rolling)
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

    /// Maximum distance of the stored outlines from the exact ones, mm: no finer tolerance is meaningful.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        OUTLINE_TOLERANCE * self.module
    }

    /// Turns of driver : turns of driven.
    #[must_use]
    pub fn mean_ratio(&self) -> (u32, u32) {
        self.rolling.mean_ratio()
    }

    /// Pressure angle of the pair, rad: between the common normal of the teeth and the pitch curves. It is that of the tool,
    /// except for circular gears with x1 + x2 not zero, whose pitch circles are the operating circles.
    #[must_use]
    pub fn pressure_angle(&self) -> f64 {
        self.generation.pressure_angle(self.teeth.pressure_angle())
    }

    /// Profile shift coefficient of a member.
    #[must_use]
    pub fn shift(&self, member: Member) -> f64 {
        self.generation.shifts[member as usize]
    }

    /// Tip shortening coefficient k: every addendum is longer by k modules, shorter if k is negative.
    #[must_use]
    pub fn tip_shortening(&self) -> f64 {
        self.generation.tip_shortening
    }

    /// Diameter of the circle as long as the pitch curve on which a member is generated, mm: m z.
    #[must_use]
    pub fn reference_diameter(&self, member: Member) -> f64 {
        self.generation.rolling.pitch_length(member) / PI
    }

    /// Height of the tips of full teeth above a member's pitch curve, mm.
    #[must_use]
    pub fn tip_height(&self, member: Member) -> f64 {
        let teeth = &self.teeth;
        let addendum = teeth.tool(member).addendum + teeth.profile_shift(member) + teeth.tip_change;
        addendum + self.generation.rise(member)
    }

    /// Depth of the roots of full teeth below a member's pitch curve, mm.
    #[must_use]
    pub fn root_depth(&self, member: Member) -> f64 {
        let teeth = &self.teeth;
        teeth.tool(member).dedendum - teeth.profile_shift(member) - self.generation.rise(member)
    }

    pub(crate) fn generation(&self) -> &Generation {
        &self.generation
    }

    /// The tool that makes the same flanks of a member on the pitch curves of the pair.
    pub(crate) fn operating_tool(&self, member: Member) -> Tool {
        self.generation.operating_tool(self.teeth.tool(member))
    }

    /// Tool, addendum, backlash and the like, resolved to mm and rad.
    #[must_use]
    pub fn teeth(&self) -> &TeethParameters {
        &self.teeth
    }

    /// Pitches from phi = 0 to the middle of driver tooth 0.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.plan.phase
    }

    /// Normal backlash, mm.
    #[must_use]
    pub fn backlash(&self) -> f64 {
        self.plan.backlash
    }

    /// Whether both gears are the same part.
    #[must_use]
    pub fn congruent(&self) -> bool {
        self.plan.congruent
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

    /// Driver angle of a whole cycle, after which both gears are as they were, rad.
    #[must_use]
    pub fn cycle(&self) -> f64 {
        TAU * f64::from(self.mean_ratio().0)
    }
}

pub(crate) fn parameters(design: &GearPairDesign, module: f64) -> TeethParameters {
    let tool = |member: Member, gear: &GearSpec| {
        let spec = design.tool_of(member);
        let kind = match spec {
            ToolSpec::Rack(_) => ToolKind::Rack,
            ToolSpec::Shaper(shaper) => ToolKind::Shaper {
                radius: 0.5 * module * f64::from(shaper.tooth_count),
            },
        };
        let [addendum, dedendum, tip_radius] = match spec {
            ToolSpec::Rack(t) => [
                t.addendum_coefficient,
                t.dedendum_coefficient,
                t.tip_radius_coefficient,
            ],
            ToolSpec::Shaper(t) => [
                t.addendum_coefficient,
                t.dedendum_coefficient,
                t.tip_radius_coefficient,
            ],
        };
        Tool {
            pressure_angle: spec.pressure_angle(),
            addendum: gear.addendum.unwrap_or(addendum) * module,
            dedendum: gear.dedendum.unwrap_or(dedendum) * module,
            tip_radius: tip_radius * module,
            kind,
        }
    };
    TeethParameters {
        tools: [
            tool(Member::Driver, &design.driver),
            tool(Member::Driven, &design.driven),
        ],
        profile_shifts: design.shifts().map(|x| x * module),
        tip_change: match design.teeth.tip_shortening {
            // Without a sum of shifts no change is needed for the clearance.
            TipShortening::KeepClearance | TipShortening::None => 0.0,
            TipShortening::By(coefficient) => coefficient * module,
        },
        addendum: design.teeth.addendum,
        phase: design.teeth.phase,
        backlash: design.teeth.backlash,
        backlash_angle: design.teeth.backlash_angle,
        thickness_split: design.teeth.thickness_split,
        minimum_tip_width: design.teeth.minimum_tip_width_coefficient * module,
    }
}
