use nalgebra::UnitComplex;

use crate::{
    Point, Vector,
    numeric::{POSITION, Tolerance},
};

/// Number of interpolation nodes of a [`PolySegment`] of degree thirteen. Fewer need more segments per curve, more cost time
/// per segment; [`GAUSS_NODES`](crate::numeric::GAUSS_NODES) depends on it.
pub(crate) const NODES: usize = 14;

/// A polynomial curve segment of degree thirteen on the parameter interval `[-1, 1]`.
///
/// It interpolates an exact curve at Chebyshev-Lobatto nodes. Both ends lie on the curve to rounding; the error between
/// them decreases with the fourteenth power of the length of the segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolySegment {
    start: Point,
    end: Point,
    /// Monomial coefficients in `u`, constant first.
    coefficients: [Vector; NODES],
}

/// A polynomial segment and the part of a curve that it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedSpan {
    /// The segment.
    pub poly: PolySegment,
    /// Parameter of the curve at its start.
    pub from: f64,
    /// Parameter of the curve at its end.
    pub to: f64,
}

/// Position, first and second derivative of a segment in its own parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentJet {
    /// Position, mm.
    pub point: Point,
    /// First derivative.
    pub first: Vector,
    /// Second derivative.
    pub second: Vector,
}

impl PolySegment {
    /// Interpolates `curve` over `[t0, t1]`; also returns the estimated maximum distance from it, mm.
    ///
    /// The estimate is the size of the last two Chebyshev coefficients.
    pub(crate) fn interpolate(
        curve: &mut impl FnMut(f64) -> Point,
        t0: f64,
        t1: f64,
    ) -> (Self, f64) {
        let tables = tables();
        let middle = 0.5 * (t0 + t1);
        let half = 0.5 * (t1 - t0);
        let mut values = [Point::origin(); NODES];
        let inner = values.iter_mut().zip(&tables.nodes);
        for (value, node) in inner.take(NODES - 1).skip(1) {
            *value = curve(middle + half * node);
        }
        // The end points are taken at the exact parameters, without rounding.
        values[0] = curve(t1);
        values[NODES - 1] = curve(t0);
        Self::through(&values, tables)
    }

    /// The polynomial through the values at the nodes, and the estimated error.
    fn through(values: &[Point; NODES], tables: &Tables) -> (Self, f64) {
        let mut chebyshev = [Vector::zeros(); NODES];
        for (k, c) in chebyshev.iter_mut().enumerate() {
            for (j, v) in values.iter().enumerate() {
                *c += v.coords * tables.transform[k][j];
            }
        }
        let error = chebyshev[NODES - 1].norm() + chebyshev[NODES - 2].norm();
        let mut coefficients = [Vector::zeros(); NODES];
        for (k, c) in chebyshev.iter().enumerate() {
            for (power, weight) in tables.monomial[k].iter().enumerate().take(k + 1) {
                coefficients[power] += c * *weight;
            }
        }
        let poly = Self {
            start: values[NODES - 1],
            end: values[0],
            coefficients,
        };
        (poly, error)
    }

    /// Splits `[t0, t1]` until every segment's estimated error is below the tolerance.
    ///
    /// The segments join exactly: each starts at the end point of the previous one. If `t1` is below `t0`, they follow the
    /// curve backwards.
    #[must_use]
    pub fn fit(
        curve: impl FnMut(f64) -> Point,
        t0: f64,
        t1: f64,
        tolerance: Tolerance,
    ) -> Vec<Self> {
        let spans = Self::fit_spans(curve, t0, t1, tolerance);
        spans.into_iter().map(|span| span.poly).collect()
    }

    /// Splits `[t0, t1]` like [`fit`](Self::fit); each segment comes with its interval of the curve's parameter.
    #[must_use]
    pub fn fit_spans(
        curve: impl FnMut(f64) -> Point,
        t0: f64,
        t1: f64,
        tolerance: Tolerance,
    ) -> Vec<FittedSpan> {
        // The number of halvings is limited to sixteen.
        Self::fit_spans_at_most(usize::MAX, curve, [t0, t1], tolerance).unwrap_or_default()
    }

    /// Splits an interval like [`fit_spans`](Self::fit_spans); `None` if that takes more than `max_count` segments.
    #[must_use]
    pub fn fit_spans_at_most(
        max_count: usize,
        mut curve: impl FnMut(f64) -> Point,
        [t0, t1]: [f64; 2],
        tolerance: Tolerance,
    ) -> Option<Vec<FittedSpan>> {
        let mut out: Vec<FittedSpan> = Vec::new();
        let mut stack = vec![(t0, t1, 0_u32)];
        while let Some((a, b, depth)) = stack.pop() {
            crate::checkpoint();
            let (mut poly, error) = Self::interpolate(&mut curve, a, b);
            // Halving does not help below the rounding of the points, nor at a jump of the curve.
            let rounding = POSITION * poly.start.coords.amax().max(poly.end.coords.amax());
            if error <= tolerance.mm().max(rounding) || depth >= 16 || error.is_nan() {
                if let Some(last) = out.last() {
                    poly.start = last.poly.end;
                }
                out.push(FittedSpan {
                    poly,
                    from: a,
                    to: b,
                });
            } else {
                let middle = 0.5 * (a + b);
                stack.push((middle, b, depth + 1));
                stack.push((a, middle, depth + 1));
                if out.len() + stack.len() > max_count {
                    return None;
                }
            }
        }
        Some(out)
    }

    /// Length, mm, of the polygon of `count` chords with equal steps of the parameter.
    #[must_use]
    pub fn chord_length(&self, count: u32) -> f64 {
        let point = |i: u32| self.at(-1.0 + 2.0 * f64::from(i) / f64::from(count)).point;
        (0..count).map(|i| (point(i + 1) - point(i)).norm()).sum()
    }

    /// The segment between two points with monomial coefficients in `u` on `[-1, 1]`, constant first.
    #[must_use]
    pub fn new(start: Point, end: Point, coefficients: [Vector; NODES]) -> Self {
        Self {
            start,
            end,
            coefficients,
        }
    }

    /// Start point, `u = -1`.
    #[must_use]
    pub fn start(&self) -> Point {
        self.start
    }

    /// End point, `u = 1`.
    #[must_use]
    pub fn end(&self) -> Point {
        self.end
    }

    /// Monomial coefficients in `u` on `[-1, 1]`, constant first.
    #[must_use]
    pub fn coefficients(&self) -> &[Vector] {
        &self.coefficients
    }

    /// Position and two derivatives at `u` in `[-1, 1]`.
    #[must_use]
    pub fn at(&self, u: f64) -> SegmentJet {
        let c = &self.coefficients;
        let mut p = c[NODES - 1];
        let mut d = Vector::zeros();
        let mut s = Vector::zeros();
        for k in (0..NODES - 1).rev() {
            s = s * u + d;
            d = d * u + p;
            p = p * u + c[k];
        }
        SegmentJet {
            point: Point::from(p),
            first: d,
            second: s * 2.0,
        }
    }

    /// The segment in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut coefficients = self.coefficients;
        for c in coefficients.iter_mut().skip(1).step_by(2) {
            *c = -*c;
        }
        Self {
            start: self.end,
            end: self.start,
            coefficients,
        }
    }

    /// The segment turned about the origin.
    #[must_use]
    pub fn turned(&self, turn: &UnitComplex<f64>) -> Self {
        self.mapped(|p| turn * p, |v| turn * v)
    }

    /// The mirror image about the x axis.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        self.mapped(|p| Point::new(p.x, -p.y), |v| Vector::new(v.x, -v.y))
    }

    /// The image under an affine map with the linear part `vector`.
    pub(crate) fn mapped(
        &self,
        point: impl Fn(&Point) -> Point,
        vector: impl Fn(&Vector) -> Vector,
    ) -> Self {
        let mut coefficients = self.coefficients;
        for c in &mut coefficients {
            *c = vector(c);
        }
        coefficients[0] = point(&Point::from(self.coefficients[0])).coords;
        Self {
            start: point(&self.start),
            end: point(&self.end),
            coefficients,
        }
    }

    /// The part between `u0` and `u1`, itself on `[-1, 1]`.
    #[must_use]
    pub fn part(&self, u0: f64, u1: f64) -> Self {
        if (u0, u1) == (-1.0, 1.0) {
            return *self;
        }
        let middle = 0.5 * (u0 + u1);
        let half = 0.5 * (u1 - u0);
        let mut values = [Point::origin(); NODES];
        for (value, &node) in values.iter_mut().zip(&tables().nodes) {
            *value = self.at(middle + half * node).point;
        }
        let mut poly = Self::through(&values, tables()).0;
        if u0 == -1.0 {
            poly.start = self.start;
        }
        if u1 == 1.0 {
            poly.end = self.end;
        }
        poly
    }

    /// The segment moved so that it starts and ends exactly at the given points.
    ///
    /// The correction is linear in the parameter. Use it only for end points that differ by rounding.
    #[must_use]
    pub fn pinned(&self, start: Point, end: Point) -> Self {
        let mut out = *self;
        let at_start = start - self.at(-1.0).point;
        let at_end = end - self.at(1.0).point;
        out.coefficients[0] += 0.5 * (at_start + at_end);
        out.coefficients[1] += 0.5 * (at_end - at_start);
        out.start = start;
        out.end = end;
        out
    }
}

/// Constants of the interpolation.
struct Tables {
    nodes: [f64; NODES],
    transform: [[f64; NODES]; NODES],
    monomial: [[f64; NODES]; NODES],
}

fn tables() -> &'static Tables {
    static TABLES: std::sync::OnceLock<Tables> = std::sync::OnceLock::new();
    TABLES.get_or_init(|| {
        let n = NODES - 1;
        let pi = std::f64::consts::PI;
        let mut nodes = [0.0; NODES];
        let mut transform = [[0.0; NODES]; NODES];
        let mut monomial = [[0.0; NODES]; NODES];
        for (j, node) in nodes.iter_mut().enumerate() {
            *node = (pi * j as f64 / n as f64).cos();
        }
        for (k, row) in transform.iter_mut().enumerate() {
            for (j, weight) in row.iter_mut().enumerate() {
                let ends = |i: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
                *weight =
                    2.0 / n as f64 * ends(k) * ends(j) * (pi * (k * j) as f64 / n as f64).cos();
            }
        }
        monomial[0][0] = 1.0;
        monomial[1][1] = 1.0;
        for k in 2..NODES {
            for power in 0..=k {
                let doubled = if power == 0 {
                    0.0
                } else {
                    2.0 * monomial[k - 1][power - 1]
                };
                monomial[k][power] = doubled - monomial[k - 2][power];
            }
        }
        Tables {
            nodes,
            transform,
            monomial,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(t: f64) -> Point {
        Point::new(10.0 * t.cos(), 10.0 * t.sin())
    }

    #[test]
    fn fit_stays_within_each_tolerance() {
        for exponent in 2..12 {
            let tolerance = Tolerance::new(10_f64.powi(-exponent)).expect("positive");
            let polys = PolySegment::fit(circle, 0.0, 6.0, tolerance);
            for s in &polys {
                for i in 0..=50 {
                    let p = s.at(-1.0 + f64::from(i) / 25.0).point;
                    assert!((p.coords.norm() - 10.0).abs() < tolerance.mm().max(1e-13));
                }
            }
            assert!(polys.windows(2).all(|w| w[0].end() == w[1].start()));
        }
    }

    #[test]
    fn parts_reversal_and_derivatives_agree_with_the_circle() {
        let (s, _) = PolySegment::interpolate(&mut circle, 0.2, 0.9);
        let jet = s.at(0.3);
        let t = 0.55_f64 + 0.35 * 0.3;
        assert!((jet.first - Vector::new(-t.sin(), t.cos()) * 3.5).norm() < 1e-9);
        assert!((jet.second + jet.point.coords * 0.35 * 0.35).norm() < 1e-8);
        assert!((s.reversed().at(-0.3).point - jet.point).norm() < 1e-14);
        assert!((s.part(-0.5, 0.7).at(0.0).point - s.at(0.1).point).norm() < 1e-13);
    }
}
