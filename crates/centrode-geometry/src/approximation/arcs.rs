use super::{
    arc_chains::{ArcChains, Beam},
    smooth_run::Run,
};
use crate::{numeric::Tolerance, region::Outline};

impl Outline {
    /// The outline as lines and arcs only, nowhere farther from it than the tolerance.
    ///
    /// Lines, arcs and corners stay exact. The curves between them become arcs that join without a kink. A tenth of the
    /// tolerance needs about twice the number of arcs.
    #[must_use]
    pub fn arcs(&self, tolerance: Tolerance) -> Self {
        self.arcs_with(tolerance, Beam::THOROUGH)
    }

    /// Like [`arcs`](Self::arcs), for display: a few more arcs in a fraction of the time.
    #[must_use]
    pub fn display_arcs(&self, tolerance: Tolerance) -> Self {
        self.arcs_with(tolerance, Beam::QUICK)
    }

    fn arcs_with(&self, tolerance: Tolerance, beam: Beam) -> Self {
        // The check between nodes is of fourth order: this spacing leaves an error of 1 % of the tolerance.
        let spacing = tolerance.scaled(0.5);
        let limit = 0.985 * tolerance.mm();
        let mut segments = Vec::new();
        for run in self.runs(spacing) {
            match run {
                Run::Exact(index) => segments.push(self.segments()[index]),
                Run::Smooth { nodes, free } => {
                    ArcChains::new(&nodes, free, limit, beam).shortest(&mut segments);
                }
            }
        }
        Self::from_closed(segments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Point,
        curve::Segment,
        test_shapes::{rosette, tooth_ring},
    };
    use proptest::prelude::{ProptestConfig, prop_assert, proptest};

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    /// Maximum distance from dense points of one outline to the segments of another, both walked.
    fn deviation(outline: &Outline, arcs: &Outline) -> f64 {
        let distance = |p: Point, s: &Segment| match s {
            Segment::Arc(arc) => {
                let (c, r) = (arc.center(), arc.radius());
                let half = 0.5 * arc.sweep().abs();
                let middle = s.at(0.0).point - c;
                let v = p - c;
                if v.perp(&middle).atan2(v.dot(&middle)).abs() <= half {
                    (v.norm() - r).abs()
                } else {
                    (p - arc.start).norm().min((p - arc.end).norm())
                }
            }
            _ => {
                let (a, b) = (s.start(), s.end());
                let t = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
                (p - (a + (b - a) * t)).norm()
            }
        };
        let list = arcs.segments();
        let (mut worst, mut k) = (0.0_f64, 0);
        for segment in outline.segments() {
            for i in 0..=60 {
                let p = segment.at(-1.0 + f64::from(i) / 30.0).point;
                while k + 1 < list.len() && distance(p, &list[k + 1]) < distance(p, &list[k]) {
                    k += 1;
                }
                worst = worst.max(distance(p, &list[k]));
            }
        }
        worst
    }

    fn kinks(outline: &Outline) -> usize {
        outline
            .tangent_jumps()
            .iter()
            .filter(|&&jump| jump > 1e-6)
            .count()
    }

    #[test]
    fn a_toothed_ring_keeps_tolerance_corners_and_arc_count() {
        let outline = tooth_ring(23, 2.25, tolerance(1e-10));
        for tol in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
            let arcs = outline.arcs(tolerance(tol));
            Outline::new(arcs.segments().to_vec()).expect("closed");
            let worst = deviation(&outline, &arcs);
            assert!(worst <= tol, "{tol}: {worst}");
            assert!(worst > 0.2 * tol, "{tol}: {worst} wastes arcs");
            assert_eq!(kinks(&arcs), 46, "{tol}");
            let count = arcs.segments().len();
            assert!(tol < 1e-3 || count <= 400, "{tol}: {count} arcs");
            assert!((arcs.area() - outline.area()).abs() < tol * outline.length());
        }
    }

    #[test]
    fn display_arcs_keep_tolerance_and_corners_with_hardly_more_arcs() {
        for outline in [
            tooth_ring(23, 2.25, tolerance(1e-10)),
            rosette(40.0, 6.0, 5, tolerance(1e-10)),
        ] {
            for tol in [1e-1, 1e-2, 1e-3, 1e-4] {
                let (display, thorough) = (
                    outline.display_arcs(tolerance(tol)),
                    outline.arcs(tolerance(tol)),
                );
                Outline::new(display.segments().to_vec()).expect("closed");
                let worst = deviation(&outline, &display);
                assert!(worst <= tol, "{tol}: {worst}");
                assert_eq!(kinks(&display), kinks(&thorough), "{tol}");
                let [more, few] = [display, thorough].map(|arcs| arcs.segments().len());
                assert!(4 * more <= 5 * few, "{tol}: {more} arcs instead of {few}");
            }
        }
    }

    #[test]
    fn lines_and_arcs_come_back_as_they_were() {
        let p = Point::new;
        let stadium = Outline::new(vec![
            Segment::Line(p(0.0, -2.0), p(10.0, -2.0)),
            Segment::Arc(crate::Arc {
                start: p(10.0, -2.0),
                end: p(10.0, 2.0),
                bulge: 1.0,
            }),
            Segment::Line(p(10.0, 2.0), p(0.0, 2.0)),
            Segment::Arc(crate::Arc {
                start: p(0.0, 2.0),
                end: p(0.0, -2.0),
                bulge: 1.0,
            }),
        ])
        .expect("closed");
        assert_eq!(stadium.arcs(tolerance(1e-3)), stadium);
    }

    #[test]
    fn polynomials_on_a_circle_become_few_arcs_of_its_radius() {
        let arcs = rosette(10.0, 0.0, 1, tolerance(1e-11)).arcs(tolerance(1e-4));
        assert!(arcs.segments().len() <= 6, "{}", arcs.segments().len());
        for segment in arcs.segments() {
            let Segment::Arc(arc) = segment else {
                panic!("an arc")
            };
            assert!((arc.radius() - 10.0).abs() < 1e-6);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn any_smooth_outline_is_followed_within_any_tolerance(
            radius in 5.0..80.0_f64,
            depth in 0.0..0.6_f64,
            lobes in 1_u32..9,
            exponent in 0.0..6.0_f64,
            fit in 1_i32..10,
        ) {
            let wave = radius * depth / f64::from(lobes * lobes).max(2.0);
            let outline = rosette(radius, wave, lobes, tolerance(10_f64.powi(-fit)));
            let tol = tolerance(10_f64.powf(-exponent));
            let arcs = outline.arcs(tol);
            prop_assert!(Outline::new(arcs.segments().to_vec()).is_ok());
            let worst = deviation(&outline, &arcs);
            prop_assert!(worst <= tol.mm(), "{worst}");
            prop_assert!(kinks(&arcs) <= kinks(&outline));
            let large = outline.scaled(16.0).arcs(tol.scaled(16.0));
            prop_assert!(large.segments().len() == arcs.segments().len());
        }
    }
}
