use super::*;
use crate::gear::pitch::{Bspline, PitchSpec};

#[test]
fn a_knot_where_the_cycle_starts_is_its_start_whatever_the_rounding() {
    for degree in 2..=5 {
        for count in 6..30 {
            let step = TAU / f64::from(count);
            let spline = Bspline {
                degree,
                interpolate: true,
                radius: (0..count).map(|i| 30.0 + f64::from(i * i % 7)).collect(),
                angle: (0..count).map(|i| step * f64::from(i)).collect(),
                ..Bspline::default()
            };
            let curve = PitchSpec::Bspline(spline).resolve().expect("a curve").curve;
            let rolling = Rolling::new(curve, (1, 1)).expect("rolls");
            let (start, end) = (rolling.start, rolling.start + f64::from(count));
            let frame = rolling.frame(Member::Driven, end);
            assert!((frame.arc / rolling.arc.total() - 1.0).abs() < 1e-15);
            assert!(frame.point.coords.norm().is_finite());
            // Between knots there is a whole span, or where the cycle starts inside one, two parts of it.
            let inside = rolling.breaks_between(start, end);
            let spans = inside.windows(2).map(|w| w[1] - w[0]);
            assert!(spans.clone().all(|s| (s - 1.0).abs() < 1e-9), "{inside:?}");
            let knot = degree % 2 == 1;
            assert_eq!(
                inside.len(),
                count as usize - usize::from(knot),
                "{degree} {count}"
            );
        }
    }
}
