use super::smooth_run::Node;
use crate::Vector;
use nalgebra::Rotation2;

/// Plan for arcs within a tolerance of a smooth curve: at each node the tangent of the arcs and their number so far.
///
/// If the curvature changes at the rate `κ'`, arcs of length `l` with their ends on the curve are closest to it if their
/// tangents at the ends are turned from those of the curve by `-κ' l² / 12`. Their error is then `e = κ' l³ / 72√3`, a third of
/// the error of arcs with the tangents of the curve.
pub(crate) struct ArcPlan {
    /// Tangents of the arcs.
    pub(crate) tangents: Vec<Vector>,
    /// Number of arcs up to each node, not rounded.
    pub(crate) count: Vec<f64>,
    /// Angle, rad, through which the curve has turned up to each node.
    pub(crate) turned: Vec<f64>,
    /// The angle, rad, between arcs of the planned length and the tangent of the curve.
    pub(crate) tangent_angle: Vec<f64>,
}

impl ArcPlan {
    /// Plans a run. At an end that is not free the arcs have the tangent of the curve.
    pub(crate) fn new(nodes: &[Node], free: [bool; 2], tolerance: f64) -> Self {
        let scale = 72.0 * 3.0_f64.sqrt() * tolerance;
        let last = nodes.len() - 1;
        let mut travelled = vec![0.0; nodes.len()];
        let mut turned = vec![0.0; nodes.len()];
        for i in 1..nodes.len() {
            let (a, b) = (&nodes[i - 1], &nodes[i]);
            travelled[i] = travelled[i - 1] + (b.point - a.point).norm();
            turned[i] = turned[i - 1] + a.tangent.perp(&b.tangent).atan2(a.tangent.dot(&b.tangent));
        }
        let total = travelled[last];
        let angle_at = |s: f64| {
            let k = travelled.partition_point(|&t| t < s).clamp(1, last);
            let share = (s - travelled[k - 1]) / (travelled[k] - travelled[k - 1]);
            turned[k - 1] + (turned[k] - turned[k - 1]) * share
        };
        let mut plan = Self {
            tangents: Vec::with_capacity(nodes.len()),
            count: Vec::with_capacity(nodes.len()),
            tangent_angle: Vec::with_capacity(nodes.len()),
            turned: Vec::new(),
        };
        let (mut count, mut density) = (0.0, 0.0);
        let mut length = total / 16.0;
        for (i, node) in nodes.iter().enumerate() {
            // Rate of the curvature, averaged over one arc. Where it changes sign, the tangent is not turned.
            let rate_over = |window: f64| {
                let middle = travelled[i].clamp(window, total - window);
                let angles = [middle - window, middle, middle + window].map(angle_at);
                (angles[2] - 2.0 * angles[1] + angles[0]) / (window * window)
            };
            for _ in 0..if i == 0 { 6 } else { 2 } {
                let allowed = (scale / f64::abs(rate_over(0.5 * length))).cbrt();
                length = (length * allowed).sqrt().min(total / 4.0);
            }
            let rates = [1.0, 0.5].map(|share| rate_over(share * length));
            let smaller = rates[0].abs().min(rates[1].abs());
            let is_fixed = (i == 0 && !free[0]) || (i == last && !free[1]);
            let angle = if is_fixed || rates[0] * rates[1] <= 0.0 {
                0.0
            } else {
                -smaller.copysign(rates[0]) * length * length / 12.0
            };
            let before = density;
            density = 1.0 / length;
            if i > 0 {
                count += 0.5 * (before + density) * (travelled[i] - travelled[i - 1]);
            }
            plan.count.push(count);
            plan.tangent_angle.push(scale / (12.0 * length));
            plan.tangents.push(Rotation2::new(angle) * node.tangent);
        }
        plan.turned = turned;
        plan
    }
}
