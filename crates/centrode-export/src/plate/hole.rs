use crate::fit;
use centrode_formats::sheet::number;
use centrode_gear::design::BodySpec;
use centrode_geometry::{Outline, Point, Segment};
use centrode_kinematics::machine::{Fastening, Screw};
use centrode_machines::PinHole;
use std::f64::consts::TAU;

/// A contour cut out of a plate.
#[derive(Clone, Debug)]
pub(crate) struct Hole {
    pub(crate) outline: Outline,
    /// Letter or name next to it on the sheet; may be empty.
    pub(crate) label: String,
    /// Tolerance class of its diameter or width, ISO 286; empty where general tolerances hold.
    pub(crate) fit: String,
    /// Permitted deviation of its position in any direction, mm; 0 where general tolerances hold.
    pub(crate) off: f64,
    /// Permitted deviation (±) of its distance from another hole of the plate, mm, where two gears mesh. `None` if no
    /// gears mesh there.
    pub(crate) apart: Option<f64>,
    /// Whether it is the seat of a shaft.
    pub(crate) is_seat: bool,
    /// Width of its keyway, mm; 0 if it has none.
    pub(crate) keyed: f64,
    /// Further lines next to it.
    pub(crate) notes: Vec<String>,
    /// Screw that goes through it or into its thread.
    pub(crate) screw: Option<ScrewHole>,
}

/// Hole of a screw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ScrewHole {
    /// Hole that the screw goes through with clearance.
    Clearance(Screw),
    /// Through hole with a thread of this depth from both faces, mm; `None` for a thread over the whole length.
    Thread(Screw, Option<f64>),
}

impl ScrewHole {
    /// Permitted deviation of its position in any direction, mm. Hole and thread share the clearance: each has a tolerance
    /// cylinder with half the clearance as its diameter, so that a screw in its thread fits through its hole.
    fn off(self) -> f64 {
        let (Self::Clearance(screw) | Self::Thread(screw, _)) = self;
        0.25 * (screw.clearance_hole() - screw.diameter)
    }
}

impl Hole {
    /// Holes in a plate that screws go through.
    pub(crate) fn clearance(fastening: &Fastening) -> Vec<Self> {
        let screw = fastening.screw;
        let all = fastening.clearance_holes().into_iter();
        all.map(|outline| Self {
            fit: Screw::HOLE.into(),
            notes: vec![format!("for ISO 4762 - {}", screw.thread())],
            ..Self::of_screw(outline, ScrewHole::Clearance(screw))
        })
        .collect()
    }

    /// Threaded holes in the part between the plates.
    pub(crate) fn threads(fastening: &Fastening) -> Vec<Self> {
        let (screw, depth) = (fastening.screw, fastening.thread_depth());
        let all = fastening.drilled_holes().into_iter();
        all.map(|outline| Self {
            fit: Screw::THREAD.into(),
            notes: vec![format!("drilled Ø{} through", number(screw.drill(), 3))],
            ..Self::of_screw(outline, ScrewHole::Thread(screw, depth))
        })
        .collect()
    }

    fn of_screw(outline: Outline, screw: ScrewHole) -> Self {
        Self {
            off: screw.off(),
            screw: Some(screw),
            ..Self::from(outline)
        }
    }

    /// The bore of a body, with its keyway where it has one.
    pub(crate) fn bore(outline: Outline, body: &BodySpec) -> Self {
        let mut bore = Self {
            fit: body.bore_fit.clone(),
            is_seat: true,
            ..Self::from(outline)
        };
        if let Some(key) = body.keyway {
            bore.keyed = key.width;
            let angle = fit::keyway_angle(body.keyway_angle, body.bore, key.width);
            bore.notes = vec![
                fit::bore(body.bore, &body.bore_fit),
                format!("keyway {}", fit::keyway(key.width, &body.keyway_fit)),
                format!("Ø + depth {}, at {angle}", fit::hub_depth(body.bore, key)),
            ];
        }
        bore
    }

    /// The hole of a plate for a pin or shaft, named after its point.
    pub(crate) fn of_pin(outline: Outline, pin: &PinHole) -> Self {
        let mut bored = Self::bore(outline, &pin.hub);
        bored.is_seat = !bored.notes.is_empty();
        if bored.is_seat {
            // The sheet states the position of circles only; this contour is no circle.
            let [x, y] = [pin.at.x, pin.at.y].map(|mm| number(mm, 4));
            bored.notes.insert(1, format!("at {x}, {y}"));
        }
        bored.label.clone_from(&pin.name);
        bored
    }
}

/// Sets the permitted deviation ±`off` (mm) for holes whose distance is the centre distance of gears in mesh (mm).
pub(crate) fn hold_apart(holes: &mut [Hole], distance: f64, off: f64) {
    const NEAR: f64 = 1e-6;
    let axes: Vec<Option<Point>> = holes.iter().map(Hole::axis).collect();
    let apart = |at: Point| move |other: Point| ((other - at).norm() - distance).abs() < NEAR;
    for (hole, at) in holes.iter_mut().zip(&axes) {
        let meets = at.is_some_and(|at| axes.iter().flatten().copied().any(apart(at)));
        if meets {
            hole.apart = Some(hole.apart.map_or(off, |known| known.min(off)));
        }
    }
}

impl From<Outline> for Hole {
    fn from(outline: Outline) -> Self {
        Self {
            outline,
            label: String::new(),
            fit: String::new(),
            off: 0.0,
            apart: None,
            is_seat: false,
            keyed: 0.0,
            notes: Vec::new(),
            screw: None,
        }
    }
}

/// Shape of a hole that a sheet states in words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HoleKind {
    /// Centre and radius.
    Round(Point, f64),
    /// Centres of the round ends and their radius.
    Slot([Point; 2], f64),
    /// Given by its contour.
    Free,
}

impl Hole {
    /// Middle of a round hole, or of the bore of a seat with a keyway.
    pub(super) fn axis(&self) -> Option<Point> {
        if let HoleKind::Round(center, _) = self.kind() {
            return Some(center);
        }
        let mut sides = self.outline.segments().iter().filter(|_| self.is_seat);
        sides.find_map(|side| match side {
            Segment::Arc(arc) => Some(arc.center()),
            _ => None,
        })
    }

    /// Middle of a slot with a class.
    pub(super) fn fitted_slot(&self) -> Option<Point> {
        match self.kind() {
            HoleKind::Slot([a, b], _) if !self.fit.is_empty() => Some(nalgebra::center(&a, &b)),
            _ => None,
        }
    }

    pub(super) fn kind(&self) -> HoleKind {
        if let Some((center, radius)) = self.outline.as_circle() {
            return HoleKind::Round(center, radius);
        }
        match slot(&self.outline) {
            Some((ends, radius)) => HoleKind::Slot(ends, radius),
            None => HoleKind::Free,
        }
    }

    /// Whether only its contour shows its shape, without words.
    pub(super) fn is_by_contour(&self) -> bool {
        self.kind() == HoleKind::Free && self.notes.is_empty()
    }

    /// Diameter or width with its limits; empty for a contour of another shape.
    pub(super) fn size(&self) -> String {
        if let Some(ScrewHole::Thread(screw, depth)) = self.screw {
            let thread = format!("{}-{}", screw.thread(), self.fit);
            return match depth {
                Some(depth) => format!("{thread} × {} from both faces", number(depth, 3)),
                None => format!("{thread} through"),
            };
        }
        match self.kind() {
            HoleKind::Round(_, radius) => fit::bore(2.0 * radius, &self.fit),
            HoleKind::Slot(_, radius) => {
                format!("slot {}", fit::keyway(2.0 * radius, &self.fit))
            }
            HoleKind::Free => String::new(),
        }
    }
}

/// Centres of the ends and their radius, of a contour of two half circles and two lines.
fn slot(contour: &Outline) -> Option<([Point; 2], f64)> {
    let mut ends: Vec<(Point, f64)> = Vec::new();
    let mut lines = 0;
    for segment in contour.segments() {
        match segment {
            Segment::Line(..) => lines += 1,
            Segment::Arc(arc) => {
                let half = (arc.sweep().abs() - 0.5 * TAU).abs() < 1e-6;
                ends.extend(half.then(|| (arc.center(), arc.radius())));
            }
            Segment::Poly(_) => return None,
        }
    }
    match (&ends[..], lines, contour.segments().len()) {
        ([(a, r), (b, s)], 2, 4) if (r - s).abs() < 1e-6 * r => Some(([*a, *b], *r)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_holes_and_slots_are_known_by_their_contours() {
        let p = Point::new;
        let round = Hole::from(Outline::circle(p(3.0, -1.0), 2.5));
        assert!(matches!(round.kind(), HoleKind::Round(at, r)
            if (at - p(3.0, -1.0)).norm() < 1e-12 && (r - 2.5).abs() < 1e-12));
        let ends = [(p(10.0, 0.0), 4.0), (p(30.0, 0.0), 4.0)];
        let hull = Outline::hull(&ends).expect("a hull");
        let slot = Hole {
            fit: "H9".into(),
            ..Hole::from(hull)
        };
        assert_eq!(slot.size(), "slot 8 H9 (+0.036 / 0)");
        let corners = [p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)];
        let free = Hole::from(Outline::polygon(&corners));
        assert_eq!((free.kind(), free.size()), (HoleKind::Free, String::new()));
    }

    #[test]
    fn holes_of_gears_in_mesh_are_held_to_what_their_distance_may_be_off() {
        let at = [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0)];
        let hole = |(x, y)| Hole::from(Outline::circle(Point::new(x, y), 3.0));
        let mut holes = at.map(hole);
        hold_apart(&mut holes, 40.0, 0.03);
        assert_eq!(
            holes.each_ref().map(|hole| hole.apart),
            [Some(0.03), Some(0.03), None]
        );
        // Of two pairs the closer one holds.
        hold_apart(&mut holes, 30.0, 0.02);
        assert_eq!(
            holes.map(|hole| hole.apart),
            [Some(0.03), Some(0.02), Some(0.02)]
        );
    }
}
