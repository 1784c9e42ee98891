//! Spaces fitted to the tips that enter them.

use centrode_geometry::{bracketed_root, checkpoint};

use super::{
    fitted::{Fitting, Tip},
    flank::{Flank, Side},
    profile::{FlankPlan, ToothPlan},
    rolling::Member,
    tool::{Corner, Tool},
};

/// Ratio of a flank's active depth to its mate's reach, so that the mate's tip edge clears the fillet. At 1 the edge
/// touches the fillet by rounding; a larger ratio makes the fillet smaller.
const SPARE: f64 = 1.02;

/// Maximum rounding of a space's corner, as a share of its depth. At 1 the centre is on the pitch curve, and the fillet
/// would be cut in one instant.
const ROUNDEST: f64 = 0.8;

/// Minimum generation speed, relative to a straight rack, at which a flank is extended below its active part. At zero
/// the flank would be undercut; a larger value ends the flank early.
const SLOWEST: f64 = 0.01;

/// Number of positions of a tip on its path from the flank to the root that are compared with the corner: first, and if
/// the tip comes near it. Fewer can miss contact, more take longer.
const PLACES: [u32; 2] = [8, 32];

/// Clearance that n samples may miss, relative to depth / n²: smaller values miss contacts, larger ones trim too much.
const BETWEEN: f64 = 1e-2;

/// Position of a tip on that path: the arc length rolled, and the distances of the tip ahead of and above the point at which the
/// pitch curves touch.
type Place = (f64, [f64; 2]);

impl Fitting<'_> {
    /// The corner of a space of some depth next to a flank that a tip works on; `None` if it would cut into that flank.
    pub(super) fn corner_below(
        &self,
        member: Member,
        depth: f64,
        tip: Tip,
        space: f64,
    ) -> Option<Corner> {
        let end = SPARE * tip.0;
        let found = corner(self.tool(member), depth, end, space);
        (found.end <= end * (1.0 + 1e-9)).then_some(found)
    }

    /// Fits every space of a gear to the tips that enter it, over `meshes` teeth: driven tooth k enters the space after driver
    /// tooth k, and driver tooth k + 1 the space after driven tooth k. Each space has one depth, below the higher tip, where the
    /// flanks allow it, and a fillet below each flank. The teeth take up `length` of the pitch curve.
    pub(super) fn serve(
        &self,
        member: Member,
        teeth: &mut [ToothPlan],
        mates: &[[Tip; 2]],
        meshes: usize,
        length: f64,
        space: f64,
    ) {
        let (tool, clearance) = (self.tool(member), self.clearance(member));
        let higher = |a: Tip, b: Tip| (a.0.max(b.0), a.1.max(b.1));
        let (count, ahead) = (teeth.len(), usize::from(member == Member::Driven));
        for k in 0..count {
            checkpoint();
            let entering: Vec<(f64, [Tip; 2])> = (k..meshes)
                .step_by(count)
                .map(|turn| {
                    let rolled = length * (turn / count) as f64;
                    (rolled, mates[(turn + ahead) % mates.len()])
                })
                .collect();
            let highest = |side: usize| {
                let tips = entering.iter().map(|(_, tips)| tips[side]);
                tips.fold((0.0, 0.0), higher)
            };
            let (before, after) = (highest(0), highest(1));
            let depth = before.1.max(after.1) + clearance;
            let settle = |flank: &mut FlankPlan, side: Side, rolled: f64, tip: Tip| {
                // Where the shared depth would undercut the flank, the root rises to its own.
                let shared = self.corner_below(member, depth, tip, space);
                let corner =
                    shared.unwrap_or_else(|| corner(tool, tip.1 + clearance, SPARE * tip.0, space));
                let mate = usize::from(side == Side::Leading);
                flank.corner = entering.iter().fold(corner, |corner, &(turns, tips)| {
                    let flank = self.flank(member, side, flank.crossing + rolled + turns);
                    self.clear_corner(corner, &flank, tips[mate].0)
                });
                flank.active_depth = tip.0;
            };
            settle(&mut teeth[k].trailing, Side::Trailing, 0.0, before);
            let (next, rolled) = match k + 1 {
                next if next == count => (0, length),
                next => (next, 0.0),
            };
            settle(&mut teeth[next].leading, Side::Leading, rolled, after);
        }
    }

    /// Corner with its rounding reduced until the mate's tip clears it on its path from the flank to the root, but not below the
    /// radius at which the flank can no longer be extended. The tip works on the flank down to the roll `rolled`.
    fn clear_corner(&self, corner: Corner, flank: &Flank<'_>, rolled: f64) -> Corner {
        let beyond = |path: &[Place], radius: f64| {
            let corner = flank.tool.corner(corner.depth, radius);
            path.iter()
                .map(|&(arc, tip)| flank.beyond_corner(&corner, arc, tip))
                .fold(-radius, f64::max)
                + BETWEEN * corner.depth / (path.len() as f64).powi(2)
        };
        let mut path = Vec::new();
        let mut round = 0.0;
        for places in PLACES {
            path = tip_path(flank, rolled, places);
            round = beyond(&path, corner.radius);
            if round <= 0.0 || corner.radius == 0.0 {
                return corner;
            }
        }
        let beyond = |radius: f64| beyond(&path, radius);
        let sharp = flank.tool.corner(corner.depth, 0.0).end;
        // The flank is extended until its generation speed is too low.
        let [from, to] = [rolled, sharp].map(|roll| {
            let arc = flank.crossing + flank.side.sign() * roll;
            flank.rolling.parameter(arc)
        });
        let deepest = match flank.slower(SLOWEST, from, to) {
            Some(t) => flank.side.sign() * (flank.rolling.arc_length(t) - flank.crossing),
            None => sharp,
        };
        let ends = |radius: f64| flank.tool.corner(corner.depth, radius).end - deepest;
        let minimum = match ends(corner.radius) {
            above if above >= 0.0 => return corner,
            above if sharp > deepest => {
                bracketed_root(ends, 0.0, corner.radius, sharp - deepest, above)
            }
            _ => 0.0,
        };
        let small = beyond(minimum);
        let radius = match small <= 0.0 {
            true => bracketed_root(beyond, minimum, corner.radius, small, round),
            false => minimum,
        };
        flank.tool.corner(corner.depth, radius)
    }
}

/// The path of a mate's tip from a flank, on which it works down to a roll below the crossing, to the root.
fn tip_path(flank: &Flank<'_>, rolled: f64, places: u32) -> Vec<Place> {
    let cos = flank.tool.pressure_angle.cos();
    let mate = Flank {
        member: flank.member.mate(),
        side: flank.side.other(),
        ..*flank
    };
    let arc = |share: f64| mate.crossing - mate.side.sign() * rolled * share;
    let tip = mate.point(mate.rolling.parameter(arc(1.0)));
    // The tip is deepest about where it is on the normal of the pitch curve, which is the last position.
    let shares = (1..=places).map(|i| 1.0 - cos * cos * f64::from(i) / f64::from(places));
    shares
        .map(|share| {
            let frame = mate.frame(mate.rolling.parameter(arc(share)));
            let offset = tip - frame.point;
            (
                arc(share),
                [offset.dot(&frame.tangent), -offset.dot(&frame.normal)],
            )
        })
        .collect()
}

/// The corner of a space whose root is `depth` deep and whose flank works down to a roll `end` below its crossing: the largest
/// rounding that starts there and fits a space `space` wide.
fn corner(tool: &Tool, depth: f64, end: f64, space: f64) -> Corner {
    // A centre on the pitch curve itself would cut the whole fillet in one instant.
    let maximum = tool
        .maximum_tip_radius(depth, space)
        .clamp(0.0, ROUNDEST * depth);
    let beyond = |radius: f64| tool.corner(depth, radius).end - end;
    let (sharp, round) = (beyond(0.0), beyond(maximum));
    let radius = if round >= 0.0 {
        maximum
    } else if sharp <= 0.0 {
        0.0
    } else {
        bracketed_root(beyond, 0.0, maximum, sharp, round)
    };
    tool.corner(depth, radius)
}
