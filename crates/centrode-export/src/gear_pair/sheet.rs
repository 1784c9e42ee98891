use crate::cutting::{CENTER, HOLE, PROFILE};
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text};
use centrode_gear::design::Addendum;
use centrode_gear::{Gear, GearPair, Member};
use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};
use nalgebra::Isometry2;

const PITCH_CURVE: &str = "PITCH_CURVE";
const TIP: &str = "TIP";
const ROOT: &str = "ROOT";
const TEXT: &str = "TEXT";

/// The contours of one gear in its own frame.
///
/// Tip and root are the curves at a constant distance from the pitch curve. If no such curve exists (teeth trimmed one by one, or
/// a bend too tight), they are the circles about the axis through the outermost and the innermost point.
#[derive(Clone, Debug)]
pub(super) struct Contours {
    contours: Vec<(&'static str, Outline)>,
    /// Rectangle around the teeth, with a margin; centre lines end there.
    extent: Bounds,
}

impl Contours {
    pub(super) fn new(pair: &GearPair, member: Member, tolerance: Tolerance) -> Self {
        let gear = pair.gear(member);
        let circle = |radius| Outline::circle(Point::origin(), radius);
        let mut contours = vec![(PROFILE, gear.outline().clone())];
        contours.extend(gear.bore().map(|bore| (HOLE, bore)));
        contours.push((PITCH_CURVE, gear.pitch_curve().clone()));
        let (root, tip) = gear.radii();
        let tip = tip_curve(pair, gear, tolerance).unwrap_or_else(|| circle(tip));
        let root = root_curve(pair, gear, tolerance).unwrap_or_else(|| circle(root));
        contours.push((TIP, tip));
        contours.push((ROOT, root));
        Self {
            contours,
            extent: extent(gear),
        }
    }

    /// Drawing with every contour made of lines and arcs.
    pub(super) fn with_arcs(mut self, tolerance: Tolerance) -> Self {
        for (_, outline) in &mut self.contours {
            *outline = outline.arcs(tolerance);
        }
        self
    }

    fn draw(&self, drawing: &mut Drawing, place: &Isometry2<f64>) {
        for (layer, outline) in &self.contours {
            drawing.draw(layer, EntityShape::Contour(outline.transformed(place)));
        }
    }
}

/// A gear in its own frame: profile and bore to cut; pitch curve, tip and root curves and centre lines
/// for reference.
pub(super) fn gear(contours: &Contours) -> Drawing {
    let mut drawing = layers();
    contours.draw(&mut drawing, &Isometry2::identity());
    let Bounds { min, max } = contours.extent;
    let p = Point::new;
    drawing.draw(CENTER, EntityShape::Line(p(min.x, 0.0), p(max.x, 0.0)));
    drawing.draw(CENTER, EntityShape::Line(p(0.0, min.y), p(0.0, max.y)));
    drawing.draw(CENTER, EntityShape::Mark(Point::origin()));
    drawing
}

/// Both gears assembled at phi = 0, the driver's axis at the origin.
pub(super) fn assembly(pair: &GearPair, [driver, driven]: [&Contours; 2]) -> Drawing {
    let mut drawing = layers().layer(TEXT, Color::Foreground, LineType::Continuous, 0.25);
    let a = pair.center_distance();
    for (contours, x) in [(driver, 0.0), (driven, a)] {
        contours.draw(&mut drawing, &Isometry2::translation(x, 0.0));
        let Bounds { min, max } = contours.extent;
        drawing.draw(
            CENTER,
            EntityShape::Line(Point::new(x, min.y), Point::new(x, max.y)),
        );
        drawing.draw(CENTER, EntityShape::Mark(Point::new(x, 0.0)));
    }
    let ends = [driver.extent.min.x, a + driven.extent.max.x].map(|x| Point::new(x, 0.0));
    drawing.draw(CENTER, EntityShape::Line(ends[0], ends[1]));
    let height = 0.038 * a;
    let low = driver.extent.min.y.min(driven.extent.min.y);
    let line = |row: f64, words: String| {
        EntityShape::Text(Text::new(
            Point::new(
                0.5 * (ends[0].x + ends[1].x),
                low - (1.2 + 1.7 * row) * height,
            ),
            height,
            words,
            Anchor::Middle,
        ))
    };
    let title = if pair.title().is_empty() {
        pair.name()
    } else {
        pair.title()
    };
    drawing.draw(TEXT, line(0.0, title.to_owned()));
    drawing.draw(TEXT, line(1.0, figures(pair)));
    drawing
}

/// Bounds of the outline and the axis, with a margin of a sixteenth of their diagonal.
fn extent(gear: &Gear) -> Bounds {
    let bounds = gear.outline().bounds().with(Point::origin());
    let margin = Vector::repeat(bounds.diagonal() / 16.0);
    Bounds {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}

fn figures(pair: &GearPair) -> String {
    format!(
        "z = {} / {}, m = {:.4} mm, a = {:.4} mm",
        pair.driver().tooth_count(),
        pair.driven().tooth_count(),
        pair.module(),
        pair.center_distance(),
    )
}

/// Layers of a gear: the profile last, above the reference lines.
fn layers() -> Drawing {
    Drawing::default()
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
        .layer(TIP, Color::Gray, LineType::Hidden, 0.13)
        .layer(ROOT, Color::Gray, LineType::Hidden, 0.13)
        .layer(PITCH_CURVE, Color::Blue, LineType::Center, 0.18)
        .layer(HOLE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}

fn tip_curve(pair: &GearPair, gear: &Gear, tolerance: Tolerance) -> Option<Outline> {
    if pair.teeth().addendum == Addendum::Fitted {
        return None;
    }
    let height = pair.tip_height(gear.member());
    gear.pitch_curve().offset(height, tolerance.scaled(0.1))
}

fn root_curve(pair: &GearPair, gear: &Gear, tolerance: Tolerance) -> Option<Outline> {
    let depth = pair.root_depth(gear.member());
    gear.pitch_curve().offset(-depth, tolerance.scaled(0.1))
}
