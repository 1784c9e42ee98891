use crate::numeric::ITERATED;

/// The root of `f` between `low` and `high`, to the float limit, by Brent's method.
///
/// `f_low` and `f_high` are the values at the ends; they must not have the same sign. If one of them is zero, that end is
/// the root.
pub fn bracketed_root(
    mut f: impl FnMut(f64) -> f64,
    low: f64,
    high: f64,
    f_low: f64,
    f_high: f64,
) -> f64 {
    let (mut a, mut fa, mut b, mut fb) = (low, f_low, high, f_high);
    let (mut c, mut fc) = (a, fa);
    let (mut step, mut before) = (b - a, b - a);
    for _ in 0..200 {
        crate::checkpoint();
        if fb == 0.0 {
            return b;
        }
        if (fb > 0.0) == (fc > 0.0) {
            (c, fc) = (a, fa);
            step = b - a;
            before = step;
        }
        if fc.abs() < fb.abs() {
            (a, fa) = (b, fb);
            (b, fb) = (c, fc);
            (c, fc) = (a, fa);
        }
        let limit = 2.0 * f64::EPSILON * b.abs();
        let middle = 0.5 * (c - b);
        if middle.abs() <= limit || fb == 0.0 {
            return b;
        }
        if before.abs() >= limit && fa.abs() > fb.abs() {
            let s = fb / fa;
            let (mut p, mut q) = if a == c {
                (2.0 * middle * s, 1.0 - s)
            } else {
                let (q, r) = (fa / fc, fb / fc);
                (
                    s * (2.0 * middle * q * (q - r) - (b - a) * (r - 1.0)),
                    (q - 1.0) * (r - 1.0) * (s - 1.0),
                )
            };
            if p > 0.0 {
                q = -q;
            } else {
                p = -p;
            }
            if 2.0 * p < (3.0 * middle * q - (limit * q).abs()).min((before * q).abs()) {
                before = step;
                step = p / q;
            } else {
                step = middle;
                before = middle;
            }
        } else {
            step = middle;
            before = middle;
        }
        (a, fa) = (b, fb);
        b += if step.abs() > limit {
            step
        } else {
            limit.copysign(middle)
        };
        fb = f(b);
    }
    b
}

/// Maximum number of steps: that many halvings alone reach rounding.
const MAX_STEPS: u32 = 60;

/// Root of a function that increases from `low` to `high`, by Newton's method inside a bracket.
///
/// A step that leaves the bracket is replaced by halving it. `at` returns the value of the function and the Newton step,
/// which is the value divided by the slope.
///
/// ```
/// let root = centrode_geometry::bracketed_newton(|x| (x * x - 2.0, (x * x - 2.0) / (2.0 * x)), 1.0, 2.0, 1.5);
/// assert!((root - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn bracketed_newton(
    mut at: impl FnMut(f64) -> (f64, f64),
    mut low: f64,
    mut high: f64,
    start: f64,
) -> f64 {
    let last_step = ITERATED * (high - low);
    let mut t = start;
    for _ in 0..MAX_STEPS {
        let (value, step) = at(t);
        if value > 0.0 {
            high = t;
        } else {
            low = t;
        }
        let next = t - step;
        t = if next >= low && next <= high {
            next
        } else {
            0.5 * (low + high)
        };
        if step.abs() <= last_step {
            break;
        }
    }
    t
}

/// Argument and value of a minimum of `f` inside `[low, high]`, by Brent's method: golden section and parabolas.
///
/// The value is exact to the float limit. The argument of a smooth `f` is exact to the square root of that.
pub fn bracketed_minimum(mut f: impl FnMut(f64) -> f64, low: f64, high: f64) -> (f64, f64) {
    let x = low + GOLDEN * (high - low);
    let value = (x, f(x));
    brent_minimum(f, [low, high], [value; 3], |_, _| false)
}

/// Argument and value of a minimum of `f` between the first and the last of three pairs of argument and value.
///
/// The middle pair has the minimum value of the three. The search stops early in two cases:
/// 1. the last two steps changed the value by at most `rounding`;
/// 2. three more such changes would not bring the value below `known`.
pub fn bracketed_minimum_below(
    f: impl FnMut(f64) -> f64,
    [low, middle, high]: [(f64, f64); 3],
    known: f64,
    rounding: f64,
) -> (f64, f64) {
    brent_minimum(f, [low.0, high.0], [middle, low, high], |value, change| {
        change <= rounding || value - 3.0 * change >= known
    })
}

/// Fraction of an interval at which golden section divides it.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Brent's method from three pairs of argument and value, the minimum first.
///
/// It stops if `stops` returns true for the minimum value so far and the larger change of the last two steps.
fn brent_minimum(
    mut f: impl FnMut(f64) -> f64,
    [low, high]: [f64; 2],
    [(mut x, mut fx), (mut w, mut fw), (mut v, mut fv)]: [(f64, f64); 3],
    stops: impl Fn(f64, f64) -> bool,
) -> (f64, f64) {
    let (mut a, mut b) = (low, high);
    // Three different points allow a parabola in the first step.
    let start = if w == x { 0.0 } else { high - low };
    let (mut d, mut e) = (start, start);
    let mut changes = [f64::INFINITY; 2];
    for _ in 0..120 {
        crate::checkpoint();
        if stops(fx, changes[0].max(changes[1])) {
            break;
        }
        let middle = 0.5 * (a + b);
        let limit = 1e-10 * (high - low).abs() + 2.0 * f64::EPSILON * x.abs();
        if (x - middle).abs() <= 2.0 * limit - 0.5 * (b - a) {
            break;
        }
        let mut parabola = false;
        if e.abs() > limit {
            let r = (x - w) * (fx - fv);
            let mut q = (x - v) * (fx - fw);
            let mut p = (x - v) * q - (x - w) * r;
            q = 2.0 * (q - r);
            if q > 0.0 {
                p = -p;
            }
            q = q.abs();
            let last = e;
            e = d;
            if p.abs() < (0.5 * q * last).abs() && p > q * (a - x) && p < q * (b - x) {
                d = p / q;
                let u = x + d;
                if u - a < 2.0 * limit || b - u < 2.0 * limit {
                    d = limit.copysign(middle - x);
                }
                parabola = true;
            }
        }
        if !parabola {
            e = if x < middle { b - x } else { a - x };
            d = GOLDEN * e;
        }
        let u = if d.abs() >= limit {
            x + d
        } else {
            x + limit.copysign(d)
        };
        let fu = f(u);
        changes = [changes[1], (fu - fx).abs()];
        if fu <= fx {
            if u < x {
                b = x;
            } else {
                a = x;
            }
            (v, fv) = (w, fw);
            (w, fw) = (x, fx);
            (x, fx) = (u, fu);
        } else {
            if u < x {
                a = u;
            } else {
                b = u;
            }
            if fu <= fw || w == x {
                (v, fv) = (w, fw);
                (w, fw) = (u, fu);
            } else if fu <= fv || v == x || v == w {
                (v, fv) = (u, fu);
            }
        }
    }
    (x, fx)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_to_the_float_limit() {
        let f = |x: f64| x.cos() - x;
        let x = bracketed_root(f, 0.0, 1.0, f(0.0), f(1.0));
        assert!(f(x).abs() < 1e-15);
        let steep = |x: f64| (x - 0.3).powi(9);
        assert!((bracketed_root(steep, -1.0, 2.0, steep(-1.0), steep(2.0)) - 0.3).abs() < 1e-4);
        assert_eq!(bracketed_root(|x| x, 0.0, 1.0, 0.0, 1.0), 0.0);
    }

    #[test]
    fn a_minimum_with_a_kink_is_found() {
        let (x, v) = bracketed_minimum(|x| (x - 0.7).abs(), -2.0, 3.0);
        assert!((x - 0.7).abs() < 1e-9 && v < 1e-9);
        let (x, v) = bracketed_minimum(|x| (x - 0.7).powi(2) + 2.0, -2.0, 3.0);
        assert!((x - 0.7).abs() < 1e-7 && (v - 2.0).abs() < 1e-15);
    }

    #[test]
    fn a_minimum_above_a_known_value_is_not_refined() {
        let search = |known: f64, rounding: f64| {
            let evaluations = std::cell::Cell::new(0);
            let f = |x: f64| {
                evaluations.set(evaluations.get() + 1);
                2.0 + (x - 0.7).powi(2) + 0.1 * (x - 0.7).powi(4)
            };
            let points = [-2.0, 0.0, 3.0].map(|x| (x, f(x)));
            evaluations.set(0);
            let (_, value) = bracketed_minimum_below(f, points, known, rounding);
            (evaluations.get(), value - 2.0)
        };
        let (few, some) = search(1.0, 1e-12);
        let (more, near) = search(3.0, 1e-12);
        assert!(few < more && more < 14, "{few} {more}");
        assert!(some < 0.1 && near < 1e-12, "{some} {near}");
    }
}
