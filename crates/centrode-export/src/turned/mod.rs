//! Shafts and pins: parts turned from round bar.

mod across;
mod layout;
mod sheet;

use centrode_geometry::{self as geometry, Outline, Point, SolidError, TurnedSection, TurnedSlot};
use centrode_mechanism::design::DrawingSpec;
use centrode_mechanism::gear::design::Keyway;
use centrode_mechanism::machine::{Blank, Circlip, Machine, Part, Place};

use crate::drawing::{CENTER, Drawing, PROFILE, Shape};
use crate::{ExportError, Package};
pub(crate) use across::{across, cutting_plane};
pub(crate) use layout::{Bar, centre};
pub(crate) use sheet::centre_mark;

/// A part turned from round bar, with a keyway where it has one, along its axis z.
#[derive(Clone, Debug)]
pub(crate) struct Turned {
    /// Name that its files begin with.
    pub(crate) name: String,
    /// Title of its drawing.
    pub(crate) title: String,
    /// Cylinders one after another, z upwards.
    pub(crate) steps: Vec<Step>,
    /// Keyway of the steps that have one, along x.
    pub(crate) keyway: Option<Keyway>,
    /// Chamfer at both ends, mm; 0 for none.
    pub(crate) chamfer: f64,
    pub(crate) material: String,
    /// kg/m^3.
    pub(crate) density: f64,
    /// Further notes of its sheet.
    pub(crate) notes: Vec<String>,
}

/// A cylinder of a turned part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Step {
    /// mm.
    pub(crate) diameter: f64,
    /// mm.
    pub(crate) length: f64,
    /// Tolerance class of its diameter, ISO 286; empty where general tolerances hold.
    pub(crate) class: String,
    /// Whether the keyway goes through it.
    pub(crate) is_keyed: bool,
    /// Ring whose groove it is.
    pub(crate) ring: Option<Circlip>,
}

impl Step {
    /// A plain cylinder of a diameter in a tolerance class.
    pub(crate) fn plain(diameter: f64, length: f64, class: &str) -> Self {
        Self {
            diameter,
            length,
            class: class.into(),
            is_keyed: false,
            ring: None,
        }
    }
}

impl Turned {
    /// Length over all, mm.
    pub(crate) fn length(&self) -> f64 {
        self.steps.iter().map(|step| step.length).sum()
    }

    /// Greatest diameter, mm.
    pub(crate) fn diameter(&self) -> f64 {
        let diameters = self.steps.iter().map(|step| step.diameter);
        diameters.fold(0.0, f64::max)
    }

    /// Exact body, from z = 0.
    pub(crate) fn solid(&self) -> Result<geometry::Turned, SolidError> {
        let c = self.chamfer;
        let last = self.steps.len() - 1;
        let mut sections = Vec::new();
        for (index, step) in self.steps.iter().enumerate() {
            let radius = 0.5 * step.diameter;
            let [first, final_one] = [index == 0, index == last];
            let slotted = step.is_keyed;
            let cone = |radii: [f64; 2]| TurnedSection {
                length: c,
                radii,
                slotted,
            };
            let cut = [first, final_one].into_iter().filter(|end| *end).count();
            let straight = TurnedSection {
                slotted,
                ..TurnedSection::cylinder(step.length - cut as f64 * c, radius)
            };
            sections.extend(first.then(|| cone([radius - c, radius])));
            sections.push(straight);
            sections.extend(final_one.then(|| cone([radius, radius - c])));
        }
        if c == 0.0 {
            sections.retain(|section| section.length > 0.0);
        }
        let slot = self.keyway.map(|key| TurnedSlot {
            width: key.width,
            foot: 0.5 * self.diameter() - key.depth,
        });
        geometry::Turned::new(0.0, sections, slot)
    }

    /// Mass of one, kg.
    pub(crate) fn mass(&self) -> Option<f64> {
        let body = self.solid().ok()?;
        Some(body.volume() * self.density * 1e-9)
    }

    /// Lists the part, a piece on each of the links, and what is bought for it; its number points to a place.
    pub(crate) fn list(
        &self,
        machine: &mut Machine,
        links: &[usize],
        remark: String,
        place: Option<Place>,
    ) {
        machine.part(Part {
            name: self.title.clone(),
            links: links.to_vec(),
            material: self.material.clone(),
            blank: Some(Blank::Round {
                diameter: self.diameter(),
                length: self.length(),
            }),
            mass: self.mass(),
            file: self.name.clone(),
            remark,
            place,
            ..Part::default()
        });
        for step in &self.steps {
            if let Some(ring) = step.ring {
                machine.part(Part::bought(ring.name(), links.to_vec()));
            }
        }
    }

    /// Offers the contour for the lathe, the sheets of a machine that has so many, and the exact body.
    pub(crate) fn add(
        &self,
        package: &mut Package<'_>,
        spec: &DrawingSpec,
        quantity: usize,
    ) -> Result<(), ExportError> {
        let name = &*self.name;
        package.drawing(name, |_| Ok(self.drawing()))?;
        let (options, tolerance) = (package.options(), package.tolerance());
        let words = (spec, package.design());
        package.sheets(name, || {
            self.sheets(words, quantity, &options.sheet, tolerance)
                .map_err(ExportError::no_sheet(name))
        })?;
        let body = || self.solid().map_err(ExportError::no_solid(name));
        package.shell(name, || Ok(body()?.shell()))?;
        let title = package.titled(name);
        package.mesh(name, &title, |tolerance| {
            body()?.mesh(tolerance).map_err(ExportError::no_solid(name))
        })
    }

    /// Corners of the upper half of its contour, from end to end along x, the ends' middles left out.
    pub(crate) fn half(&self) -> Vec<Point> {
        let (mut at, c) = (0.0, self.chamfer);
        let mut corners = Vec::new();
        let last = self.steps.len() - 1;
        for (index, step) in self.steps.iter().enumerate() {
            let radius = 0.5 * step.diameter;
            let end = at + step.length;
            let [from, to] =
                [(index == 0, at, 1.0), (index == last, end, -1.0)].map(|(is_end, x, inwards)| {
                    match is_end && c > 0.0 {
                        true => vec![
                            Point::new(x, radius - c),
                            Point::new(x + inwards * c, radius),
                        ],
                        false => vec![Point::new(x, radius)],
                    }
                });
            corners.extend(from.into_iter().chain(to.into_iter().rev()));
            at = end;
        }
        corners.dedup();
        corners
    }

    /// Contour as seen from the side, along x.
    pub(crate) fn silhouette(&self) -> Outline {
        let upper = self.half();
        let lower = upper.iter().map(|p| Point::new(p.x, -p.y));
        let around: Vec<Point> = lower.chain(upper.iter().rev().copied()).collect();
        Outline::polygon(&around)
    }

    fn drawing(&self) -> Drawing {
        let mut drawing = Drawing::cutting();
        drawing.draw(PROFILE, Shape::Contour(self.silhouette()));
        let [from, to] = [-3.0, self.length() + 3.0].map(|x| Point::new(x, 0.0));
        drawing.draw(CENTER, Shape::Line(from, to));
        drawing
    }
}

#[cfg(test)]
mod tests;
