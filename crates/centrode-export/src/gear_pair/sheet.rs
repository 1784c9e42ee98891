use crate::drawing::{Anchor, Color, Drawing, LineType, Shape, Text};
use centrode_geometry::{Outline, Point, Tolerance, Vector};
use centrode_mechanism::gear::{Gear, GearPair, Member, design::Addendum};
use nalgebra::Isometry2;

const PROFILE: &str = "PROFILE";
const BORE: &str = "BORE";
const PITCH_CURVE: &str = "PITCH_CURVE";
const TIP: &str = "TIP";
const ROOT: &str = "ROOT";
const CENTER: &str = "CENTER";
const TEXT: &str = "TEXT";

/// A gear in its own frame: profile and bore to cut; pitch curve, tip and root curves and centre lines
/// for reference.
///
/// Tip and root are the curves at a constant distance from the pitch curve; where there are none, since
/// teeth are trimmed one by one or a bend is too tight, the circles round the axis through the
/// outermost and the innermost point.
#[must_use]
pub fn gear_drawing(pair: &GearPair, member: Member, tolerance: Tolerance) -> Drawing {
    let mut drawing = layers();
    draw_gear(
        &mut drawing,
        pair,
        member,
        &Isometry2::identity(),
        tolerance,
    );
    let reach = 1.08 * pair.gear(member).radii().1;
    cross(&mut drawing, Point::origin(), reach);
    drawing
}

/// Both gears in place at phi = 0, the driver's axis at the origin.
#[must_use]
pub fn assembly_drawing(pair: &GearPair, tolerance: Tolerance) -> Drawing {
    let mut drawing = layers().layer(TEXT, Color::Foreground, LineType::Continuous, 0.25);
    let a = pair.center_distance();
    let mut low = 0.0_f64;
    for (member, x) in [(Member::Driver, 0.0), (Member::Driven, a)] {
        let place = Isometry2::translation(x, 0.0);
        draw_gear(&mut drawing, pair, member, &place, tolerance);
        let reach = 1.08 * pair.gear(member).radii().1;
        let center = Point::new(x, 0.0);
        let up = Vector::new(0.0, reach);
        drawing.draw(CENTER, Shape::Line(center - up, center + up));
        drawing.draw(CENTER, Shape::Mark(center));
        low = low.min(-reach);
    }
    let ends = [
        Point::new(-1.08 * pair.driver().radii().1, 0.0),
        Point::new(a + 1.08 * pair.driven().radii().1, 0.0),
    ];
    drawing.draw(CENTER, Shape::Line(ends[0], ends[1]));
    let height = 0.05 * a;
    let line = |row: f64, words: String| {
        Shape::Text(Text {
            at: Point::new(0.5 * a, low - (1.4 + 1.7 * row) * height),
            height,
            words,
            anchor: Anchor::Middle,
        })
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

fn figures(pair: &GearPair) -> String {
    format!(
        "z = {} / {}   m = {:.4} mm   a = {:.4} mm",
        pair.driver().tooth_count(),
        pair.driven().tooth_count(),
        pair.module(),
        pair.center_distance(),
    )
}

fn layers() -> Drawing {
    Drawing::default()
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(BORE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PITCH_CURVE, Color::Blue, LineType::Center, 0.18)
        .layer(TIP, Color::Gray, LineType::Hidden, 0.13)
        .layer(ROOT, Color::Gray, LineType::Hidden, 0.13)
        .layer(CENTER, Color::Red, LineType::Center, 0.13)
}

fn draw_gear(
    drawing: &mut Drawing,
    pair: &GearPair,
    member: Member,
    place: &Isometry2<f64>,
    tolerance: Tolerance,
) {
    let gear = pair.gear(member);
    let mut contour = |layer: &str, outline: &Outline| {
        drawing.draw(layer, Shape::Contour(outline.transformed(place)));
    };
    contour(PROFILE, gear.outline());
    if let Some(bore) = gear.bore() {
        contour(BORE, &bore);
    }
    contour(PITCH_CURVE, gear.pitch_curve());
    for (layer, curve) in [
        (TIP, tip_curve(pair, gear, tolerance)),
        (ROOT, root_curve(pair, gear, tolerance)),
    ] {
        match curve {
            Ok(outline) => contour(layer, &outline),
            Err(radius) => contour(layer, &Outline::circle(Point::origin(), radius)),
        }
    }
}

/// The tip curve, or the radius of the tip circle.
fn tip_curve(pair: &GearPair, gear: &Gear, tolerance: Tolerance) -> Result<Outline, f64> {
    let teeth = pair.teeth();
    let circle = gear.radii().1;
    if teeth.addendum == Addendum::Fitted {
        return Err(circle);
    }
    let height = teeth.tool.addendum + shift(pair, gear);
    gear.pitch_curve()
        .offset(height, tolerance.scaled(0.1))
        .ok_or(circle)
}

/// The root curve, or the radius of the root circle.
fn root_curve(pair: &GearPair, gear: &Gear, tolerance: Tolerance) -> Result<Outline, f64> {
    let depth = pair.teeth().tool.dedendum - shift(pair, gear);
    let offset = gear.pitch_curve().offset(-depth, tolerance.scaled(0.1));
    offset.ok_or_else(|| gear.radii().0)
}

/// How far the tool is withdrawn from this gear, mm.
fn shift(pair: &GearPair, gear: &Gear) -> f64 {
    match gear.member() {
        Member::Driver => pair.teeth().tool.profile_shift,
        Member::Driven => -pair.teeth().tool.profile_shift,
    }
}

fn cross(drawing: &mut Drawing, center: Point, reach: f64) {
    for v in [Vector::new(reach, 0.0), Vector::new(0.0, reach)] {
        drawing.draw(CENTER, Shape::Line(center - v, center + v));
    }
    drawing.draw(CENTER, Shape::Mark(center));
}
