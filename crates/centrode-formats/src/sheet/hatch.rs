use super::{Draft, Pen};
use crate::drawing::{Hatch, Object};
use centrode_geometry::{Outline, Point, Tolerance, Vector};
use nalgebra::Rotation2;
use std::f64::consts::FRAC_PI_4;

/// Distance of hatching lines, mm.
const SPACING: f64 = 2.0;

/// Maximum extent of a hatched area on paper, mm: several times that of the largest sheet.
const LARGEST: f64 = 1e4;

impl Draft {
    /// Hatches the area between contours, some of which may be holes, at 45 degrees.
    pub fn hatch(&mut self, contours: &[Outline], tolerance: Tolerance) {
        let first = self.count();
        let turn = Rotation2::new(-FRAC_PI_4);
        let rings: Vec<Vec<Point>> = contours
            .iter()
            .map(|c| c.flatten(tolerance).iter().map(|p| turn * p).collect())
            .collect();
        let heights = || rings.iter().flatten().map(|p| p.y);
        let low = heights().fold(f64::INFINITY, f64::min);
        let high = heights().fold(f64::NEG_INFINITY, f64::max);
        // An area that fits on no sheet is not hatched at this scale.
        if high - low > LARGEST {
            return;
        }
        let mut row = (low / SPACING).floor();
        while row * SPACING < high {
            row += 1.0;
            // A line never passes through a corner.
            let y = row * SPACING + 1e-7;
            let mut xs: Vec<f64> = rings.iter().flat_map(|ring| crossings(ring, y)).collect();
            xs.sort_by(f64::total_cmp);
            for pair in xs.chunks_exact(2) {
                let [a, b] = [pair[0], pair[1]].map(|x| turn.inverse() * Point::new(x, y));
                if (b - a).norm() > 0.2 {
                    self.line(Pen::Hatch, a, b);
                }
            }
        }
        let hatch = Hatch {
            contours: contours.to_vec(),
            origin: Point::origin(),
            angle: FRAC_PI_4,
            spacing: SPACING,
        };
        self.gather(first, Pen::Hatch, Object::Hatch(hatch));
    }
}

fn crossings(ring: &[Point], y: f64) -> impl Iterator<Item = f64> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).filter_map(move |(a, b)| {
        let crosses = (a.y > y) != (b.y > y);
        crosses.then(|| {
            let along: Vector = b - a;
            a.x + along.x * (y - a.y) / along.y
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::EntityShape;

    #[test]
    fn hatching_stays_between_the_contours() {
        let tolerance = Tolerance::new(1e-3).expect("positive");
        let ring = [20.0, 8.0].map(|r| Outline::circle(Point::new(3.0, 1.0), r));
        let mut draft = Draft::default();
        draft.hatch(&ring, tolerance);
        let mut length = 0.0;
        let drawn = draft.into_entities();
        for entity in drawn.iter().flat_map(|entity| entity.plain()) {
            let EntityShape::Line(a, b) = entity.shape else {
                panic!("hatching is lines");
            };
            let middle = ((a + b.coords) / 2.0 - Point::new(3.0, 1.0)).norm();
            assert!(middle > 7.9 && middle < 20.1, "{middle}");
            length += (b - a).norm();
        }
        let area = std::f64::consts::PI * (400.0 - 64.0);
        assert!((length * SPACING / area - 1.0).abs() < 0.01, "{length}");
    }
}
