use centrode_geometry::minimum;

use super::{
    design::{Addendum, Phase},
    fitted::Fitting,
    flank::Side,
    pattern::Patterns,
    profile::{FlankPlan, ToothPlan, Top},
    rolling::{Member, Rolling},
    tool::Tool,
};

/// Parameters of the teeth of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TeethParameters {
    /// Generating tools of driver and driven gear, of one pressure angle, with the heights of the gear's teeth.
    pub tools: [Tool; 2],
    /// Profile shifts of driver and driven gear, mm: by how much the tool is moved away from the axis.
    pub profile_shifts: [f64; 2],
    /// Change of every addendum, mm: negative for shorter teeth.
    pub tip_change: f64,
    /// Height of the teeth.
    pub addendum: Addendum,
    /// Position of the teeth.
    pub phase: Phase,
    /// Normal backlash: distance between mating flanks along their common normal, mm.
    pub backlash: f64,
    /// Maximum angular backlash of the driven gear with the driver held, rad; replaces `backlash`.
    pub backlash_angle: Option<f64>,
    /// The driver's share of the pitch, tooth against space; 0.5 for equal teeth.
    pub thickness_split: f64,
    /// Minimum width of the top land, mm.
    pub minimum_tip_width: f64,
}

impl TeethParameters {
    /// Generating tool of a member.
    #[must_use]
    pub fn tool(&self, member: Member) -> &Tool {
        &self.tools[member as usize]
    }

    /// Pressure angle of both tools, rad.
    #[must_use]
    pub fn pressure_angle(&self) -> f64 {
        self.tools[0].pressure_angle
    }

    /// Profile shift of a member, mm.
    #[must_use]
    pub fn profile_shift(&self, member: Member) -> f64 {
        self.profile_shifts[member as usize]
    }
}

/// Reason why no teeth can be laid out.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TeethError {
    /// The tool's tip has no room for its rounding.
    #[error("tip radius {radius} mm does not fit the tool: a space {space} mm wide and {depth} mm deep on the {} takes at most {maximum} mm", .member.name())]
    TipRadius {
        /// Gear of the space.
        member: Member,
        /// Required radius, mm.
        radius: f64,
        /// Width of the space on the pitch curve, mm.
        space: f64,
        /// Depth of the space, mm.
        depth: f64,
        /// Maximum radius that fits, mm.
        maximum: f64,
    },
    /// The tool comes to a point before it is as deep as it must cut.
    #[error("the tool comes to a point {short:.6} mm before it reaches the required depth: a space {space:.6} mm wide on the {} must be cut {depth:.6} mm deep", .member.name())]
    NoTip {
        /// Gear of the space.
        member: Member,
        /// Width of the space on the pitch curve, mm.
        space: f64,
        /// Depth of the space, mm.
        depth: f64,
        /// Depth that is missing, mm.
        short: f64,
    },
    /// A tooth or a space is left with no width.
    #[error("a tooth of the {} would be {width} mm wide on a pitch of {pitch} mm, which leaves no tooth or no space; the backlash takes {backlash} mm of the width", .member.name())]
    NoWidth {
        /// Gear at fault.
        member: Member,
        /// Width of the tooth on the pitch curve, mm.
        width: f64,
        /// Thinning, mm.
        backlash: f64,
        /// Pitch, mm.
        pitch: f64,
    },
    /// Both gears cannot be the same part.
    #[error(
        "phase \"congruent\" needs two equal pitch curves; these differ by {difference:e} mm in radius"
    )]
    NotCongruent {
        /// Maximum difference of radius, mm.
        difference: f64,
    },
}

/// Layout of the teeth of both gears.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) driver: Vec<ToothPlan>,
    pub(crate) driven: Vec<ToothPlan>,
    /// Pitches from phi = 0 to the middle of driver tooth 0.
    pub(crate) phase: f64,
    pub(crate) backlash: f64,
    pub(crate) congruent: bool,
    /// Width of the spaces of driver and driven gear on the pitch curves, mm.
    spaces: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    pub(crate) driver: u32,
    pub(crate) driven: u32,
}

impl Counts {
    pub(crate) fn of(&self, member: Member) -> u32 {
        match member {
            Member::Driver => self.driver,
            Member::Driven => self.driven,
        }
    }
}

/// Lays out the teeth; those with a fitted addendum are as high as their tool makes them.
pub(crate) fn layout(
    rolling: &Rolling,
    counts: &Counts,
    parameters: &TeethParameters,
) -> Result<Layout, TeethError> {
    let alpha = parameters.pressure_angle();
    let pitch = rolling.pitch_length(Member::Driver) / f64::from(counts.driver);
    let (phase, congruent) = phase(rolling, pitch, parameters)?;
    let backlash = match parameters.backlash_angle {
        Some(angle) => angle * minimum_lever(rolling, alpha),
        None => parameters.backlash,
    };
    let thinning = backlash / (4.0 * alpha.cos());
    // A tool moved away from the axis leaves a thicker tooth.
    let nominal = pitch * parameters.thickness_split;
    let width = |member: Member| {
        let thicker = 2.0 * parameters.profile_shift(member) * alpha.tan();
        match member {
            Member::Driver => nominal + thicker,
            Member::Driven => pitch - (nominal - thicker),
        }
    };
    for member in [Member::Driver, Member::Driven] {
        let width = width(member);
        if !(width > 2.0 * thinning && width < pitch) {
            return Err(TeethError::NoWidth {
                member,
                width: width - 2.0 * thinning,
                backlash: 2.0 * thinning,
                pitch,
            });
        }
    }
    let middle = |member: Member, k: u32| {
        let half = if member == Member::Driver { 0.0 } else { 0.5 };
        (f64::from(k) + phase + half) * pitch
    };
    let crossing = |member: Member, k: u32, side: Side| {
        middle(member, k) + side.sign() * (0.5 * width(member) - thinning)
    };
    let space = |member: Member| pitch - width(member) + 2.0 * thinning;
    let plan = |member: Member| -> Result<Vec<ToothPlan>, TeethError> {
        let tool = parameters.tool(member);
        // A tip that is fitted stays above the root of its mate.
        let addendum = match parameters.addendum {
            Addendum::Full => tool.addendum,
            Addendum::Fitted => tool.addendum.min(parameters.tool(member.mate()).dedendum),
        };
        let shift = parameters.profile_shift(member);
        let depth = tool.dedendum - shift;
        let maximum = tool.maximum_tip_radius(depth, space(member));
        let short = depth - tool.pointed_depth(space(member), depth);
        if maximum < 0.0 {
            return Err(TeethError::NoTip {
                member,
                space: space(member),
                depth,
                short,
            });
        }
        // The two roundings may just touch, with an error within rounding.
        if tool.tip_radius > maximum * (1.0 + 1e-12) {
            return Err(TeethError::TipRadius {
                member,
                radius: tool.tip_radius,
                space: space(member),
                depth,
                maximum,
            });
        }
        let corner = tool.corner(depth, tool.tip_radius);
        let flank = |k: u32, side: Side| FlankPlan {
            crossing: crossing(member, k, side),
            top: Top::Height(addendum + shift + parameters.tip_change),
            corner,
            active_depth: corner.end,
        };
        Ok((0..counts.of(member))
            .map(|k| ToothPlan {
                leading: flank(k, Side::Leading),
                trailing: flank(k, Side::Trailing),
            })
            .collect())
    };
    Ok(Layout {
        driver: plan(Member::Driver)?,
        driven: plan(Member::Driven)?,
        phase,
        backlash,
        congruent,
        spaces: Member::ALL.map(space),
    })
}

impl Layout {
    /// The layout with its addenda trimmed, if the parameters require it.
    pub(crate) fn fitted(
        mut self,
        rolling: &Rolling,
        counts: &Counts,
        parameters: &TeethParameters,
    ) -> Self {
        if parameters.addendum == Addendum::Full {
            return self;
        }
        let pitch = rolling.pitch_length(Member::Driver) / f64::from(counts.driver);
        let fitting = Fitting {
            rolling,
            tools: &parameters.tools,
            minimum_tip_width: parameters.minimum_tip_width,
        };
        let patterns = Patterns::new(rolling.symmetry(), counts, &self, pitch);
        let all = [&mut self.driver[..], &mut self.driven[..]];
        let spaces = self.spaces;
        fitting.fit(all, &patterns, pitch, |member| spaces[member as usize]);
        self
    }
}

/// Length that turns normal backlash into the maximum angular backlash over the cycle, mm: the minimum harmonic mean
/// of the driven shaft's distances from the two common normals.
fn minimum_lever(rolling: &Rolling, pressure_angle: f64) -> f64 {
    let (sin, cos) = pressure_angle.sin_cos();
    let lever = |t: f64| {
        let frame = rolling.frame(Member::Driven, t);
        let distance = |side: f64| {
            let line = frame.tangent * cos + frame.normal * (side * sin);
            frame.point.coords.perp(&line).abs()
        };
        2.0 / (1.0 / distance(-1.0) + 1.0 / distance(1.0))
    };
    minimum(lever, &rolling.pieces()).value
}

/// Pitches from phi = 0 to the middle of a driver tooth, and whether the gears are congruent.
///
/// Two gears are the same part when r(s) + r(s* - s) = a for some s*: the driven tooth at
/// (k + phase + 1/2) p must fall on a driver tooth of the mirrored count, which requires
/// 2 phase = s*/p - 1/2 mod 1.
fn phase(
    rolling: &Rolling,
    pitch: f64,
    parameters: &TeethParameters,
) -> Result<(f64, bool), TeethError> {
    let small = 1e-9 * rolling.center_distance();
    // Only the error of a congruent pair states a difference that is not small.
    let enough = match parameters.phase {
        Phase::Congruent => f64::INFINITY,
        _ => small,
    };
    let difference = self_mating_difference(rolling, pitch, enough);
    let [driver, driven] = parameters.profile_shifts;
    let [one, two] = &parameters.tools;
    let symmetric = parameters.thickness_split == 0.5 && driver == driven && one == two;
    let required = |mirror: f64| (0.5 * (mirror / pitch - 0.5)).rem_euclid(0.5);
    let congruent_at = |phase: f64| {
        difference.is_some_and(|(mirror, d)| {
            let off = 2.0 * (phase - required(mirror));
            symmetric && d < small && (off - off.round()).abs() < 1e-9
        })
    };
    match (parameters.phase, difference) {
        (Phase::Auto, Some((mirror, d))) if d < small => Ok((required(mirror), symmetric)),
        (Phase::Auto | Phase::Tooth, _) => Ok((0.0, congruent_at(0.0))),
        (Phase::Space, _) => Ok((0.5, congruent_at(0.5))),
        (Phase::Pitches(pitches), _) => Ok((pitches, congruent_at(pitches))),
        (Phase::Congruent, Some((mirror, d))) if d < small && symmetric => {
            Ok((required(mirror), true))
        }
        (Phase::Congruent, found) => Err(TeethError::NotCongruent {
            difference: found.map_or(f64::INFINITY, |(_, d)| d),
        }),
    }
}

/// Mirror s* for which r(s) + r(s* - s) comes nearest to a, and the maximum remaining deviation; or the first one that is `enough`.
fn self_mating_difference(rolling: &Rolling, pitch: f64, enough: f64) -> Option<(f64, f64)> {
    /// Number of points of the pitch curve that are compared. Fewer can miss a deviation, more take longer.
    const SAMPLES: u32 = 96;
    if rolling.mean_ratio() != (1, 1) {
        return None;
    }
    let length = rolling.pitch_length(Member::Driver);
    let radius = |s: f64| rolling.curve().at(rolling.parameter(s)).point.coords.norm();
    let (minimum, maximum) = rolling.radii(Member::Driver);
    if maximum - minimum < 1e-12 * maximum {
        // A circle is symmetric about any point: half a pitch puts tooth 0 at phi = 0.
        return Some((0.5 * pitch, 0.0));
    }
    let (low, high) = rolling.extreme_arcs();
    let mirror = low + high;
    if rolling.symmetry().mates_itself {
        return Some((mirror, 0.0));
    }
    let mut difference = 0.0_f64;
    for i in 0..SAMPLES {
        let s = length * f64::from(i) / f64::from(SAMPLES);
        difference =
            difference.max((radius(s) + radius(mirror - s) - rolling.center_distance()).abs());
        if difference >= enough {
            break;
        }
    }
    Some((mirror, difference))
}
