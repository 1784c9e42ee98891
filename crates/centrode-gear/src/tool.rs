use centrode_geometry::bracketed_root;

/// The generating tool, resolved: lengths in mm, angles in rad.
///
/// Heights are about the tool's own datum, without profile shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Pressure angle, rad.
    pub pressure_angle: f64,
    /// Height of a tooth above the pitch curve, without profile shift.
    pub addendum: f64,
    /// Depth of a space below the pitch curve, without profile shift.
    pub dedendum: f64,
    /// Radius of the tool's rounded tip corner.
    pub tip_radius: f64,
    /// Rack, or pinion-type shaper.
    pub kind: ToolKind,
}

/// Kind of tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolKind {
    /// A rack: hob, rack cutter, or the basic rack itself.
    Rack,
    /// A pinion-type cutter of this pitch radius, mm.
    Shaper {
        /// Pitch radius, mm.
        radius: f64,
    },
}

/// Position of a tool's tip rounding against the flank it ends, and the end of the flank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    /// Depth of the root below the pitch curve.
    pub(crate) depth: f64,
    /// Radius of the rounding.
    pub(crate) radius: f64,
    /// Arc length from the flank's crossing of the pitch curve to where the rounding's centre is square below the
    /// pitch point.
    pub(crate) center: f64,
    /// Arc length from the crossing to where the flank's generation ends.
    pub(crate) end: f64,
}

impl Tool {
    /// The corner of a tool that cuts to `depth` with a rounding of `radius`.
    pub(crate) fn corner(&self, depth: f64, radius: f64) -> Corner {
        let (sin, cos) = self.pressure_angle.sin_cos();
        let straight = depth - radius;
        match self.kind {
            ToolKind::Rack => Corner {
                depth,
                radius,
                center: straight * sin / cos + radius / cos,
                end: straight / (cos * sin) + radius / cos,
            },
            ToolKind::Shaper { radius: r0 } => {
                let base = r0 * cos;
                let center = r0 + straight;
                let tangent = (center * center - base * base).max(0.0).sqrt();
                let involute = |t: f64| t - t.atan();
                let angle = involute(tangent / base) - involute(sin / cos) + radius / base;
                Corner {
                    depth,
                    radius,
                    center: r0 * angle,
                    end: (tangent + radius - r0 * sin) / cos,
                }
            }
        }
    }

    /// Angle between the tool's flank at its transition to the corner and the line to the tool's axis, rad.
    pub(crate) fn corner_angle(&self, corner: &Corner) -> f64 {
        match self.kind {
            ToolKind::Rack => self.pressure_angle,
            ToolKind::Shaper { radius } => {
                let center = radius + corner.depth - corner.radius;
                (radius * self.pressure_angle.cos() / center).acos()
            }
        }
    }

    /// Maximum arc length the tool can generate on the addendum side of a crossing, mm: a shaper's
    /// flank starts at its base circle.
    pub(crate) fn addendum_reach(&self) -> f64 {
        match self.kind {
            ToolKind::Rack => f64::INFINITY,
            ToolKind::Shaper { radius } => radius * self.pressure_angle.tan(),
        }
    }

    /// Depth, at most `deepest`, at which the tool comes to a point without rounding, for a space of pitch-line width `space`,
    /// mm.
    pub(crate) fn pointed_depth(&self, space: f64, deepest: f64) -> f64 {
        match self.kind {
            ToolKind::Rack => (0.5 * space / self.pressure_angle.tan()).min(deepest),
            ToolKind::Shaper { .. } => {
                let beyond = |depth: f64| self.corner(depth, 0.0).center - 0.5 * space;
                let (flat, pointed) = (beyond(0.0), beyond(deepest));
                match flat < 0.0 && pointed > 0.0 {
                    true => bracketed_root(beyond, 0.0, deepest, flat, pointed),
                    false => deepest,
                }
            }
        }
    }

    /// Maximum rounding that leaves a flat on the tool's tip, for a space of pitch-line width `space` and `depth`, mm: the two
    /// roundings of a tool tooth meet at its middle. Not positive if the tip is pointed even without rounding.
    pub(crate) fn maximum_tip_radius(&self, depth: f64, space: f64) -> f64 {
        let (sin, cos) = self.pressure_angle.sin_cos();
        match self.kind {
            ToolKind::Rack => ((0.5 * space - depth * sin / cos) * cos / (1.0 - sin)).min(depth),
            ToolKind::Shaper { .. } => {
                // The centre moves towards the middle of the tooth as the rounding grows.
                let beyond = |radius: f64| self.corner(depth, radius).center - 0.5 * space;
                let (sharp, round) = (beyond(0.0), beyond(depth));
                if sharp >= 0.0 {
                    -sharp
                } else if round <= 0.0 {
                    depth
                } else {
                    bracketed_root(beyond, 0.0, depth, sharp, round)
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tool(kind: ToolKind) -> Tool {
        Tool {
            pressure_angle: 20_f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            tip_radius: 0.2,
            kind,
        }
    }

    #[test]
    fn a_large_shaper_cuts_as_a_rack_does() {
        let rack = tool(ToolKind::Rack).corner(1.25, 0.2);
        let mut before = f64::INFINITY;
        for radius in [1e2, 1e3, 1e4, 1e5] {
            let shaper = tool(ToolKind::Shaper { radius }).corner(1.25, 0.2);
            let off = (shaper.center - rack.center)
                .abs()
                .max((shaper.end - rack.end).abs());
            // The difference falls with the curvature of the cutter.
            assert!(off < 0.2 * before, "{radius}: {off}");
            before = off;
        }
    }

    #[test]
    fn a_shaper_tip_touches_its_own_flank() {
        // The flank is the involute of the base circle; a rounding tangent to it from inside has its centre
        // on the parallel involute, a tip radius nearer to the base circle along the generating line.
        let radius = 10.0;
        let shaper = tool(ToolKind::Shaper { radius });
        let corner = shaper.corner(1.25, 0.2);
        let base = radius * shaper.pressure_angle.cos();
        let center = radius + 1.05;
        let line = (center * center - base * base).sqrt();
        let end = (line + 0.2) - radius * shaper.pressure_angle.sin();
        assert!((corner.end * shaper.pressure_angle.cos() - end).abs() < 1e-14);
        // From the flank's crossing to the centre, as an angle at the cutter's axis.
        let involute = |t: f64| t - t.atan();
        let unrolled = involute(line / base) + 0.2 / base - involute(shaper.pressure_angle.tan());
        assert!((corner.center / radius - unrolled).abs() < 1e-14);
        assert!(shaper.addendum_reach() < radius);
    }

    #[test]
    fn the_greatest_rounding_leaves_no_land() {
        let space = 0.5 * std::f64::consts::PI;
        for kind in [
            ToolKind::Rack,
            ToolKind::Shaper { radius: 10.0 },
            ToolKind::Shaper { radius: 40.0 },
        ] {
            let tool = tool(kind);
            let radius = tool.maximum_tip_radius(1.25, space);
            assert!((0.2..0.5).contains(&radius), "{kind:?}: {radius}");
            assert!((2.0 * tool.corner(1.25, radius).center - space).abs() < 1e-14);
        }
    }

    #[test]
    fn a_tool_as_deep_as_it_comes_to_a_point_bears_no_rounding() {
        let space = 0.5 * std::f64::consts::PI;
        // tan 20 deg of the depth on either side of a rack's middle.
        let rack = tool(ToolKind::Rack);
        assert!(
            (rack.pointed_depth(space, 9.0) * rack.pressure_angle.tan() - 0.5 * space).abs()
                < 1e-14
        );
        assert!(rack.pointed_depth(space, 1.0) <= 1.0);
        for radius in [2.0, 10.0, 40.0] {
            let shaper = tool(ToolKind::Shaper { radius });
            let depth = shaper.pointed_depth(space, 9.0);
            assert!(depth < rack.pointed_depth(space, 9.0), "{radius}");
            assert!(shaper.maximum_tip_radius(depth, space).abs() < 1e-13);
        }
    }

    #[test]
    fn a_shapers_tip_is_narrower_than_a_racks_and_may_be_pointed() {
        let space = 0.5 * std::f64::consts::PI;
        let maximum = |kind: ToolKind, space: f64| tool(kind).maximum_tip_radius(1.25, space);
        let rack = maximum(ToolKind::Rack, space);
        let shaper = maximum(ToolKind::Shaper { radius: 10.0 }, space);
        assert!(shaper < 0.9 * rack, "{shaper}, {rack}");
        let large = maximum(ToolKind::Shaper { radius: 1e6 }, space);
        assert!((large - rack).abs() < 1e-5, "{large}, {rack}");
        // The flanks meet below the tip.
        assert!(maximum(ToolKind::Shaper { radius: 10.0 }, 1.0) < 0.0);
        // Wider than any rounding of the whole depth.
        assert_eq!(maximum(ToolKind::Shaper { radius: 10.0 }, 9.0), 1.25);
    }
}
