//! Bore in the middle of a part.

use std::f64::consts::PI;

use centrode_geometry::{Arc, Outline, Point, Segment};
use nalgebra::Isometry2;

use crate::design::BodySpec;

impl BodySpec {
    /// The bore with its keyway, counter-clockwise; `None` for a body without one.
    #[must_use]
    pub fn bore_outline(&self) -> Option<Outline> {
        let radius = 0.5 * self.bore;
        if radius <= 0.0 {
            return None;
        }
        let segments = match self.keyway {
            None => {
                let (east, west) = (Point::new(radius, 0.0), Point::new(-radius, 0.0));
                let half = |start, end| {
                    Segment::Arc(Arc {
                        start,
                        end,
                        bulge: 1.0,
                    })
                };
                vec![half(east, west), half(west, east)]
            }
            Some(key) => {
                let half = 0.5 * key.width;
                let foot = (radius * radius - half * half).max(0.0).sqrt();
                let top = radius + key.depth;
                let west = Point::new(-radius, 0.0);
                let corner = |x: f64, y: f64| Point::new(x, y);
                let (start, end) = (corner(foot, half), corner(foot, -half));
                let quarter = (0.25 * (PI - half.atan2(foot))).tan();
                vec![
                    Segment::Arc(Arc {
                        start,
                        end: west,
                        bulge: quarter,
                    }),
                    Segment::Arc(Arc {
                        start: west,
                        end,
                        bulge: quarter,
                    }),
                    Segment::Line(end, corner(top, -half)),
                    Segment::Line(corner(top, -half), corner(top, half)),
                    Segment::Line(corner(top, half), start),
                ]
            }
        };
        let along_x = Outline::new(segments).ok()?;
        Some(match self.keyway_angle {
            0.0 => along_x,
            angle => along_x.transformed(&Isometry2::rotation(angle)),
        })
    }

    /// Maximum distance of bore and keyway from the axis, mm.
    #[must_use]
    pub fn bore_reach(&self) -> f64 {
        let keyway = self
            .keyway
            .map_or(0.0, |k| (0.5 * self.bore + k.depth).hypot(0.5 * k.width));
        keyway.max(0.5 * self.bore)
    }
}
