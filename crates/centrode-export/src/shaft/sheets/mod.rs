//! The drawing sheets of a spiral shaft and of its slider.

mod section;
mod side;
mod slider;
mod tables;

pub(super) use tables::data;

use super::slider_solid;
use crate::turned::centre;
use crate::{
    ExportError, Options, fit, number::mass, package::title_or_name, treatment::treatment_note,
};
use centrode_formats::{
    drawing::{Anchor, EntityShape},
    sheet::{Corner, Draft, Scale, Sheet, SheetBlock, Table, TitleBlock, compose, view_letters},
};
use centrode_geometry::{Arc, Point};
use centrode_groove::{ShaftSolid, SpiralShaft};
use centrode_spec::SheetSize;

/// Letter of the section across the journal; datums have the letters before it.
const SECTION: char = 'C';

/// The sheets of a spiral shaft: side view and development with dimensions, sections, data and the file of the lead table.
///
/// # Errors
/// [`ExportError`] if the requested size is too small.
pub fn shaft_sheets(shaft: &SpiralShaft, options: &Options) -> Result<Vec<Sheet>, ExportError> {
    let tolerance = options.tolerance;
    let mut block = block(shaft, "shaft", "Spiral shaft", options);
    block.material = shaft.body().material.clone();
    block.mass = mass(shaft.mass_properties()?.mass * 1e3);
    let views = side::Views::new(shaft, tolerance)?;
    let data = tables::data(shaft);
    let mut lines = notes(shaft);
    let journals = [shaft.body().journal_fit.as_str()];
    lines.extend(block.fitted(journals, "walls of the groove"));
    lines.push(treatment_note(&shaft.body().heat_treatment));
    let journal = section::journal(shaft, tolerance);
    let groove = section::groove(shaft, tolerance);
    let pieces = |scale: Scale, size: SheetSize| {
        let both = views.draft(scale, view_letters(size));
        let lower =
            |name, draft: &Draft| SheetBlock::detail(name, draft.clone(), Corner::LowerLeft);
        vec![
            SheetBlock::table("shaft data table", &data),
            SheetBlock::notes(&lines),
            SheetBlock::view("side view with development", both),
            lower("section", &journal),
            lower("groove section", &groove),
        ]
    };
    let [low, high] = ShaftSolid::new(shaft.groove(), shaft.body())?.whole();
    let size = options.sheet.size.or(shaft.drawing().sheet);
    let flowing = [tables::lead(shaft)];
    compose(size, &block, high - low, &pieces, &flowing).map_err(ExportError::no_sheet("shaft"))
}

/// The sheet of the slider.
///
/// # Errors
/// [`ExportError`] if the requested size is too small.
pub fn slider_sheets(shaft: &SpiralShaft, options: &Options) -> Result<Vec<Sheet>, ExportError> {
    let mut block = block(shaft, "slider", "Slider", options);
    let spec = shaft.slider();
    let properties = slider_solid(shaft)?.mass_properties(spec.density);
    block.mass = mass(properties.mass * 1e3);
    block.material.clone_from(&spec.material);
    let mut lines = vec![
        "1 for each machine.".to_owned(),
        "Cutting file: slider.dxf.".to_owned(),
        treatment_note(&spec.heat_treatment),
    ];
    let classes = [spec.slider_fit.as_str(), &spec.hole_fit, &spec.pin_fit];
    lines.extend(block.fitted(classes, ""));
    let pieces = |scale: Scale, size: SheetSize| {
        let draft = slider::views(shaft, scale, view_letters(size), block.projection);
        vec![
            SheetBlock::notes(&lines),
            SheetBlock::view("slider with section", draft),
        ]
    };
    let size = options.sheet.size.or(shaft.drawing().sheet);
    compose(size, &block, spec.length, &pieces, &[]).map_err(ExportError::no_sheet("slider"))
}

fn block(shaft: &SpiralShaft, part: &str, title: &str, options: &Options) -> TitleBlock {
    let supplement = title_or_name(&shaft.design().title, &shaft.design().name);
    let (spec, projection) = (shaft.drawing(), options.sheet.projection);
    TitleBlock::of_part(spec, part, title, supplement, projection)
}

fn notes(shaft: &SpiralShaft) -> Vec<String> {
    let mut lines = vec![
        "1 for each machine.".to_owned(),
        "Development seen from outside, its lower edge at 360°.".to_owned(),
        "Groove angle θ = 0 where the slider is at the first hole;".to_owned(),
        "it faces the viewer in the side view.".to_owned(),
        "Outline of the side view cut in the plane of the paper.".to_owned(),
        "Walls begin at the surface's offset and point to the axis.".to_owned(),
        "Exact groove: groove.dxf, tool-path.csv, program groove.ngc.".to_owned(),
    ];
    if let Some(centre) = centre(shaft.body().journal_diameter) {
        lines.push(format!("Centre holes at both ends: {centre}."));
    }
    if let Some(key) = shaft.body().keyway {
        let angle = fit::keyway_angle(0.0, shaft.body().journal_diameter, key.width);
        lines.push(format!("Keyway at θ = {angle}."));
    }
    lines
}

/// A shape of a drawing at a scale, with every point mapped by `place`; `None` for texts and arrow heads.
fn scaled(shape: &EntityShape, k: f64, place: impl Fn(Point) -> Point) -> Option<EntityShape> {
    let at = |p: &Point| Point::from(place(*p).coords * k);
    Some(match shape {
        EntityShape::Contour(outline) => {
            let corners: Vec<Point> = outline.segments().iter().map(|s| at(&s.start())).collect();
            EntityShape::Contour(centrode_geometry::Outline::polygon(&corners))
        }
        EntityShape::Polyline(points) => EntityShape::Polyline(points.iter().map(at).collect()),
        EntityShape::Line(a, b) => EntityShape::Line(at(a), at(b)),
        EntityShape::Circle { center, radius } => EntityShape::Circle {
            center: at(center),
            radius: k * radius,
        },
        EntityShape::Arc(arc) => EntityShape::Arc(Arc {
            start: at(&arc.start),
            end: at(&arc.end),
            bulge: arc.bulge,
        }),
        _ => return None,
    })
}

/// A table with title and headings, to which rows are added.
fn table(title: &str, headings: &[&str], columns: Vec<Anchor>) -> Table {
    Table {
        title: title.into(),
        headings: headings.iter().map(|h| (*h).to_owned()).collect(),
        columns,
        ..Table::default()
    }
}
