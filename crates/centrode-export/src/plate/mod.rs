//! Plates: cutting drawing, sheets and solid of parts with constant thickness.

mod edges;
mod geometrical;
mod hole;
mod sheet;

use crate::cutting::{self, CENTER, HOLE, PROFILE};
use crate::number::mass;
use crate::{ExportError, Package};
use centrode_formats::drawing::{Drawing, EntityShape};
use centrode_formats::dxf::Curves;
use centrode_formats::sheet::Table;
use centrode_gear::design::BodySpec;
use centrode_geometry::{
    MassProperties, Opening, Outline, Point, Solid, SolidError, Tolerance, Vector,
};
use centrode_kinematics::machine::{Blank, Fastening, LinkedMachine, Mounted, Part, Stock};
use centrode_spec::DrawingSpec;
pub(crate) use hole::{Hole, hold_apart};
use hole::{HoleKind, ScrewHole};
use nalgebra::Isometry2;

/// Bodies to be mounted, each with its mass.
pub(crate) type Pieces = Vec<(Mounted, MassProperties)>;

/// A part of one thickness.
#[derive(Clone, Debug)]
pub(crate) struct Plate {
    /// Name that its files begin with.
    pub(crate) name: String,
    /// Title of its drawing.
    pub(crate) title: String,
    /// Number of these plates in a machine.
    pub(crate) quantity: usize,
    pub(crate) outline: Outline,
    pub(crate) holes: Vec<Hole>,
    /// Opening through a wall; its height is measured from the middle of the thickness.
    pub(crate) opening: Option<Opening>,
    /// mm.
    pub(crate) thickness: f64,
    pub(crate) material: String,
    /// kg/m^3.
    pub(crate) density: f64,
    /// Heat treatment, empty for none; `None` where a table of the sheet shows it.
    pub(crate) heat_treatment: Option<String>,
    /// Further notes of its sheet.
    pub(crate) notes: Vec<String>,
    /// Tables of its sheet.
    pub(crate) tables: Vec<Table>,
    /// Tolerance of its contour relative to the datum of its bore.
    pub(crate) exactness: Option<Exactness>,
    /// Timing marks on its face.
    pub(crate) marks: Vec<Point>,
    /// Tolerance classes of its height (or the diameter of a round plate) and of the height of its opening, ISO 286; empty where
    /// general tolerances hold.
    pub(crate) classes: [String; 2],
}

/// Tolerance of a contour relative to the bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Exactness {
    /// Profile tolerance, a grade of its reach.
    Profile,
    /// Runout of a round plate, a grade of its diameter.
    Rim,
    /// The runout of its teeth over pins, mm.
    Teeth(f64),
}

impl Plate {
    /// One plate of a contour and thickness, mm, without holes, and without heat treatment if that of its stock is empty.
    pub(crate) fn new(
        name: &str,
        title: &str,
        outline: Outline,
        thickness: f64,
        stock: Stock<'_>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            quantity: 1,
            outline,
            holes: Vec::new(),
            opening: None,
            thickness,
            material: stock.material.into(),
            density: stock.density,
            heat_treatment: Some(stock.heat_treatment.into()),
            notes: Vec::new(),
            tables: Vec::new(),
            exactness: None,
            marks: Vec::new(),
            classes: Default::default(),
        }
    }

    /// A body of a gear or cam with its bore; `name` begins the names of its files.
    pub(crate) fn of_body(
        name: &str,
        title: &str,
        outline: Outline,
        bore: Option<Outline>,
        body: &BodySpec,
    ) -> Self {
        let stock = Stock::new(&body.material, body.density).treated(&body.heat_treatment);
        let bore = bore.map(|bore| Hole::bore(bore, body));
        Self {
            holes: bore.into_iter().collect(),
            ..Self::new(name, title, outline, body.width, stock)
        }
    }

    /// Spacers between two plates that screws hold, with twice the diameter of the screws.
    pub(crate) fn spacer(
        screws: &Fastening,
        title: &str,
        quantity: usize,
        stock: Stock<'_>,
    ) -> Self {
        let one = Fastening {
            at: vec![Point::origin()],
            ..screws.clone()
        };
        let outline = Outline::circle(Point::origin(), screws.screw.diameter);
        Self {
            quantity,
            holes: Hole::threads(&one),
            ..Self::new("spacer", title, outline, screws.between(), stock)
        }
        .noted("Those of one machine are of one length within 0.02 mm.")
    }

    /// The plate with its origin moved to a point.
    pub(crate) fn about(mut self, origin: Point) -> Self {
        let place = Isometry2::translation(-origin.x, -origin.y);
        self.outline = self.outline.transformed(&place);
        for hole in &mut self.holes {
            hole.outline = hole.outline.transformed(&place);
        }
        self
    }

    pub(crate) fn noted(mut self, line: &str) -> Self {
        self.notes.push(line.into());
        self
    }

    /// Contours of the holes.
    pub(crate) fn cut_outs(&self) -> Vec<Outline> {
        self.holes.iter().map(|hole| hole.outline.clone()).collect()
    }

    /// The solid from z = 0 to its thickness.
    pub(crate) fn solid(&self) -> Result<Solid, SolidError> {
        self.placed([0.0, self.thickness])
    }

    /// The solid between other heights.
    pub(crate) fn placed(&self, [bottom, top]: [f64; 2]) -> Result<Solid, SolidError> {
        let solid = Solid::new(self.outline.clone(), self.cut_outs(), bottom, top)?;
        let Some(opening) = &self.opening else {
            return Ok(solid);
        };
        let middle = 0.5 * (bottom + top);
        solid.with_opening(Opening {
            span: opening.span.map(|z| middle + z),
            ..opening.clone()
        })
    }

    /// Its line in the parts list of a machine, on the links that carry its pieces.
    pub(crate) fn listed(&self, links: Vec<usize>) -> Part {
        let solid = self.solid().ok();
        Part {
            name: self.title.clone(),
            links,
            material: self.material.clone(),
            blank: Blank::plate(&self.outline, self.thickness),
            mass: solid.map(|solid| solid.mass_properties(self.density).mass),
            file: self.name.clone(),
            ..Part::default()
        }
    }

    /// Pieces to be mounted on a link, with their lower faces at `places` in the link's frame, mm; `name` is that of their shape,
    /// `part` that of their part.
    ///
    /// # Errors
    /// [`ExportError`] where it is no solid.
    pub(crate) fn pieces(
        &self,
        machine: &mut LinkedMachine,
        [name, part]: [&str; 2],
        places: &[[f64; 3]],
    ) -> Result<Pieces, ExportError> {
        let solid = self.solid().map_err(ExportError::no_solid(&self.name))?;
        let own = solid.mass_properties(self.density);
        let shape = machine.solids(name, part, vec![solid]);
        let mounted = |&at: &[f64; 3]| {
            let turn = [0.0; 3];
            (Mounted { shape, at, turn }, own)
        };
        Ok(places.iter().map(mounted).collect())
    }

    /// Mass of one, in words.
    fn weight(&self) -> String {
        let volume = self.solid().map_or(0.0, |solid| solid.volume());
        mass(volume * self.density * 1e-6)
    }

    /// Offers drawing, sheets and solid.
    pub(crate) fn add(
        &self,
        package: &mut Package<'_>,
        spec: &DrawingSpec,
    ) -> Result<(), ExportError> {
        let (name, tolerance) = (&*self.name, package.tolerance());
        package.cutting(name, |curves| Ok(self.drawing(curves, tolerance)))?;
        self.add_sheets(package, spec)?;
        let title = package.titled(name);
        package.solid(name, &title, || {
            self.solid().map_err(ExportError::no_solid(name))
        })
    }

    /// Offers the sheets.
    pub(crate) fn add_sheets(
        &self,
        package: &mut Package<'_>,
        spec: &DrawingSpec,
    ) -> Result<(), ExportError> {
        let (name, options, tolerance) = (&*self.name, package.options(), package.tolerance());
        let supplement = package.design();
        package.sheets(name, || {
            self.sheets(spec, supplement, &options.sheet, tolerance)
                .map_err(ExportError::no_sheet(name))
        })
    }

    /// The cutting drawing: contour, holes, centre lines.
    pub(crate) fn drawing(&self, curves: Curves, tolerance: Tolerance) -> Drawing {
        let plain = |outline: &Outline| match curves {
            Curves::Arcs => outline.arcs(tolerance),
            Curves::Splines | Curves::Chords => outline.clone(),
        };
        let mut drawing = cutting::drawing();
        drawing.draw(PROFILE, EntityShape::Contour(plain(&self.outline)));
        for hole in &self.holes {
            drawing.draw(HOLE, EntityShape::Contour(plain(&hole.outline)));
            if let HoleKind::Round(center, radius) = hole.kind() {
                let arm = 1.25 * radius + 1.0;
                let (x, y) = (Vector::new(arm, 0.0), Vector::new(0.0, arm));
                drawing.draw(CENTER, EntityShape::Line(center - x, center + x));
                drawing.draw(CENTER, EntityShape::Line(center - y, center + y));
            }
        }
        drawing
    }
}
