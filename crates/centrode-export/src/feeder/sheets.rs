//! The drawing sheets of a feeder: each plate with its dimensions.

use crate::{
    ExportError, SheetOptions,
    drawing::{Anchor, Shape},
    sheet::{Draft, Pen, Piece, Scale, Sheet, TitleBlock, compose, view_letters},
};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_mechanism::design::SheetSize;
use centrode_mechanism::feeder::{Feeder, MakingSpec, Part, Plate};

/// Room between a view and its first dimension line, mm, and from one line to the next.
const FIRST: f64 = 10.0;
const NEXT: f64 = 9.0;

fn block(feeder: &Feeder, name: &str, options: &SheetOptions) -> TitleBlock {
    let mut title = name.to_owned();
    if let Some(first) = title.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    TitleBlock {
        title,
        supplement: super::named(feeder).to_owned(),
        ..TitleBlock::new(&feeder.design().drawing, name, options)
    }
}

/// The sheets of a plate.
pub(super) fn part(
    feeder: &Feeder,
    plate: &Plate,
    options: &SheetOptions,
) -> Result<Vec<Sheet>, ExportError> {
    let spec = &feeder.design().plates;
    let mut block = block(feeder, plate.part.name(), options);
    block.document = "Part drawing".into();
    block.material.clone_from(&spec.material);
    let cut: f64 = plate.cut_outs().iter().map(|hole| hole.area().abs()).sum();
    let kilograms = (plate.outline.area() - cut) * plate.thickness * spec.density * 1e-9;
    block.mass = format!("{kilograms:.3} kg");
    let lines = [
        format!(
            "Thickness {} mm, quantity {}.",
            number(plate.thickness),
            plate.part.quantity()
        ),
        format!("Cutting file: {}.dxf.", plate.part.name()),
    ];
    let pieces = |scale: Scale, size: SheetSize| {
        let making = &feeder.design().making;
        let draft = view(
            plate,
            (spec.pin_diameter, making),
            scale,
            view_letters(size),
        );
        vec![Piece::notes(&lines), Piece::view("view", draft)]
    };
    let bounds = plate.outline.bounds();
    let size = options.size.or(feeder.design().drawing.sheet);
    compose(size, &block, (bounds.max - bounds.min).amax(), &pieces, &[])
        .map_err(ExportError::no_sheet(plate.part.name()))
}

/// A length and how far it may be off either way, where that is given.
fn toleranced(length: f64, tolerance: f64) -> String {
    if tolerance > 0.0 {
        format!("{} ±{}", number(length), number(tolerance))
    } else {
        number(length)
    }
}

/// A plate with its joints' distances, its holes, its width and its slot.
///
/// The distances of the holes are as exact as the swing needs them.
fn view(plate: &Plate, (pin, making): (f64, &MakingSpec), scale: Scale, letters: f64) -> Draft {
    let k = scale.factor();
    let mut draft = Draft::lettered(letters);
    draft.draw(Pen::Outline, Shape::Contour(plate.outline.scaled(k)));
    for hole in plate.cut_outs() {
        draft.draw(Pen::Outline, Shape::Contour(hole.scaled(k)));
    }
    let bounds = plate.outline.bounds();
    let Bounds { min, max } = Bounds {
        min: bounds.min * k,
        max: bounds.max * k,
    };
    let cross = 0.5 * pin * k + 2.0;
    for joint in &plate.joints {
        let at = joint.at * k;
        let [x, y] = [Vector::x(), Vector::y()].map(|v: Vector| v * cross);
        draft.line(Pen::Axis, at - x, at + x);
        draft.line(Pen::Axis, at - y, at + y);
        let beside = 0.36 * pin * k + 0.8;
        let name = at + Vector::new(beside, beside);
        draft.text(name, letters, joint.name, Anchor::Left);
    }
    let origin = plate.joints[0].at * k;
    let joints = plate.joints.iter().skip(1);
    // Only the effector's pivot lies off the line through the others.
    let exact = |at: Point| {
        if at.y == 0.0 {
            making.length_tolerance
        } else {
            making.pivot_tolerance
        }
    };
    let mut along: Vec<(Point, String)> = joints
        .clone()
        .filter(|joint| joint.at.x != 0.0)
        .map(|joint| {
            let tolerance = if joint.hole { exact(joint.at) } else { 0.0 };
            (joint.at, toleranced(joint.at.x, tolerance))
        })
        .collect();
    let slot = plate.slot.as_ref();
    along.extend(
        slot.iter()
            // Its ends have play enough: a hundredth says all.
            .flat_map(|(ends, _)| {
                ends.map(|x| (Point::new(x, 0.0), number((100.0 * x).round() / 100.0)))
            }),
    );
    distances(&mut draft, along, min.y, k);
    for joint in joints.filter(|j| j.at.y != 0.0) {
        let beside = Point::new(max.x + FIRST, 0.0);
        draft.dimension(
            [origin, joint.at * k],
            Vector::y(),
            beside,
            &toleranced(joint.at.y, exact(joint.at)),
        );
    }
    if let Some(([start, end], slot)) = slot {
        let width = slot.bounds().max.y - slot.bounds().min.y;
        let tip = Point::new(0.5 * (start + end) * k, slot.bounds().max.y * k);
        let elbow = Point::new(tip.x + 8.0, max.y + 8.0);
        draft.leader(
            tip,
            elbow,
            &[format!(
                "slot {} wide, R{}",
                number(width),
                number(0.5 * width)
            )],
        );
    }
    let holes = plate.joints.iter().filter(|j| j.hole).count();
    let hole = plate.joints[0].at * k;
    let tip = hole + Vector::new(-0.5, 0.866) * (0.5 * pin * k);
    let elbow = Point::new(min.x - 2.0, max.y + 8.0);
    let words = match holes {
        1 => format!("Ø{} H8", number(pin)),
        n => format!("{n} × Ø{} H8", number(pin)),
    };
    draft.leader(tip, elbow, &[words]);
    ends(plate, k, &mut draft);
    draft
}

/// Distances of points from the origin along x, below what lies above `low` on paper: the shortest one nearest, so that no line
/// crosses another.
fn distances(draft: &mut Draft, mut points: Vec<(Point, String)>, low: f64, k: f64) {
    points.sort_by(|(a, _), (b, _)| a.x.abs().total_cmp(&b.x.abs()));
    for (row, (at, words)) in points.into_iter().enumerate() {
        let below = Point::new(0.0, low - FIRST - NEXT * row as f64);
        let ends = [Point::origin(), at * k];
        draft.dimension(ends, Vector::x(), below, &words);
    }
}

/// Width of the plate and the radius of its ends.
fn ends(plate: &Plate, k: f64, draft: &mut Draft) {
    let Bounds { min, max } = plate.outline.bounds();
    if plate.part == Part::Frame {
        return;
    }
    let [low, high] = [min.y, max.y].map(|y| Point::new(max.x.min(plate_end(plate)) * k, y * k));
    let beside = Point::new(max.x * k + FIRST, 0.0);
    draft.dimension([low, high], Vector::y(), beside, &number(max.y - min.y));
}

/// Where the straight edge of a plate ends.
fn plate_end(plate: &Plate) -> f64 {
    let bounds = plate.outline.bounds();
    bounds.max.x - 0.5 * (bounds.max.y - bounds.min.y)
}

/// A number to four places, without trailing zeros.
fn number(x: f64) -> String {
    crate::sheet::number(x, 4)
}
