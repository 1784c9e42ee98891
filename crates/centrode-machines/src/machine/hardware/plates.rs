use std::collections::BTreeMap;

use centrode_geometry::{Outline, Point, Solid, SolidError, Tolerance};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::PinHole;
use crate::machine::design::FRAME;
use crate::machine::{Hardware, Machine, MachineBodySpec, MachineDesign, MachineError};
use centrode_kinematics::machine::{Fastening, JointKind, Stock, hole_class, shaft_class};
use centrode_spec::SpecError;
use centrode_spec::digits::thousandths;
use centrode_spec::rule::{in_range, not_negative, positive, single_line};

/// Maximum diameter of a pin as a share of its plate's width.
pub(super) const PIN: f64 = 0.9;
/// Half length and half height of the block of a body that slides, as shares of a plate's width: higher than the plate.
pub(super) const BLOCK: [f64; 2] = [1.0, 0.6];
/// Radius of the corners of this block, as a share of a plate's width.
const BLOCK_ROUNDING: f64 = 0.1;
/// Minimum size of a plate or pin, mm: far below any real part. Below it a picture needs ten times as many points.
const SMALLEST: f64 = 1e-3;
/// Maximum size of a plate or pin, mm.
const FAR: f64 = 1e9;
/// First and last layer.
pub(in crate::machine) const LAYERS: [f64; 2] = [-1000.0, 1000.0];
/// Width of the bars that represent bodies without plates, as a share of the longest distance in a body.
const BAR: f64 = 0.03;
/// Distance of two pins, as a share of their diameter, below which they count as one.
pub(super) const ONE: f64 = 1e-6;
/// Accuracy of the check of a given contour, as a share of its length.
const CHECKED: f64 = 1e-6;

/// The bodies as plates drawn round their points.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct MachinePlatesSpec {
    /// Thickness of a plate, mm; default 5, or less in proportion if two holes are closer than 8 mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f64>,
    /// Distance of neighbouring plates, mm; default 1, or less in proportion if two holes are closer than 8 mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<f64>,
    /// Width of a plate, mm: it ends in half circles about its points; default 8, or less in proportion if two holes are closer than 8 mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Diameter of the pins, mm; default 3, or less in proportion if two holes are closer than 8 mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_diameter: Option<f64>,
    /// Tolerance class of the holes, ISO 286, for the drawing.
    pub hole_fit: String,
    /// Tolerance class of the pins, ISO 286, for the drawing.
    pub pin_fit: String,
    /// Material, for the drawing.
    pub material: String,
    /// Heat treatment of the plates, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Heat treatment of the pins and of shafts without a gear, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub pin_heat_treatment: String,
    /// Density, kg/m^3.
    pub density: f64,
}

impl Default for MachinePlatesSpec {
    fn default() -> Self {
        Self {
            thickness: None,
            gap: None,
            width: None,
            pin_diameter: None,
            hole_fit: "H8".into(),
            pin_fit: "f7".into(),
            material: "steel".into(),
            heat_treatment: String::new(),
            pin_heat_treatment: String::new(),
            density: 7850.0,
        }
    }
}

impl MachinePlatesSpec {
    /// Material of the pins.
    #[must_use]
    pub fn pin_stock(&self) -> Stock<'_> {
        Stock::new(&self.material, self.density).treated(&self.pin_heat_treatment)
    }

    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        for (key, value) in [
            ("thickness", self.thickness),
            ("width", self.width),
            ("pin_diameter", self.pin_diameter),
        ] {
            let given = value.map_or(Ok(()), |size| positive(key, size));
            given
                .and_then(|()| in_range(key, value.unwrap_or(SMALLEST), [SMALLEST, FAR], " mm"))?;
        }
        positive("density", self.density)?;
        not_negative("gap", self.gap.unwrap_or(0.0))?;
        hole_class("hole_fit", &self.hole_fit)?;
        shaft_class("pin_fit", &self.pin_fit)?;
        single_line("material", &self.material)?;
        single_line("heat_treatment", &self.heat_treatment)?;
        single_line("pin_heat_treatment", &self.pin_heat_treatment)
    }
}

/// Contours that the design gives for bodies, by name.
pub(in crate::machine) fn drawn(
    design: &MachineDesign,
) -> Result<BTreeMap<String, Outline>, MachineError> {
    let mut all = BTreeMap::new();
    if let Some(outline) = design.frame.drawn().contour(FRAME)? {
        all.insert(FRAME.to_owned(), outline);
    }
    for (name, body) in &design.bodies {
        if let Some(outline) = body.drawn().contour(&format!("bodies.{name}"))? {
            all.insert(name.clone(), outline);
        }
    }
    Ok(all)
}

impl Machine {
    /// Tolerance classes, ISO 286, of guides and of the blocks that slide in them.
    pub const GUIDE_FIT: [&str; 2] = ["H9", "e9"];

    /// Contour of a body's plate, as given or round all its points and slots, and the holes in it, in the body's axes: the holes
    /// of pins and shafts, then its [`slots`](Self::slots); `None` for a body without a plate.
    #[must_use]
    pub fn contours(&self, body: usize) -> Option<(Outline, Vec<Outline>)> {
        if !self.has_plate(body) {
            return None;
        }
        let holes = self.pin_holes(body)?.into_iter();
        let screws = (body == 0).then(|| self.frame_screws()).flatten();
        let screws = screws.into_iter().flat_map(Fastening::clearance_holes);
        let slots = self.slots(body).into_iter();
        let slots = slots.filter_map(|slot| slot.outline());
        let holes = holes.map(|hole| hole.outline()).chain(screws).chain(slots);
        let own = self.bodies.get(body)?;
        let outline = match self.drawn.get(&own.name) {
            Some(outline) => outline.clone(),
            None if body == 0 => self.frame_outline()?.clone(),
            None => match self.stemmed(body) {
                Some(outline) => outline,
                None => Outline::hull(&self.circles(body, self.width(body)))?,
            },
        };
        Some((outline, holes.collect()))
    }

    /// Holes for pins and shafts in a body's plate; `None` for a body without a plate.
    #[must_use]
    pub fn pin_holes(&self, body: usize) -> Option<Vec<PinHole>> {
        let holes = self.hole_places(body)?.into_iter();
        Some(holes.map(|(name, at)| self.hole(body, name, at)).collect())
    }

    /// Message about two holes of one plate, or a hole and a slot, that overlap; `None` if there are none.
    #[must_use]
    pub fn overlapping_holes(&self) -> Option<String> {
        self.bodies.iter().enumerate().find_map(|(index, body)| {
            let holes = self.pin_holes(index)?;
            let mut pairs = (0..holes.len()).flat_map(|k| (0..k).map(move |i| (i, k)));
            let of_holes = pairs.find_map(|(i, k)| {
                let (one, other) = (&holes[i], &holes[k]);
                let apart = (one.at - other.at).norm();
                if apart >= 0.5 * (one.hub.bore + other.hub.bore) {
                    return None;
                }
                let [first, second] = [one, other].map(|hole| thousandths(hole.hub.bore));
                Some(format!(
                    "axes {} and {} of body {} are {} mm apart, but their holes of {first} and {second} mm overlap: use thinner pins",
                    one.name,
                    other.name,
                    body.name,
                    thousandths(apart),
                ))
            });
            of_holes.or_else(|| {
                let slots = self.slots(index);
                let mut pairs = slots.iter().flat_map(|slot| holes.iter().map(move |hole| (slot, hole)));
                pairs.find_map(|(slot, hole)| {
                    let wall = -slot.depth(hole.at) - 0.5 * hole.hub.bore;
                    (wall < 0.0).then(|| format!(
                        "in body {}, the slot of {} mm for {} overlaps the hole of axis {} by {} mm: use a narrower {}, or a shorter stroke",
                        body.name,
                        thousandths(slot.width),
                        self.bodies[slot.block].name,
                        hole.name,
                        thousandths(-wall),
                        self.bodies[slot.block].name,
                    ))
                })
            })
        })
    }

    /// Whether a body is fixed to a body that turns, with its origin on that body's pin: its plate is then on the shaft there.
    fn is_fixed_on_axis(&self, body: usize) -> bool {
        let own = &self.bodies[body];
        let (root, place) = self.rigid(body);
        let turns = self.bodies[root].mount.as_ref();
        let turns = turns.is_some_and(|mount| mount.kind == JointKind::Turning);
        let near = ONE * self.design.plates.pin_diameter;
        let drawn = self.drawn.get(&own.name);
        root != body
            && turns
            && place.translation.vector.norm() <= near
            && drawn.is_none_or(|outline| outline.contains(Point::origin()))
    }

    /// Whether pins and shafts go through a body: through its plate, or through the frame.
    pub(super) fn is_on_axes(&self, body: usize) -> bool {
        let name = self.bodies.get(body).map(|body| &body.name);
        let is_described = self.design.hardware() != Hardware::None;
        name.filter(|_| is_described).is_some_and(|name| {
            let spec = self.design.bodies.get(name);
            let has_shape = || {
                let is_sized = |body: &MachineBodySpec| body.width.or(body.thickness).is_some();
                body == 0
                    || self.drawn.contains_key(name)
                    || self.is_block(body)
                    || self.carries_block(body)
                    || spec.is_some_and(is_sized)
                    || self.centers(body).len() > 1
            };
            self.points.contains_key(name)
                && spec.is_none_or(|body| body.has_plate())
                && has_shape()
        })
    }

    /// Whether a body has a plate. A body with a single point has none, unless it has a given contour or size.
    pub(in crate::machine) fn has_plate(&self, body: usize) -> bool {
        let is_made = body != 0 || self.drawn.contains_key(FRAME) || self.has_frame_plates();
        is_made && self.is_on_axes(body)
    }

    /// Names and positions of the holes for pins and shafts in a body, in its axes; `None` if no pin goes through the body.
    pub(in crate::machine) fn hole_places(&self, body: usize) -> Option<Vec<(String, Point)>> {
        if !self.is_on_axes(body) {
            return None;
        }
        let name = &self.bodies[body].name;
        let (points, spec) = (self.points.get(name)?, self.design.bodies.get(name));
        let meshed = spec.is_some_and(|body| body.mesh.is_some());
        let pinned = self.pinned();
        let pins = points
            .iter()
            .filter(|(point, at)| !at.own || pinned.contains(&format!("{name}.{point}")));
        // A mesh places the axis of its body at the body's origin, which need not be a point.
        let axis = meshed || self.is_fixed_on_axis(body);
        let axis = axis.then(|| ("axis".to_owned(), Point::origin()));
        let pins = pins.map(|(point, local)| (point.clone(), local.at));
        let pin = self.design.plates.pin_diameter;
        // Shafts on one axis, for example of a carrier and of a gear in its middle, share a hole.
        let mut holes: Vec<(String, Point)> = Vec::new();
        for hole in pins.chain(axis) {
            let apart = |known: &(String, Point)| (hole.1 - known.1).norm() > ONE * pin;
            if holes.iter().all(apart) {
                holes.push(hole);
            }
        }
        Some(holes)
    }

    /// Contour of the bar that represents a body of a machine without hardware, in the body's axes; `None` for the frame and
    /// for a body with a single point.
    #[must_use]
    pub fn bar(&self, body: usize) -> Option<Outline> {
        if body == 0 || self.design.hardware() != Hardware::None {
            return None;
        }
        let points = self.points.values().flat_map(|points| points.values());
        let sizes = points.map(|point| point.at.coords.norm());
        let circles = self.circles(body, BAR * sizes.fold(0.0, f64::max));
        Outline::hull(&circles).filter(|_| circles.len() > 1)
    }

    /// Circles round which a plate of a width, mm, is drawn: about its points, at the ends of its slots, and at the corners of
    /// the block of a body that slides.
    pub(super) fn circles(&self, index: usize, width: f64) -> Vec<(Point, f64)> {
        let around = |at: Point| (at, self.boss(index, at).max(0.5 * width));
        let mut circles: Vec<(Point, f64)> = self.centers(index).into_iter().map(around).collect();
        let wall = self.wall(index);
        let slots = self.slots(index).into_iter();
        let at_slots = slots.flat_map(|slot| slot.ends.map(|at| (at, 0.5 * slot.width + wall)));
        if self.is_block(index) {
            let radius = BLOCK_ROUNDING * width;
            let [x, y] = BLOCK.map(|half| half * width - radius);
            let corners = [[x, y], [-x, y], [-x, -y], [x, -y]];
            circles.extend(corners.map(|corner| (Point::from(corner), radius)));
        }
        circles.extend(at_slots);
        circles
    }

    /// Points round which the plate of a body is drawn.
    fn centers(&self, index: usize) -> Vec<Point> {
        let name = &self.bodies[index].name;
        let spec = self.design.bodies.get(name);
        let at_origin = spec.is_some_and(|body| body.fixed_to.is_some() || body.mesh.is_some());
        let points = self
            .points
            .get(name)
            .into_iter()
            .flat_map(|points| points.values());
        let near = ONE * self.design.plates.width;
        let mut centers: Vec<Point> = Vec::new();
        for at in points
            .map(|point| point.at)
            .chain(at_origin.then(Point::origin))
        {
            if centers.iter().all(|known| (at - known).norm() > near) {
                centers.push(at);
            }
        }
        if centers.is_empty() {
            centers.push(Point::origin());
        }
        centers
    }

    /// Whether the block of a dyad slides along a line of a body.
    fn carries_block(&self, body: usize) -> bool {
        let mut blocks = self.dyads.iter().flat_map(|dyad| dyad.bodies);
        blocks.any(|block| {
            let mount = self.bodies[block].mount.as_ref();
            self.is_block(block) && mount.is_some_and(|mount| mount.carrier == body)
        })
    }

    /// Whether a body is a block that slides along a line.
    fn is_block(&self, body: usize) -> bool {
        let mount = self.bodies[body].mount.as_ref();
        mount.is_some_and(|mount| matches!(mount.kind, JointKind::Sliding(_)))
    }

    /// Width of a body's plate, mm.
    pub(in crate::machine) fn width(&self, body: usize) -> f64 {
        let spec = self.design.bodies.get(&self.bodies[body].name);
        let own = spec.and_then(|body| body.width);
        own.unwrap_or(self.design.plates.width)
    }

    /// Height of the block of a body that slides, mm, which a guide holds on both sides; `None` for a body that does not slide,
    /// has a given contour, or has a slot and no stem.
    #[must_use]
    pub fn guided(&self, body: usize) -> Option<f64> {
        let own = self.bodies.get(body)?;
        let is_block = self.is_block(body)
            && !self.drawn.contains_key(&own.name)
            && (self.slots(body).is_empty() || self.stemmed(body).is_some());
        is_block.then_some(2.0 * BLOCK[1] * self.width(body))
    }

    /// Checks that given contours contain the holes of their pins, and that every given mass has an inertia or a plate.
    pub(in crate::machine) fn check_drawn(&self) -> Result<(), MachineError> {
        for (index, body) in self.bodies.iter().enumerate() {
            if let Some(spec) = self.design.bodies.get(&body.name) {
                let mass = spec.given_mass().validate(self.has_plate(index));
                mass.map_err(|error| error.inside(&format!("bodies.{}", body.name)))?;
            }
            let Some((outline, holes)) = self.contours(index) else {
                continue;
            };
            if !self.drawn.contains_key(&body.name) {
                continue;
            }
            let key = match index {
                0 => format!("{FRAME}.outline"),
                _ => format!("bodies.{}.outline", body.name),
            };
            let wrong = |why: String| MachineError::Refused {
                key: key.clone(),
                why,
            };
            let fine = Tolerance::new(CHECKED * outline.length().max(f64::MIN_POSITIVE));
            let fine = fine.map_err(|error| wrong(error.to_string()))?;
            // Adding zero makes a negative zero positive.
            let stated = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
            let pins = self.pin_holes(index).into_iter().flatten();
            let pins = pins.map(|PinHole { at, hub, .. }| {
                let [x, y] = [at.x, at.y].map(stated);
                format!("hole of {} mm for the pin at {x}, {y} mm", hub.bore)
            });
            let slots = self.slots(index).into_iter().map(|slot| {
                let [a, b, c, d] = [
                    slot.ends[0].x,
                    slot.ends[0].y,
                    slot.ends[1].x,
                    slot.ends[1].y,
                ]
                .map(stated);
                let block = &self.bodies[slot.block].name;
                format!(
                    "slot of {} mm for {block}, with round ends about {a}, {b} and {c}, {d} mm,",
                    slot.width
                )
            });
            for (hole, what) in holes.into_iter().zip(pins.chain(slots)) {
                let plate = Solid::new(outline.clone(), vec![hole], 0.0, 1.0);
                if plate.and_then(|plate| plate.mesh(fine)).is_err() {
                    return Err(wrong(format!("the {what} is not inside the outline")));
                }
            }
        }
        Ok(())
    }

    /// Height of the lower face of a body's plate along the shafts, mm; that of the frame is below all others.
    pub(in crate::machine) fn bottom(&self, body: usize) -> f64 {
        let name = &self.bodies[body].name;
        let layer = match (self.layer_of(body), self.guide(body)) {
            _ if self.has_frame_plates() && body == 0 => return self.frame_spans()[0][0],
            _ if name == FRAME => -1.0,
            (Some(layer), _) => f64::from(layer),
            // A block in a slot lies in the plate with the slot.
            (None, Some(guide)) => return self.bottom(guide),
            (None, None) => {
                let original = self.body_named(self.original(name)).unwrap_or(body);
                let before = (1..original).filter(|&other| self.is_in_slot(other));
                (original - 1 - before.count()) as f64
            }
        };
        self.design.plates.height_of(layer)
    }

    /// Layer of a body's plate as the design gives it.
    pub(super) fn layer_of(&self, body: usize) -> Option<i32> {
        let spec = self.design.bodies.get(&self.bodies[body].name)?;
        spec.layer
    }

    /// Whether a body is a block in a slot, without a layer of its own.
    fn is_in_slot(&self, body: usize) -> bool {
        self.layer_of(body).is_none() && self.guide(body).is_some()
    }

    /// Thickness of a body's plate, mm.
    #[must_use]
    pub fn thickness(&self, body: usize) -> f64 {
        let spec = self.design.bodies.get(&self.bodies[body].name);
        let own = match body {
            0 => self.design.frame.thickness,
            _ => spec.and_then(|body| body.thickness),
        };
        own.unwrap_or(self.design.plates.thickness)
    }

    /// The plate of a body; `None` for a body without a contour.
    ///
    /// # Errors
    /// [`SolidError`] if a number is not finite.
    pub fn plate(&self, body: usize) -> Result<Option<Solid>, SolidError> {
        let Some((outline, holes)) = self.contours(body) else {
            return Ok(None);
        };
        let bottom = self.bottom(body);
        let top = bottom + self.thickness(body);
        Solid::new(outline, holes, bottom, top).map(Some)
    }
}
