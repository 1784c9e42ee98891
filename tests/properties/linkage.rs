//! Linkages against a solver of its own: their constraints are solved as numbers, and twice differentiated.

use std::f64::consts::TAU;

use centrode_geometry::{Jet, Point, Vector};
use centrode_kinematics::linkage::{Branch, FourBar, LinkId, Linkage, SixBar};
use centrode_kinematics::transmission::MotionJet;
use nalgebra::Matrix2;
use proptest::prelude::{Just, ProptestConfig, Strategy, any, prop_assert, prop_oneof, proptest};

/// Minimum transmission angle: nearer to a change point nothing is known to ten digits.
const MINIMUM: f64 = 0.25;

/// Two equations that a joint fulfils, each a distance to a moving point.
struct Bars<'a> {
    from: [&'a Motion; 2],
    lengths: [f64; 2],
}

/// A point with its first two derivatives by the crank angle.
#[derive(Clone, Copy, Debug)]
struct Motion([Vector; 3]);

impl Motion {
    fn fixed(at: Point) -> Self {
        Self([at.coords, Vector::zeros(), Vector::zeros()])
    }

    fn crank(length: f64, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let out = Vector::new(cos, sin) * length;
        Self([out, Vector::new(-out.y, out.x), -out])
    }

    /// A point fixed to the bar from `self` to `other`, in its axes.
    fn carried(&self, other: &Self, length: f64, local: Vector) -> Self {
        let along = |k: usize| (other.0[k] - self.0[k]) / length;
        let left = |v: Vector| Vector::new(-v.y, v.x);
        Self(std::array::from_fn(|k| {
            self.0[k] + along(k) * local.x + left(along(k)) * local.y
        }))
    }
}

/// Newton's method on two equations, each step with their slopes.
fn newton(mut x: Vector, equations: impl Fn(&Vector) -> (Vector, Matrix2<f64>)) -> Option<Vector> {
    for _ in 0..200 {
        let (off, slopes) = equations(&x);
        let step = slopes.lu().solve(&off)?;
        // Far away a whole step may lead anywhere.
        let damped = f64::min(20.0 / step.norm(), 1.0);
        x -= step * damped;
        if step.norm() < 1e-13 * (1.0 + x.norm()) {
            return Some(x);
        }
    }
    None
}

impl Bars<'_> {
    fn ways(&self, at: Vector, order: usize) -> [Vector; 2] {
        self.from.map(|from| at - from.0[order])
    }

    fn slopes(&self, at: Vector) -> Matrix2<f64> {
        let [p, q] = self.ways(at, 0);
        Matrix2::new(p.x, p.y, q.x, q.y) * 2.0
    }

    /// The joint on the side asked for, from a guess there.
    fn joint(&self, branch: Branch) -> Option<Motion> {
        let [p, q] = self.from.map(|from| from.0[0]);
        let way = q - p;
        let left = Vector::new(-way.y, way.x) * branch.sign();
        let guess = p + way * 0.5 + left * (0.5 * self.lengths[0] / way.norm());
        let at = newton(guess, |at| {
            let ways = self.ways(*at, 0);
            let off = [0, 1].map(|i| ways[i].norm_squared() - self.lengths[i].powi(2));
            (off.into(), self.slopes(*at))
        })?;
        if way.perp(&(at - p)) * branch.sign() <= 0.0 {
            return None;
        }
        // d/dphi |c - p|^2 = 0, once and twice.
        let slopes = self.slopes(at).lu();
        let ways = self.ways(at, 0);
        let moved = [0, 1].map(|i| 2.0 * ways[i].dot(&self.from[i].0[1]));
        let first: Vector = slopes.solve(&Vector::from(moved))?;
        let rates = self.ways(first, 1);
        let bent =
            [0, 1].map(|i| 2.0 * ways[i].dot(&self.from[i].0[2]) - 2.0 * rates[i].norm_squared());
        let second: Vector = slopes.solve(&Vector::from(bent))?;
        Some(Motion([at, first, second]))
    }
}

/// Direction and distance of a point from a pivot, with two derivatives: the equations of a slider in its guide.
fn guided(c: &Motion, pivot: Point, near: f64) -> Option<[[f64; 2]; 3]> {
    let way = c.0[0] - pivot.coords;
    let guess = Vector::from([near, way.norm()]);
    let slopes = |x: &Vector| {
        let (sin, cos) = x[0].sin_cos();
        Matrix2::new(-x[1] * sin, cos, x[1] * cos, sin)
    };
    let x = newton(guess, |x| {
        let (sin, cos) = x[0].sin_cos();
        (Vector::new(cos, sin) * x[1] - way, slopes(x))
    })?;
    let solved = slopes(&x).lu();
    let first = solved.solve(&c.0[1])?;
    let (sin, cos) = x[0].sin_cos();
    let turned = Vector::new(-sin, cos) * (2.0 * first[0] * first[1])
        - Vector::new(cos, sin) * (x[1] * first[0] * first[0]);
    let second = solved.solve(&(c.0[2] - turned))?;
    Some([x, first, second].map(Into::into))
}

fn four_bars() -> impl Strategy<Value = FourBar> {
    let lengths = (
        20.0..60.0_f64,
        65.0..200.0_f64,
        65.0..200.0_f64,
        65.0..200.0_f64,
    );
    (lengths, any::<bool>()).prop_filter_map("a crank-rocker", |((a, b, c, d), upper)| {
        let branch = if upper { Branch::Upper } else { Branch::Lower };
        let four_bar = FourBar::new(a, b, c, d, branch).ok()?;
        let turns = four_bar.grashof_margin() > 2.0 && four_bar.dead_centers().is_some();
        (turns && four_bar.minimum_transmission_angle() > MINIMUM).then_some(four_bar)
    })
}

fn six_bars() -> impl Strategy<Value = SixBar> {
    let pivot = (-100.0..250.0_f64, -200.0..200.0_f64);
    (four_bars(), pivot).prop_filter_map("a pivot off the path", |(four_bar, (x, y))| {
        let six_bar = SixBar::new(four_bar, Point::new(x, y), 200.0).ok()?;
        (six_bar.minimum_slider_distance() > 15.0).then_some(six_bar)
    })
}

/// Maximum difference of a joint from what was solved, as a share of its size.
fn off(found: &Jet, solved: &Motion) -> f64 {
    let pairs = [found.point.coords, found.first, found.second].into_iter();
    let size = |v: Vector| 1.0 + v.norm();
    pairs
        .zip(solved.0)
        .map(|(a, b)| (a - b).norm() / size(b))
        .fold(0.0, f64::max)
}

fn motions_agree(a: MotionJet, b: MotionJet) -> bool {
    let size = 1.0 + a.jerk.abs();
    let off = |a: f64, b: f64| (a - b).abs() <= 1e-12 * size;
    off(a.position, b.position)
        && off(a.velocity, b.velocity)
        && off(a.acceleration, b.acceleration)
        && off(a.jerk, b.jerk)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn a_six_bar_is_where_its_constraints_say(six_bar in six_bars(), input in 0.0..TAU) {
        let [a, b, c, d] = six_bar.four_bar().lengths();
        let crank = Motion::crank(a, input);
        let frame = Motion::fixed(Point::new(d, 0.0));
        let bars = Bars { from: [&crank, &frame], lengths: [b, c] };
        let joint = bars.joint(six_bar.four_bar().branch()).expect("solved");
        let at = six_bar.at(input);
        prop_assert!(off(&at.b, &crank) < 1e-10);
        prop_assert!(off(&at.c, &joint) < 1e-10, "{:?} {joint:?}", at.c);
        let near = at.effector.position + 0.3;
        let effector = guided(&joint, six_bar.pivot(), near).expect("solved");
        let found = [at.effector.position, at.effector.velocity, at.effector.acceleration];
        for (found, [solved, _]) in found.into_iter().zip(effector) {
            let difference = (found - solved).abs() / (1.0 + solved.abs());
            prop_assert!(difference < 1e-10, "{found} {solved}");
        }
        let distance = six_bar.slider_distance(input);
        let found = [distance.position, distance.velocity, distance.acceleration];
        for (found, [_, solved]) in found.into_iter().zip(effector) {
            let difference = (found - solved).abs() / (1.0 + solved.abs());
            prop_assert!(difference < 1e-10, "{found} {solved}");
        }
    }

    #[test]
    fn a_six_bar_side_by_side_is_where_it_is_alone(
        six_bar in six_bars(),
        mut inputs in proptest::collection::vec(-50.0..50.0_f64, 0..12),
        odd in proptest::option::of((0..12_usize, prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(1e7)])),
    ) {
        if let Some((place, value)) = odd && place < inputs.len() {
            inputs[place] = value;
        }
        let all = six_bar.at_each(&inputs);
        let joints = six_bar.joints_each(&inputs);
        let angles = six_bar.effector_angle_each(&inputs);
        prop_assert!(all.len() == inputs.len() && joints.len() == inputs.len() && angles.len() == inputs.len());
        for (i, &input) in inputs.iter().enumerate() {
            let (alone, beside) = (six_bar.at(input), all[i]);
            if !input.is_finite() {
                let found = [beside.b, beside.c, beside.e].map(|j| j.point.x + j.point.y);
                prop_assert!(found.iter().all(|x| x.is_nan()));
                prop_assert!(beside.effector.position.is_nan() && joints[i].iter().all(|p| p.x.is_nan()));
                continue;
            }
            // Near a dead centre digits of the highest derivatives are lost in either way.
            for (a, b) in [(alone.b, beside.b), (alone.c, beside.c), (alone.e, beside.e)] {
                for (a, b) in [(a.point.coords, b.point.coords), (a.first, b.first), (a.second, b.second), (a.third, b.third)] {
                    prop_assert!((a - b).norm() <= 1e-12 * (200.0 + a.norm()), "{a} {b}");
                }
            }
            prop_assert!(motions_agree(alone.effector, beside.effector));
            prop_assert!(motions_agree(six_bar.effector_angle(input), angles[i]));
            for (a, b) in six_bar.joints(input).into_iter().zip(joints[i]) {
                prop_assert!((a - b).norm() <= 1e-12 * 200.0);
            }
            // Bits do not depend on what is worked out next to.
            prop_assert!(six_bar.at_each(&[input]) == [beside]);
        }
    }

    #[test]
    fn a_chain_of_two_dyads_is_where_its_constraints_say(
        four_bar in four_bars(),
        local in (-80.0..80.0_f64, -80.0..80.0_f64),
        pivot in (-100.0..250.0_f64, -200.0..200.0_f64),
        lengths in (60.0..200.0_f64, 60.0..200.0_f64),
        upper in any::<bool>(),
        input in 0.0..TAU,
    ) {
        let [a, b, c, d] = four_bar.lengths();
        let branch = if upper { Branch::Upper } else { Branch::Lower };
        let (pivot, local) = (Point::new(pivot.0, pivot.1), Vector::new(local.0, local.1));
        let build = || {
            let mut linkage = Linkage::new();
            let at_a = linkage.point(LinkId::FRAME, Point::origin())?;
            let at_d = linkage.point(LinkId::FRAME, Point::new(d, 0.0))?;
            let at_g = linkage.point(LinkId::FRAME, pivot)?;
            let (_, at_b) = linkage.crank(at_a, a, 0.0)?;
            let bars = linkage.rrr(at_b, at_d, (b, c), four_bar.branch())?;
            let carried = linkage.point(bars.first, Point::from(local))?;
            let second = linkage.rrr(carried, at_g, lengths, branch)?;
            Ok::<_, centrode_kinematics::linkage::LinkageError>((linkage, carried, second.joint))
        };
        let (linkage, carried, joint) = build().expect("a linkage");
        let crank = Motion::crank(a, input);
        let frame = Motion::fixed(Point::new(d, 0.0));
        let first = Bars { from: [&crank, &frame], lengths: [b, c] };
        let c_at = first.joint(four_bar.branch()).expect("solved");
        let p = crank.carried(&c_at, b, local);
        let ground = Motion::fixed(pivot);
        let (long, way) = (lengths.0 + lengths.1, (p.0[0] - pivot.coords).norm());
        let short = (lengths.0 - lengths.1).abs();
        let pose = linkage.at(input);
        // Which dyads close is a matter of two lengths.
        prop_assert!(pose.is_ok() == (way < long && way > short));
        let cosine = (lengths.0.powi(2) + lengths.1.powi(2) - way * way) / (2.0 * lengths.0 * lengths.1);
        if cosine.abs() < MINIMUM.cos() {
            let pose = pose.expect("closes");
            let second = Bars { from: [&p, &ground], lengths: [lengths.0, lengths.1] };
            let solved = second.joint(branch).expect("solved");
            prop_assert!(off(&pose.joint(carried), &p) < 1e-10);
            prop_assert!(off(&pose.joint(joint), &solved) < 1e-10);
        }
    }
}
