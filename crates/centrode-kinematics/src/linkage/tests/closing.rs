//! Change points, and where dyads do not close, held against closed forms.

use super::super::NotClosing;
use super::super::four_bar::FourBarError;
use super::*;

/// Change points and gaps of a four-bar by the triangle inequality at its crank angles; a limit is found in steps and by halving.
fn brute([a, b, c, d]: [f64; 4], phase: f64) -> (Vec<f64>, Vec<(f64, f64)>) {
    let room = |input: f64| {
        let diagonal = (a * a + d * d - 2.0 * a * d * (input + phase).cos()).sqrt();
        (b + c - diagonal).min(diagonal - (b - c).abs())
    };
    let rounding = 1e-9 * (a + b + c + d);
    let flat = [0.0, PI].map(|angle| (angle - phase).rem_euclid(TAU));
    let beside = |input: f64| room(input - 1e-3).min(room(input + 1e-3)) > 0.0;
    let mut points: Vec<f64> = flat
        .into_iter()
        .filter(|&input| room(input).abs() < rounding && beside(input))
        .collect();
    points.sort_by(f64::total_cmp);
    let count = 100_000;
    let at = |i: i32| TAU * f64::from(i) / f64::from(count);
    let (mut open, mut start) = (Vec::new(), (room(1e-3) > 0.0).then_some(0.0));
    let half = |mut low: f64, mut high: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (room(middle) > 0.0) == (room(low) > 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    for i in 0..count {
        let apart = |p: &f64| ((at(i) - p + PI).rem_euclid(TAU) - PI).abs();
        let near = points.iter().any(|p| apart(p) < 1e-3);
        match (room(at(i)) > 0.0, room(at(i + 1)) > 0.0) {
            _ if near => {}
            (true, false) => open.push((start.take().unwrap_or(0.0), half(at(i), at(i + 1)))),
            (false, true) => start = Some(half(at(i), at(i + 1))),
            _ => {}
        }
    }
    open.extend(start.map(|start| (start, TAU)));
    (points, open)
}

#[test]
fn change_points_and_limits_are_those_of_the_triangle_inequality() {
    for lengths in [
        [40.0, 80.0, 60.0, 100.0],
        [40.0, 120.0, 40.0, 120.0],
        [120.0, 40.0, 120.0, 40.0],
        [40.0, 120.0, 60.0, 100.0],
        [40.0, 80.0, 20.0, 100.0],
        [0.1, 0.2, 0.15, 0.25],
        [30.0, 70.0, 50.0, 90.0],
        [4e-4, 8e-4, 6e-4, 1e-3],
        [4e5, 8e5, 6e5, 1e6],
        [50.0, 80.0, 90.0, 60.0],
        [33.3, 77.7, 11.1, 55.5],
        // None, and gaps of all sizes.
        [77.0, 147.0, 127.0, 105.0],
        [40.0, 80.0, 60.1, 100.0],
        [40.0, 80.0, 59.9, 100.0],
        [40.0, 80.0, 59.9999, 100.0],
        [40.0, 119.0, 60.0, 100.0],
        [40.0, 122.0, 60.0, 100.0],
        [90.0, 65.0, 70.0, 100.0],
        [100.0, 30.0, 20.0, 100.0],
    ] {
        for phase in [0.0, 0.7, 2.5, -PI / 2.0] {
            let [a, b, c, d] = lengths;
            let (points, open) = brute(lengths, phase);
            let mut linkage = Linkage::new();
            let at_a = fixed(&mut linkage, 0.0, 0.0);
            let at_d = fixed(&mut linkage, d, 0.0);
            let (_, at_b) = linkage.crank(at_a, a, phase).expect("a length");
            let bars = linkage.rrr(at_b, at_d, (b, c), Branch::Lower);
            let bars = bars.expect("lengths");
            let whole = open == [(0.0, TAU)];
            let found = linkage.not_closing();
            assert_eq!(
                found.is_empty(),
                whole && points.is_empty(),
                "{lengths:?} {phase}"
            );
            let [
                NotClosing {
                    open: parts,
                    change_points,
                    missing,
                    ..
                },
            ] = &found[..]
            else {
                assert!(linkage.transmission(bars.second).is_ok());
                assert_eq!(linkage.closing_inputs(), open);
                continue;
            };
            assert_eq!(
                change_points.len(),
                points.len(),
                "{lengths:?} {phase}: {change_points:?}"
            );
            for (one, other) in change_points.iter().zip(&points) {
                assert!(
                    (one - other).abs() < 1e-6,
                    "{lengths:?} {phase}: {one} {other}"
                );
            }
            assert_eq!(
                parts.len(),
                open.len(),
                "{lengths:?} {phase}: {parts:?} {open:?}"
            );
            for (one, other) in parts.iter().zip(&open) {
                let off = (one.0 - other.0).abs() + (one.1 - other.1).abs();
                assert!(off < 1e-8, "{lengths:?} {phase}: {one:?} {other:?}");
            }
            assert_eq!(linkage.closing_inputs(), *parts);
            let far = (a + d) - (b + c);
            let near = (b - c).abs() - (d - a).abs();
            let most = if whole { 0.0 } else { far.max(near) };
            assert!(
                (missing - most).abs() < 1e-9 * (a + d),
                "{lengths:?}: {missing} {most}"
            );
            // The first of them stops the crank.
            let first = points.first().copied().unwrap_or(TAU);
            let stop = if open.first().is_some_and(|o| o.0 == 0.0) {
                open[0].1
            } else {
                0.0
            };
            match linkage.transmission(bars.second).map(|_| ()) {
                Err(LinkageError::Flat { input, .. }) => {
                    assert!((input - first).abs() < 1e-6 && first < stop);
                }
                Err(LinkageError::DoesNotClose { input, .. }) => {
                    assert!((input - stop).abs() < 1e-8 && stop < first);
                }
                other => panic!("{lengths:?} {phase}: {other:?}"),
            }
        }
        // The closed form of a four-bar names the same points.
        let bar = four_bar(lengths, Branch::Upper);
        let (points, open) = brute(lengths, 0.0);
        assert_eq!(bar.change_points(), points, "{lengths:?}");
        for point in points {
            let error = bar.rocker_angle(point).map(|_| ());
            let flat = matches!(error, Err(FourBarError::ChangePoint { input }) if input == point);
            // Rounding may leave a triangle.
            assert!(flat || error.is_ok(), "{lengths:?}: {error:?}");
            assert!(matches!(
                bar.transmission().map(|_| ()),
                Err(FourBarError::ChangePoint { .. })
            ));
        }
        let turns = open == [(0.0, TAU)] && bar.change_points().is_empty();
        assert_eq!(bar.transmission().is_ok(), turns, "{lengths:?}");
    }
}

#[test]
fn every_kind_of_dyad_has_its_change_points_and_every_dyad_is_named() {
    let crank = |linkage: &mut Linkage, length: f64| {
        let pivot = fixed(linkage, 0.0, 0.0);
        linkage.crank(pivot, length, 0.0).expect("a length").1
    };
    let line = |y: f64, angle: f64| Line {
        link: LinkId::FRAME,
        through: Point::new(0.0, y),
        angle,
    };
    // A rod as long as the crank, a slotted lever whose pivot the pin passes, and one that it touches.
    let mut linkage = Linkage::new();
    let pin = crank(&mut linkage, 30.0);
    linkage
        .rrp(pin, 30.0, line(0.0, 0.0), Branch::Upper)
        .expect("a rod");
    let pivot = fixed(&mut linkage, 30.0, 0.0);
    linkage
        .rpr(pin, pivot, 0.0, Branch::Upper)
        .expect("a lever");
    let other = fixed(&mut linkage, 0.0, 50.0);
    linkage
        .rpr(pin, other, 20.0, Branch::Lower)
        .expect("a lever");
    linkage
        .rrp(pin, 31.0, line(0.0, 0.0), Branch::Upper)
        .expect("a rod");
    linkage
        .rrp(pin, 20.0, line(10.0, 0.0), Branch::Lower)
        .expect("a rod");
    // Two bars as far apart as they are long, all the time.
    let [one, two] = [0.0, 100.0].map(|x| fixed(&mut linkage, x, 7.0));
    linkage
        .rrr(one, two, (60.0, 40.0), Branch::Upper)
        .expect("bars");
    let found = linkage.not_closing();
    let dyads: Vec<usize> = found.iter().map(|found| found.dyad).collect();
    assert_eq!(dyads, [0, 1, 2, 4, 5]);
    let points = |i: usize| found[i].change_points.clone();
    for (i, expected) in [
        (0, vec![PI / 2.0, 1.5 * PI]),
        (1, vec![0.0]),
        (2, vec![PI / 2.0]),
    ] {
        let points = points(i);
        assert_eq!(points.len(), expected.len(), "{i}: {points:?}");
        for (one, other) in points.iter().zip(expected) {
            assert!((one - other).abs() < 1e-6, "{i}: {points:?}");
        }
        assert_eq!((found[i].missing, found[i].open.len()), (0.0, 1));
    }
    // The rod of 20 mm on the line 10 mm above the pivot: stretched at 90 deg, and short where 30 sin(phi) < -10.
    assert!((points(3)[0] - PI / 2.0).abs() < 1e-6, "{:?}", points(3));
    let low = PI + (1.0_f64 / 3.0).asin();
    assert!((found[3].open[0].1 - low).abs() < 1e-9, "{:?}", found[3]);
    assert!((found[3].missing - 20.0).abs() < 1e-9);
    assert_eq!((&found[4].open[..], found[4].missing), (&[][..], 0.0));
}

/// A dyad that depends on one that does not close is checked where that one closes, any other over the whole cycle.
#[test]
fn a_dyad_after_one_that_does_not_close_is_checked_where_that_one_does() {
    let mut linkage = Linkage::new();
    let pivot = fixed(&mut linkage, 0.0, 0.0);
    let (_, pin) = linkage.crank(pivot, 30.0, 0.0).expect("a length");
    let line = |y: f64| Line {
        link: LinkId::FRAME,
        through: Point::new(0.0, y),
        angle: 0.0,
    };
    let first = linkage
        .rrp(pin, 20.0, line(0.0), Branch::Upper)
        .expect("a rod");
    // Its slider is 22.4 mm from the pivot or more: a rod of 100 mm to a line 110 mm above never reaches, one of 120 mm always.
    linkage
        .rrp(first.joint, 100.0, line(110.0), Branch::Upper)
        .expect("a rod");
    linkage
        .rrp(first.joint, 120.0, line(110.0), Branch::Upper)
        .expect("a rod");
    linkage
        .rrp(pin, 25.0, line(0.0), Branch::Upper)
        .expect("a rod");
    let found = linkage.not_closing();
    let dyads: Vec<usize> = found.iter().map(|found| found.dyad).collect();
    assert_eq!(dyads, [0, 1, 3]);
    assert!(found[1].open.is_empty() && (found[1].missing - 10.0).abs() < 1e-9);
    let limits = [20.0_f64, 25.0].map(|rod| (rod / 30.0).asin());
    for (found, limit) in [&found[0], &found[2]].into_iter().zip(limits) {
        let expected = [(0.0, limit), (PI - limit, PI + limit), (TAU - limit, TAU)];
        assert_eq!(found.open.len(), 3, "{:?}", found.open);
        for (one, other) in found.open.iter().zip(expected) {
            assert!((one.0 - other.0).abs() + (one.1 - other.1).abs() < 1e-9);
        }
    }
}
