use crate::ExportError;
use crate::drawing::{Color, Drawing, LineType, Shape};
use centrode_geometry::{Mesh, Outline, Point, Solid, Tolerance};
use centrode_mechanism::gear::{Gear, IncompletePair};
use nalgebra::Isometry2;

const PROFILE: &str = "PROFILE";
const BORE: &str = "BORE";
const PIN: &str = "PIN";
const CENTER: &str = "CENTER";
const CAM: &str = "CAM";

/// A part of the incomplete gear pair.
pub(super) struct GearPart {
    pub(super) name: &'static str,
    /// A polygon of short chords.
    outline: Outline,
    /// Outline of few lines and arcs, for drawings.
    drawn: Outline,
    /// Contours cut out of it.
    holes: Vec<Outline>,
    /// Pins that stand on it, for reference.
    pins: Vec<(Point, f64)>,
    width: f64,
}

/// Driver, driven gear and, where there is an entry angle, the cams beside the driver; drawn with arcs within the tolerance.
pub(super) fn parts(gears: &IncompletePair, tolerance: Tolerance) -> Vec<GearPart> {
    let pair = gears.pair();
    let part = |name, outline: &Outline, gear: &Gear, pins| GearPart {
        name,
        outline: outline.clone(),
        drawn: outline.arcs_of_chords(gears.accuracy(), tolerance),
        holes: gear.bore().into_iter().collect(),
        pins,
        width: gear.body().width,
    };
    let pins = gears.cams().iter().flat_map(|cam| {
        let pins = cam.pins.iter();
        pins.map(|&at| (at, cam.pin_radius))
    });
    let mut parts = vec![
        part("gear-driver", gears.driver(), pair.driver(), Vec::new()),
        part("gear-driven", gears.driven(), pair.driven(), pins.collect()),
    ];
    let sides = ["gear-entry-cam", "gear-exit-cam"];
    for (name, cam) in sides.into_iter().zip(gears.cams()) {
        parts.push(part(name, &cam.outline, pair.driver(), Vec::new()));
    }
    parts
}

impl GearPart {
    pub(super) fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, ExportError> {
        Solid::new(self.outline.clone(), self.holes.clone(), 0.0, self.width)
            .and_then(|solid| solid.mesh(tolerance))
            .map_err(ExportError::no_solid(self.name))
    }

    pub(super) fn drawing(&self) -> Drawing {
        let mut drawing = layers();
        self.draw(&mut drawing, PROFILE, &Isometry2::identity());
        drawing
    }

    fn draw(&self, drawing: &mut Drawing, layer: &str, place: &Isometry2<f64>) {
        for &(center, radius) in &self.pins {
            let center = place * center;
            drawing.draw(PIN, Shape::Circle { center, radius });
        }
        for hole in &self.holes {
            drawing.draw(BORE, Shape::Contour(hole.transformed(place)));
        }
        drawing.draw(CENTER, Shape::Mark(place * Point::origin()));
        drawing.draw(layer, Shape::Contour(self.drawn.transformed(place)));
    }
}

/// The gears in place as the motion begins.
pub(super) fn assembly(gears: &IncompletePair, parts: &[GearPart]) -> Drawing {
    let mut drawing = layers();
    for part in parts {
        let x = if part.name == "gear-driven" {
            gears.center_distance()
        } else {
            0.0
        };
        let layer = if part.name.ends_with("cam") {
            CAM
        } else {
            PROFILE
        };
        part.draw(&mut drawing, layer, &Isometry2::translation(x, 0.0));
    }
    drawing
}

fn layers() -> Drawing {
    Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(PIN, Color::Blue, LineType::Continuous, 0.18)
        .layer(CAM, Color::Green, LineType::Continuous, 0.25)
        .layer(BORE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}
