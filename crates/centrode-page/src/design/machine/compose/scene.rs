//! The machine at the input shown: where its points and bodies are, and what its text says.

use std::sync::Arc;

use centrode_families::FAMILIES;
use centrode_geometry::Point;
use centrode_machines::machine::Machine;
use serde_json::Value as Json;
use toml_edit::DocumentMut;

use super::writing::{self, digits};
use super::{Composed, Pin, Place, Refusal, naming};
use crate::design::kind::mechanism;
use crate::design::machine::Frame;

/// Inputs of a period at which motions are sampled.
const SAMPLES: u32 = 360;

/// A machine that is being composed.
pub(super) struct Scene {
    pub(super) document: DocumentMut,
    /// The text as a value.
    pub(super) design: Json,
    /// `None` while the design has no body.
    pub(super) machine: Option<Arc<Machine>>,
    /// Input shown, rad.
    pub(super) input: f64,
}

/// A pin of a new part.
pub(super) struct Held {
    /// `crank.A`
    pub(super) word: String,
    /// Index of its body.
    pub(super) body: usize,
    /// Position in the axes of the body, mm.
    local: Point,
    /// Position in the picture, mm.
    pub(super) at: Point,
}

impl Scene {
    pub(super) fn new(text: &str, input: f64) -> Result<Self, Box<Refusal>> {
        let document: DocumentMut = text.parse().map_err(|error| {
            Box::new(Refusal::because(format!("the text is not TOML: {error}")))
        })?;
        let table = text.parse::<toml::Table>();
        let design = table
            .ok()
            .and_then(|table| serde_json::to_value(table).ok());
        let design = design.unwrap_or_default();
        if design.get("family").and_then(Json::as_str) != Some("machine") {
            let why = "parts can be added only to a design of family machine";
            return Err(Box::new(Refusal::because(why)));
        }
        let read = FAMILIES.read(text.as_bytes());
        let machine = match read.and_then(|file| file.mechanism()) {
            Ok(made) => made.downcast::<Machine>(),
            Err(_) if is_empty(&design) => None,
            Err(error) => {
                let why = format!("correct the design first: {}", error.message());
                return Err(Box::new(Refusal::because(why)));
            }
        };
        Ok(Self {
            document,
            design,
            machine,
            input,
        })
    }

    /// Axes of a body at an input.
    fn axes(&self, body: usize, input: f64) -> Frame {
        match &self.machine {
            Some(machine) => Frame {
                origin: machine.place(body, Point::origin(), input),
                angle: machine.angle(body, input).position,
            },
            None => Frame {
                origin: Point::origin(),
                angle: 0.0,
            },
        }
    }

    /// Index of a body.
    pub(super) fn body(&self, name: &str) -> Result<usize, Box<Refusal>> {
        let found = match &self.machine {
            Some(machine) => machine.body_named(name),
            None => (name == "frame").then_some(0),
        };
        found.ok_or_else(|| Box::new(Refusal::because(format!("there is no body {name}"))))
    }

    /// Angle of a body at the input shown, rad.
    pub(super) fn angle(&self, body: usize) -> f64 {
        self.axes(body, self.input).angle
    }

    /// Origin of a body at the input shown.
    pub(super) fn origin(&self, body: usize) -> Point {
        self.axes(body, self.input).origin
    }

    /// Position of the picture in the axes of a body, mm, with six digits.
    pub(super) fn local(&self, body: usize, at: Point) -> [f64; 2] {
        let own = self.axes(body, self.input).seen(at);
        // Digits of the length, so that a zero is not written as 1e-16.
        let size = own.coords.norm().max(f64::MIN_POSITIVE);
        [own.x, own.y].map(|x| digits(if x.abs() < 1e-6 * size { 0.0 } else { x }))
    }

    /// Point with a name, and its body.
    pub(super) fn point(&self, word: &str) -> Result<Held, Box<Refusal>> {
        let none = || Box::new(Refusal::because(format!("there is no point {word}")));
        let (body, local) = match &self.machine {
            Some(machine) => {
                let found = machine.point_named(word).ok_or_else(none)?;
                (found.body, found.at)
            }
            None => {
                let name = word.strip_prefix("frame.").ok_or_else(none)?;
                let at = &self.design["frame"]["points"][name];
                let at: [f64; 2] = serde_json::from_value(at.clone()).map_err(|_| none())?;
                (0, at.into())
            }
        };
        Ok(self.held(word.into(), body, local))
    }

    fn held(&self, word: String, body: usize, local: Point) -> Held {
        let at = self.at(body, local, self.input);
        Held {
            word,
            body,
            local,
            at,
        }
    }

    fn at(&self, body: usize, local: Point, input: f64) -> Point {
        match &self.machine {
            Some(machine) => machine.place(body, local, input),
            None => local,
        }
    }

    /// The pin; a new one is written into the design.
    pub(super) fn pin(&mut self, pin: &Pin) -> Result<Held, Box<Refusal>> {
        match pin {
            Pin::Point(word) => self.point(word),
            Pin::New { body, at } => {
                let index = self.body(body)?;
                let local = self.local(index, Point::from(*at));
                let name = naming::point(&self.design, body);
                writing::put_point(&mut self.document, body, &name, local)?;
                self.reread();
                Ok(self.held(format!("{body}.{name}"), index, local.into()))
            }
        }
    }

    /// Takes note of a change of the document.
    pub(super) fn reread(&mut self) {
        let table = self.document.to_string().parse::<toml::Table>();
        if let Some(design) = table.ok().and_then(|t| serde_json::to_value(t).ok()) {
            self.design = design;
        }
    }

    /// Positions of a pin over a period, mm.
    pub(super) fn path(&self, pin: &Held) -> Vec<Point> {
        let inputs = self.inputs();
        let at = inputs.map(|input| self.at(pin.body, pin.local, input));
        at.collect()
    }

    /// Positions of a pin over a period in the axes of a body, mm.
    pub(super) fn seen(&self, pin: &Held, body: usize) -> Vec<Point> {
        let inputs = self.inputs();
        let at = inputs.map(|input| {
            let place = self.at(pin.body, pin.local, input);
            self.axes(body, input).seen(place)
        });
        at.collect()
    }

    fn inputs(&self) -> impl Iterator<Item = f64> + use<> {
        let period = self
            .machine
            .as_ref()
            .map_or(0.0, |machine| machine.period());
        (0..SAMPLES).map(move |i| period * f64::from(i) / f64::from(SAMPLES))
    }

    /// The design with the part, if it is a machine.
    pub(super) fn finish(&self, key: &str, part: Composed) -> Result<Composed, Box<Refusal>> {
        let text = self.document.to_string();
        if !is_empty(&self.design)
            && let Err(error) = mechanism(&text)
        {
            return Err(Box::new(Refusal::because(error.message())));
        }
        Ok(Composed {
            text,
            key: key.into(),
            ..part
        })
    }
}

/// Whether a design has neither bodies nor dyads.
pub(super) fn is_empty(design: &Json) -> bool {
    let none = |key: &str| {
        let table = design.get(key).and_then(Json::as_object);
        table.is_none_or(serde_json::Map::is_empty)
    };
    none("bodies") && none("dyads")
}

/// The position that was clicked.
///
/// # Errors
/// The numbers that are missing if there is none.
pub(super) fn clicked(at: Option<Place>, numbers: &str) -> Result<Point, Box<Refusal>> {
    let missing = || Refusal::because(format!("click a position, or give {numbers}"));
    at.map(Point::from).ok_or_else(|| Box::new(missing()))
}

/// Line between two positions.
pub(super) fn line(a: Point, b: Point) -> [Place; 2] {
    [a.coords.into(), b.coords.into()]
}
