use centrode_geometry::{Outline, Point};
use centrode_kinematics::machine::FasteningError;

/// Maximum number of positions tried along a segment of a line.
const MAX_PLACES: f64 = 500.0;

/// Minimum number of screws that hold a plate.
const FEWEST: usize = 3;

/// Room for screws: a line on which they may be, and the room that other parts occupy.
#[derive(Clone, Debug)]
pub(crate) struct ScrewRoom {
    /// Line on which the axes of the screws lie; `None` if there is none.
    pub(crate) line: Option<Outline>,
    /// Occupied room: circles that move along a straight line between two points, with their radius, mm.
    pub(crate) taken: Vec<([Point; 2], f64)>,
    /// Number of copies of every position, turned about the origin.
    pub(crate) turns: u32,
    /// Step to which coordinates are rounded, mm; positions may be off the line by less than that. Zero: no rounding.
    pub(crate) grid: f64,
}

impl ScrewRoom {
    /// Centres of circles of a radius, mm: at least `count`, or at least three if there is no room for more. The first is where
    /// the free circle is largest, each other one as far from all before it as possible.
    ///
    /// # Errors
    /// [`FasteningError::NoRoom`] for a screw of the given diameter, mm.
    pub(crate) fn places(
        &self,
        diameter: f64,
        radius: f64,
        count: usize,
    ) -> Result<Vec<Point>, FasteningError> {
        let step = 0.25 * diameter;
        let mut free: Vec<(Point, f64)> = Vec::new();
        for segment in self.line.iter().flat_map(Outline::segments) {
            let long = 2.0 * segment.at(-1.0).first.norm();
            let parts = (long / step).ceil().clamp(1.0, MAX_PLACES);
            for i in 0..parts as usize {
                let at = self.stepped(segment.at(2.0 * i as f64 / parts - 1.0).point);
                let room = self.room(at);
                if room >= radius {
                    // Positions with equal room differ by rounding: rounding the room to 1e-6 mm lets the first of them win.
                    free.push((at, (1e6 * room).round()));
                }
            }
        }
        let mut found: Vec<Point> = Vec::new();
        while found.len() < count {
            let score = |(at, room): &(Point, f64)| match found.is_empty() {
                true => *room,
                false => {
                    let near = found.iter().map(|other| (at - other).norm());
                    (1e6 * near.fold(f64::INFINITY, f64::min)).round()
                }
            };
            let best = free.iter().map(|place| (score(place), place.0));
            let best = best.reduce(|a, b| if b.0 > a.0 { b } else { a });
            let Some((score, at)) = best else { break };
            if !found.is_empty() && score < 4e6 * radius {
                break;
            }
            let turn = std::f64::consts::TAU / f64::from(self.turns);
            let copies =
                (0..self.turns).map(|k| nalgebra::Rotation2::new(turn * f64::from(k)) * at);
            found.extend(copies);
        }
        if found.len() < FEWEST {
            return Err(FasteningError::NoRoom {
                diameter,
                found: found.len(),
                around: 2.0 * radius,
            });
        }
        Ok(found)
    }

    /// Position with coordinates in whole steps that is nearest to another position.
    fn stepped(&self, at: Point) -> Point {
        if self.grid > 0.0 {
            at.map(|x| (x / self.grid).round() * self.grid)
        } else {
            at
        }
    }

    /// Radius of the free circle about a position, mm.
    fn room(&self, at: Point) -> f64 {
        let off = self.taken.iter().map(|([from, to], radius)| {
            let along = to - from;
            let square = along.norm_squared();
            let share = if square > 0.0 {
                ((at - from).dot(&along) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (at - (from + along * share)).norm() - radius
        });
        off.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f64) -> Outline {
        let p = Point::new;
        Outline::polygon(&[p(0.0, 0.0), p(side, 0.0), p(side, side), p(0.0, side)])
    }

    #[test]
    fn places_miss_what_is_taken_and_lie_far_apart() {
        let middle = Point::new(20.0, 0.0);
        let mut room = ScrewRoom {
            line: Some(square(40.0)),
            taken: vec![([middle, middle], 10.0)],
            turns: 1,
            grid: 0.0,
        };
        let found = room.places(4.0, 4.0, 4).expect("room");
        assert_eq!(found.len(), 4);
        for (i, at) in found.iter().enumerate() {
            assert!((at - middle).norm() >= 14.0, "{at}");
            assert!(found[..i].iter().all(|other| (at - other).norm() >= 16.0));
        }
        room.grid = 0.8;
        for at in room.places(4.0, 4.0, 4).expect("room") {
            assert!((at - middle).norm() >= 14.0, "{at}");
            let off = at.coords.map(|x| x / 0.8 - (x / 0.8).round()).norm();
            assert!(off < 1e-9, "{at}");
        }
        let across = [Point::new(-50.0, 20.0), Point::new(90.0, 20.0)];
        room.taken.push((across, 19.0));
        let error = room.places(4.0, 4.0, 4).expect_err("no room");
        assert!(
            matches!(error, FasteningError::NoRoom { found: 0, .. }),
            "{error}"
        );
    }
}
