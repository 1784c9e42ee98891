use crate::{Point, curve::Bounds, numeric::rounding};

/// A circle with its inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Center.
    pub center: Point,
    /// Radius, mm.
    pub radius: f64,
}

impl Disc {
    /// A disc around points, about the middle of their bounding box.
    #[must_use]
    pub fn around(points: impl Iterator<Item = Point> + Clone) -> Self {
        let center = points.clone().collect::<Bounds>().center();
        let radius = points.map(|p| (p - center).norm()).fold(0.0, f64::max);
        Self { center, radius }
    }

    /// A disc around discs, about the middle of the bounding box of their centers.
    #[must_use]
    pub fn around_discs(discs: &[Self]) -> Self {
        if let [one] = discs {
            return *one;
        }
        let center = discs.iter().map(|d| d.center).collect::<Bounds>().center();
        let reach = discs.iter().map(|d| (d.center - center).norm() + d.radius);
        let radius = reach.fold(0.0, f64::max) * (1.0 + rounding(1.0));
        Self { center, radius }
    }
}
