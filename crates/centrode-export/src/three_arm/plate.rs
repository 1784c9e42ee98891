use std::f64::consts::PI;

use centrode_geometry::{
    Bounds, MassProperties, Opening, Outline, Point, Segment, Solid, SolidError, Tolerance, Vector,
};
use centrode_mechanism::design::{DrawingSpec, Projection, SheetSize};

use super::Part;
use crate::drawing::{Anchor, Color, Drawing, LineType, Shape};
use crate::sheet::{
    Draft, Pen, Piece, Scale, Sheet, SheetError, Table, TitleBlock, compose, view_letters,
};
use crate::{ExportError, Package, SheetOptions};

const PROFILE: &str = "PROFILE";
const BORE: &str = "BORE";
const CENTER: &str = "CENTER";

/// A part of one thickness.
#[derive(Clone, Debug)]
pub(super) struct Plate {
    pub(super) part: Part,
    pub(super) quantity: u32,
    pub(super) outline: Outline,
    pub(super) holes: Vec<Outline>,
    /// Holes through a wall, their height from the middle of the thickness.
    pub(super) opening: Option<Opening>,
    /// mm.
    pub(super) thickness: f64,
    pub(super) material: String,
    /// kg/m^3.
    pub(super) density: f64,
    /// Further notes of its sheet.
    pub(super) notes: Vec<String>,
    /// Tables of its sheet.
    pub(super) tables: Vec<Table>,
}

impl Plate {
    pub(super) fn noted(mut self, line: &str) -> Self {
        self.notes.push(line.into());
        self
    }

    /// From z = 0 to its thickness.
    pub(super) fn solid(&self) -> Result<Solid, SolidError> {
        self.placed([0.0, self.thickness])
    }

    /// Offers drawing, sheets and solid.
    pub(super) fn add(
        &self,
        package: &mut Package<'_>,
        spec: &DrawingSpec,
    ) -> Result<(), ExportError> {
        let (name, options) = (self.part.name(), package.options());
        let spec = (spec, package.design());
        package.drawing(name, |_| Ok(self.drawing()))?;
        package.sheets(name, || {
            self.sheets(spec, &options.sheet, options.tolerance)
                .map_err(ExportError::no_sheet(name))
        })?;
        let title = package.titled(name);
        package.solid(name, &title, || {
            self.solid().map_err(ExportError::no_solid(name))
        })
    }

    /// Plate between other heights.
    pub(super) fn placed(&self, [bottom, top]: [f64; 2]) -> Result<Solid, SolidError> {
        let solid = Solid::new(self.outline.clone(), self.holes.clone(), bottom, top)?;
        let Some(opening) = &self.opening else {
            return Ok(solid);
        };
        let middle = 0.5 * (bottom + top);
        solid.with_opening(Opening {
            span: opening.span.map(|z| middle + z),
            ..opening.clone()
        })
    }

    pub(super) fn mass(&self, span: [f64; 2]) -> Result<MassProperties, SolidError> {
        Ok(self.placed(span)?.mass_properties(self.density))
    }

    /// The cutting drawing: contour, holes, centre lines.
    pub(super) fn drawing(&self) -> Drawing {
        let mut drawing = Drawing::default()
            .layer(CENTER, Color::Red, LineType::Center, 0.13)
            .layer(BORE, Color::Foreground, LineType::Continuous, 0.35)
            .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35);
        drawing.draw(PROFILE, Shape::Contour(self.outline.clone()));
        for hole in &self.holes {
            drawing.draw(BORE, Shape::Contour(hole.clone()));
        }
        for (center, radius) in self.circles() {
            let arm = 1.25 * radius + 1.0;
            let (x, y) = (Vector::new(arm, 0.0), Vector::new(0.0, arm));
            drawing.draw(CENTER, Shape::Line(center - x, center + x));
            drawing.draw(CENTER, Shape::Line(center - y, center + y));
        }
        drawing
    }

    /// The holes that are full circles: centre and radius.
    fn circles(&self) -> Vec<(Point, f64)> {
        self.holes.iter().filter_map(circle).collect()
    }

    /// The drawing sheets: face, edge, dimensions, notes.
    pub(super) fn sheets(
        &self,
        (spec, supplement): (&DrawingSpec, &str),
        options: &SheetOptions,
        tolerance: Tolerance,
    ) -> Result<Vec<Sheet>, SheetError> {
        let mut block = TitleBlock::new(spec, self.part.name(), options);
        block.title = self.part.title().into();
        block.supplement = supplement.into();
        block.document = "Part drawing".into();
        block.material.clone_from(&self.material);
        block.mass = self.mass_in_words();
        let plain = Plate {
            outline: self.outline.arcs(tolerance),
            ..self.clone()
        };
        let (table, projection) = (plain.contour_table(), block.projection);
        let lines = self.lines();
        let pieces = |scale: Scale, size: SheetSize| {
            vec![
                Piece::notes(&lines),
                Piece::view("face and edge", plain.views(scale, size, projection)),
            ]
        };
        let bounds = plain.outline.bounds();
        let extent = (bounds.max - bounds.min).amax();
        let mut tables = self.tables.clone();
        tables.extend(table);
        compose(
            options.size.or(spec.sheet),
            &block,
            extent,
            &pieces,
            &tables,
        )
    }

    fn mass_in_words(&self) -> String {
        let volume = self.solid().map_or(0.0, |solid| solid.volume());
        let grams = volume * self.density * 1e-6;
        if grams >= 1000.0 {
            format!("{:.3} kg", grams / 1000.0)
        } else {
            format!("{grams:.1} g")
        }
    }

    fn lines(&self) -> Vec<String> {
        let name = self.part.name();
        let mut lines = vec![
            format!("{} of these a machine.", self.quantity),
            format!("Contour: {name}.dxf."),
        ];
        lines.extend(self.notes.iter().cloned());
        lines
    }

    /// Face, and edge seen from the left.
    fn views(&self, scale: Scale, size: SheetSize, projection: Projection) -> Draft {
        let k = scale.factor();
        let mut draft = Draft::lettered(view_letters(size));
        draft.draw(Pen::Outline, Shape::Contour(self.outline.scaled(k)));
        for hole in &self.holes {
            draft.draw(Pen::Outline, Shape::Contour(hole.scaled(k)));
        }
        for (center, radius) in self.circles() {
            let (at, arm) = (center * k, radius * k + 2.0);
            let (x, y) = (Vector::new(arm, 0.0), Vector::new(0.0, arm));
            draft.line(Pen::Axis, at - x, at + x);
            draft.line(Pen::Axis, at - y, at + y);
        }
        let Bounds { min, max } = self.outline.bounds();
        let (low, high) = (min * k, max * k);
        let p = Point::new;
        let size = max - min;
        // Below everything, and left of the notes.
        let below = p(low.x, low.y - 12.0);
        draft.dimension(
            [p(low.x, low.y), p(high.x, low.y)],
            Vector::x(),
            below,
            &short(size.x),
        );
        let around = Bounds {
            min: low - Vector::repeat(4.0),
            max: high + Vector::repeat(4.0),
        };
        draft.callouts(around, [f64::NEG_INFINITY; 2], &self.callouts(k));
        self.edge(&mut draft, k, projection);
        draft
    }

    /// The edge, beside the face: seen from the left it stands on the right in first angle.
    fn edge(&self, draft: &mut Draft, k: f64, projection: Projection) {
        let whole = draft.bounds();
        let Bounds { min, max } = self.outline.bounds();
        let (low, high) = (min.y * k, max.y * k);
        let thick = self.thickness * k;
        let gap = 14.0;
        let left = match projection {
            Projection::FirstAngle => whole.max.x + gap,
            Projection::ThirdAngle => whole.min.x - gap - thick - 16.0,
        };
        let p = Point::new;
        let edge = Bounds {
            min: p(left, low),
            max: p(left + thick, high),
        };
        draft.rectangle(Pen::Outline, edge);
        let heights = [p(left + thick, low), p(left + thick, high)];
        let beside = p(left + thick + 9.0, low);
        draft.dimension(heights, Vector::y(), beside, &short(max.y - min.y));
        let across = [p(left, low), p(left + thick, low)];
        draft.dimension(
            across,
            Vector::x(),
            p(left, low - 12.0),
            &short(self.thickness),
        );
    }

    /// Holes by their diameter and place, greatest rounding of the contour.
    fn callouts(&self, k: f64) -> Vec<(Point, Vec<String>)> {
        let circles = self.circles();
        let mut notes: Vec<(Point, Vec<String>)> = Vec::new();
        for (center, radius) in &circles {
            let side = Vector::new(center.x.signum() * 0.8, 0.6) * *radius;
            let words = vec![
                format!("Ø{}", short(2.0 * radius)),
                format!("at {}, {}", short(center.x), short(center.y)),
            ];
            notes.push(((center + side) * k, words));
        }
        notes
    }

    /// The contour's corners and roundings; none for one with more than a sheet would be read for.
    fn contour_table(&self) -> Option<Table> {
        const MOST: usize = 40;
        if self.outline.segments().len() > MOST {
            return None;
        }
        let contours = std::iter::once(&self.outline)
            .chain(self.holes.iter().filter(|hole| circle(hole).is_none()));
        let mut rows = Vec::new();
        for (number, contour) in contours.enumerate() {
            for segment in contour.segments() {
                let start = segment.start();
                let round = match segment {
                    Segment::Arc(arc) => short(arc.radius()),
                    _ => "line".into(),
                };
                let name = if number == 0 { "contour" } else { "opening" };
                rows.push(vec![
                    name.to_owned(),
                    format!("{:.3}", start.x + 0.0),
                    format!("{:.3}", start.y + 0.0),
                    round,
                ]);
            }
        }
        Some(Table {
            title: "Contour".into(),
            headings: ["", "x", "y", "radius to the next"]
                .map(String::from)
                .to_vec(),
            columns: vec![Anchor::Left, Anchor::Right, Anchor::Right, Anchor::Right],
            rows,
            notes: Vec::new(),
        })
    }
}

/// Centre and radius of a contour that is a full circle.
fn circle(contour: &Outline) -> Option<(Point, f64)> {
    let mut found: Option<(Point, f64)> = None;
    let mut turned = 0.0;
    for segment in contour.segments() {
        let Segment::Arc(arc) = segment else {
            return None;
        };
        let (center, radius) = (arc.center(), arc.radius());
        let same = found.is_none_or(|(c, r)| {
            (center - c).norm() < 1e-9 * radius && (r - radius).abs() < 1e-9 * radius
        });
        if !same {
            return None;
        }
        found = Some((center, radius));
        turned += arc.sweep().abs();
    }
    found.filter(|_| (turned - 2.0 * PI).abs() < 1e-6)
}

/// Three places at most, without trailing zeros.
fn short(x: f64) -> String {
    let words = format!("{:.3}", x + 0.0);
    let words = words.trim_end_matches('0').trim_end_matches('.');
    if words == "-0" {
        "0".into()
    } else {
        words.into()
    }
}
