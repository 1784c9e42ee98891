//! Overlap of rolling pitch curves away from the point at which they roll.

use std::f64::consts::{PI, TAU};

use centrode_geometry::{COMPUTED, Extreme, Point, bracketed_minimum, checkpoint};

use super::Rolling;

/// Number of positions per driver turn among which an overlap is searched. Fewer can miss a short overlap, more take
/// longer.
const PLACES: usize = 360;

/// One position of the pitch point: driver angle, radius of the driver's curve, and driven angle.
struct Place {
    angle: f64,
    radius: f64,
    driven: f64,
}

impl Rolling {
    /// Maximum overlap of the two pitch curves away from the point at which they roll: the driver angle, rad, and the depth, mm,
    /// to which one curve reaches into the other towards the driver's shaft. `None` if they only roll.
    ///
    /// With the driver at phi, the point of the driven gear's curve that comes to the pitch point after a further turn beta of
    /// that gear is at (a - r2 cos beta, r2 sin beta). With rho and gamma its distance and angle from the driver's shaft, the
    /// overlap is r1(phi + gamma) - rho. Convex curves have none. Searched at 360 points of either curve and refined between
    /// them.
    #[must_use]
    pub fn overlap(&self) -> Option<Extreme> {
        if self
            .curvature_ranges()
            .iter()
            .all(|range| range.minimum.1 >= 0.0)
        {
            return None;
        }
        let places: Vec<Place> = (0..=PLACES)
            .map(|k| self.place(self.arc.total() * k as f64 / PLACES as f64))
            .collect();
        // Deepest first.
        let mut found = self.suspects(&places);
        found.sort_by(|p, q| q.0.total_cmp(&p.0));
        let step = self.arc.total() / PLACES as f64;
        let mut best: Option<Extreme> = None;
        for (rough, [pose, place]) in found {
            checkpoint();
            // A point that is outside by more than a step does not overlap between the samples.
            if rough < -step || best.is_some_and(|best| rough < best.value - step) {
                break;
            }
            let [pose, place] = [pose, place].map(|k| step * k as f64);
            let deepest = |s: f64| {
                let depth = |t: f64| -self.depth(&self.place(s), &self.place(t));
                bracketed_minimum(depth, place - step, place + step).1
            };
            let (at, depth) = bracketed_minimum(deepest, pose - step, pose + step);
            let one = Extreme {
                input: self.place(at).angle.rem_euclid(TAU),
                value: -depth,
            };
            if best.is_none_or(|best| one.value > best.value) {
                best = Some(one);
            }
        }
        best.filter(|best| best.value > COMPUTED * self.center_distance)
    }

    /// Position at an arc length.
    fn place(&self, arc: f64) -> Place {
        let contact = self.pitch_contact(self.parameter(arc));
        Place {
            angle: contact.input,
            radius: contact.radii[0],
            driven: contact.driven_angle,
        }
    }

    /// A point of the driven gear's curve with the gears at a pose.
    fn next_to(&self, pose: &Place, place: &Place) -> Point {
        let (sin, cos) = (place.driven - pose.driven).sin_cos();
        let radius = self.center_distance - place.radius;
        Point::new(self.center_distance - radius * cos, radius * sin)
    }

    /// Depth of a point of the driven gear's curve within the driver's curve; negative outside.
    fn depth(&self, pose: &Place, place: &Place) -> f64 {
        let point = self.next_to(pose, place);
        let radius = self.radius(pose.angle + point.y.atan2(point.x));
        radius - point.coords.norm()
    }

    /// Poses and points, by their numbers, with a local maximum of the depth: the deepest point of a pose, if it is deeper than
    /// those of the neighbouring poses. Each has its depth, by chords.
    fn suspects(&self, places: &[Place]) -> Vec<(f64, [i64; 2])> {
        let count = PLACES as i64;
        let angle_of_turn = self.driven.total();
        // A turn before and a turn after the poses of one turn.
        let around = |number: i64| {
            let place = &places[number.rem_euclid(count) as usize];
            let turns = number.div_euclid(count) as f64;
            Place {
                driven: place.driven + turns * angle_of_turn,
                angle: place.angle + turns * TAU,
                ..*place
            }
        };
        let around: Vec<Place> = (-count..2 * count).map(around).collect();
        let at = |number: i64| &around[(number + count) as usize];
        // Radii at equally spaced angles.
        let radii: Vec<f64> = (0..count)
            .map(|k| self.radius(TAU * k as f64 / count as f64))
            .collect();
        let radius = |angle: f64| {
            let turns = angle / TAU;
            let along = (turns - turns.floor()) * count as f64;
            let (k, rest) = (along as usize, along.fract());
            let pair = [radii[k % PLACES], radii[(k + 1) % PLACES]];
            pair[0] + rest * (pair[1] - pair[0])
        };
        // Deepest point of a pose on either side of the pitch point, beyond the part where the curves move apart from there.
        let deepest = |pose: i64, way: i64| {
            let here = at(pose);
            let depth = |steps: i64| {
                let place = at(pose + way * steps);
                let point = self.next_to(here, place);
                let within = (place.driven - here.driven).abs() < PI;
                within.then(|| radius(here.angle + point.y.atan2(point.x)) - point.coords.norm())
            };
            let depths: Vec<f64> = (1..count).map_while(depth).collect();
            let parted = (1..depths.len()).find(|&k| depths[k] > depths[k - 1])?;
            let deepest =
                (parted..depths.len()).max_by(|&p, &q| depths[p].total_cmp(&depths[q]))?;
            Some((depths[deepest], [pose, pose + way * (deepest as i64 + 1)]))
        };
        [1, -1]
            .into_iter()
            .flat_map(|way| {
                let all: Vec<_> = (0..count).map(|pose| deepest(pose, way)).collect();
                let value = |k: i64| {
                    all[k.rem_euclid(count) as usize].map_or(f64::NEG_INFINITY, |one| one.0)
                };
                let is_peak = |k: &i64| value(*k) >= value(*k - 1).max(value(*k + 1));
                let peaks = (0..count).filter(is_peak).filter_map(|k| all[k as usize]);
                peaks.collect::<Vec<_>>()
            })
            .collect()
    }
}
