use centrode_geometry::{Jet, Point, gauss_legendre};

use super::RequiredPath;

/// Distance from an extreme, as a share of the path's period, within which second derivatives of the limit lose digits.
const TOO_NEAR: f64 = 1e-4;
/// Distance, as a share of the period, within which a break counts as the extreme itself.
const SAME_PLACE: f64 = 1e-8;

/// Means of the derivatives of the square u of a distance, taken between an extreme and a position near it, a step h away.
///
/// There `u' = h A` and `u = u(extreme) + h^2 V` with `A = integral of u''` and `V = integral of (1 - tau) u''`, at the extreme
/// plus tau h and over tau from 0 to 1: no digit is lost in them. Derivatives are by h.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    /// A and A'.
    pub(super) slope: [f64; 2],
    /// V and V'.
    pub(super) square: [f64; 2],
    /// h A'' and h V''.
    pub(super) bends: [f64; 2],
}

impl Limit {
    /// Between the parameter `extreme` of the path and a position `h` away, whose derivatives are `jet`.
    pub(super) fn new(path: &RequiredPath, axis: Point, extreme: f64, h: f64, jet: &Jet) -> Self {
        let mut found = Self {
            slope: [0.0; 2],
            square: [0.0; 2],
            bends: [0.0; 2],
        };
        let mut moment = 0.0;
        let mut over = |from: f64, to: f64| {
            gauss_legendre(from, to, |tau, weight| {
                let [_, second, third] = squares(&path.at(extreme + tau * h), axis);
                let [second, third] = [weight * second, weight * third];
                found.slope[0] += second;
                found.square[0] += (1.0 - tau) * second;
                moment += tau * third;
                found.square[1] += (1.0 - tau) * tau * third;
                found.bends[1] += (3.0 * tau - 2.0) * tau * third;
            });
        };
        let (low, high) = (extreme.min(extreme + h), extreme.max(extreme + h));
        let shares = path.breaks_between(low, high);
        let mut shares: Vec<f64> = shares.iter().map(|b| (b - extreme) / h).collect();
        shares.retain(|tau| *tau > 0.0 && *tau < 1.0);
        shares.sort_by(f64::total_cmp);
        let mut from = 0.0;
        for to in shares.into_iter().chain([1.0]) {
            over(from, to);
            from = to;
        }
        let [_, _, last] = squares(jet, axis);
        found.slope[1] = moment;
        found.bends[0] = last - 2.0 * moment;
        found
    }

    /// A'' and V'' at a step: very near the extreme, extrapolated linearly from two points farther from it on the same side.
    pub(super) fn second(
        &self,
        path: &RequiredPath,
        axis: Point,
        extreme: f64,
        h: f64,
    ) -> [f64; 2] {
        let near = TOO_NEAR * path.period();
        if h.abs() >= near {
            return self.bends.map(|bend| bend / h);
        }
        let side = 1.0_f64.copysign(h);
        let same = SAME_PLACE * path.period();
        let far = extreme + 2.0 * near * side;
        let breaks = path.breaks_between(extreme.min(far), extreme.max(far));
        let room = breaks.iter().map(|b| (b - extreme).abs());
        let room = room.filter(|room| *room > same.max(h.abs()));
        let step = 0.5 * side * room.fold(2.0 * near, f64::min);
        let at = |h: f64| {
            let limit = Self::new(path, axis, extreme, h, &path.at(extreme + h));
            limit.bends.map(|b| b / h)
        };
        let [one, other] = [at(step), at(2.0 * step)];
        std::array::from_fn(|k| one[k] + (h / step - 1.0) * (other[k] - one[k]))
    }
}

/// First three derivatives of the square of the distance from an axis.
pub(super) fn squares(jet: &Jet, axis: Point) -> [f64; 3] {
    let p = jet.point - axis;
    [
        2.0 * p.dot(&jet.first),
        2.0 * (jet.first.norm_squared() + p.dot(&jet.second)),
        6.0 * jet.first.dot(&jet.second) + 2.0 * p.dot(&jet.third),
    ]
}
