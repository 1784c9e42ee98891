use crate::{
    Point, Vector,
    curve::{NODES, Segment},
    numeric::{GAUSS_NODES, gauss_legendre},
    region::Outline,
};

/// Area, first and second moments about the origin of the region inside an [`Outline`].
///
/// For a clockwise outline all have the opposite sign.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AreaMoments {
    /// `∫ dA`, mm².
    pub area: f64,
    /// `∫ (x, y) dA`, mm³.
    pub first: Vector,
    /// `∫ x² dA`, mm⁴.
    pub xx: f64,
    /// `∫ x y dA`, mm⁴.
    pub xy: f64,
    /// `∫ y² dA`, mm⁴.
    pub yy: f64,
}

impl AreaMoments {
    /// Center of area, `first / area`.
    #[must_use]
    pub fn centroid(&self) -> Point {
        Point::from(self.first / self.area)
    }

    /// Moments minus those of a region that is cut out.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        self.plus(other.times(-1.0))
    }

    /// All moments times a factor.
    pub(crate) fn times(self, k: f64) -> Self {
        Self {
            area: k * self.area,
            first: k * self.first,
            xx: k * self.xx,
            xy: k * self.xy,
            yy: k * self.yy,
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            first: self.first + other.first,
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            yy: self.yy + other.yy,
        }
    }
}

// Green's theorem integrates x³ y', of degree 4 (NODES - 1) - 1 on a polynomial segment, exactly.
const _: () = assert!(4 * (NODES - 1) <= 2 * GAUSS_NODES);

impl Segment {
    /// Number of equal parts on which the quadrature rule is exact to rounding.
    fn parts(&self) -> usize {
        match self {
            Self::Arc(arc) => (arc.sweep().abs() / std::f64::consts::FRAC_PI_2)
                .ceil()
                .max(1.0) as usize,
            Self::Line(..) | Self::Poly(_) => 1,
        }
    }
}

impl Outline {
    /// Area and moments about the origin by Green's theorem, exact to rounding.
    #[must_use]
    pub fn moments(&self) -> AreaMoments {
        let mut sum = AreaMoments::default();
        for segment in self.segments() {
            let parts = segment.parts();
            for part in 0..parts {
                let at = |k: usize| -1.0 + 2.0 * k as f64 / parts as f64;
                gauss_legendre(at(part), at(part + 1), |u, w| {
                    let jet = segment.at(u);
                    let (x, y) = (jet.point.x, jet.point.y);
                    let (dx, dy) = (w * jet.first.x, w * jet.first.y);
                    sum.area += 0.5 * (x * dy - y * dx);
                    sum.first.x += 0.5 * x * x * dy;
                    sum.first.y -= 0.5 * y * y * dx;
                    sum.xx += x * x * x * dy / 3.0;
                    sum.xy += 0.5 * x * x * y * dy;
                    sum.yy -= y * y * y * dx / 3.0;
                });
            }
        }
        sum
    }

    /// Enclosed area, mm², exact to rounding; negative for a clockwise outline.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.moments().area
    }

    /// Center of the enclosed area.
    #[must_use]
    pub fn centroid(&self) -> Point {
        self.moments().centroid()
    }

    /// Length of the contour, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.segments().iter().map(Segment::length).sum()
    }

    /// Whether the outline runs counter-clockwise, so that the enclosed area lies to its left.
    #[must_use]
    pub fn is_counter_clockwise(&self) -> bool {
        self.area() > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        curve::{Arc, PolySegment},
        numeric::Tolerance,
    };
    use std::f64::consts::PI;

    #[test]
    fn an_ellipse_of_polynomials_has_the_closed_forms() {
        let (a, b, x0, y0) = (7.0, 4.0, 2.0, -3.0);
        let tolerance = Tolerance::new(1e-12).expect("positive");
        let ellipse = |t: f64| Point::new(x0 + a * t.cos(), y0 + b * t.sin());
        let polys = PolySegment::fit(ellipse, 0.0, 2.0 * PI, tolerance);
        let (first, last) = (polys[0].start(), polys.len() - 1);
        let mut segments: Vec<Segment> = polys.into_iter().map(Segment::from).collect();
        if let Segment::Poly(poly) = segments[last] {
            segments[last] = poly.pinned(poly.start(), first).into();
        }
        let outline = Outline::new(segments).expect("closed");
        let m = outline.moments();
        let area = PI * a * b;
        assert!((m.area - area).abs() < 1e-10);
        assert!((m.centroid() - Point::new(x0, y0)).norm() < 1e-11);
        assert!((m.xx - area * (a * a / 4.0 + x0 * x0)).abs() < 1e-8);
        assert!((m.yy - area * (b * b / 4.0 + y0 * y0)).abs() < 1e-8);
        assert!((m.xy - area * x0 * y0).abs() < 1e-8);
        // Perimeter by Ramanujan's second formula, good to 1e-9 at this eccentricity.
        let h = ((a - b) / (a + b)).powi(2);
        let perimeter = PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()));
        assert!((outline.length() - perimeter).abs() < 1e-6);
        assert!(outline.is_counter_clockwise() && !outline.reversed().is_counter_clockwise());
    }

    #[test]
    fn a_stadium_of_lines_and_arcs_has_the_closed_forms() {
        let p = Point::new;
        let outline = Outline::new(vec![
            Segment::Line(p(0.0, -2.0), p(10.0, -2.0)),
            Segment::Arc(Arc {
                start: p(10.0, -2.0),
                end: p(10.0, 2.0),
                bulge: 1.0,
            }),
            Segment::Line(p(10.0, 2.0), p(0.0, 2.0)),
            Segment::Arc(Arc {
                start: p(0.0, 2.0),
                end: p(0.0, -2.0),
                bulge: 1.0,
            }),
        ])
        .expect("closed");
        assert!((outline.area() - (40.0 + 4.0 * PI)).abs() < 1e-12);
        assert!((outline.length() - (20.0 + 4.0 * PI)).abs() < 1e-12);
        assert!((outline.centroid() - p(5.0, 0.0)).norm() < 1e-12);
    }
}
