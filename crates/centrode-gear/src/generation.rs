//! How the gears of a pair are generated: the pitch curves on which their tools roll, and the shifts of these tools.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{WRITTEN, bracketed_root};

use centrode_spec::digits::digits;
use centrode_spec::rule::in_range;

use super::{
    design::{GearPairDesign, SHIFTS, TipShortening},
    flank::Side,
    pair::GearPairError,
    pitch::{Circle, PitchSpec},
    profile::ToothSide,
    rolling::{Member, Rolling},
    tool::Tool,
};

/// Relative difference below which a written centre distance is the computed one: it is written to about a micrometre.
/// A larger one hides contradictions, a smaller one reports rounded values.
const DISTANCE: f64 = 1e-6;

/// Pressure angle above that of any pair, rad: its involute function exceeds that of the maximum sum of shifts on the fewest
/// teeth.
const STEEPEST: f64 = 1.5;

/// Generation of both gears of a pair.
///
/// Each gear is generated on its own: the tool rolls on its generating pitch curve, shifted by x m. On circular gears this is the
/// reference circle of radius m z/2. The pair runs on its own pitch curves: those of the tools, or for circular gears with
/// x1 + x2 not zero the operating circles.
#[derive(Clone, Debug)]
pub(crate) struct Generation {
    /// Pitch curves on which the tools roll.
    pub(crate) rolling: Arc<Rolling>,
    /// Profile shift coefficients of driver and driven gear.
    pub(crate) shifts: [f64; 2],
    /// Tip shortening coefficient k: change of every addendum, in modules.
    pub(crate) tip_shortening: f64,
    /// Pressure angles of the tool and of the pair, rad.
    angles: [f64; 2],
}

impl Generation {
    /// Generation of a design on the pitch curves of its tools, and the pitch curves of the pair.
    pub(crate) fn new(
        design: &GearPairDesign,
        reference: Rolling,
    ) -> Result<(Self, Arc<Rolling>), GearPairError> {
        let rolling = Arc::new(reference);
        let angle = design.tool.pressure_angle();
        let circles = Circles::of(design, &rolling);
        let needed = rolling.center_distance();
        let other = design
            .center_distance
            .filter(|required| is_other(*required, needed));
        let by_distance = |known: f64, member: Member| -> Result<Option<f64>, GearPairError> {
            let (Some(circles), Some(required)) = (&circles, other) else {
                return Ok(None);
            };
            let shift = circles.sum(required)? - known;
            in_range("shift", shift, SHIFTS, "").map_err(|error| error.inside(member.name()))?;
            Ok(Some(shift))
        };
        let shifts = match [design.driver.shift, design.driven.shift] {
            [Some(one), Some(two)] => [one, two],
            [Some(one), None] => [one, by_distance(one, Member::Driven)?.unwrap_or(0.0 - one)],
            [None, Some(two)] => [by_distance(two, Member::Driver)?.unwrap_or(0.0 - two), two],
            [None, None] => [0.0, 0.0],
        };
        let sum = shifts[0] + shifts[1];
        let made = |angles: [f64; 2], keep: f64| Self {
            rolling: Arc::clone(&rolling),
            shifts,
            tip_shortening: match design.teeth.tip_shortening {
                TipShortening::KeepClearance => keep,
                TipShortening::None => 0.0,
                TipShortening::By(coefficient) => coefficient,
            },
            angles,
        };
        if sum.abs() <= WRITTEN {
            if let Some(required) = other {
                return Err(GearPairError::CenterDistance { required, needed });
            }
            return Ok((made([angle; 2], 0.0), rolling));
        }
        let Some(circles) = circles else {
            return Err(match rolling.is_round() {
                true => GearPairError::NoToothCount,
                false => GearPairError::ShiftSum { shifts },
            });
        };
        if design.is_fitted() {
            return Err(GearPairError::FittedShift { sum });
        }
        let operating_angle = circles.operating_angle(sum)?;
        let scale = angle.cos() / operating_angle.cos();
        let operating = circles.operating(&rolling, scale)?;
        let needed = operating.center_distance();
        if let Some(required) = design.center_distance
            && is_other(required, needed)
        {
            return Err(GearPairError::ShiftedDistance { required, needed });
        }
        let keep = 0.5 * circles.teeth * (scale - 1.0) - sum;
        let made = made([angle, operating_angle], keep);
        Ok((made, Arc::new(operating)))
    }

    /// The design with the profile shifts and the tip shortening of its generation written into it.
    pub(crate) fn written(&self, design: &GearPairDesign) -> GearPairDesign {
        let mut written = design.clone();
        let [driver, driven] = self.shifts;
        (written.driver.shift, written.driven.shift) = (Some(driver), Some(driven));
        written.teeth.tip_shortening = TipShortening::By(self.tip_shortening);
        written
    }

    /// The driver's pitch curve in words, with the operating circle if the pair runs on another one.
    pub(crate) fn named(&self, definition: String) -> String {
        if self.is_plain() {
            return definition;
        }
        let radius = self.scale() * self.radius(Member::Driver);
        let radius = digits(radius, 8);
        format!("{definition}; operating circle, R = {radius} mm")
    }

    /// Whether the pair runs on the pitch curves on which the tools roll.
    fn is_plain(&self) -> bool {
        self.angles[0] == self.angles[1]
    }

    /// Pressure angle of the pair on its pitch curves for a pressure angle of the tool, rad.
    pub(crate) fn pressure_angle(&self, tool: f64) -> f64 {
        if self.is_plain() {
            tool
        } else {
            self.angles[1]
        }
    }

    /// The tool that makes the same flanks on the pitch curves of the pair. The fillets differ.
    pub(crate) fn operating_tool(&self, tool: &Tool) -> Tool {
        Tool {
            pressure_angle: self.pressure_angle(tool.pressure_angle),
            ..*tool
        }
    }

    /// Radius of the pair's pitch circle over that of the generating circle; 1 for all other pairs.
    pub(crate) fn scale(&self) -> f64 {
        let [tool, pair] = self.angles;
        if self.is_plain() {
            1.0
        } else {
            tool.cos() / pair.cos()
        }
    }

    /// Height of a member's generating pitch curve above that of the pair, mm.
    pub(crate) fn rise(&self, member: Member) -> f64 {
        self.radius(member) * (1.0 - self.scale())
    }

    /// Radius of the circle as long as a member's generating pitch curve, mm.
    fn radius(&self, member: Member) -> f64 {
        self.rolling.pitch_length(member) / TAU
    }

    /// A side of a tooth as generated, by the pitch curve of the pair: crossing, rolls and heights.
    ///
    /// On circular gears a flank point made by a roll u above the crossing has the distance r sin(alpha) + u cos(alpha) from the
    /// point where the line of action touches the base circle. This holds for both pitch circles of the gear.
    pub(crate) fn mounted(&self, member: Member, side: Side, made: ToothSide) -> ToothSide {
        if self.is_plain() {
            return made;
        }
        let [tool, pair] = self.angles;
        let (sin, cos) = tool.sin_cos();
        let (sin_w, cos_w) = pair.sin_cos();
        let scale = self.scale();
        let radius = self.radius(member);
        let operating = scale * radius;
        let sign = side.sign();
        let crossing = scale * made.crossing + sign * operating * (involute(tool) - involute(pair));
        let rolled = |roll: f64| (radius * sin + roll * cos - operating * sin_w) / cos_w;
        let arc = |arc: f64| crossing - sign * rolled(sign * (made.crossing - arc));
        ToothSide {
            crossing,
            tip_height: made.tip_height + self.rise(member),
            form_depth: -rolled(-made.form_depth / (sin * cos)) * sin_w * cos_w,
            active_depth: -rolled(-made.active_depth),
            undercut: scale * made.undercut,
            active: made.active.map(|(low, high)| (arc(low), arc(high))),
            ..made
        }
    }
}

/// Whether a written centre distance differs from the computed one.
fn is_other(required: f64, needed: f64) -> bool {
    (required - needed).abs() > DISTANCE * needed
}

/// Involute function, rad.
fn involute(angle: f64) -> f64 {
    angle.tan() - angle
}

/// Reference circles of a circular pair.
struct Circles {
    angle: f64,
    /// Teeth of both gears together.
    teeth: f64,
    center_distance: f64,
}

impl Circles {
    /// `None` if there is no tooth count, or if the pitch curves are not circles.
    fn of(design: &GearPairDesign, rolling: &Rolling) -> Option<Self> {
        let driver = f64::from(design.driver_tooth_count()?);
        let (n1, n2) = rolling.mean_ratio();
        rolling.is_round().then(|| Self {
            angle: design.tool.pressure_angle(),
            teeth: driver * (1.0 + f64::from(n1) / f64::from(n2)),
            center_distance: rolling.center_distance(),
        })
    }

    /// Change of the involute function from the tool to the pair, per sum of the shifts.
    fn rate(&self) -> f64 {
        2.0 * self.angle.tan() / self.teeth
    }

    /// Sum of the shifts at a centre distance: `(inv(alpha_w) - inv(alpha)) (z1 + z2) / (2 tan(alpha))`.
    fn sum(&self, required: f64) -> Result<f64, GearPairError> {
        let minimum = self.center_distance * self.angle.cos();
        if required <= minimum {
            return Err(GearPairError::BaseCircles { required, minimum });
        }
        let operating = (minimum / required).acos();
        Ok((involute(operating) - involute(self.angle)) / self.rate())
    }

    /// Pressure angle of the pair: `inv(alpha_w) = inv(alpha) + 2 tan(alpha) (x1 + x2) / (z1 + z2)`.
    fn operating_angle(&self, sum: f64) -> Result<f64, GearPairError> {
        let required = involute(self.angle) + self.rate() * sum;
        let miss = |angle: f64| involute(angle) - required;
        let ends = [miss(0.0), miss(STEEPEST)];
        if !(ends[0] < 0.0 && ends[1] > 0.0) {
            let minimum = -involute(self.angle) / self.rate();
            return Err(GearPairError::ShiftsTooSmall { sum, minimum });
        }
        Ok(bracketed_root(miss, 0.0, STEEPEST, ends[0], ends[1]))
    }

    /// The operating circles: `scale` times the reference circles.
    fn operating(&self, rolling: &Rolling, scale: f64) -> Result<Rolling, GearPairError> {
        let reference = 0.5 * rolling.pitch_length(Member::Driver) / PI;
        let pitch = PitchSpec::Circle(Circle {
            radius: Some(scale * reference),
            ..Circle::default()
        });
        let pitch = pitch.resolve()?;
        let operating = Rolling::new(pitch.curve, rolling.mean_ratio())?;
        Ok(operating.with_symmetry(pitch.symmetry))
    }
}

impl Rolling {
    /// Whether the pitch curves are circles.
    pub(super) fn is_round(&self) -> bool {
        let (minimum, maximum) = self.radii(Member::Driver);
        maximum - minimum <= WRITTEN * maximum
    }
}
