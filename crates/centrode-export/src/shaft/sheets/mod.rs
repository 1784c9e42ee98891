//! The drawing sheets of a spiral shaft and of its slider.

mod section;
mod side;
mod slider;
mod tables;

use super::ShaftFilesError;
use crate::{
    Bundle,
    drawing::{Anchor, Shape},
    dxf,
    gear_pair::{Format, Options},
    pdf,
    sheet::{Corner, Draft, Piece, Scale, Sheet, Table, TitleBlock, compose, number},
    svg,
};
use centrode_geometry::Point;
use centrode_mechanism::design::SheetSize;
use centrode_mechanism::shaft::{ShaftSolid, SpiralShaft};

/// The sheets of a spiral shaft: side view and development with dimensions, sections, data and lead table.
///
/// # Errors
/// [`ShaftFilesError`] if the size asked for is too small.
pub fn shaft_sheets(shaft: &SpiralShaft, options: &Options) -> Result<Vec<Sheet>, ShaftFilesError> {
    let tolerance = options.tolerance;
    let mut block = block(shaft, "shaft", "Spiral shaft", options);
    block.material = shaft.body().material.clone();
    block.mass = mass(shaft.mass_properties()?.mass * 1e3);
    let views = side::Views::new(shaft, tolerance)?;
    let data = tables::data(shaft);
    let lines = notes(shaft);
    let journal = section::journal(shaft, tolerance);
    let groove = section::groove(shaft, tolerance);
    let pieces = |scale: Scale, size: SheetSize| {
        let view = |name, draft, corner, leads| Piece {
            name,
            draft,
            corner,
            floats: true,
            leads,
        };
        let both = views.draft(scale, letters(size));
        vec![
            fixed("shaft data table", data.whole()),
            fixed("notes", written(&lines)),
            view("side view with development", both, Corner::UpperLeft, true),
            view("section", journal.clone(), Corner::LowerLeft, false),
            view("groove section", groove.clone(), Corner::LowerLeft, false),
        ]
    };
    let [low, high] = ShaftSolid::new(shaft.groove(), shaft.body())?.whole();
    let size = options.sheet.size.or(shaft.drawing().sheet);
    let flowing = [tables::lead(shaft)];
    Ok(compose(size, &block, high - low, &pieces, &flowing)?)
}

/// The sheet of the slider.
///
/// # Errors
/// [`ShaftFilesError`] if the size asked for is too small.
pub fn slider_sheets(
    shaft: &SpiralShaft,
    options: &Options,
) -> Result<Vec<Sheet>, ShaftFilesError> {
    let mut block = block(shaft, "slider", "Slider", options);
    let spec = shaft.slider();
    block.mass = mass(shaft.slider_solid()?.mass_properties(spec.density).mass * 1e3);
    let pieces = |scale: Scale, size: SheetSize| {
        vec![Piece {
            name: "slider with section",
            draft: slider::views(shaft, scale, letters(size), block.projection),
            corner: Corner::UpperLeft,
            floats: true,
            leads: true,
        }]
    };
    let size = options.sheet.size.or(shaft.drawing().sheet);
    Ok(compose(size, &block, spec.length, &pieces, &[])?)
}

/// Adds the sheets in the formats asked for.
pub(super) fn add(
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), ShaftFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    if !wanted(Format::Sheet) && !wanted(Format::Pdf) {
        return Ok(());
    }
    let sets = [
        ("shaft", shaft_sheets(shaft, options)?),
        ("slider", slider_sheets(shaft, options)?),
    ];
    for (name, sheets) in &sets {
        if wanted(Format::Sheet) {
            for (index, sheet) in sheets.iter().enumerate() {
                let file = match sheets.len() {
                    1 => format!("{name}-sheet"),
                    _ => format!("{name}-sheet-{}", index + 1),
                };
                let (version, curves) = (options.dxf_version, dxf::Curves::Arcs);
                let bytes = dxf::write(&sheet.drawing, version, curves, options.tolerance)?;
                bundle.add(&format!("{file}.dxf"), bytes)?;
                let picture = svg::sheet(sheet, options.tolerance);
                bundle.add(&format!("{file}.svg"), picture.into_bytes())?;
            }
        }
        if wanted(Format::Pdf) {
            let title = format!("{}: {name}", named(shaft));
            let bytes = pdf::write(sheets, &title, options.tolerance)?;
            bundle.add(&format!("{name}.pdf"), bytes)?;
        }
    }
    Ok(())
}

fn named(shaft: &SpiralShaft) -> &str {
    match shaft.title() {
        "" => shaft.name(),
        title => title,
    }
}

fn block(shaft: &SpiralShaft, part: &str, title: &str, options: &Options) -> TitleBlock {
    let spec = shaft.drawing();
    let mut block = TitleBlock::of(spec);
    if !spec.number.is_empty() {
        block.number = format!("{}-{part}", spec.number);
    }
    block.projection = options.sheet.projection.unwrap_or(spec.projection);
    block.title = title.to_owned();
    block.supplement = named(shaft).to_owned();
    block.document = "Part drawing".into();
    block
}

/// Height of the letters of the views, mm: smaller on the smallest sheet.
fn letters(size: SheetSize) -> f64 {
    match size {
        SheetSize::A4 => 2.5,
        _ => 3.5,
    }
}

fn fixed(name: &'static str, draft: Draft) -> Piece {
    Piece {
        name,
        draft,
        corner: Corner::UpperRight,
        floats: false,
        leads: false,
    }
}

fn written(lines: &[String]) -> Draft {
    let mut draft = Draft::default();
    for (row, line) in lines.iter().enumerate() {
        let at = Point::new(0.0, -4.6 * row as f64);
        draft.text(at, 2.5, line, Anchor::Left);
    }
    draft
}

fn notes(shaft: &SpiralShaft) -> Vec<String> {
    let mut lines = vec![
        "Development seen from outside, its lower edge at 360°.".to_owned(),
        "Groove angle θ = 0 where the slider is at the first hole;".to_owned(),
        "it faces the viewer in the side view.".to_owned(),
        "Outline of the side view cut in the plane of the paper.".to_owned(),
        "Walls stand on the surface's offset and point to the axis.".to_owned(),
        "Exact groove: groove.dxf, lead-table.csv, tool-path.csv.".to_owned(),
    ];
    if shaft.body().keyway.is_some() {
        lines.push("Keyway at θ = 0.".to_owned());
    }
    lines
}

fn mass(grams: f64) -> String {
    if grams >= 1000.0 {
        format!("{} kg", number(grams / 1000.0, 3))
    } else {
        format!("{} g", number(grams, 1))
    }
}

/// A shape of a drawing at a scale, with every point put where `place` says; `None` for words and heads.
fn scaled(shape: &Shape, k: f64, place: impl Fn(Point) -> Point) -> Option<Shape> {
    let at = |p: &Point| Point::from(place(*p).coords * k);
    Some(match shape {
        Shape::Contour(outline) => {
            let corners: Vec<Point> = outline.segments().iter().map(|s| at(&s.start())).collect();
            Shape::Contour(centrode_geometry::Outline::polygon(&corners))
        }
        Shape::Polyline(points) => Shape::Polyline(points.iter().map(at).collect()),
        Shape::Line(a, b) => Shape::Line(at(a), at(b)),
        Shape::Circle { center, radius } => Shape::Circle {
            center: at(center),
            radius: k * radius,
        },
        _ => return None,
    })
}

/// A title under which a table's rows are collected.
fn table(title: &str, headings: &[&str], columns: Vec<Anchor>) -> Table {
    Table {
        title: title.into(),
        headings: headings.iter().map(|h| (*h).to_owned()).collect(),
        columns,
        ..Table::default()
    }
}
