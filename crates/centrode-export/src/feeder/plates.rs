use crate::drawing::{Anchor, Color, Drawing, LineType, Shape, Text};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_mechanism::feeder::{Feeder, Part, Plate};

const PROFILE: &str = "PROFILE";
const HOLE: &str = "HOLE";
const CENTER: &str = "CENTER";
const PATH: &str = "PATH";
const TEXT: &str = "TEXT";

/// Points of the path of a joint.
const POINTS: u32 = 360;

/// A plate to cut: profile, holes and slot, and the centres of its joints.
#[must_use]
pub fn plate(plate: &Plate) -> Drawing {
    let mut drawing = layers();
    drawing.draw(PROFILE, Shape::Contour(plate.outline.clone()));
    for hole in plate.cut_outs() {
        drawing.draw(HOLE, Shape::Contour(hole));
    }
    for joint in &plate.joints {
        drawing.draw(CENTER, Shape::Mark(joint.at));
    }
    drawing
}

/// The six-bar where it rests, seen along the shafts, with the paths of its joints and its tip.
#[must_use]
pub fn assembly(feeder: &Feeder, plates: &[Plate]) -> Drawing {
    let mut drawing = layers()
        .layer(PATH, Color::Blue, LineType::Continuous, 0.18)
        .layer(TEXT, Color::Foreground, LineType::Continuous, 0.25);
    for part in Part::ALL {
        let name = part.name().to_uppercase();
        let line = match part {
            Part::Frame => LineType::Phantom,
            _ => LineType::Continuous,
        };
        drawing = drawing.layer(&name, Color::Foreground, line, 0.35);
    }
    for plate in plates {
        let place = feeder.place(plate.part, feeder.start());
        let layer = plate.part.name().to_uppercase();
        for contour in std::iter::once(plate.outline.clone()).chain(plate.cut_outs()) {
            drawing.draw(&layer, Shape::Contour(contour.transformed(&place)));
        }
    }
    for joint in 0..3 {
        drawing.draw(PATH, Shape::Polyline(feeder.path(joint, POINTS)));
    }
    let [b, c, e] = feeder.six_bar().joints(feeder.start());
    let frame = feeder.six_bar().four_bar().lengths()[3];
    let joints = [
        ("A", Point::origin()),
        ("B", b),
        ("C", c),
        ("D", Point::new(frame, 0.0)),
        ("E", e),
        ("F", feeder.six_bar().pivot()),
    ];
    let Bounds { min, max } = drawing.bounds();
    let height = 0.015 * (max - min).norm();
    for (name, at) in joints {
        drawing.draw(CENTER, Shape::Mark(at));
        let at = at + Vector::new(0.6, 0.6) * height;
        drawing.draw(TEXT, Shape::Text(Text::new(at, height, name, Anchor::Left)));
    }
    let words = format!(
        "{}: at rest, crank at {:.4} deg; paths of B, C and the tip E",
        super::named(feeder),
        feeder.start().to_degrees()
    );
    let at = Point::new(min.x, min.y - 2.0 * height);
    drawing.draw(
        TEXT,
        Shape::Text(Text::new(at, height, words, Anchor::Left)),
    );
    drawing
}

/// The profile last, over the lines of reference.
fn layers() -> Drawing {
    Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(HOLE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}
