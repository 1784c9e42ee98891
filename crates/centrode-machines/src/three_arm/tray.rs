use centrode_geometry::{Outline, Point};
use nalgebra::Isometry2;

use super::ThreeArm;
use super::design::Unpicked;

/// Depth of the plate that represents a tray, in distances of its holes.
const DEPTH: f64 = 2.0;

/// Side view of the tray, with the seedlings that are still in it.
///
/// The origin of its frame is on the tray's surface at the hole that is picked from; x is the direction in which the arms
/// enter, y runs along the rows.
#[derive(Clone, Debug)]
pub struct TrayBody {
    /// Pose of the tray's frame in the machine's.
    pub place: Isometry2<f64>,
    /// The plate behind the surface, counter-clockwise, in the tray's frame.
    pub plate: Outline,
    /// The stems of the unpicked rows, the nearest row first, in the tray's frame.
    pub stems: Vec<Outline>,
}

impl TrayBody {
    /// Contour of the tray moved into the machine's frame.
    #[must_use]
    pub fn placed(&self, outline: &Outline) -> Outline {
        outline.transformed(&self.place)
    }
}

impl ThreeArm {
    /// Distance of the tray's surface from the carrier's axis, mm.
    fn tray_distance(&self) -> f64 {
        let tip = self.tip(self.picking(0), 0).position;
        let spec = &self.design().tray;
        spec.distance
            .unwrap_or(tip.coords.dot(&self.tray_direction()))
    }

    /// Distance of the circle that the gearbox sweeps from the tray's surface, mm; negative if the circle extends beyond the
    /// surface.
    #[must_use]
    pub fn gearbox_tray_clearance(&self) -> f64 {
        self.tray_distance() - self.gearbox_radius()
    }

    /// Tray in the pose in which the arms enter it, with all its rows; the hole that is picked from is in the middle.
    ///
    /// The stems of unpicked rows are perpendicular to the surface. Stems in the row that is picked do not count.
    #[must_use]
    pub fn tray_body(&self) -> TrayBody {
        let spec = &self.design().tray;
        let inward = self.tray_direction();
        let tip = self.tip(self.picking(0), 0).position;
        let reach = tip.coords.dot(&inward);
        let origin = tip + inward * (self.tray_distance() - reach);
        let half = 0.5 * f64::from(spec.rows) * spec.hole_spacing;
        let box_of = |[left, low]: [f64; 2], [right, high]: [f64; 2]| {
            let corners = [[left, low], [right, low], [right, high], [left, high]];
            Outline::polygon(&corners.map(Point::from))
        };
        // The directions up of machine and tray agree if the arms enter the tray to the right; otherwise they are opposite.
        let up = inward.x.signum();
        let sides: &[f64] = match spec.unpicked {
            Unpicked::Above => &[1.0],
            Unpicked::Below => &[-1.0],
            Unpicked::Both => &[1.0, -1.0],
            Unpicked::None => &[],
        };
        let (length, thick) = (spec.stem_length, 0.5 * self.design().seedling.width);
        let rows = (1..).map(|row| f64::from(row) * spec.hole_spacing);
        let rows = rows.take_while(|far| *far < half);
        let stems = rows.flat_map(|far| sides.iter().map(move |side| far * side * up));
        TrayBody {
            place: Isometry2::new(origin.coords, inward.y.atan2(inward.x)),
            plate: box_of([0.0, -half], [DEPTH * spec.hole_spacing, half]),
            stems: stems
                .filter(|_| length > 0.0 && thick > 0.0)
                .map(|y| box_of([-length, y - thick], [0.0, y + thick]))
                .collect(),
        }
    }
}
