//! Addenda trimmed flank by flank to what the pitch curves let mesh.

use centrode_geometry::bracketed_root;

use super::{
    flank::{Flank, Side},
    rolling::{Member, Rolling},
    tool::{Corner, Tool},
};

/// Least share of a straight rack's flank speed kept at the end of a trimmed flank: below it the
/// flank ends in a knife edge of no radius of curvature.
const LEAST_SPEED: f64 = 0.05;

/// How far, in arc length of roll, the flank of `member` on `side` that crosses the pitch curve at
/// `crossing` can work above it together with its mate, at most `limit`.
///
/// A roll v above the crossing both flanks are regular while sin alpha + kappa v cos alpha (its own
/// curvature) and sin alpha - kappa v cos alpha (its mate's) are positive.
pub(crate) fn reach(
    rolling: &Rolling,
    tool: &Tool,
    (member, side): (Member, Side),
    crossing: f64,
    limit: f64,
) -> f64 {
    const STEPS: u32 = 48;
    let (sin, cos) = tool.pressure_angle.sin_cos();
    let mate = member.mate();
    let margin = |v: f64| {
        let t = rolling.parameter(crossing - side.sign() * v);
        let own = sin + rolling.frame(member, t).curvature * v * cos;
        let other = sin - rolling.frame(mate, t).curvature * v * cos;
        own.min(other) - LEAST_SPEED * sin
    };
    let limit = limit.min(tool.addendum_reach());
    let mut before = (0.0, sin * (1.0 - LEAST_SPEED));
    for i in 1..=STEPS {
        let v = limit * f64::from(i) / f64::from(STEPS);
        let value = margin(v);
        if value <= 0.0 {
            return bracketed_root(margin, before.0, v, before.1, value);
        }
        before = (v, value);
    }
    limit
}

/// The share of both reaches a tooth can keep with a top land at least `width` wide.
pub(crate) fn share_for_width(
    leading: (&Flank<'_>, f64),
    trailing: (&Flank<'_>, f64),
    width: f64,
) -> f64 {
    let land = |share: f64| {
        let tip = |(flank, reach): (&Flank<'_>, f64)| {
            let arc = flank.crossing - flank.side.sign() * share * reach;
            flank.point(flank.rolling.parameter(arc))
        };
        let (a, b) = (tip(leading), tip(trailing));
        let middle = 0.5 * (leading.0.crossing + trailing.0.crossing);
        let frame = leading.0.frame(leading.0.rolling.parameter(middle));
        (b - a).dot(&frame.tangent) - width
    };
    let (low, high) = (land(0.0), land(1.0));
    if high >= 0.0 {
        1.0
    } else if low <= 0.0 {
        0.0
    } else {
        bracketed_root(land, 0.0, 1.0, low, high)
    }
}

/// The corner of a space whose root is `depth` deep and whose flank is worked down to a roll `end`
/// below its crossing: the largest rounding that starts there and fits a space `space` wide.
pub(crate) fn corner(tool: &Tool, depth: f64, end: f64, space: f64) -> Corner {
    let greatest = tool.greatest_tip_radius(depth, space).max(0.0);
    let beyond = |radius: f64| tool.corner(depth, radius).end - end;
    let (sharp, round) = (beyond(0.0), beyond(greatest));
    let radius = if round >= 0.0 {
        greatest
    } else if sharp <= 0.0 {
        0.0
    } else {
        bracketed_root(beyond, 0.0, greatest, sharp, round)
    };
    tool.corner(depth, radius)
}
