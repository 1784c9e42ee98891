use std::fmt;

use centrode_geometry::{Outline, Point, Tolerance, Vector, convex_hull};
use nalgebra::Isometry2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Piece of stock that a part is made from, its net size: nothing is added for the cut.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case", tag = "kind")]
pub enum Blank {
    /// A rectangle of plate.
    Plate {
        /// Longer and shorter side, mm.
        sides: [f64; 2],
        /// Thickness, mm.
        thickness: f64,
    },
    /// A length of round bar.
    Round {
        /// Diameter, mm.
        diameter: f64,
        /// Length, mm.
        length: f64,
    },
}

/// Maximum distance from the contour, mm, of the polygon that decides the direction of the sides; their lengths are those of the
/// contour.
const FINE: f64 = 1e-3;
/// Excess over a tenth of a millimetre that is not rounded up to the next tenth, mm: larger than any rounding error.
const HAIR: f64 = 1e-6;

impl Blank {
    /// The minimum rectangle of plate around a contour, or round bar if it is a circle; `None` for a contour of no extent.
    ///
    /// One side of the minimum rectangle lies along a side of the convex hull: every one is tried, on a polygon within 0.001 mm.
    /// The sides returned are those of the contour.
    #[must_use]
    pub fn plate(outline: &Outline, thickness: f64) -> Option<Self> {
        let points = outline.flatten(Tolerance::new(FINE).ok()?);
        let middle = outline.bounds().center();
        let radii = points.iter().map(|p| (p - middle).norm());
        let [minimum, most] = radii.fold([f64::INFINITY, 0.0], |[low, high], r| {
            [f64::min(low, r), f64::max(high, r)]
        });
        if most - minimum < 2.0 * FINE {
            return Some(Self::Round {
                diameter: 2.0 * outline.maximum_distance(middle),
                length: thickness,
            });
        }
        let hull: Vec<_> = convex_hull(&points).iter().map(|&i| points[i]).collect();
        let next = hull.iter().cycle().skip(1);
        let ways = hull.iter().zip(next).filter_map(|(a, b)| {
            let along = (b - a).try_normalize(0.0)?;
            let across = Vector::new(-along.y, along.x);
            let [long, wide] = [along, across].map(|way| {
                let places = hull.iter().map(|p| p.coords.dot(&way));
                let ends = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                    [low.min(x), high.max(x)]
                });
                ends[1] - ends[0]
            });
            Some((long * wide, along))
        });
        let (_, along) = ways.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        let upright = Isometry2::new(Vector::zeros(), -along.y.atan2(along.x));
        let bounds = outline.transformed(&upright).bounds();
        let [a, b] = (bounds.max - bounds.min).into();
        let sides = [f64::max(a, b), f64::min(a, b)];
        Some(Self::Plate { sides, thickness })
    }

    /// Round bar about the origin of a contour, as for a turned part.
    #[must_use]
    pub fn round(outline: &Outline, length: f64) -> Option<Self> {
        let diameter = 2.0 * outline.maximum_distance(Point::origin());
        (diameter > 0.0).then_some(Self::Round { diameter, length })
    }
}

impl fmt::Display for Blank {
    /// "plate 8: 210.6 x 30", "round Ø66 x 10": sizes rounded up to tenths of a millimetre.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let up = |mm: f64| (10.0 * (mm - HAIR)).ceil() / 10.0;
        match self {
            Self::Plate {
                sides: [long, short],
                thickness,
            } => {
                let thickness = (1e3 * thickness).round() / 1e3;
                write!(f, "plate {thickness}: {} x {}", up(*long), up(*short))
            }
            Self::Round { diameter, length } => {
                write!(f, "round Ø{} x {}", up(*diameter), up(*length))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_rectangle_lies_askew_where_the_part_does() {
        let ends = [(Point::new(0.0, 0.0), 15.0), (Point::new(147.0, 0.0), 15.0)];
        let bar = Outline::hull(&ends).expect("a bar");
        for angle in [0.0, 0.4, 2.0, 3.3] {
            let turned = bar.transformed(&Isometry2::new(Vector::new(7.0, -30.0), angle));
            let blank = Blank::plate(&turned, 8.0).expect("a blank");
            let Blank::Plate { sides, .. } = blank else {
                panic!("{blank}");
            };
            assert!((sides[0] - 177.0).abs() < 1e-9 && (sides[1] - 30.0).abs() < 1e-9);
            assert_eq!(blank.to_string(), "plate 8: 177 x 30");
        }
    }

    #[test]
    fn a_round_blank_is_as_thick_as_the_farthest_point_asks_for() {
        let tip = [
            Point::new(33.02, 0.0),
            Point::new(0.0, 5.0),
            Point::new(-9.0, 0.0),
        ];
        let blank = Blank::round(&Outline::polygon(&tip), 10.0);
        assert_eq!(blank.expect("a blank").to_string(), "round Ø66.1 x 10");
        let disc = Outline::circle(Point::new(4.0, 3.0), 4.0);
        let blank = Blank::plate(&disc, 7.03514).expect("a blank");
        assert_eq!(blank.to_string(), "round Ø8 x 7.1");
    }

    #[test]
    fn a_micrometre_over_a_tenth_costs_another() {
        for (over, stated) in [(0.0, "96"), (9e-7, "96"), (1e-5, "96.1"), (1e-3, "96.1")] {
            let [diameter, length] = [96.0 + over, 8.0];
            let blank = Blank::Round { diameter, length };
            assert_eq!(blank.to_string(), format!("round Ø{stated} x 8"));
            let blank = Blank::Plate {
                sides: [diameter, 30.0],
                thickness: 8.0,
            };
            assert_eq!(blank.to_string(), format!("plate 8: {stated} x 30"));
        }
    }

    #[test]
    fn a_round_blank_is_as_wide_as_the_arc_between_its_points() {
        // An arc of 4 mm off the origin, whose farthest point is no corner.
        let disc = Outline::circle(Point::new(0.3, 0.4), 4.0);
        let Some(Blank::Round { diameter, .. }) = Blank::round(&disc, 1.0) else {
            panic!("no blank");
        };
        assert!((diameter - 9.0).abs() < 1e-12, "{diameter}");
    }
}
