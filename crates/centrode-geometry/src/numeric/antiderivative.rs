use crate::numeric::{COMPUTED, bracketed_newton};

/// Nodes per panel, on which the integrand is a polynomial of degree 15.
const NODES: usize = 16;
/// Relative size of the last two Chebyshev coefficients below which they count as rounding. Ten times larger loses a digit;
/// ten times smaller halves panels because of rounding.
const NOISE: f64 = 3e-14;
/// Maximum number of halvings. A panel that needs more contains a point where the integrand is not analytic.
const MAX_DEPTH: u32 = 12;

/// Antiderivative of a function from the start of an interval, to the float limit, by Chebyshev series.
///
/// The interval is cut at the breaks of the function. Each panel is halved until the Chebyshev series of the integrand
/// has decayed to rounding, then the series is integrated term by term. An evaluation costs one binary search and a
/// Clenshaw sum of seventeen terms.
#[derive(Clone, Debug)]
pub struct Antiderivative {
    /// Panel ends, one more than panels.
    ends: Vec<f64>,
    panels: Vec<Panel>,
    total: f64,
    unconverged: usize,
}

#[derive(Clone, Debug)]
struct Panel {
    /// Integral up to the start of the panel.
    before: f64,
    /// Chebyshev coefficients of the integral from the start of the panel.
    integral: [f64; NODES + 1],
    /// Chebyshev coefficients of the integrand.
    integrand: [f64; NODES],
    /// Values of the integrand at both ends.
    ends: [f64; 2],
}

impl Antiderivative {
    /// Integrates `f` over the interval from the first to the last of `breaks` (ascending, two or more).
    ///
    /// Between neighbouring breaks `f` must be analytic for this accuracy. It is never evaluated at a break.
    #[must_use]
    pub fn new(f: impl FnMut(f64) -> f64, breaks: &[f64]) -> Self {
        Self::with_scale(f, breaks, 0.0)
    }

    /// Integrates `f`, whose rounding error is that of values of the size `scale`, for instance a difference of such values.
    ///
    /// Panels on which `f` is tiny are then not halved because of rounding. See [`Self::new`].
    #[must_use]
    pub fn with_scale(mut f: impl FnMut(f64) -> f64, breaks: &[f64], scale: f64) -> Self {
        let mut pending: Vec<(f64, f64, u32)> = Vec::new();
        for pair in breaks.windows(2).rev() {
            // Two equal breaks have no panel between them.
            if pair[0] < pair[1] {
                pending.push((pair[0], pair[1], 0));
            }
        }
        let tables = tables();
        let mut ends = vec![breaks[0]];
        let mut panels: Vec<Panel> = Vec::new();
        let mut before = 0.0;
        let mut lost = 0.0;
        let mut unconverged = 0;
        while let Some((a, b, depth)) = pending.pop() {
            crate::checkpoint();
            let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
            let values: [f64; NODES] = std::array::from_fn(|j| f(middle + half * tables.nodes[j]));
            let series: [f64; NODES] = std::array::from_fn(|k| {
                let row = &tables.transform[k];
                values.iter().zip(row).map(|(v, w)| v * w).sum()
            });
            let size = series.iter().fold(scale, |m, c| m.max(c.abs()));
            let tail = series[NODES - 2..].iter().map(|c| c.abs()).sum::<f64>();
            if tail > NOISE * size && depth < MAX_DEPTH && tail.is_finite() {
                pending.push((middle, b, depth + 1));
                pending.push((a, middle, depth + 1));
                continue;
            }
            unconverged += usize::from(tail > COMPUTED * size);
            let mut integral = [0.0; NODES + 1];
            for k in 1..=NODES {
                let lower = if k == 1 {
                    2.0 * series[0]
                } else {
                    series[k - 1]
                };
                let upper = if k + 1 < NODES { series[k + 1] } else { 0.0 };
                integral[k] = half * (lower - upper) / (2.0 * k as f64);
            }
            integral[0] = -(1..=NODES)
                .map(|k| {
                    if k % 2 == 0 {
                        integral[k]
                    } else {
                        -integral[k]
                    }
                })
                .sum::<f64>();
            let whole: f64 = 2.0 * integral.iter().skip(1).step_by(2).sum::<f64>();
            panels.push(Panel {
                before,
                integral,
                integrand: series,
                ends: [-1.0, 1.0].map(|u| sum(series[0], &series[1..], u)),
            });
            ends.push(b);
            // Kahan summation: a thousand panels lose no digit.
            let y = whole - lost;
            let next = before + y;
            lost = (next - before) - y;
            before = next;
        }
        Self {
            ends,
            panels,
            total: before,
            unconverged,
        }
    }

    /// The integral over the whole interval.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.total
    }

    /// Number of panels whose series has not decayed to 1e-9 after the last halving.
    #[must_use]
    pub fn unconverged(&self) -> usize {
        self.unconverged
    }

    /// Nodes and weights of Fejér's first rule on every panel. They integrate `f`, and functions like it, over the whole
    /// interval to the float limit.
    pub fn nodes(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let tables = tables();
        self.ends.windows(2).flat_map(move |end| {
            let (middle, half) = (0.5 * (end[0] + end[1]), 0.5 * (end[1] - end[0]));
            (0..NODES).map(move |j| (middle + half * tables.nodes[j], half * tables.weights[j]))
        })
    }

    /// The integral from the start of the interval to `t`, for `t` inside it.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let after = self.ends.partition_point(|&end| end <= t);
        self.at_panel(after.clamp(1, self.panels.len()) - 1, t)
    }

    fn at_panel(&self, index: usize, t: f64) -> f64 {
        let (a, b) = (self.ends[index], self.ends[index + 1]);
        let u = ((t - a) - (b - t)) / (b - a);
        let panel = &self.panels[index];
        panel.before + sum(panel.integral[0], &panel.integral[1..], u)
    }

    /// Argument at which the integral of a positive function reaches `value`, which is between zero and the total.
    #[must_use]
    pub fn inverse(&self, value: f64) -> f64 {
        let after = self.panels.partition_point(|panel| panel.before <= value);
        let index = after.clamp(1, self.panels.len()) - 1;
        let (a, b) = (self.ends[index], self.ends[index + 1]);
        let low = self.panels[index].before - value;
        let high = self
            .panels
            .get(index + 1)
            .map_or(self.total, |panel| panel.before)
            - value;
        if low >= 0.0 {
            return a;
        }
        if high <= 0.0 {
            return b;
        }
        crate::checkpoint();
        let integrand = &self.panels[index].integrand;
        let at = |t: f64| {
            let off = self.at_panel(index, t) - value;
            let u = ((t - a) - (b - t)) / (b - a);
            (off, off / sum(integrand[0], &integrand[1..], u))
        };
        // Start on the cubic with the slopes of the inverse at both ends: two digits nearer than a line.
        let share = -low / (high - low);
        let [first, last] = self.panels[index]
            .ends
            .map(|slope| (high - low) / ((b - a) * slope) - 1.0);
        let bend = share * (1.0 - share) * ((1.0 - share) * first - share * last);
        let line = a + (b - a) * share;
        let curve = line + (b - a) * bend;
        bracketed_newton(at, a, b, if curve > a && curve < b { curve } else { line })
    }
}

/// Value of a Chebyshev series, given by its constant and its other terms, at `u` in [-1, 1].
fn sum(constant: f64, rest: &[f64], u: f64) -> f64 {
    // Even and odd terms separately, as series in T2(u): two short chains of operations instead of a long one.
    let twice = 4.0 * u * u - 2.0;
    let ([mut even, mut even2], [mut odd, mut odd2]) = ([0.0; 2], [0.0; 2]);
    let pairs = rest.chunks_exact(2);
    if let [last] = pairs.remainder() {
        odd = *last;
    }
    for pair in pairs.rev() {
        (odd, odd2) = (twice * odd + (pair[0] - odd2), odd);
        (even, even2) = (twice * even + (pair[1] - even2), even);
    }
    let even = 0.5 * twice * even - even2 + constant;
    u * (odd - odd2) + even
}

struct Tables {
    nodes: [f64; NODES],
    transform: [[f64; NODES]; NODES],
    weights: [f64; NODES],
}

fn tables() -> &'static Tables {
    static TABLES: std::sync::OnceLock<Tables> = std::sync::OnceLock::new();
    TABLES.get_or_init(|| {
        let angle = |j: usize| std::f64::consts::PI * (j as f64 + 0.5) / NODES as f64;
        let weight = |j: usize| {
            let series =
                (1..NODES / 2).map(|k| (2.0 * k as f64 * angle(j)).cos() / (4 * k * k - 1) as f64);
            2.0 / NODES as f64 * (1.0 - 2.0 * series.sum::<f64>())
        };
        Tables {
            weights: std::array::from_fn(weight),
            nodes: std::array::from_fn(|j| angle(j).cos()),
            transform: std::array::from_fn(|k| {
                std::array::from_fn(|j| {
                    let scale = if k == 0 { 1.0 } else { 2.0 } / NODES as f64;
                    scale * (k as f64 * angle(j)).cos()
                })
            }),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_match_closed_forms_to_the_float_limit() {
        let p = Antiderivative::new(|t| 1.0 / (1.0 + 25.0 * t * t), &[-1.0, 1.0]);
        for i in 0..=200 {
            let t = -1.0 + f64::from(i) / 100.0;
            let exact = ((5.0 * t).atan() + 5.0_f64.atan()) / 5.0;
            assert!((p.at(t) - exact).abs() < 2e-15, "{t}: {}", p.at(t) - exact);
            assert!((p.inverse(exact) - t).abs() < 1e-13);
        }
        let sum: f64 = p.nodes().map(|(t, w)| w / (1.0 + 25.0 * t * t)).sum();
        assert!((sum - p.total()).abs() < 1e-14);
    }

    #[test]
    fn the_inverse_of_a_steep_and_of_a_flat_integral_is_found() {
        let steep = |t: f64| (40.0 * t).exp() + 1e-9;
        let p = Antiderivative::new(steep, &[0.0, 0.25, 1.0]);
        let exact = |t: f64| ((40.0 * t).exp() - 1.0) / 40.0 + 1e-9 * t;
        for i in 0..=500 {
            let t = f64::from(i) / 500.0;
            let off = exact(p.inverse(exact(t))) - exact(t);
            assert!(off.abs() <= 1e-13 * p.total(), "{t}: {off}");
        }
        assert_eq!((p.inverse(0.0), p.inverse(p.total())), (0.0, 1.0));
        let slow = Antiderivative::new(|t: f64| t * t, &[0.0, 2.0]);
        for i in 0..=100 {
            let t = 0.02 * f64::from(i);
            assert!((slow.inverse(t.powi(3) / 3.0) - t).abs() < 1e-5, "{t}");
        }
    }

    #[test]
    fn rounding_of_a_difference_is_not_followed_where_its_size_is_known() {
        let calls = std::cell::Cell::new(0);
        let difference = |t: f64| {
            calls.set(calls.get() + 1);
            (1e4 + t.sin()) - 1e4
        };
        let found = Antiderivative::with_scale(difference, &[0.0, 2.0], 1e4).total();
        assert!((found - (1.0 - 2.0_f64.cos())).abs() < 1e-11, "{found}");
        assert_eq!(calls.get(), NODES);
        let _ = Antiderivative::new(difference, &[0.0, 2.0]);
        assert!(calls.get() > 100 * NODES);
    }

    #[test]
    fn panels_that_do_not_settle_are_counted() {
        // A wave takes two panels or three; of half a million waves none is seen.
        let waves =
            |n: f64| Antiderivative::new(move |t: f64| 1.0 + 0.5 * (n * t).sin(), &[0.0, 6.0]);
        assert_eq!(waves(500.0).unconverged(), 0);
        assert_eq!(waves(5e5).unconverged(), 1 << MAX_DEPTH);
        // At a kink one.
        let kink = Antiderivative::new(|t: f64| (t - 1.0).abs(), &[0.0, 6.0]);
        assert_eq!(kink.unconverged(), 1);
    }

    #[test]
    fn a_break_given_twice_changes_nothing() {
        let ends = [0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
        let p = Antiderivative::new(|t| t, &ends);
        for t in [0.0, 1.0, 2.0] {
            assert!((p.at(t) - 0.5 * t * t).abs() < 1e-15, "{t}: {}", p.at(t));
            assert!((p.inverse(p.at(t)) - t).abs() < 1e-15);
        }
    }

    #[test]
    fn a_jump_at_a_break_costs_nothing() {
        let p = Antiderivative::new(|t| if t < 1.0 { 1.0 } else { 3.0 }, &[0.0, 1.0, 2.0]);
        assert_eq!(p.panels.len(), 2);
        assert!((p.at(1.5) - 2.5).abs() < 1e-15 && (p.total() - 4.0).abs() < 1e-15);
    }
}
