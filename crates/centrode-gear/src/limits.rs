use centrode_geometry::{Extreme, checkpoint, maximum};

use super::{
    design::GearPairDesign,
    flank::{Flank, Side},
    pair::{GearPair, PlannedPair, parameters},
    pitch::{Circle, PitchSpec},
    rolling::{CurvatureRange, Member},
    tool::{Tool, ToolKind},
};

/// Curvature of the pitch curves, and the teeth it allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Maximum curvature of either pitch curve where it is convex, 1/mm; zero where neither is.
    pub convex_curvature: f64,
    /// Maximum curvature of either pitch curve where it is concave, 1/mm; zero for convex curves.
    pub concave_curvature: f64,
    /// Largest module at which the straight sides of this tool undercut or cut short no flank, wherever the teeth fall
    /// on these pitch curves, mm: minimum radius x sin^2 alpha over the tool's depth in modules.
    pub largest_module: f64,
    /// Largest module at which the rounding of the tool's tip cuts into no flank, mm; infinite for convex curves. Where the
    /// pitch curve is concave the rounding's envelope has a cusp, once the curvature there is above sin alpha rho / (d (d - rho)),
    /// plus 1/R for a shaper of pitch radius R. rho is the radius of the rounding, d the distance from the pitch point to where
    /// the flank ends, along the line of action (from the equation of Euler and Savary).
    pub largest_module_of_fillets: f64,
    /// Height, mm, up to which every flank is regular wherever the teeth fall: minimum radius x sin^2 alpha.
    regular_height: f64,
    /// Range of curvature of the driver's and of the driven gear's pitch curve.
    pub ranges: [CurvatureRange; 2],
}

/// Both pitch curves where they touch at one driver angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchPoint {
    /// Driver angle, rad.
    pub input: f64,
    /// Radius of the driver's pitch curve, mm.
    pub driver_radius: f64,
    /// Radius of the driven gear's pitch curve, mm.
    pub driven_radius: f64,
    /// Curvature of the driver's pitch curve, 1/mm, positive where it is convex.
    pub driver_curvature: f64,
    /// Curvature of the driven gear's pitch curve, 1/mm.
    pub driven_curvature: f64,
    /// Angle between the common normal and the driven gear's motion while the driver pushes that gear forward, rad:
    /// |alpha - mu|, with mu the inclination of the pitch curve, tan mu = r'/r.
    pub pressure_angle: f64,
    /// Pressure angle while the driver pushes the driven gear back, rad: |alpha + mu|.
    pub reverse_pressure_angle: f64,
}

impl PitchPoint {
    /// Whether both pitch curves are convex here.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.driver_curvature >= 0.0 && self.driven_curvature >= 0.0
    }
}

impl PlannedPair {
    /// Radii, curvatures and pressure angles where the pitch curves touch at a driver angle.
    #[must_use]
    pub fn pitch_point(&self, phi: f64) -> PitchPoint {
        let rolling = self.rolling();
        let contact = rolling.pitch_contact(rolling.parameter_at_angle(phi));
        let alpha = self.pressure_angle();
        let inclination = angle(contact.inclination);
        let [driver_radius, driven_radius] = contact.radii;
        let [driver_curvature, driven_curvature] = rolling.curvatures(contact.parameter);
        PitchPoint {
            input: phi,
            driver_radius,
            driven_radius,
            driver_curvature,
            driven_curvature,
            pressure_angle: (alpha - inclination).abs(),
            reverse_pressure_angle: (alpha + inclination).abs(),
        }
    }

    /// Maximum pressure angle over the cycle, with the driver pushing in either direction, and the driver angle at which it is,
    /// rad.
    #[must_use]
    pub fn maximum_pressure_angle(&self) -> Extreme {
        let rolling = self.rolling();
        // |alpha - mu| and |alpha + mu|: the greater of both.
        let alpha = self.pressure_angle();
        let steeper = |t: f64| alpha + angle(rolling.inclination(t)).abs();
        let found = maximum(steeper, &rolling.pieces());
        Extreme {
            input: rolling.angle(found.input),
            ..found
        }
    }

    /// Curvatures of the pitch curves, and the modules that they allow with this tool.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let teeth = self.teeth();
        let sin = self.pressure_angle().sin();
        let ranges = self.rolling().curvature_ranges();
        let convex = ranges.iter().map(|r| r.maximum.1).fold(0.0, f64::max);
        let concave = ranges.iter().map(|r| -r.minimum.1).fold(0.0, f64::max);
        let regular = sin * sin / convex.max(concave);
        let regular = teeth
            .tools
            .iter()
            .fold(regular, |regular, tool| match tool.kind {
                ToolKind::Rack => regular,
                ToolKind::Shaper { radius } => regular.min(radius * sin * sin),
            });
        let scale = self.generation().scale();
        let of_both = |of: &dyn Fn(usize, f64) -> f64| {
            let [one, two] = [0, 1].map(|member| of(member, teeth.profile_shifts[member]));
            one.min(two)
        };
        Limits {
            convex_curvature: convex,
            concave_curvature: concave,
            largest_module: of_both(&|member, shift| {
                let bends = [ranges[member].maximum.1, -ranges[member].minimum.1];
                // The tool rolls on the generating pitch curve.
                let bends = bends.map(|bend| scale * bend.max(0.0));
                largest_module(&teeth.tools[member], self.module(), shift, bends)
            }),
            largest_module_of_fillets: of_both(&|member, shift| {
                let concave = (-ranges[member].minimum.1).max(0.0);
                fillet_module(&teeth.tools[member], self.module(), shift, concave)
            }),
            regular_height: regular,
            ranges,
        }
    }
}

impl GearPair {
    /// Largest addendum, mm, with every flank regular wherever the teeth fall, and every tooth as cut
    /// no thinner at its tip than requested.
    #[must_use]
    pub fn largest_addendum(&self) -> f64 {
        let mut height = self.limits().regular_height;
        for member in [Member::Driver, Member::Driven] {
            let (pattern, tool) = (self.patterns.of(member), self.operating_tool(member));
            // A tooth that is the image of another has the same width.
            let teeth = (0..).zip(self.gear(member).teeth());
            for (_, tooth) in teeth.filter(|(k, _)| pattern.image(*k).is_none()) {
                checkpoint();
                let flank = |side, crossing| Flank {
                    rolling: self.rolling(),
                    member,
                    tool: &tool,
                    side,
                    crossing,
                };
                let leading = flank(Side::Leading, tooth.leading.crossing);
                let trailing = flank(Side::Trailing, tooth.trailing.crossing);
                let spare = |h: f64| {
                    land(&leading, &trailing, h)
                        .map_or(-1.0, |w| w - self.teeth().minimum_tip_width)
                };
                // Most teeth are wide enough at the height that the teeth before them allow.
                if spare(height) >= 0.0 {
                    continue;
                }
                let (mut low, mut high) = (0.0, height);
                while high - low > 1e-9 * self.module() {
                    let middle = 0.5 * (low + high);
                    if spare(middle) < 0.0 {
                        high = middle;
                    } else {
                        low = middle;
                    }
                }
                height = low;
            }
        }
        height
    }
}

impl Limits {
    /// Largest module with neither flanks undercut by their own tool's straight sides, nor by the rounding of its tip, mm.
    #[must_use]
    pub fn largest_module_of_full_teeth(&self) -> f64 {
        self.largest_module.min(self.largest_module_of_fillets)
    }

    /// Largest module without undercut or short teeth, mm, where the pitch curves' curvatures are at most those given
    /// (convex, concave, 1/mm): no tooth has to be laid out.
    #[must_use]
    pub fn largest_module_of(design: &GearPairDesign, curvatures: [f64; 2]) -> f64 {
        let teeth = parameters(design, 1.0);
        let of =
            |i: usize| largest_module(&teeth.tools[i], 1.0, teeth.profile_shifts[i], curvatures);
        of(0).min(of(1))
    }

    /// Largest module, mm, of full teeth that are sound at every position, cut by the usual rack on pitch curves whose curvatures
    /// are at most those given (convex, concave, 1/mm): the rack's rounding cuts into flanks of concave gears, too.
    #[must_use]
    pub fn largest_full_module(curvatures: [f64; 2]) -> f64 {
        let design = GearPairDesign::new(PitchSpec::Circle(Circle::default()));
        let [tool, _] = parameters(&design, 1.0).tools;
        largest_module(&tool, 1.0, 0.0, curvatures).min(fillet_module(
            &tool,
            1.0,
            0.0,
            curvatures[1],
        ))
    }
}

/// Angle by its cosine and sine, rad.
fn angle((cos, sin): (f64, f64)) -> f64 {
    sin.atan2(cos)
}

fn largest_module(tool: &Tool, module: f64, shift: f64, [convex, concave]: [f64; 2]) -> f64 {
    let (sin, cos) = tool.pressure_angle.sin_cos();
    let depth = tool.corner(tool.dedendum, tool.tip_radius).end * sin * cos - shift;
    let height = tool.addendum + shift;
    let bound = |curvature: f64, reach: f64| match reach > 0.0 {
        true => module * sin * sin / (curvature * reach),
        false => f64::INFINITY,
    };
    bound(convex, depth).min(bound(concave, height))
}

fn fillet_module(tool: &Tool, module: f64, shift: f64, concave: f64) -> f64 {
    let (sin, cos) = tool.pressure_angle.sin_cos();
    let radius = tool.tip_radius;
    let far = tool.corner(tool.dedendum, radius).end * cos - shift / sin;
    let tool_curvature = match tool.kind {
        ToolKind::Rack => 0.0,
        ToolKind::Shaper { radius } => 1.0 / radius,
    };
    if concave > 0.0 && far > radius {
        module * (tool_curvature + sin * radius / (far * (far - radius))) / concave
    } else {
        f64::INFINITY
    }
}

/// Width of the top land of a tooth cut off at a height; negative above the point where its flanks cross.
fn land(leading: &Flank<'_>, trailing: &Flank<'_>, height: f64) -> Option<f64> {
    let ((a, foot_a), (b, foot_b)) = (leading.at_height(height)?, trailing.at_height(height)?);
    let width = (trailing.point(b) - leading.point(a)).norm();
    Some(if foot_b > foot_a { width } else { -width })
}

#[cfg(test)]
mod tests {
    use crate::GearPair;
    use crate::design::{GearPairDesign, Phase, Shaper, ToolSpec};
    use crate::pitch::{PitchSpec, Polar};

    /// A pair of concave pitch curves with teeth of about this module, laid out at a phase.
    fn pair_at(tool: &ToolSpec, module: f64, phase: f64) -> GearPair {
        let tooth_count = (120.0 / module / 2.0).round() as u32 * 2;
        let mut design = GearPairDesign::new(PitchSpec::Polar(Polar {
            expression: Some("1 + 0.3*cos(2*phi)".into()),
            module: Some(120.0 / f64::from(tooth_count)),
            tooth_count: Some(tooth_count),
            ..Polar::default()
        }));
        design.tool = tool.clone();
        design.teeth.phase = Phase::Pitches(phase);
        GearPair::resolve(&design).expect("a pair")
    }

    #[test]
    fn the_rounding_of_a_tool_cuts_into_flanks_of_concave_gears_above_a_module() {
        let shaper = ToolSpec::Shaper(Shaper {
            tooth_count: 200,
            ..Shaper::default()
        });
        for tool in [ToolSpec::default(), shaper] {
            let limits = pair_at(&tool, 2.0, 0.0).limits();
            let bound = limits.largest_module_of_fillets;
            assert!(bound < limits.largest_module, "{tool:?}: {limits:?}");
            let undercut = |module: f64| {
                (0..4).any(|i| {
                    let pair = pair_at(&tool, module, f64::from(i) / 4.0);
                    let teeth = pair.driver().teeth().iter();
                    let sides = teeth.flat_map(|t| [t.leading, t.trailing]);
                    sides.into_iter().any(|side| side.undercut > 0.0)
                })
            };
            assert!(
                !undercut(0.96 * bound) && undercut(1.06 * bound),
                "{tool:?}: {bound}"
            );
        }
    }
}
