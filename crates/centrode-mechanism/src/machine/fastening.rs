//! Screws through two plates, from both sides, into what lies between and holds them apart.

use std::f64::consts::PI;

use centrode_geometry::{Outline, Point};

use super::{Fit, Screw, TurnedPiece, TurnedPieces};

/// Greatest length of thread that a screw enters, in its diameters: more holds no better.
const ENTERED: f64 = 2.0;
/// Length of thread beyond the end of the screw, in its diameters.
const BEYOND: f64 = 0.5;
/// Least distance of the ends of two screws that are screwed in from both sides, in their diameters.
const APART: f64 = 0.25;
/// Most places looked at along a segment of a line.
const MOST_PLACES: f64 = 500.0;
/// Fewest screws that hold a plate.
const FEWEST: usize = 3;

/// Screws of one kind through two plates from both sides into the body between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Fastening {
    /// The screw.
    pub screw: Screw,
    /// Middles of the holes in the plates' frame, mm.
    pub at: Vec<Point>,
    /// Heights of the outer faces of both plates, on which the heads lie, mm.
    pub faces: [f64; 2],
    /// Thickness of each plate, mm.
    pub plate: f64,
}

/// Reason why plates are not screwed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FasteningError {
    /// No screw enters far enough.
    #[error(
        "no screw of ISO 4762 through plates of {plate} mm enters the {between} mm between them by {least} mm from either side, as M{diameter} needs"
    )]
    TooShort {
        /// Nominal diameter, mm.
        diameter: f64,
        /// Thickness of a plate, mm.
        plate: f64,
        /// Distance between the plates, mm.
        between: f64,
        /// Least length of thread, mm.
        least: f64,
    },
    /// Too few places that miss everything else.
    #[error(
        "{found} places for screws M{diameter} clear of all that turns there, {FEWEST} are needed: around each a circle of {around} mm"
    )]
    NoRoom {
        /// Nominal diameter, mm.
        diameter: f64,
        /// Places found.
        found: usize,
        /// Diameter of the circle that must be free, mm.
        around: f64,
    },
}

impl Fastening {
    /// Screws of a diameter for plates of a thickness between two outer faces, mm, without places yet: each as long as leaves it
    /// two diameters of thread at most, and its end apart from that of the screw from the other side.
    ///
    /// # Errors
    /// [`FasteningError::TooShort`] where it then enters less than so many diameters.
    pub fn new(
        diameter: f64,
        (faces, plate): ([f64; 2], f64),
        least: f64,
    ) -> Result<Self, FasteningError> {
        let between = faces[1] - faces[0] - 2.0 * plate;
        let enters = (ENTERED * diameter).min(0.5 * (between - APART * diameter));
        let screw = Screw::for_diameter(diameter, plate + enters);
        let entered = |screw: &Screw| screw.length - plate >= least * diameter * (1.0 - 1e-9);
        let screw = screw.filter(entered).ok_or(FasteningError::TooShort {
            diameter,
            plate,
            between,
            least: least * diameter,
        })?;
        Ok(Self {
            screw,
            at: Vec::new(),
            faces,
            plate,
        })
    }

    /// Of the sizes that are no thicker than a plate, down to half of that, or of one size alone, the first that a layout finds
    /// screws and room for.
    ///
    /// # Errors
    /// [`FasteningError`] of the smallest size tried.
    pub fn largest(
        size: Option<f64>,
        plate: f64,
        layout: impl Fn(f64) -> Result<Self, FasteningError>,
    ) -> Option<Result<Self, FasteningError>> {
        let mut found = None;
        for diameter in Self::sizes(size, plate) {
            let tried = layout(diameter);
            let done = tried.is_ok();
            found = Some(tried);
            if done {
                break;
            }
        }
        found
    }

    /// Sizes tried, the largest first.
    fn sizes(size: Option<f64>, plate: f64) -> Vec<f64> {
        let fitting = |d: &f64| match size {
            Some(size) => *d == size,
            None => *d <= plate * (1.0 + 1e-9) && *d >= 0.5 * plate,
        };
        Screw::sizes().rev().filter(fitting).collect()
    }

    /// Greatest height of a head that [`Fastening::largest`] may choose, mm; zero for none.
    #[must_use]
    pub fn highest_head(size: Option<f64>, plate: f64) -> f64 {
        let sizes = Self::sizes(size, plate);
        sizes.first().copied().unwrap_or_default()
    }

    /// Distance between the plates, mm.
    #[must_use]
    pub fn between(&self) -> f64 {
        self.faces[1] - self.faces[0] - 2.0 * self.plate
    }

    /// Depth of the thread from either face of the body between the plates, mm; none where it goes through.
    #[must_use]
    pub fn thread_depth(&self) -> Option<f64> {
        let depth = self.screw.length - self.plate + BEYOND * self.screw.diameter;
        (2.0 * depth < self.between()).then_some(depth)
    }

    /// Contours of the holes in the plates.
    #[must_use]
    pub fn clearance_holes(&self) -> Vec<Outline> {
        self.holes(self.screw.clearance_hole())
    }

    /// Contours of the holes that the threads are cut in.
    #[must_use]
    pub fn drilled_holes(&self) -> Vec<Outline> {
        self.holes(self.screw.drill())
    }

    fn holes(&self, diameter: f64) -> Vec<Outline> {
        let circle = |at: &Point| Outline::circle(*at, 0.5 * diameter);
        self.at.iter().map(circle).collect()
    }

    /// The screws on links that all have such plates, heads on both outer faces.
    #[must_use]
    pub fn screws(&self, links: &[String], role: &str) -> TurnedPieces {
        let [low, high] = self.faces;
        let long = self.screw.length;
        let pieces = links.iter().flat_map(|link| {
            self.at.iter().flat_map(move |at| {
                let upright = |z: f64| TurnedPiece::upright(link, [at.x, at.y, z]);
                let turned = TurnedPiece {
                    turn: [PI, 0.0, 0.0],
                    ..upright(low + long)
                };
                [upright(high - long), turned]
            })
        });
        TurnedPieces {
            role: role.into(),
            standard: Some(self.screw.name()),
            pieces: pieces.collect(),
            ..TurnedPieces::new(self.screw.body(), Fit::default())
        }
    }
}

/// Where screws may be: on a line, clear of what else is there.
pub(crate) struct ScrewRoom {
    /// Line on which their axes lie; none where there is no such.
    pub(crate) line: Option<Outline>,
    /// Room taken already: circles that move along a straight line between two places, with their radius, mm.
    pub(crate) taken: Vec<([Point; 2], f64)>,
    /// Every place is there as often, turned about the origin.
    pub(crate) turns: u32,
    /// Step of the coordinates of the places, mm, which are then beside the line by less than that; zero for none.
    pub(crate) grid: f64,
}

impl ScrewRoom {
    /// Middles of so many circles of a radius, mm, or of at least three: the first where most room is, every other as far from
    /// all before it as there is room.
    ///
    /// # Errors
    /// [`FasteningError::NoRoom`] for a screw of a diameter.
    pub(crate) fn places(
        &self,
        (diameter, radius): (f64, f64),
        count: usize,
    ) -> Result<Vec<Point>, FasteningError> {
        let step = 0.25 * diameter;
        let mut free: Vec<(Point, f64)> = Vec::new();
        for segment in self.line.iter().flat_map(Outline::segments) {
            let long = 2.0 * segment.at(-1.0).first.norm();
            let parts = (long / step).ceil().clamp(1.0, MOST_PLACES);
            for i in 0..parts as usize {
                let at = self.stepped(segment.at(2.0 * i as f64 / parts - 1.0).point);
                let room = self.room(at);
                if room >= radius {
                    // Alike places differ by rounding: the first of them is taken.
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

    /// The place nearest to another with coordinates in whole steps.
    fn stepped(&self, at: Point) -> Point {
        if self.grid > 0.0 {
            at.map(|x| (x / self.grid).round() * self.grid)
        } else {
            at
        }
    }

    /// Radius of the free circle about a place, mm.
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
    fn screws_enter_no_more_than_two_diameters_and_do_not_meet() {
        let between = |distance: f64| {
            let faces = [-6.0, distance + 6.0];
            Fastening::new(6.0, (faces, 6.0), 1.0).map(|f| (f.screw.length, f.thread_depth()))
        };
        assert_eq!(between(14.0), Ok((12.0, None)));
        // Screws of 16 mm would end in the middle of 20 mm.
        assert_eq!(between(20.0), Ok((12.0, Some(9.0))));
        assert_eq!(between(22.0), Ok((16.0, None)));
        assert_eq!(between(100.0), Ok((16.0, Some(13.0))));
        let error = between(10.0).expect_err("too short");
        assert_eq!(
            error.to_string(),
            "no screw of ISO 4762 through plates of 6 mm enters the 10 mm between them by 6 mm from either side, as M6 needs"
        );
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
        let found = room.places((4.0, 4.0), 4).expect("room");
        assert_eq!(found.len(), 4);
        for (i, at) in found.iter().enumerate() {
            assert!((at - middle).norm() >= 14.0, "{at}");
            assert!(found[..i].iter().all(|other| (at - other).norm() >= 16.0));
        }
        room.grid = 0.8;
        for at in room.places((4.0, 4.0), 4).expect("room") {
            assert!((at - middle).norm() >= 14.0, "{at}");
            let off = at.coords.map(|x| x / 0.8 - (x / 0.8).round()).norm();
            assert!(off < 1e-9, "{at}");
        }
        let across = [Point::new(-50.0, 20.0), Point::new(90.0, 20.0)];
        room.taken.push((across, 19.0));
        let error = room.places((4.0, 4.0), 4).expect_err("no room");
        assert!(
            matches!(error, FasteningError::NoRoom { found: 0, .. }),
            "{error}"
        );
    }
}
