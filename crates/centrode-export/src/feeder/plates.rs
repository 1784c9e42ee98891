use crate::cutting::CENTER;
use crate::number::capital;
use crate::plate::{self, Hole};
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_kinematics::machine::Stock;
use centrode_machines::feeder::{Feeder, FeederPart, Plate};

const PATH: &str = "PATH";
const TEXT: &str = "TEXT";

/// Number of points of the path of a joint.
const POINTS: u32 = 360;

/// A plate of the six-bar for the workshop: its holes have the position tolerances that the swing requires.
pub(super) fn made(feeder: &Feeder, plate: &Plate) -> plate::Plate {
    let (spec, making) = (&feeder.design().plates, &feeder.design().making);
    let pins = plate.holes().map(|joint| Hole {
        // Only the effector's pivot lies off the line through the others.
        off: match joint.at {
            at if at == Point::origin() => 0.0,
            at if at.y == 0.0 => making.length_tolerance,
            _ => making.pivot_tolerance,
        },
        ..Hole::of_pin(joint.outline(), joint)
    });
    let slot = plate.slot.iter().map(|outline| Hole {
        fit: spec.slot_fit.clone(),
        ..Hole::from(outline.clone())
    });
    let of_frame = feeder.frame_screws().and_then(Result::ok);
    let of_frame = of_frame.filter(|_| !plate.screws.is_empty());
    let screws = of_frame.iter().flat_map(Hole::clearance);
    let name = plate.part.name();
    let note = match plate.part {
        FeederPart::Slider => "Runs in the effector's slot.".to_owned(),
        _ => "x points from the first joint to the second.".to_owned(),
    };
    let rim = match plate.part {
        FeederPart::Slider => spec.slider_fit.clone(),
        _ => String::new(),
    };
    let stock = Stock::new(&spec.material, spec.density).treated(&spec.heat_treatment);
    let (outline, thickness) = (plate.outline.clone(), plate.thickness);
    plate::Plate {
        quantity: plate.part.quantity() as usize,
        holes: pins.chain(slot).chain(screws).collect(),
        notes: vec![note],
        classes: [rim, String::new()],
        ..plate::Plate::new(name, &capital(name), outline, thickness, stock)
    }
}

/// Spacer between the plates of the frame; `None` if the frame has no screws.
pub(super) fn spacer(feeder: &Feeder) -> Option<plate::Plate> {
    let spec = &feeder.design().plates;
    let screws = feeder.frame_screws()?.ok()?;
    let stock = Stock::new(&spec.material, spec.density);
    let title = "Spacer of the frame";
    Some(plate::Plate::spacer(&screws, title, screws.at.len(), stock))
}

/// The six-bar at rest, seen along the shafts, with the paths of its joints and its tip.
#[must_use]
pub fn assembly(feeder: &Feeder, plates: &[Plate]) -> Drawing {
    let mut drawing = Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(PATH, Color::Blue, LineType::Continuous, 0.18)
        .layer(TEXT, Color::Foreground, LineType::Continuous, 0.25);
    for part in FeederPart::ALL {
        let name = part.name().to_uppercase();
        let line = match part {
            FeederPart::Frame => LineType::Phantom,
            _ => LineType::Continuous,
        };
        drawing = drawing.layer(&name, Color::Foreground, line, 0.35);
    }
    for plate in plates {
        let place = feeder.place(plate.part, feeder.start());
        let layer = plate.part.name().to_uppercase();
        for contour in std::iter::once(plate.outline.clone()).chain(plate.cut_outs()) {
            drawing.draw(&layer, EntityShape::Contour(contour.transformed(&place)));
        }
    }
    for joint in 0..3 {
        drawing.draw(PATH, EntityShape::Polyline(feeder.path(joint, POINTS)));
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
        (
            "G",
            Point::new(-feeder.design().gears.center_distance(), 0.0),
        ),
    ];
    let Bounds { min, max } = drawing.bounds();
    let height = 0.015 * (max - min).norm();
    for (name, at) in joints {
        drawing.draw(CENTER, EntityShape::Mark(at));
        let at = at + Vector::new(0.6, 0.6) * height;
        drawing.draw(
            TEXT,
            EntityShape::Text(Text::new(at, height, name, Anchor::Left)),
        );
    }
    let words = format!(
        "{}: at rest, crank at {:.4} deg; paths of B, C and the tip E",
        super::named(feeder),
        feeder.start().to_degrees()
    );
    let at = Point::new(min.x, min.y - 2.0 * height);
    drawing.draw(
        TEXT,
        EntityShape::Text(Text::new(at, height, words, Anchor::Left)),
    );
    drawing
}
