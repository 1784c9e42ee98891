use centrode_gear::{GearPair, Member, Tooth, ToothSide};
use centrode_geometry::Point;

use crate::picture::{Contacts, Track, short};

/// Number of intervals between the samples of one contact path.
const SAMPLES: u32 = 8;
/// Samples of the pitch point in one turn of the driver.
pub(crate) const PITCH_SAMPLES: u32 = 120;
/// Positions are rounded to this fraction of the module, inputs of gears on fixed axes to the same number of radians.
pub(crate) const ROUNDING: f64 = 1e-4;

/// Flanks of the driver that touch.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Flanks {
    /// Flanks that go ahead as the driver turns clockwise: they touch while it drives in that direction.
    Leading,
    /// Flanks on the other side of the teeth.
    Trailing,
}

impl Flanks {
    /// The flank of a tooth.
    fn of(self, tooth: &Tooth) -> ToothSide {
        match self {
            Self::Leading => tooth.leading,
            Self::Trailing => tooth.trailing,
        }
    }

    /// The flanks of the mate that touch these.
    fn mates(self) -> Self {
        match self {
            Self::Leading => Self::Trailing,
            Self::Trailing => Self::Leading,
        }
    }
}

/// Positions at which the flanks touch while the driver drives, along one cycle, in the axes of the frame.
///
/// The driver turns clockwise: it drives by its leading flanks.
#[must_use]
pub fn contacts(pair: &GearPair) -> Contacts {
    let rolling = pair.rolling();
    let steps = PITCH_SAMPLES * pair.mean_ratio().0;
    let pitch_points = (0..=steps).map(|i| {
        let phi = pair.cycle() * f64::from(i) / f64::from(steps);
        (phi, Point::new(rolling.radius(phi), 0.0))
    });
    let paths = paths(pair, Flanks::Leading).into_iter();
    let units = [ROUNDING, ROUNDING * pair.module()];
    Contacts {
        mesh: "driver and driven gear".into(),
        pitch_point: track(pitch_points, units),
        paths: paths.map(|path| track(path, units)).collect(),
    }
}

/// A track of inputs and positions, rounded to units.
pub(crate) fn track(
    samples: impl IntoIterator<Item = (f64, Point)>,
    [angle, length]: [f64; 2],
) -> Track {
    let rounded = |(input, at): (f64, Point)| {
        (
            short(input, angle),
            [short(at.x, length), short(at.y, length)],
        )
    };
    Track::from_samples(samples.into_iter().map(rounded))
}

/// Paths of contact of one cycle: polar angles of the driver, ascending, and positions with the driver's axis at the origin
/// and the driven gear's on the x axis.
///
/// By the law of gearing a flank touches its mate where its normal passes through the pitch point. The contact lasts while both
/// flanks are active there.
pub(crate) fn paths(pair: &GearPair, flanks: Flanks) -> Vec<Vec<(f64, Point)>> {
    let rolling = pair.rolling();
    let lengths = [Member::Driver, Member::Driven].map(|member| rolling.pitch_length(member));
    let teeth = [pair.driver().teeth(), pair.driven().teeth()];
    let (sin, cos) = pair.pressure_angle().sin_cos();
    let aside = match flanks {
        Flanks::Leading => -sin,
        Flanks::Trailing => sin,
    };
    // Active range of the driven flank that crosses its pitch curve nearest to the point of the driver's crossing, in arc length
    // rolled.
    let mate = |crossing: f64| {
        let along = crossing.rem_euclid(lengths[1]);
        let off = |side: &ToothSide| {
            let apart = (side.crossing - along).rem_euclid(lengths[1]);
            apart.min(lengths[1] - apart)
        };
        let sides = teeth[1].iter().map(|tooth| flanks.mates().of(tooth));
        let nearest = sides.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let shift = along - nearest.crossing;
        let (low, high) = nearest.active?;
        let turns = (shift / lengths[1]).round() * lengths[1] + crossing - along;
        Some([low + turns, high + turns])
    };
    let turns = (0..pair.mean_ratio().0).map(f64::from);
    let sides = turns.flat_map(|turn| teeth[0].iter().map(move |tooth| (turn, flanks.of(tooth))));
    let path = |(turn, side): (f64, ToothSide)| {
        let (low, high) = side.active?;
        let start = turn * lengths[0];
        let [minimum, maximum] = mate(side.crossing + start)?;
        let (low, high) = (low.max(minimum - start), high.min(maximum - start));
        if low >= high {
            return None;
        }
        let samples = (0..=SAMPLES).map(|i| {
            let arc = low + (high - low) * f64::from(i) / f64::from(SAMPLES);
            let t = rolling.parameter(arc);
            let frame = rolling.frame(Member::Driver, t);
            let line = frame.tangent * cos + frame.normal * aside;
            let point = frame.point + line * ((side.crossing - arc) * cos);
            let phi = rolling.angle(t);
            let turned = nalgebra::Rotation2::new(-phi) * point;
            (phi + turn * std::f64::consts::TAU, turned)
        });
        Some(samples.collect())
    };
    sides.filter_map(path).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{Circle, PitchSpec};
    use std::f64::consts::{PI, TAU};

    #[test]
    fn contacts_of_circular_gears_lie_on_the_line_of_action_and_last_as_long_as_the_textbook_says()
    {
        let (module, teeth): (f64, u32) = (2.0, 24);
        let circle = Circle {
            module: Some(module),
            tooth_count: Some(teeth),
            ..Circle::default()
        };
        let pair =
            GearPair::resolve(&GearPairDesign::new(PitchSpec::Circle(circle))).expect("a pair");
        let found = contacts(&pair);
        let alpha = pair.teeth().pressure_angle();
        let radius = 0.5 * module * f64::from(teeth);
        let pitch = Point::new(radius, 0.0);
        assert!(
            found
                .pitch_point
                .at
                .iter()
                .all(|&at| (Point::from(at) - pitch).norm() < 1e-3)
        );
        assert_eq!(found.paths.len(), teeth as usize);
        // Involutes touch on a line through the pitch point, between the tip circles.
        let tip = radius + module;
        let half = (tip.powi(2) - (radius * alpha.cos()).powi(2)).sqrt() - radius * alpha.sin();
        for path in &found.paths {
            for (&input, &at) in path.input.iter().zip(&path.at) {
                let away = Point::from(at) - pitch;
                let off = away.x.abs() * alpha.cos() - away.y.abs() * alpha.sin();
                assert!(off.abs() < 1e-3, "{input}: {away}");
            }
            let [first, last] = [path.at[0], path.at[SAMPLES as usize]].map(Point::from);
            let length = (last - first).norm();
            assert!(
                (length - 2.0 * half).abs() < 0.02 * module,
                "{length} is not {}",
                2.0 * half
            );
            // One after the other at every base pitch.
            let turn = path.input[SAMPLES as usize] - path.input[0];
            assert!((turn - length / (radius * alpha.cos())).abs() < 3e-4);
        }
        let ratio = 2.0 * half / (PI * module * alpha.cos());
        let inputs = (0..720).map(|i| TAU * f64::from(i) / 720.0);
        let touching = |phi: f64| {
            let within = |path: &&Track| {
                [-TAU, 0.0, TAU].iter().any(|turn| {
                    path.input[0] <= phi + turn && phi + turn <= path.input[SAMPLES as usize]
                })
            };
            found.paths.iter().filter(within).count()
        };
        let mean = inputs.map(touching).sum::<usize>() as f64 / 720.0;
        assert!((mean - ratio).abs() < 0.02, "{mean} is not {ratio}");
    }

    #[test]
    fn contacts_of_shifted_gears_lie_on_the_line_of_action_of_the_operating_circles() {
        let circle = Circle {
            module: Some(3.0),
            tooth_count: Some(12),
            ..Circle::default()
        };
        let mut design = GearPairDesign::new(PitchSpec::Circle(circle));
        design.mean_ratio = [2, 1];
        (design.driver.shift, design.driven.shift) = (Some(0.6), Some(0.36));
        let pair = GearPair::resolve(&design).expect("a pair");
        let found = contacts(&pair);
        // Operating angle and radius, and contact ratio, of the example of the published figures.
        let alpha = 26.088_56_f64.to_radians();
        let pitch = Point::new(56.499_87 / 3.0, 0.0);
        let base_pitch = PI * 3.0 * 20_f64.to_radians().cos();
        for path in &found.paths {
            for &at in &path.at {
                let away = Point::from(at) - pitch;
                let off = away.x.abs() * alpha.cos() - away.y.abs() * alpha.sin();
                assert!(off.abs() < 1e-3, "{away}");
            }
            let [first, last] = [path.at[0], path.at[SAMPLES as usize]].map(Point::from);
            let ratio = (last - first).norm() / base_pitch;
            assert!((ratio - 1.202).abs() < 1e-3, "{ratio}");
        }
    }
}
