use std::collections::BTreeSet;

use centrode_geometry::{Outline, Point, Solid, SolidError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Composed;
use super::design::FRAME;
use super::points::ROLLER;
use crate::gear::design::SpecError;
use crate::gear::design::rule::{in_range, not_negative, positive};

/// The bodies as plates drawn round their points.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedPlatesSpec {
    /// Thickness of a plate, mm.
    pub thickness: f64,
    /// Distance of neighbouring plates, mm.
    pub gap: f64,
    /// Width of a plate, mm: it ends in half circles about its points.
    pub width: f64,
    /// Diameter of the pins, mm.
    pub pin_diameter: f64,
    /// Density, kg/m^3.
    pub density: f64,
}

impl Default for ComposedPlatesSpec {
    fn default() -> Self {
        Self {
            thickness: 5.0,
            gap: 1.0,
            width: 8.0,
            pin_diameter: 3.0,
            density: 7850.0,
        }
    }
}

impl ComposedPlatesSpec {
    pub(super) fn validate(&self) -> Result<(), SpecError> {
        for (key, value) in [
            ("thickness", self.thickness),
            ("width", self.width),
            ("density", self.density),
        ] {
            positive(key, value)?;
        }
        not_negative("gap", self.gap)?;
        let most = 0.9 * self.width;
        in_range("pin_diameter", self.pin_diameter, [0.0, most], " mm")
    }
}

impl Composed {
    /// Contour of a body's plate, round all its points, and the holes in it, where other bodies are pinned, in the body's
    /// axes.
    #[must_use]
    pub fn contours(&self, body: usize) -> Option<(Outline, Vec<Outline>)> {
        let ComposedPlatesSpec {
            width,
            pin_diameter,
            ..
        } = self.design.plates;
        let name = &self.bodies.get(body)?.name;
        let points = self.points.get(name)?;
        let mut circles: Vec<(Point, f64)> = points.values().map(|p| (p.at, 0.5 * width)).collect();
        let spec = self.design.bodies.get(name);
        let fixed = spec.is_some_and(|body| body.fixed_to.is_some());
        // A mesh places the axis of its body at the body's origin, which need not be a point.
        let meshed = spec.is_some_and(|body| body.mesh.is_some());
        if circles.is_empty() || fixed || meshed {
            circles.push((Point::origin(), 0.5 * width));
        }
        let pinned = self.pinned();
        let pins = points
            .iter()
            .filter(|(point, at)| !at.own || pinned.contains(&format!("{name}.{point}")));
        let axis = meshed.then(Point::origin);
        let holes = pins.map(|(_, point)| point.at).chain(axis);
        let holes = holes.map(|at| Outline::circle(at, 0.5 * pin_diameter));
        Some((Outline::hull(&circles)?, holes.collect()))
    }

    /// Points, by `body.point`, on which other bodies turn.
    pub(super) fn pinned(&self) -> BTreeSet<String> {
        let design = &self.design;
        let bodies = design.bodies.values();
        let turning = bodies.filter(|body| body.slides.is_none() && body.mesh.is_none());
        let on = turning.filter_map(|body| body.on.clone());
        let dyads = design.dyads.values().flat_map(|dyad| {
            let ends = dyad.from.iter().chain(&dyad.to).cloned();
            let joint = dyad.joint.iter();
            let joint =
                joint.flat_map(|joint| dyad.bodies.iter().map(move |b| format!("{b}.{joint}")));
            ends.chain(joint).collect::<Vec<_>>()
        });
        let following = design.bodies.iter().filter(|(_, body)| {
            let law = body.law.as_ref();
            law.is_some_and(|law| law.follows.is_some())
        });
        let rollers = following.map(|(name, _)| format!("{name}.{ROLLER}"));
        on.chain(dyads).chain(rollers).collect()
    }

    /// Points worth following, among those that no other body is held by: given ones, or joints where there is none.
    pub(super) fn followed(&self) -> Vec<String> {
        let design = &self.design;
        let bodies = design.bodies.values();
        let held = bodies.flat_map(|body| body.on.iter().chain(&body.fixed_to));
        let dyads = design.dyads.values();
        let tied = dyads.flat_map(|dyad| [&dyad.from, &dyad.to, &dyad.line, &dyad.second_line]);
        let words: BTreeSet<&String> = held.chain(tied.flatten()).collect();
        // A joint has a name on each of its bodies.
        let joints: Vec<[String; 2]> = design
            .dyads
            .values()
            .filter_map(|dyad| {
                let joint = dyad.joint.as_ref()?;
                Some(dyad.bodies.each_ref().map(|body| format!("{body}.{joint}")))
            })
            .collect();
        let of = |name: &String| joints.iter().find(|names| names.contains(name));
        let free = |name: &String| match of(name) {
            Some(names) => !names.iter().any(|name| words.contains(name)),
            None => !words.contains(name),
        };
        let moving = self.points().filter(|(_, body, _)| *body > 0);
        let all = moving.map(|(name, ..)| name).filter(free);
        let (ties, given): (Vec<String>, Vec<String>) = all.partition(|name| of(name).is_some());
        if given.is_empty() { ties } else { given }
    }

    /// Height of the lower face of a body's plate along the shafts, mm; that of the frame is below all others.
    pub(super) fn bottom(&self, body: usize) -> f64 {
        let spec = &self.design.plates;
        let name = &self.bodies[body].name;
        let written = self.design.bodies.get(name).and_then(|body| body.layer);
        let layer = match written {
            _ if name == FRAME => -1.0,
            Some(layer) => f64::from(layer),
            None => {
                let original = self.body_named(self.original(name));
                original.unwrap_or(body) as f64 - 1.0
            }
        };
        layer * (spec.thickness + spec.gap)
    }

    /// A body as a plate; none for one without a contour.
    ///
    /// # Errors
    /// [`SolidError`] where a number is not finite.
    pub fn plate(&self, body: usize) -> Result<Option<Solid>, SolidError> {
        let Some((outline, holes)) = self.contours(body) else {
            return Ok(None);
        };
        let bottom = self.bottom(body);
        let top = bottom + self.design.plates.thickness;
        Solid::new(outline, holes, bottom, top).map(Some)
    }
}
