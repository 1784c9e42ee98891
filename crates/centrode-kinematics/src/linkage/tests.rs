use std::f64::consts::{FRAC_PI_2, PI, TAU};

use centrode_geometry::{Jet, Point, Vector};
use proptest::prelude::{Strategy, prop_assert, prop_assert_eq, proptest};

use super::{
    Branch, FourBar, Grashof, JointId, Line, LinkId, Linkage, LinkageError, SixBar, SliderCrank,
};
use crate::transmission::{MotionJet, Transmission};

mod closing;

const PUBLISHED: [f64; 4] = [77.0, 147.0, 127.0, 105.0];
const SIDES: [Branch; 2] = [Branch::Upper, Branch::Lower];

fn four_bar([a, b, c, d]: [f64; 4], branch: Branch) -> FourBar {
    FourBar::new(a, b, c, d, branch).expect("lengths above zero")
}

fn fixed(linkage: &mut Linkage, x: f64, y: f64) -> JointId {
    let joint = linkage.point(LinkId::FRAME, Point::new(x, y));
    joint.expect("finite")
}

/// A four-bar as a composition: linkage, B, the two bars.
fn composed([a, b, c, d]: [f64; 4], branch: Branch) -> (Linkage, JointId, super::TwoBars) {
    let mut linkage = Linkage::new();
    let (at_a, at_d) = (fixed(&mut linkage, 0.0, 0.0), fixed(&mut linkage, d, 0.0));
    let (_, at_b) = linkage.crank(at_a, a, 0.0).expect("a length");
    let bars = linkage.rrr(at_b, at_d, (b, c), branch).expect("lengths");
    (linkage, at_b, bars)
}

fn points_agree(a: &Jet, b: &Jet, tolerance: f64) {
    for (u, v) in [
        (a.point.coords, b.point.coords),
        (a.first, b.first),
        (a.second, b.second),
        (a.third, b.third),
    ] {
        assert!(
            (u - v).norm() <= tolerance * (1.0 + u.norm()),
            "{a:?} {b:?}"
        );
    }
}

fn angles_agree(a: &MotionJet, b: &MotionJet, tolerance: f64) {
    let turns = (a.position - b.position) / TAU;
    assert!((turns - turns.round()).abs() < tolerance, "{a:?} {b:?}");
    for (u, v) in [
        (a.velocity, b.velocity),
        (a.acceleration, b.acceleration),
        (a.jerk, b.jerk),
    ] {
        assert!((u - v).abs() <= tolerance * (1.0 + u.abs()), "{a:?} {b:?}");
    }
}

/// Lengths of a crank-rocker well away from its change point.
fn crank_rockers() -> impl Strategy<Value = [f64; 4]> {
    let lengths = (
        20.0..60.0_f64,
        65.0..200.0_f64,
        65.0..200.0_f64,
        65.0..200.0_f64,
    );
    lengths
        .prop_map(|(a, b, c, d)| [a, b, c, d])
        .prop_filter("a crank-rocker", |&lengths| {
            let four_bar = four_bar(lengths, Branch::Upper);
            four_bar.grashof() == Grashof::CrankRocker && four_bar.grashof_margin() > 2.0
        })
}

#[test]
fn a_parallelogram_turns_as_its_crank_does() {
    // Its links meet in one line at 0 and pi: the upper branch is a parallelogram between them.
    let parallel = four_bar([40.0, 100.0, 40.0, 100.0], Branch::Upper);
    assert_eq!(parallel.grashof(), Grashof::ChangePoint);
    for phi in [0.3, 1.0, 2.0, 3.0] {
        let rocker = parallel.rocker_angle(phi).expect("between");
        let expected = MotionJet {
            position: phi,
            velocity: 1.0,
            acceleration: 0.0,
            jerk: 0.0,
        };
        angles_agree(&rocker, &expected, 1e-11);
        assert!((rocker.position - phi).abs() < 1e-13);
    }
    assert!(parallel.joints(0.0).is_err(), "the branch is open there");
}

#[test]
fn a_slider_crank_follows_its_closed_form() {
    let (a, b, e) = (30.0, 95.0, 12.0);
    for branch in SIDES {
        let slider_crank = SliderCrank::new(a, b, e, branch).expect("lengths");
        let mut linkage = Linkage::new();
        let pivot = fixed(&mut linkage, 0.0, 0.0);
        let (_, pin) = linkage.crank(pivot, a, 0.0).expect("a length");
        let line = Line {
            link: LinkId::FRAME,
            through: Point::new(0.0, e),
            angle: 0.0,
        };
        let dyad = linkage.rrp(pin, b, line, branch).expect("a length");
        for i in 0..40 {
            let phi = 0.17 * f64::from(i);
            let root = (b * b - (e - a * phi.sin()).powi(2)).sqrt();
            let s = branch.sign();
            let slope = (e - a * phi.sin()) * a * phi.cos() / root;
            let x = slider_crank.slider(phi).expect("it turns");
            assert!((x.position - (a * phi.cos() + s * root)).abs() < 1e-13 * b);
            assert!((x.velocity - (-a * phi.sin() + s * slope)).abs() < 1e-13 * b);
            let joint = linkage.at(phi).expect("it turns").joint(dyad.joint);
            let expected = Jet {
                point: Point::new(x.position, e),
                first: Vector::new(x.velocity, 0.0),
                second: Vector::new(x.acceleration, 0.0),
                third: Vector::new(x.jerk, 0.0),
            };
            points_agree(&joint, &expected, 1e-12);
        }
    }
    let centered = SliderCrank::new(30.0, 95.0, 0.0, Branch::Upper).expect("lengths");
    assert!((centered.stroke().expect("it turns") - 60.0).abs() < 1e-12);
}

#[test]
fn a_scotch_yoke_is_a_sine_and_a_guided_link_a_tangent() {
    let mut linkage = Linkage::new();
    let pivot = fixed(&mut linkage, 0.0, 0.0);
    let (_, pin) = linkage.crank(pivot, 25.0, 0.0).expect("a length");
    let along = |angle: f64| Line {
        link: LinkId::FRAME,
        through: Point::new(3.0, 7.0),
        angle,
    };
    let yoke = linkage
        .rpp(pin, along(0.0), FRAC_PI_2)
        .expect("finite numbers");
    let far = fixed(&mut linkage, 80.0, 10.0);
    let guided = linkage.rpr(pin, far, 4.0, Branch::Upper).expect("finite");
    let crossing = linkage
        .prp(
            Line {
                link: guided.link,
                through: Point::new(0.0, 4.0),
                angle: 0.0,
            },
            along(1.0),
        )
        .expect("lines");
    for i in 0..30 {
        let phi = 0.2 * f64::from(i);
        let pose = linkage.at(phi).expect("it turns");
        let x = pose.joint(yoke.joint);
        assert!((x.point.x - 25.0 * phi.cos()).abs() < 1e-13 && x.point.y == 7.0);
        assert!((x.third.x - 25.0 * phi.sin()).abs() < 1e-12);
        // The pin lies on the guided link's line, 4 mm to the left of its pivot.
        let body = pose.body(guided.link);
        let axis = Vector::new(body.angle.position.cos(), body.angle.position.sin());
        let way = pose.joint(pin).point - Point::new(80.0, 10.0);
        assert!((axis.perp(&way) - 4.0).abs() < 1e-12 && axis.dot(&way) > 0.0);
        // The crossing lies on both lines.
        let at = pose.joint(crossing.joint).point;
        assert!((axis.perp(&(at - Point::new(80.0, 10.0))) - 4.0).abs() < 1e-11);
        let slant = Vector::new(1.0_f64.cos(), 1.0_f64.sin());
        assert!(slant.perp(&(at - Point::new(3.0, 7.0))).abs() < 1e-11);
    }
}

/// The published six-bar, a Watt chain (a dyad on coupler and rocker's ternary link) and a Stephenson
/// chain (a dyad from a coupler point to the frame).
#[test]
fn six_bars_are_compositions() {
    let (mut linkage, at_b, bars) = composed(PUBLISHED, Branch::Upper);
    let f = fixed(&mut linkage, 100.0, 67.0);
    let effector = linkage
        .rpr(bars.joint, f, 0.0, Branch::Upper)
        .expect("finite");
    let tip = linkage
        .point(effector.link, Point::new(200.0, 0.0))
        .expect("a point");
    let six_bar = SixBar::new(
        four_bar(PUBLISHED, Branch::Upper),
        Point::new(100.0, 67.0),
        200.0,
    )
    .expect("a six-bar");
    let turning = linkage
        .transmission(effector.link)
        .expect("the crank turns");
    for i in 0..300 {
        let phi = -3.0 + 0.05 * f64::from(i);
        let (pose, place) = (linkage.at(phi).expect("turns"), six_bar.at(phi));
        points_agree(&pose.joint(at_b), &place.b, 1e-12);
        points_agree(&pose.joint(bars.joint), &place.c, 1e-11);
        points_agree(&pose.joint(tip), &place.e, 1e-10);
        let angle = pose.body(effector.link).angle;
        angles_agree(&angle, &place.effector, 1e-10);
        let rocker = six_bar.four_bar().rocker_angle(phi).expect("turns");
        angles_agree(&pose.body(bars.second).angle, &rocker, 1e-10);
        let unwrapped = turning.at(phi);
        let whole = (unwrapped.position - place.effector.position) / TAU;
        assert!((whole - whole.round()).abs() < 1e-12);
        angles_agree(&unwrapped, &place.effector, 1e-10);
    }

    let ternary = linkage
        .point(bars.second, Point::new(70.0, 30.0))
        .expect("a point");
    let ground = fixed(&mut linkage, 250.0, -20.0);
    let watt = linkage
        .rrr(ternary, ground, (140.0, 150.0), Branch::Lower)
        .expect("lengths");
    let coupler = linkage
        .point(bars.first, Point::new(60.0, 40.0))
        .expect("a point");
    let base = fixed(&mut linkage, -120.0, 30.0);
    let stephenson = linkage
        .rrr(coupler, base, (170.0, 160.0), Branch::Upper)
        .expect("lengths");
    assert_eq!(linkage.closing_inputs(), vec![(0.0, TAU)]);
    for i in 0..50 {
        let pose = linkage.at(0.13 * f64::from(i)).expect("it turns");
        let between = |a: JointId, b: JointId| (pose.joint(a).point - pose.joint(b).point).norm();
        assert!((between(ternary, watt.joint) - 140.0).abs() < 1e-11);
        assert!((between(ground, watt.joint) - 150.0).abs() < 1e-11);
        assert!((between(coupler, stephenson.joint) - 170.0).abs() < 1e-11);
        assert!((between(base, stephenson.joint) - 160.0).abs() < 1e-11);
        let moved = pose.body(bars.first).point(Point::new(60.0, 40.0));
        points_agree(&moved, &pose.joint(coupler), 1e-10);
    }
}

#[test]
fn a_linkage_that_cannot_turn_says_where_it_stops() {
    let lengths = [90.0, 65.0, 70.0, 100.0];
    let bar = four_bar(lengths, Branch::Upper);
    assert_eq!(bar.grashof(), Grashof::TripleRocker);
    let (low, high) = bar.crank_limits().expect("it closes");
    // Stretched: cos = (90² + 100² - 135²) / (2 90 100); the frame line itself is passed.
    assert!((high - (-125.0_f64 / 18000.0).acos()).abs() < 1e-14);
    assert_eq!(low, 0.0);
    let (linkage, _, bars) = composed(lengths, Branch::Upper);
    let open = linkage.closing_inputs();
    for &(from, to) in &open {
        assert!(from == 0.0 || (from - (TAU - high)).abs() < 1e-12 || (from - low).abs() < 1e-12);
        assert!(to == TAU || (to - high).abs() < 1e-12 || (to - (TAU - low)).abs() < 1e-12);
    }
    assert!(!open.is_empty());
    let Err(LinkageError::DoesNotClose { missing, .. }) = linkage.at(high + 0.1) else {
        panic!("past the limit");
    };
    let far = (90.0_f64.powi(2) + 100.0_f64.powi(2) - 18000.0 * (high + 0.1).cos()).sqrt();
    assert!((missing - (far - 135.0)).abs() < 1e-12);
    assert!(matches!(
        linkage.transmission(bars.second),
        Err(LinkageError::DoesNotClose { dyad: 0, .. })
    ));
    let Err(super::FourBarError::DoesNotClose { limit, .. }) = bar.rocker_angle(3.0) else {
        panic!("past the limit");
    };
    assert_eq!(limit, high);
}

#[test]
fn grashof_names_what_turns() {
    for (lengths, class) in [
        ([77.0, 147.0, 127.0, 105.0], Grashof::CrankRocker),
        ([105.0, 147.0, 127.0, 77.0], Grashof::DoubleCrank),
        ([127.0, 147.0, 77.0, 105.0], Grashof::RockerCrank),
        ([147.0, 77.0, 127.0, 105.0], Grashof::DoubleRocker),
        ([90.0, 65.0, 70.0, 100.0], Grashof::TripleRocker),
        ([50.0, 80.0, 90.0, 60.0], Grashof::ChangePoint),
    ] {
        let bar = four_bar(lengths, Branch::Upper);
        assert_eq!(bar.grashof(), class);
        let turns = (0..720).all(|i| bar.joints(f64::from(i) * TAU / 720.0 + 1e-4).is_ok());
        let expected = class.crank_turns() || class == Grashof::ChangePoint;
        assert_eq!(turns, expected, "{class:?}");
    }
}

/// A double crank winds: its rocker turns with the crank, without a jump.
#[test]
fn a_double_crank_advances_a_turn_a_turn() {
    let bar = four_bar([105.0, 147.0, 127.0, 77.0], Branch::Lower);
    let law = bar.transmission().expect("it turns");
    assert!((law.at(TAU + 0.4).position - law.at(0.4).position - TAU).abs() < 1e-12);
    let (linkage, _, bars) = composed(bar.lengths(), Branch::Lower);
    let composed = linkage.transmission(bars.second).expect("it turns");
    assert!((composed.advance() - TAU).abs() < 1e-12);
    let mut before = law.at(0.0).position;
    let offset = composed.at(0.0).position - before;
    for i in 1..2000 {
        let phi = 0.01 * f64::from(i);
        let here = law.at(phi).position;
        assert!((here - before).abs() < 0.05);
        assert!((composed.at(phi).position - here - offset).abs() < 1e-11);
        before = here;
    }
}

proptest! {
    #[test]
    fn links_keep_their_lengths_and_the_branch_holds(lengths in crank_rockers(), side in 0..2_usize) {
        let bar = four_bar(lengths, SIDES[side]);
        let d = Point::new(lengths[3], 0.0);
        let mut before: Option<Point> = None;
        for i in 0..=720 {
            let [b, c] = bar.joints(f64::from(i) * TAU / 720.0).expect("the crank turns");
            let size = lengths[1];
            prop_assert!((b.point.coords.norm() - lengths[0]).abs() < 1e-12 * size);
            prop_assert!(((c.point - b.point).norm() - lengths[1]).abs() < 1e-12 * size);
            prop_assert!(((c.point - d).norm() - lengths[2]).abs() < 1e-12 * size);
            let left = (d - b.point).perp(&(c.point - b.point));
            prop_assert!(left * SIDES[side].sign() > 0.0);
            if let Some(before) = before {
                let most = c.first.norm().max(lengths[0]) * TAU / 720.0;
                prop_assert!((c.point - before).norm() < 3.0 * most);
            }
            before = Some(c.point);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_motion(
        lengths in crank_rockers(),
        side in 0..2_usize,
        x in -100.0..200.0_f64,
        y in -300.0..-250.0_f64,
        phi in 0.0..TAU,
    ) {
        let six_bar = SixBar::new(four_bar(lengths, SIDES[side]), Point::new(x, y), 150.0)
            .expect("the pivot is off the path");
        let h = 1e-4;
        let (a, b, c) = (six_bar.at(phi - h), six_bar.at(phi), six_bar.at(phi + h));
        let slope = |f: &dyn Fn(&super::SixBarPosition) -> f64| (f(&c) - f(&a)) / (2.0 * h);
        let near = |found: f64, exact: f64, scale: f64| (found - exact).abs() < 2e-4 * (scale + exact.abs());
        let swift = b.effector.jerk.abs() + b.effector.acceleration.abs() + 1.0;
        prop_assert!(near(slope(&|p| p.effector.position), b.effector.velocity, swift));
        prop_assert!(near(slope(&|p| p.effector.velocity), b.effector.acceleration, swift));
        prop_assert!(near(slope(&|p| p.effector.acceleration), b.effector.jerk, 100.0 * swift));
        prop_assert!(near(slope(&|p| p.e.point.x), b.e.first.x, 150.0 * swift));
        prop_assert!(near(slope(&|p| p.e.first.y), b.e.second.y, 150.0 * swift));
        let effector = six_bar.effector_angle(phi);
        prop_assert!((effector.jerk - b.effector.jerk).abs() < 1e-9 * swift);
    }

    /// The swing in closed form is that of a fine sampling, wherever the pivot is.
    #[test]
    fn the_swing_is_the_range_of_the_angle(
        lengths in crank_rockers(),
        x in -300.0..400.0_f64,
        y in -300.0..300.0_f64,
    ) {
        let six_bar = SixBar::new(four_bar(lengths, Branch::Upper), Point::new(x, y), 150.0)
            .expect("off the path");
        if six_bar.minimum_slider_distance() > 5.0 {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let mut before: Option<f64> = None;
            for i in 0..=4000 {
                let angle = six_bar.effector_angle(f64::from(i) * TAU / 4000.0).position;
                (low, high) = (low.min(angle), high.max(angle));
                if let Some(before) = before {
                    prop_assert!((angle - before).abs() < 0.3, "a jump");
                }
                before = Some(angle);
            }
            prop_assert!(high - low <= six_bar.swing() + 1e-12);
            prop_assert!(high - low > six_bar.swing() - 1e-3);
            for (phi, angle) in [six_bar.extremes().low, six_bar.extremes().high] {
                let there = six_bar.effector_angle(phi);
                prop_assert!((there.position - angle).abs() < 1e-9);
                prop_assert!(there.velocity.abs() < 1e-6);
            }
        }
    }

    #[test]
    fn scaled_lengths_scale_points_and_keep_angles(lengths in crank_rockers(), k in 0.01..100.0_f64, phi in 0.0..TAU) {
        let pivot = Point::new(30.0, -260.0);
        let of = |k: f64| SixBar::new(
            four_bar(lengths.map(|l| l * k), Branch::Upper),
            pivot * k,
            150.0 * k,
        ).expect("a six-bar");
        let (one, other) = (of(1.0), of(k));
        let (p, q) = (one.at(phi), other.at(phi));
        prop_assert!((p.e.point * k - q.e.point).norm() < 1e-11 * k * 200.0);
        prop_assert!((p.effector.position - q.effector.position).abs() < 1e-11);
        prop_assert!((one.swing() - other.swing()).abs() < 1e-11);
    }

    #[test]
    fn pivots_on_the_locus_give_the_swing(lengths in crank_rockers(), degrees in 20.0..240.0_f64, side in 0..2_usize) {
        let bar = four_bar(lengths, SIDES[side]);
        for swing in [degrees.to_radians(), PI] {
            let pivots = SixBar::pivots(&bar, swing, 96);
            let most = PI + 0.5 * bar.rocker_swing().expect("a crank-rocker");
            prop_assert_eq!(pivots.len(), if swing < most - 1e-6 { 96 } else { 0 });
            let spaces: Vec<f64> = pivots.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
            let mean = spaces.iter().sum::<f64>() / spaces.len() as f64;
            // Shorter only across one of the curve's corners, two of which may lie at either end of the chord.
            prop_assert!(spaces.iter().all(|space| space / mean < 1.05), "{spaces:?}");
            prop_assert!(spaces.iter().filter(|&space| space / mean < 0.95).count() <= 4, "{spaces:?}");
            for pivot in pivots {
                let six_bar = SixBar::new(bar, pivot, 10.0).expect("off the path");
                prop_assert!((six_bar.swing() - swing).abs() < 1e-8, "{} {}", six_bar.swing(), swing);
            }
        }
    }

    #[test]
    fn the_swing_sensitivity_is_its_derivative(
        lengths in crank_rockers(),
        x in -300.0..400.0_f64,
        y in -300.0..300.0_f64,
    ) {
        let of = |change: usize, by: f64| {
            let mut lengths = lengths;
            let mut pivot = [x, y];
            if change < 4 { lengths[change] += by } else { pivot[change - 4] += by }
            SixBar::new(four_bar(lengths, Branch::Lower), pivot.into(), 1.0).expect("off the path")
        };
        let six_bar = of(0, 0.0);
        let sensitivity = six_bar.swing_sensitivity();
        let exact = [sensitivity.lengths.as_slice(), sensitivity.pivot.as_slice()].concat();
        if six_bar.minimum_slider_distance() > 5.0 {
            for (k, exact) in exact.into_iter().enumerate() {
                let h = 1e-4;
                let found = (of(k, h).swing() - of(k, -h).swing()) / (2.0 * h);
                prop_assert!((found - exact).abs() < 1e-5 * (1.0 + exact.abs()), "{k}: {found} {exact}");
            }
        }
    }
}
