use std::f64::consts::{PI, TAU};

use proptest::prelude::*;

use super::*;
use crate::pitch::{PitchSpec, Polar, Ratio, Transmission};

fn even(count: usize, law: impl Fn(f64) -> f64) -> Vec<f64> {
    let at = |k: usize| law(TAU * k as f64 / count as f64);
    (0..count).map(at).collect()
}

fn harmonics(highest: u32) -> Option<Smooth> {
    Some(Smooth {
        harmonics: Some(highest),
        ..Smooth::default()
    })
}

/// Normally distributed numbers, by the sum of twelve uniform ones.
fn scatter(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
    (0..count).map(|_| normal()).collect()
}

fn ratio(samples: Vec<f64>) -> Ratio {
    Ratio {
        ratio: samples,
        center_distance: Some(100.0),
        ..Ratio::default()
    }
}

/// Radii of a pitch curve at some angles.
fn radii(spec: &PitchSpec, ratio: (u32, u32)) -> Vec<f64> {
    let pitch = spec.resolve_for(ratio).expect("a curve");
    (0..100)
        .map(|k| pitch.curve.at(0.0628 * f64::from(k)).point.coords.norm())
        .collect()
}

#[test]
fn smoothing_is_the_truncated_fourier_series() {
    for (count, highest) in [(36, 5), (37, 7), (360, 20), (12, 6)] {
        let noise = scatter(count, 7);
        let mut values = even(count, |t| 2.0 + t.cos() + 0.3 * (3.0 * t).sin());
        values
            .iter_mut()
            .zip(&noise)
            .for_each(|(v, n)| *v += 0.1 * n);
        let table = Table::new("ratio", &[], &values).expect("a table");
        let law = table.law(None, harmonics(highest), 1).expect("a law").law;
        for phi in [0.0, 0.4, 2.0, 5.1] {
            // The kernel of the truncated series, summed over the samples.
            let series: f64 = (0..count)
                .map(|k| {
                    let t = phi - TAU * k as f64 / count as f64;
                    let term = |n: u32| {
                        let half = if 2 * n as usize == count { 0.5 } else { 1.0 };
                        half * (f64::from(n) * t).cos()
                    };
                    // The sine of the highest harmonic is zero at every sample.
                    let nyquist = if 2 * highest as usize == count {
                        let n = f64::from(highest);
                        0.5 * (n * phi).cos() * (PI * k as f64).cos() - 0.5 * (n * t).cos()
                    } else {
                        0.0
                    };
                    let sum = 1.0 + 2.0 * ((1..=highest).map(term).sum::<f64>() + nyquist);
                    values[k] * sum / count as f64
                })
                .sum();
            let found = law.at(phi).0[0];
            assert!(
                (found - series).abs() < 1e-12,
                "{count} {highest}: {found} {series}"
            );
        }
    }
}

#[test]
fn a_tolerance_keeps_the_fewest_harmonics_within_it() {
    let values = even(90, |t| 1.0 / (1.0 + 0.5 * t.cos()));
    let table = Table::new("ratio", &[], &values).expect("a table");
    let miss = |smooth: Smooth| {
        let law = table.law(None, Some(smooth), 1).expect("a law");
        let miss = |(k, value): (usize, &f64)| {
            let at = TAU * k as f64 / 90.0;
            (law.law.at(at).0[0] - value).abs()
        };
        let most = values.iter().enumerate().map(miss).fold(0.0, f64::max);
        (most, law.highest.expect("smoothed") as u32)
    };
    for tolerance in [0.1, 1e-2, 1e-4] {
        let (most, highest) = miss(Smooth {
            harmonics: None,
            tolerance: Some(tolerance),
        });
        assert!(most <= tolerance * (1.0 + 1e-9), "{tolerance}: {most}");
        let (most, _) = miss(harmonics(highest - 1).expect("a smoothing"));
        assert!(most > tolerance, "{tolerance}: {highest}");
    }
    // A law of two folds does not reach samples of one.
    let tolerance = Some(1e-3);
    let smooth = Smooth {
        harmonics: None,
        tolerance,
    };
    let refused = table.law(None, Some(smooth), 2).expect_err("refused");
    assert!(
        matches!(refused, PitchError::NotSmoothed { .. }),
        "{refused}"
    );
}

#[test]
fn a_smoothing_is_given_once_and_within_the_samples() {
    let table = Table::new("ratio", &[], &even(20, |t| 2.0 + t.cos())).expect("a table");
    let key = |smooth| table.law(None, Some(smooth), 1).expect_err("refused").key();
    let both = Smooth {
        harmonics: Some(2),
        tolerance: Some(0.1),
    };
    assert_eq!(key(both), "smooth");
    assert_eq!(key(Smooth::default()), "smooth");
    for count in [0, 11] {
        assert_eq!(
            key(harmonics(count).expect("a smoothing")),
            "smooth.harmonics"
        );
    }
    let interpolated = table.law(Some(Interpolation::Cubic), harmonics(3), 1);
    assert_eq!(interpolated.expect_err("refused").key(), "interpolation");
}

#[test]
fn a_repeated_end_is_dropped_and_a_dwell_is_not() {
    let count = |values: &[f64]| Table::new("ratio", &[], values).expect("a table").count();
    for n in [16, 25, 30, 36, 75, 360] {
        let laws: [&dyn Fn(f64) -> f64; 5] = [
            &|t| 1.0 + 0.2 * t.sin(),
            &|t| 1.0 + 0.2 * t.cos(),
            &|t| 1.0 - 0.16 * (2.0 * t).cos(),
            &|t| 2.0 + 0.3 * (t + 1.0).cos() + 0.1 * (3.0 * t).sin(),
            &|t| 1.0 / (1.0 - 0.4 * t.cos()),
        ];
        for (k, law) in laws.into_iter().enumerate() {
            let mut values = even(n, law);
            assert_eq!(count(&values), n, "law {k} of {n}");
            values.push(law(TAU));
            assert_eq!(count(&values), n, "law {k} of {n}, repeated");
        }
        // Equal neighbours on both sides of the start are no repetition.
        let half = PI / n as f64;
        let values = even(n, |t| ((1.0 + 0.2 * (t + half).cos()) * 1e6).round() / 1e6);
        assert_eq!(count(&values), n, "about half a step, {n}");
    }
    // A dwell around the start of the turn, and a table that does not change.
    let dwell = even(36, |t| 1.0 + 0.3 * (-t.cos() - 0.5).max(0.0));
    assert_eq!(count(&dwell), 36);
    assert_eq!(count(&[2.0; 12]), 12);
    // Noise does not hide a repetition.
    let mut noisy = scatter(360, 3);
    noisy.push(noisy[0]);
    assert_eq!(count(&noisy), 360);
}

#[test]
fn angles_at_equal_steps_are_no_other_law() {
    let law = |t: f64| 1.0 + 0.2 * t.cos() + 0.1 * (2.0 * t).sin();
    let plain = PitchSpec::Ratio(ratio(even(36, law)));
    let with = |angle: Vec<f64>| {
        PitchSpec::Ratio(Ratio {
            ratio: angle.iter().map(|&t| law(t)).collect(),
            angle,
            ..ratio(Vec::new())
        })
    };
    let angles: Vec<f64> = (0..=36).map(|k| f64::from(10 * k).to_radians()).collect();
    let miss = |spec: PitchSpec| {
        let off = radii(&plain, (1, 1)).into_iter().zip(radii(&spec, (1, 1)));
        off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(miss(with(angles[..36].to_vec())) < 1e-12 * 100.0);
    assert!(miss(with(angles)) < 1e-12 * 100.0);
    // Unequal steps give the law within the error of a cubic spline, and smoothed ones, too.
    let uneven: Vec<f64> = even(72, |t| t + 0.3 * t.sin());
    let mut smooth = with(uneven.clone());
    if let PitchSpec::Ratio(ratio) = &mut smooth {
        ratio.smooth = harmonics(4);
    }
    assert!(miss(with(uneven)) < 2e-3);
    assert!(miss(smooth) < 2e-3);
}

#[test]
fn driven_angles_may_omit_the_end_of_the_turn() {
    for (n1, n2) in [(1, 1), (2, 1), (3, 1)] {
        let turn = TAU * f64::from(n2) / f64::from(n1);
        let law = |t: f64| 0.3 + turn * t / TAU - 0.1 * turn / TAU * t.sin();
        let spec = |driven_angle: Vec<f64>| {
            PitchSpec::Transmission(Transmission {
                driven_angle,
                center_distance: Some(80.0),
                ..Transmission::default()
            })
        };
        let mut angles = even(40, law);
        let omitted = radii(&spec(angles.clone()), (n1, n2));
        angles.push(law(TAU));
        let whole = radii(&spec(angles), (n1, n2));
        for (a, b) in omitted.iter().zip(&whole) {
            assert!((a - b).abs() < 1e-12 * a, "{n1}:{n2}");
        }
    }
}

#[test]
fn the_mean_is_scaled_to_the_mean_ratio_of_the_pair() {
    let law = |t: f64| 0.5 + 0.1 * (t + 0.3).sin();
    let samples = even(60, law);
    let scaled: Vec<f64> = samples.iter().map(|q| 1.013 * q).collect();
    let exact = PitchSpec::Ratio(ratio(samples.clone()));
    let off = PitchSpec::Ratio(ratio(scaled));
    for (a, b) in radii(&exact, (2, 1)).iter().zip(radii(&off, (2, 1))) {
        assert!((a - b).abs() < 1e-12 * a);
    }
    let found = |spec: &PitchSpec| spec.resolve_for((2, 1)).expect("a curve").sampled.scaling;
    assert_eq!(found(&exact), None);
    let scaling = found(&off).expect("scaled");
    assert!((scaling.mean - 0.5065).abs() < 1e-12, "{scaling:?}");
    assert!((scaling.factor - 1.0 / 1.013).abs() < 1e-12, "{scaling:?}");
    // Another column, and the law of another pair.
    let wrong = PitchSpec::Ratio(ratio(samples.iter().map(|q| 1.2345 * q).collect()));
    let refused = wrong.resolve_for((2, 1)).expect_err("refused");
    assert!(matches!(refused, PitchError::MeanOff { .. }), "{refused}");
    let other = exact.resolve_for((1, 1)).expect("a curve");
    assert_eq!(other.implied_ratio, Some((2, 1)));
    // Driven angles of a sensor that is 2 % off.
    let turned = PitchSpec::Transmission(Transmission {
        driven_angle: (0..=60).map(|k| 1.02 * TAU * f64::from(k) / 60.0).collect(),
        center_distance: Some(100.0),
        ..Transmission::default()
    });
    let pitch = turned.resolve_for((1, 1)).expect("a curve");
    let factor = pitch.sampled.scaling.expect("scaled").factor;
    assert!((1.02 * factor - 1.0).abs() < 1e-12, "{factor}");
    assert!((pitch.curve.at(1.0).point.coords.norm() - 50.0).abs() < 1e-9);
}

#[test]
fn a_smoothed_law_of_two_driven_turns_repeats_twice() {
    let noise = scatter(90, 5);
    let mut samples = even(90, |t| 2.0 + 0.3 * (2.0 * t).cos());
    samples
        .iter_mut()
        .zip(noise)
        .for_each(|(q, n)| *q += 0.01 * n);
    let spec = PitchSpec::Ratio(Ratio {
        smooth: harmonics(6),
        ..ratio(samples)
    });
    let curve = spec.resolve_for((1, 2)).expect("a curve").curve;
    for k in 0..20 {
        let phi = 0.1 * f64::from(k);
        let [a, b] = [phi, phi + PI].map(|t| curve.at(t).point.coords.norm());
        assert!((a - b).abs() < 1e-12 * a);
    }
}

/// A smooth law about one: amplitudes of its harmonics, which fall, and its phases.
fn smooth_law() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec((0.0..1.0_f64, 0.0..TAU), 1..9).prop_map(|terms| {
        let terms = terms.into_iter().enumerate();
        terms
            .map(|(k, (share, phase))| [0.3 * share * 0.5_f64.powi(k as i32), phase])
            .collect()
    })
}

fn at(terms: &[[f64; 2]], t: f64) -> f64 {
    let terms = (1..).zip(terms);
    1.0 + terms
        .map(|(n, [a, p])| a * (f64::from(n) * t + p).cos())
        .sum::<f64>()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn noise_is_found_in_noisy_samples_only_and_its_remedy_removes_it(
        law in smooth_law(),
        exponent in -3.0..-2.0_f64,
        seed in any::<u64>(),
        kind in 0..3,
    ) {
        let spec = |scattered: f64, smooth: Option<u32>| {
            let noise = scatter(360, seed);
            let value = |(k, n): (usize, &f64)| at(&law, TAU * k as f64 / 360.0) * (1.0 + scattered * n);
            let values: Vec<f64> = noise.iter().enumerate().map(value).collect();
            match kind {
                0 => PitchSpec::Ratio(Ratio {
                    smooth: smooth.and_then(harmonics),
                    ..ratio(values)
                }),
                1 => PitchSpec::Polar(Polar {
                    radius: values.iter().map(|r| 30.0 * r).collect(),
                    smooth: smooth.and_then(harmonics),
                    ..Polar::default()
                }),
                _ => {
                    // The angle by the trapezoidal rule, with its own noise.
                    let mut angle = vec![0.0];
                    for k in 0..360 {
                        let t = TAU * (f64::from(k) + 0.5) / 360.0;
                        angle.push(angle[k as usize] + TAU / 360.0 * at(&law, t));
                    }
                    angle.iter_mut().zip(&noise).for_each(|(a, n)| *a += scattered * n);
                    PitchSpec::Transmission(Transmission {
                        driven_angle: angle,
                        center_distance: Some(100.0),
                        smooth: smooth.map(|harmonics| SmoothAngle {
                            harmonics: Some(harmonics),
                            ..SmoothAngle::default()
                        }),
                        ..Transmission::default()
                    })
                }
            }
        };
        let clean = spec(0.0, None).resolve_for((1, 1)).expect("a curve");
        prop_assert_eq!(clean.sampled.noise, None);
        let noisy = match spec(10_f64.powf(exponent), None).resolve_for((1, 1)) {
            Ok(pitch) => pitch.sampled.noise.expect("noise"),
            Err(PitchError::Noisy(noise)) => noise,
            Err(error) => panic!("{error}"),
        };
        let cured = spec(10_f64.powf(exponent), Some(noisy.harmonics)).resolve_for((1, 1));
        prop_assert_eq!(cured.expect("a curve").sampled.noise, None);
    }
}
