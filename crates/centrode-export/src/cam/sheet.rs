use crate::cutting::{CENTER, HOLE, PROFILE};
use crate::package::title_or_name;
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text};
use centrode_gear::cam::design::{Follower, Turn};
use centrode_gear::cam::{Cam, CamError};
use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};

const PITCH_CURVE: &str = "PITCH_CURVE";
const BASE_CIRCLE: &str = "BASE_CIRCLE";
const FOLLOWER: &str = "FOLLOWER";
const TEXT: &str = "TEXT";

/// The contours of a cam in its own frame.
#[derive(Clone, Debug)]
pub(super) struct Contours {
    contours: Vec<(&'static str, Outline)>,
    /// Rectangle around the cam and the roller's path, with a margin; centre lines end there.
    extent: Bounds,
}

impl Contours {
    pub(super) fn new(cam: &Cam, tolerance: Tolerance) -> Result<Self, CamError> {
        let disc = cam.disc();
        let base = Outline::circle(Point::origin(), disc.base_radius());
        let mut contours = vec![(PROFILE, cam.profile().outline().clone())];
        contours.extend(cam.bore().map(|bore| (HOLE, bore)));
        let path = disc.pitch_curve(tolerance.scaled(1e-3))?;
        contours.extend(path.map(|path| (PITCH_CURVE, path)));
        contours.push((BASE_CIRCLE, base));
        let bounds = contours
            .iter()
            .fold(Bounds::EMPTY, |b, (_, outline)| b.union(outline.bounds()));
        let margin = Vector::repeat(bounds.diagonal() / 16.0);
        Ok(Self {
            contours,
            extent: Bounds {
                min: bounds.min - margin,
                max: bounds.max + margin,
            },
        })
    }

    /// Drawing with every contour made of lines and arcs.
    pub(super) fn with_arcs(mut self, tolerance: Tolerance) -> Self {
        for (_, outline) in &mut self.contours {
            *outline = outline.arcs(tolerance);
        }
        self
    }
}

/// A cam in its own frame: profile and bore to cut; the path of the roller's centre, base circle and
/// centre lines for reference.
pub(super) fn cam(contours: &Contours) -> Drawing {
    let mut drawing = layers();
    for (layer, outline) in &contours.contours {
        drawing.draw(layer, EntityShape::Contour(outline.clone()));
    }
    let Bounds { min, max } = contours.extent;
    let p = Point::new;
    drawing.draw(CENTER, EntityShape::Line(p(min.x, 0.0), p(max.x, 0.0)));
    drawing.draw(CENTER, EntityShape::Line(p(0.0, min.y), p(0.0, max.y)));
    drawing.draw(CENTER, EntityShape::Mark(Point::origin()));
    drawing
}

/// The cam with its follower at the input zero.
pub(super) fn assembly(part: &Cam, contours: &Contours) -> Drawing {
    let mut drawing = cam(contours)
        .layer(FOLLOWER, Color::Green, LineType::Continuous, 0.25)
        .layer(TEXT, Color::Foreground, LineType::Continuous, 0.25);
    follower(part, contours, &mut drawing);
    let Bounds { min, max } = contours.extent;
    let height = 0.025 * contours.extent.diagonal();
    let line = |row: f64, words: String| {
        let at = Point::new(0.5 * (min.x + max.x), min.y - (1.2 + 1.7 * row) * height);
        EntityShape::Text(Text::new(at, height, words, Anchor::Middle))
    };
    let title = title_or_name(part.title(), part.name());
    drawing.draw(TEXT, line(0.0, title.to_owned()));
    drawing.draw(TEXT, line(1.0, figures(part)));
    drawing
}

/// The follower at input zero: it slides parallel to the x axis, or its pivot lies on the x axis.
fn follower(part: &Cam, contours: &Contours, drawing: &mut Drawing) {
    let disc = part.disc();
    let contact = disc.contact(0.0);
    let mut draw = |shape: EntityShape| drawing.draw(FOLLOWER, shape);
    if let (Some(center), Some(radius)) = (contact.roller, disc.follower().roller_radius()) {
        if radius > 0.0 {
            draw(EntityShape::Circle { center, radius });
        }
        draw(EntityShape::Mark(center));
    }
    let along = Vector::new(-contact.normal.y, contact.normal.x);
    let far = contours.extent.max.x;
    match disc.follower() {
        Follower::TranslatingRoller(slide) => {
            let start = contact.roller.unwrap_or(contact.point);
            draw(EntityShape::Line(start, Point::new(far, slide.offset)));
        }
        Follower::SwingingRoller(arm) => {
            let pivot = Point::new(arm.center_distance, 0.0);
            draw(EntityShape::Line(
                contact.roller.unwrap_or(contact.point),
                pivot,
            ));
            draw(EntityShape::Mark(pivot));
        }
        Follower::SwingingFlat(arm) => {
            let pivot = Point::new(arm.center_distance, 0.0);
            let foot = contact.point + along * (pivot - contact.point).dot(&along);
            draw(EntityShape::Line(contact.point, foot));
            draw(EntityShape::Line(foot, pivot));
            draw(EntityShape::Mark(pivot));
        }
        _ => {
            let (low, high) = disc.limits().face.unwrap_or((0.0, 0.0));
            let middle = Point::new(contact.point.x, 0.0);
            draw(EntityShape::Line(
                middle + along * low,
                middle + along * high,
            ));
            draw(EntityShape::Line(middle, Point::new(far, 0.0)));
        }
    }
}

fn figures(part: &Cam) -> String {
    let disc = part.disc();
    let turns = match disc.rotation() {
        Turn::CounterClockwise => "counter-clockwise",
        Turn::Clockwise => "clockwise",
    };
    let base = format!("base radius {:.4} mm", disc.base_radius());
    match disc.follower().roller_radius() {
        Some(radius) => format!("{base}, roller radius {radius:.4} mm, turns {turns}"),
        None => format!("{base}, flat face, turns {turns}"),
    }
}

/// Layers of a cam: the profile last, above the reference lines.
fn layers() -> Drawing {
    Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(BASE_CIRCLE, Color::Gray, LineType::Hidden, 0.13)
        .layer(PITCH_CURVE, Color::Blue, LineType::Center, 0.18)
        .layer(HOLE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}
