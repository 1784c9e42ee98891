use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PitchError;
use super::error::{finite, positive};
use super::piecewise::Coordinates;

/// Maximum number of points of one curve: limits time and memory of a design.
pub(crate) const MAX_POINTS: usize = 10_000;

/// The plane control points are drawn in.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Plane {
    /// Polar angle across, radius up: `angle_deg` and `radius`.
    #[default]
    Polar,
    /// `x` and `y` around the shaft axis.
    Cartesian,
}

/// The lists of a description that hold its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lists<'a> {
    pub(crate) plane: Plane,
    pub(crate) radius: &'a [f64],
    pub(crate) angle: &'a [f64],
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
}

/// Points of a closed curve in one of the planes; the list repeats after one turn.
#[derive(Clone, Debug)]
pub(crate) struct Points {
    pub(crate) coordinates: Coordinates,
    list: Vec<[f64; 2]>,
}

impl Lists<'_> {
    /// Key at which an error of the whole curve is reported.
    pub(crate) fn key(&self) -> &'static str {
        match self.plane {
            Plane::Polar => "radius",
            Plane::Cartesian => "x",
        }
    }

    /// Checks the points: as many as needed, finite, in the polar plane in order round the axis.
    pub(crate) fn check(&self, minimum: usize) -> Result<(), PitchError> {
        let stray = |key, list: &[f64], rule| {
            if list.is_empty() {
                Ok(())
            } else {
                Err(PitchError::Key { key, rule })
            }
        };
        let cartesian = "belongs to plane = \"cartesian\", but plane is \"polar\"";
        let polar = "belongs to plane = \"polar\", but plane is \"cartesian\"";
        match self.plane {
            Plane::Polar => {
                stray("x", self.x, cartesian)?;
                stray("y", self.y, cartesian)?;
                pair("radius", self.radius, "angle_deg", self.angle, minimum)?;
                for &r in self.radius {
                    positive("radius", r)?;
                }
                angles_in_order(self.angle)
            }
            Plane::Cartesian => {
                stray("radius", self.radius, polar)?;
                stray("angle_deg", self.angle, polar)?;
                pair("x", self.x, "y", self.y, minimum)?;
                for (&x, &y) in self.x.iter().zip(self.y) {
                    finite("x", x)?;
                    finite("y", y)?;
                }
                Ok(())
            }
        }
    }

    /// The points, checked.
    pub(crate) fn points(&self, minimum: usize) -> Result<Points, PitchError> {
        self.check(minimum)?;
        let (coordinates, first, second) = match self.plane {
            Plane::Polar => (Coordinates::Polar, self.angle, self.radius),
            Plane::Cartesian => (Coordinates::Cartesian, self.x, self.y),
        };
        let list = first.iter().zip(second).map(|(&a, &b)| [a, b]);
        Ok(Points {
            coordinates,
            list: list.collect(),
        })
    }
}

fn pair(
    first: &'static str,
    a: &[f64],
    second: &'static str,
    b: &[f64],
    minimum: usize,
) -> Result<(), PitchError> {
    count(first, a.len(), minimum)?;
    if a.len() == b.len() {
        return Ok(());
    }
    Err(PitchError::LengthMismatch {
        first,
        first_length: a.len(),
        second,
        second_length: b.len(),
    })
}

/// Refuses a list that is too short or too long.
pub(crate) fn count(key: &'static str, count: usize, minimum: usize) -> Result<(), PitchError> {
    if count < minimum {
        return Err(PitchError::TooFewPoints {
            key,
            count,
            minimum,
        });
    }
    if count > MAX_POINTS {
        let limit = MAX_POINTS;
        return Err(PitchError::TooManyPoints { key, count, limit });
    }
    Ok(())
}

/// Refuses angles that do not increase, or exceed one turn.
pub(crate) fn angles_in_order(angle: &[f64]) -> Result<(), PitchError> {
    for &a in angle {
        finite("angle_deg", a)?;
    }
    for (i, w) in angle.windows(2).enumerate() {
        if w[1] <= w[0] || w[1] - angle[0] >= std::f64::consts::TAU {
            return Err(PitchError::AnglesNotIncreasing {
                index: i + 1,
                value: w[1].to_degrees(),
                before: w[0].to_degrees(),
            });
        }
    }
    Ok(())
}

impl Points {
    pub(crate) fn cartesian(list: Vec<[f64; 2]>) -> Self {
        let coordinates = Coordinates::Cartesian;
        Self { coordinates, list }
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Point `index`, counted on through any number of turns.
    pub(crate) fn at(&self, index: isize) -> [f64; 2] {
        let count = self.list.len() as isize;
        let [a, b] = self.list[index.rem_euclid(count) as usize];
        match self.coordinates {
            Coordinates::Polar => [
                a + index.div_euclid(count) as f64 * std::f64::consts::TAU,
                b,
            ],
            Coordinates::Cartesian => [a, b],
        }
    }

    /// Polar angle and radius of every point, in order of the angle.
    pub(crate) fn polar(&self) -> Vec<[f64; 2]> {
        let polar = |&[a, b]: &[f64; 2]| match self.coordinates {
            Coordinates::Polar => [a, b],
            Coordinates::Cartesian => [b.atan2(a), a.hypot(b)],
        };
        let mut list: Vec<[f64; 2]> = self.list.iter().map(polar).collect();
        list.sort_by(|p, q| p[0].total_cmp(&q[0]));
        list
    }

    /// Part of the coordinates that repeats: in the polar plane without the even turn.
    pub(crate) fn periodic(&self) -> [Vec<f64>; 2] {
        let step = self.even_turn();
        let first = self.list.iter().enumerate();
        let first = first.map(|(i, p)| p[0] - step * i as f64).collect();
        [first, self.list.iter().map(|p| p[1]).collect()]
    }

    /// The points with the repeating part of their coordinates replaced.
    pub(crate) fn with_periodic(&self, [first, second]: [Vec<f64>; 2]) -> Self {
        let step = self.even_turn();
        let list = first.into_iter().zip(second).enumerate();
        Self {
            coordinates: self.coordinates,
            list: list.map(|(i, (a, b))| [a + step * i as f64, b]).collect(),
        }
    }

    fn even_turn(&self) -> f64 {
        match self.coordinates {
            Coordinates::Polar => std::f64::consts::TAU / self.list.len() as f64,
            Coordinates::Cartesian => 0.0,
        }
    }
}
