//! Evenly spaced copies of a chain of bodies.
//!
//! The copies are written out as ordinary bodies, so the resulting design has no copies.

pub(super) mod copying;
mod dyads;
pub(super) mod expansion;
mod loads;

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use centrode_geometry::Point;
use nalgebra::Rotation2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::expansion::Expansion;
use super::body::points::{BodyPoints, Reference};
use super::design::FRAME;
use super::{MachineBodySpec, MachineCamSpec, MachineDesign, MachineError};
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, count_in_range};

/// Maximum number of pieces of a chain.
const MOST: u32 = 60;

/// Copies of a chain of bodies, evenly spaced about the origin of a body.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineCopiesSpec {
    /// Bodies that are copied, with the dyads, gears and cams that are theirs; the second of `arm` is `arm-2`.
    pub bodies: Vec<String>,
    /// Number of pieces in all.
    pub count: u32,
    /// Body about whose origin they are spaced; the frame where omitted.
    #[serde(default = "frame")]
    pub about: String,
}

fn frame() -> String {
    FRAME.into()
}

impl MachineCopiesSpec {
    pub(super) fn validate(&self) -> Result<(), SpecError> {
        count_in_range("count", self.count, 2, MOST)?;
        match self.bodies.is_empty() {
            true => broken("bodies", Rule::Needed("with at least one body to copy")),
            false => Ok(()),
        }
    }

    /// Angle of a piece from the first one, rad.
    pub(super) fn turn(&self, piece: u32) -> f64 {
        TAU * f64::from(piece) / f64::from(self.count)
    }
}

/// Motion of the body about which copies are spaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spin {
    /// It is fixed.
    Still,
    /// It turns evenly, at this rate, rad per rad of the input.
    Even(f64),
    /// It turns unevenly in one direction: the sign of its rate.
    Uneven(f64),
}

/// The piece of a chain that is being copied.
struct ChainCopy<'a> {
    whole: &'a mut MachineDesign,
    expansion: &'a mut Expansion,
    points: &'a BodyPoints,
    key: String,
    about: &'a str,
    bodies: &'a BTreeSet<String>,
    number: u32,
    /// Angle of the piece from the first one, rad.
    turn: f64,
    spin: Spin,
}

/// Writes out the copies of a chain; the originals are in the design already.
pub(super) fn add(
    whole: &mut MachineDesign,
    expansion: &mut Expansion,
    points: &BodyPoints,
    name: &str,
    spin: Spin,
) -> Result<(), MachineError> {
    let design = whole.clone();
    let spec = &design.copies[name];
    let bodies: BTreeSet<String> = spec.bodies.iter().cloned().collect();
    for piece in 1..spec.count {
        let mut piece = ChainCopy {
            whole: &mut *whole,
            expansion: &mut *expansion,
            points,
            key: format!("copies.{name}"),
            about: &spec.about,
            bodies: &bodies,
            number: piece + 1,
            turn: spec.turn(piece),
            spin,
        };
        piece.add(&design)?;
    }
    Ok(())
}

impl ChainCopy<'_> {
    fn wrong(&self, why: String) -> MachineError {
        MachineError::refused(&self.key, why)
    }

    /// Name of the copy of a part. It is an error if the name is taken.
    fn name(&mut self, of: &str, taken: bool) -> Result<String, MachineError> {
        let name = self.copy(of);
        if taken {
            return Err(self.wrong(format!(
                "the name {name} of a copy of {of} is already in use"
            )));
        }
        self.expansion.originals.insert(name.clone(), of.into());
        Ok(name)
    }

    fn copy(&self, of: &str) -> String {
        format!("{of}-{}", self.number)
    }

    fn is_about(&self, body: &str) -> bool {
        body == self.about
    }

    /// A reference in the copy: to a copied body, to a point turned about the middle, or unchanged.
    fn word(&mut self, key: &str, word: &str) -> Result<String, MachineError> {
        let on = Reference::to_body(word);
        let Some(point) = &on.point else {
            let copied = self.bodies.contains(&on.body);
            return Ok(if copied { self.copy(word) } else { word.into() });
        };
        if self.bodies.contains(&on.body) {
            return Ok(format!("{}.{point}", self.copy(&on.body)));
        }
        let at = on.find(key, self.points)?;
        if !self.is_about(&on.body) || at == Point::origin() {
            return Ok(word.into());
        }
        let name = self.copy(point);
        let made = format!("{}.{name}", on.body);
        if self.expansion.pins.contains_key(&made) {
            return Ok(made);
        }
        let known = self.points.get(&on.body);
        if known.is_some_and(|points| points.contains_key(&name)) {
            let body = &on.body;
            return Err(self.wrong(format!(
                "body {body} already has a point {name}, the name of point {point} of a copy"
            )));
        }
        let at = Rotation2::new(self.turn) * at;
        let points = match on.body.as_str() {
            FRAME => &mut self.whole.frame.points,
            body => &mut self.whole.bodies.entry(body.into()).or_default().points,
        };
        points.insert(name, [at.x, at.y]);
        self.expansion.pins.insert(made.clone(), point.clone());
        Ok(made)
    }

    fn optional(
        &mut self,
        key: &str,
        word: &Option<String>,
    ) -> Result<Option<String>, MachineError> {
        word.as_ref().map(|word| self.word(key, word)).transpose()
    }

    /// A direction (rad) in the axes of the body that a word names, as the copy has it.
    fn direction(&self, word: Option<&String>, direction: Option<f64>) -> Option<f64> {
        let about = word.is_some_and(|word| self.is_about(&Reference::to_body(word).body));
        match about {
            true => Some(direction.unwrap_or(0.0) + self.turn),
            false => direction,
        }
    }

    fn add(&mut self, design: &MachineDesign) -> Result<(), MachineError> {
        let beside = self.beside(design)?;
        for name in self.bodies {
            // The bodies that dyads make need no table of their own.
            if let Some(body) = design.bodies.get(name) {
                let copy = self.body(name, body, &beside)?;
                let taken = self.whole.bodies.contains_key(&self.copy(name));
                let name = self.name(name, taken)?;
                self.whole.bodies.insert(name, copy);
            } else {
                self.name(name, false)?;
            }
        }
        for (name, dyad) in &design.dyads {
            let own = dyad
                .bodies
                .iter()
                .filter(|body| self.bodies.contains(*body));
            match own.count() {
                0 => continue,
                1 => {
                    return Err(self.wrong(format!(
                        "only one of the bodies {} and {} of dyad {name} would be copied: name both",
                        dyad.bodies[0], dyad.bodies[1]
                    )));
                }
                _ => {}
            }
            let copy = self.dyad(name, dyad)?;
            let taken = self.whole.dyads.contains_key(&self.copy(name));
            let name = self.name(name, taken)?;
            self.whole.dyads.insert(name, copy);
        }
        for name in &beside {
            if let Some(gear) = design.gears.get(name) {
                let mut copy = gear.clone();
                copy.on = self.word(&format!("gears.{name}.on"), &gear.on)?;
                copy.mount = self.mounted(&gear.on, gear.mount);
                let taken = self.whole.gears.contains_key(&self.copy(name));
                let name = self.name(name, taken)?;
                self.whole.gears.insert(name, copy);
            }
            if let Some(cam) = design.cams.get(name) {
                let mut copy = cam.clone();
                copy.on = self.word(&format!("cams.{name}.on"), &cam.on)?;
                copy.about = self.optional(&format!("cams.{name}.about"), &cam.about)?;
                copy.cut_to = self.optional(&format!("cams.{name}.cut_to"), &cam.cut_to)?;
                copy.mount = self.mounted(&cam.on, cam.mount);
                let taken = self.whole.cams.contains_key(&self.copy(name));
                let name = self.name(name, taken)?;
                self.whole.cams.insert(name, copy);
            }
        }
        for (name, mesh) in &design.meshes {
            let mut copy = mesh.clone();
            for gear in copy.gears.iter_mut().filter(|gear| beside.contains(*gear)) {
                *gear = self.copy(gear);
            }
            if copy != *mesh {
                let taken = self.whole.meshes.contains_key(&self.copy(name));
                let name = self.name(name, taken)?;
                self.whole.meshes.insert(name, copy);
            }
        }
        self.loads(design)
    }

    /// Names of the gears and cams that are copied: those on copied bodies, and those off the middle of the body about which
    /// the copies are spaced, if they move copied bodies.
    fn beside(&self, design: &MachineDesign) -> Result<BTreeSet<String>, MachineError> {
        let own = self
            .bodies
            .iter()
            .filter_map(|name| design.bodies.get(name));
        let moving: BTreeSet<&String> = own
            .flat_map(|body| {
                let gear = body.mesh.as_ref().map(|mesh| &mesh.with);
                let cam = body.law.as_ref().and_then(|law| law.follows.as_ref());
                gear.into_iter().chain(cam)
            })
            .collect();
        let gears = design
            .gears
            .iter()
            .map(|(name, gear)| ("gears", name, &gear.on));
        let cams = design
            .cams
            .iter()
            .map(|(name, cam)| ("cams", name, &cam.on));
        let cut = design.cams.iter().filter(|(_, cam)| self.is_cut(cam));
        let mut found: BTreeSet<String> = cut.map(|(name, _)| name.clone()).collect();
        for (table, name, on) in gears.chain(cams) {
            let seat = Reference::to_body(on);
            let aside = || {
                let at = seat.find(&format!("{table}.{name}.on"), self.points)?;
                Ok::<bool, MachineError>(at != Point::origin())
            };
            if self.bodies.contains(&seat.body)
                || (self.is_about(&seat.body) && moving.contains(name) && aside()?)
            {
                found.insert(name.clone());
            }
        }
        Ok(found)
    }

    /// Whether a cam is cut to a body that is copied.
    fn is_cut(&self, cam: &MachineCamSpec) -> bool {
        cam.cut_to
            .as_ref()
            .is_some_and(|body| self.bodies.contains(body))
    }

    /// Mounting angle (rad) of the copy of a gear or cam on the body that a word names.
    fn mounted(&self, on: &String, mount: f64) -> f64 {
        self.direction(Some(on), Some(mount)).unwrap_or(mount)
    }

    fn body(
        &mut self,
        name: &str,
        body: &MachineBodySpec,
        beside: &BTreeSet<String>,
    ) -> Result<MachineBodySpec, MachineError> {
        let key = format!("bodies.{name}");
        let mut copy = body.clone();
        copy.on = self.optional(&format!("{key}.on"), &body.on)?;
        copy.fixed_to = self.optional(&format!("{key}.fixed_to"), &body.fixed_to)?;
        copy.slides = body
            .slides
            .and_then(|slides| self.direction(body.on.as_ref(), Some(slides)));
        if body.fixed_to.is_some() {
            copy.turned = self.direction(body.fixed_to.as_ref(), body.turned);
        }
        if let (Some(mesh), Some(own)) = (&body.mesh, &mut copy.mesh) {
            own.gear = self.copy(&mesh.gear);
            if beside.contains(&mesh.with) {
                own.with = self.copy(&mesh.with);
            }
            own.direction = self.mounted(body.on.as_ref().unwrap_or(&mesh.gear), mesh.direction);
        }
        let Some(law) = &mut copy.law else {
            return Ok(copy);
        };
        if let Some(cam) = law.follows.as_mut() {
            if beside.contains(cam) {
                *cam = self.copy(cam);
            }
            return Ok(copy);
        }
        // A body that is driven by a copied body gets the copy as its driver.
        let driven = law.by.as_ref().filter(|by| self.bodies.contains(*by));
        let moves = law.moves() && driven.is_none();
        if let Some(by) = driven.cloned() {
            law.by = Some(format!("{by}-{}", self.number));
        }
        if body.slides.is_none() {
            law.start_angle = self.direction(body.on.as_ref(), law.start_angle);
        }
        if moves {
            let what = format!("body {name}, which has its own law,");
            let ahead = self.ahead(&format!("{key}.law"), &what)?;
            self.run_ahead(self.copy(name), ahead);
        }
        Ok(copy)
    }

    /// Input (rad) by which a function of the input runs ahead for the copy.
    fn ahead(&self, key: &str, what: &str) -> Result<f64, MachineError> {
        match self.spin {
            Spin::Even(rate) if rate > 0.0 => Ok(self.turn / rate),
            Spin::Even(rate) => Ok((self.turn - TAU) / rate),
            Spin::Still => Ok(0.0),
            Spin::Uneven(_) => {
                let about = self.about;
                let why = format!("body {about} turns unevenly: {what} cannot be copied about it");
                Err(MachineError::refused(key, why))
            }
        }
    }

    /// Records that a law or load runs ahead of the original's by an input, rad.
    fn run_ahead(&mut self, name: String, ahead: f64) {
        if ahead != 0.0 {
            self.expansion.ahead.insert(name, ahead);
        }
    }
}
