use centrode_geometry::{Extreme, maxima, rounding};
use centrode_machines::machine::{BodyPoint, Machine};

/// Extremes over the cycle of all reported motions, found in one sweep.
pub(super) struct Motion {
    /// Minimum and maximum transmission angle of each dyad, rad.
    pub(super) angles: Vec<[Extreme; 2]>,
    /// Minimum and maximum coordinate of each body's joint; zero for the frame.
    pub(super) joints: Vec<[Extreme; 2]>,
    /// Every point that moves.
    pub(super) points: Vec<PointMotion>,
}

/// Extremes of a point's motion.
pub(super) struct PointMotion {
    /// Name of the point, `body.point`.
    pub(super) name: String,
    /// Minimum and maximum x, minimum and maximum y, mm.
    pub(super) sides: [f64; 4],
    /// Maximum speed, mm per radian of the input.
    pub(super) fastest: f64,
}

/// Number of functions per point: x and y with both signs, and the speed.
const OF_POINT: usize = 5;

impl Motion {
    /// Extremes over a cycle. `ends` are the ends of its parts in which all motion is smooth.
    pub(super) fn new(composed: &Machine, ends: &[f64]) -> Self {
        let (names, points): (Vec<_>, Vec<_>) = composed
            .points()
            .filter(|(_, point)| point.body > 0)
            .unzip();
        let (dyads, bodies) = (composed.dyads().len(), composed.bodies().len());
        let joint = |body: usize, input: f64| {
            let mount = composed.bodies()[body].mount.as_ref();
            mount.map_or(0.0, |mount| mount.law.at(input).position)
        };
        let of_points = |points: &[BodyPoint], input: f64| -> Vec<[f64; OF_POINT]> {
            let all = composed.moving(points, input).into_iter();
            all.map(|(at, velocity)| [-at.x, at.x, -at.y, at.y, velocity.norm()])
                .collect()
        };
        let both = |value: f64| [-value, value];
        let all = |input: f64, values: &mut Vec<f64>| {
            values.extend(
                composed
                    .transmission_angles(input)
                    .into_iter()
                    .flat_map(both),
            );
            values.extend((0..bodies).flat_map(|body| both(joint(body, input))));
            values.extend(of_points(&points, input).into_iter().flatten());
        };
        let one = |k: usize, input: f64| {
            let pair = k / 2;
            if pair < dyads {
                return both(composed.transmission_angles(input)[pair])[k % 2];
            }
            if pair < dyads + bodies {
                return both(joint(pair - dyads, input))[k % 2];
            }
            let k = k - 2 * (dyads + bodies);
            of_points(&points[k / OF_POINT..][..1], input)[0][k % OF_POINT]
        };
        let noise = |_: usize, value: f64| rounding(value);
        let first = 2 * (dyads + bodies);
        let count = first + OF_POINT * points.len();
        let mut found = maxima(count, all, one, noise, ends);
        let of_points = found.split_off(first);
        let mut pairs = found.chunks(2).map(|pair| {
            let [mut low, high] = [pair[0], pair[1]];
            low.value = -low.value;
            [low, high]
        });
        let points = names.into_iter().zip(of_points.chunks(OF_POINT));
        Self {
            angles: pairs.by_ref().take(dyads).collect(),
            joints: pairs.collect(),
            points: points
                .map(|(name, of)| PointMotion {
                    name,
                    sides: [-of[0].value, of[1].value, -of[2].value, of[3].value],
                    fastest: of[4].value,
                })
                .collect(),
        }
    }
}
