//! Screws through two plates, from both sides, into the body between them that holds them apart.

use std::f64::consts::PI;

use centrode_geometry::{Outline, Point};

use super::{Fit, Screw, TurnedPiece, TurnedPieces};

/// Maximum length of thread that a screw enters, in its diameters: a longer one holds no better.
const ENTERED: f64 = 2.0;
/// Length of thread beyond the end of the screw, in its diameters.
const BEYOND: f64 = 0.5;
/// Minimum distance of the ends of two screws that are screwed in from both sides, in their diameters.
const APART: f64 = 0.25;

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

/// Reason why plates cannot be screwed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FasteningError {
    /// No screw enters far enough.
    #[error(
        "no screw M{diameter} of ISO 4762 fits: through a plate of {plate} mm its thread must engage at least {minimum} mm from each side, but the plates are {between} mm apart"
    )]
    TooShort {
        /// Nominal diameter, mm.
        diameter: f64,
        /// Thickness of a plate, mm.
        plate: f64,
        /// Distance between the plates, mm.
        between: f64,
        /// Minimum length of thread, mm.
        minimum: f64,
    },
    /// Too few positions that are clear of all other parts.
    #[error(
        "only {found} of the 3 required positions for screws M{diameter} are clear of moving parts: each needs a free circle of {around} mm diameter"
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
    /// Screws of a diameter for plates of a thickness between two outer faces, mm, without positions yet. Each enters two
    /// diameters of thread at most, and its end is apart from that of the screw from the other side.
    ///
    /// # Errors
    /// [`FasteningError::TooShort`] if it then enters less than `minimum` diameters.
    pub fn new(
        diameter: f64,
        faces: [f64; 2],
        plate: f64,
        minimum: f64,
    ) -> Result<Self, FasteningError> {
        let between = faces[1] - faces[0] - 2.0 * plate;
        let enters = (ENTERED * diameter).min(0.5 * (between - APART * diameter));
        let screw = Screw::for_diameter(diameter, plate + enters);
        let entered = |screw: &Screw| screw.length - plate >= minimum * diameter * (1.0 - 1e-9);
        let screw = screw.filter(entered).ok_or(FasteningError::TooShort {
            diameter,
            plate,
            between,
            minimum: minimum * diameter,
        })?;
        Ok(Self {
            screw,
            at: Vec::new(),
            faces,
            plate,
        })
    }

    /// The first size for which a layout finds screws and room. Sizes are tried from the thickness of a plate down to half of it,
    /// or `size` alone; `None` if there is no such size.
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

    /// Maximum height of a head that [`Fastening::largest`] may choose, mm; zero if there is no size to choose.
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

    /// Depth of the thread from either face of the body between the plates, mm; `None` if it goes through.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screws_enter_no_more_than_two_diameters_and_do_not_meet() {
        let between = |distance: f64| {
            let faces = [-6.0, distance + 6.0];
            Fastening::new(6.0, faces, 6.0, 1.0).map(|f| (f.screw.length, f.thread_depth()))
        };
        assert_eq!(between(14.0), Ok((12.0, None)));
        // Screws of 16 mm would end in the middle of 20 mm.
        assert_eq!(between(20.0), Ok((12.0, Some(9.0))));
        assert_eq!(between(22.0), Ok((16.0, None)));
        assert_eq!(between(100.0), Ok((16.0, Some(13.0))));
        let error = between(10.0).expect_err("too short");
        assert_eq!(
            error.to_string(),
            "no screw M6 of ISO 4762 fits: through a plate of 6 mm its thread must engage at least 6 mm from each side, but the plates are 10 mm apart"
        );
    }
}
