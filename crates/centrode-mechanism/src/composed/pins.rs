//! Pins of a composed machine, turned to the heights of the plates on them.

use centrode_geometry::Point;

use super::{Composed, ShaftPart};
use crate::digits::thousandths;
use crate::machine::{Bar, Fit, Spacer, TurnedPiece, TurnedPieces};

/// Shares of the period at which plates on one pin have their holes on one axis.
const SHARES: [f64; 4] = [0.0, 0.137, 0.411, 0.732];
/// Distance, as a share of the pin's diameter, within which axes are one.
const ONE: f64 = 1e-6;

/// How a pin is held where there is no room for rings.
const BONDED: &str = "No room for rings: bonded into one of its plates with a retaining compound.";

/// Holes on one axis.
pub(super) struct Axis {
    places: Vec<Point>,
    /// The bodies with a hole there, and its place in their axes.
    pub(super) holes: Vec<(usize, Point)>,
    /// Lower and upper faces of the plates with these holes, mm.
    pub(super) plates: Vec<[f64; 2]>,
    /// From the lowest face to the highest, mm.
    span: [f64; 2],
    /// Diameter of its pin, mm.
    size: f64,
}

impl Axis {
    /// Whether places over the period, as [`Composed::places_of`] tells them, are on it.
    pub(super) fn is_one(&self, places: &[Point]) -> bool {
        let near = ONE * self.size;
        let mut both = self.places.iter().zip(places);
        both.all(|(a, b)| (a - b).norm() < near)
    }

    /// Heights of the plates with a hole on it, from the lowest, above the lowest face.
    fn parts(&self) -> Vec<[f64; 2]> {
        let raised = |span: &[f64; 2]| span.map(|z| z - self.span[0]);
        self.plates.iter().map(raised).collect()
    }

    fn length(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

impl Composed {
    /// Shafts, and the pins in the plates that have none.
    #[must_use]
    pub fn turned(&self) -> &[TurnedPieces] {
        self.turned.get_or_init(|| {
            let mut all = self.turned_shafts();
            all.extend(self.pins_in_plates());
            all
        })
    }

    /// The pins in the plates, those of one length with the same spacers together, the shortest first; each belongs to the body nearest to the frame.
    #[must_use]
    pub fn pins_in_plates(&self) -> Vec<TurnedPieces> {
        let spec = &self.design.plates;
        let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
        let general = &self.design.drawing.general_tolerance;
        let mut found: Vec<(f64, TurnedPieces)> = Vec::new();
        let mut axes = self.axes();
        axes.sort_by(|a, b| a.length().total_cmp(&b.length()));
        // A single plate turns on a pin of what is around the machine.
        let is_pin = |axis: &Axis| axis.holes.len() > 1 && !self.has_shaft(axis);
        for axis in axes.into_iter().filter(is_pin) {
            let own = axis.holes.iter().min_by_key(|(body, _)| *body);
            let spacers = own.map(|own| self.spacers(*own, spec.pin_diameter, &axis.plates));
            let spacers = spacers.unwrap_or_default();
            let raised = |(spacer, at): &(Spacer, f64)| {
                let low = at - axis.span[0];
                [low, low + spacer.length]
            };
            let rings: Vec<[f64; 2]> = spacers.iter().map(raised).collect();
            let bar = Bar::new(spec.pin_diameter, &spec.pin_fit, [0.0, axis.length()]);
            let bar = bar
                .held([spec.gap; 2])
                .through(&axis.parts())
                .through(&rings);
            let bottom = axis.span[0] + bar.bottom();
            let piece = own.map(|&(body, at)| {
                let name = &self.bodies[body].name;
                let spec = self.design.bodies.get(name);
                TurnedPiece {
                    is_counted: spec.is_some_and(|body| body.given_mass().mass.is_some()),
                    ..TurnedPiece::upright(name, [at.x, at.y, bottom])
                }
            });
            let above = |(spacer, at): (Spacer, f64)| (spacer, at - bottom);
            let spacers: Vec<(Spacer, f64)> = spacers.into_iter().map(above).collect();
            let known = found.iter_mut().find(|(long, pins)| {
                axis.length() - *long < ONE * spec.pin_diameter
                    && are_alike(&pins.spacers, &spacers)
            });
            match known {
                Some((_, pins)) => pins.pieces.extend(piece),
                None => {
                    let title = format!("Pin through {} mm", thousandths(axis.length()));
                    let mut part = bar.part(["pin", &title], spec.pin_stock(), general);
                    let role = if bar.is_held() { "" } else { "without rings" };
                    part.notes.extend((!bar.is_held()).then(|| BONDED.into()));
                    let pins = TurnedPieces {
                        role: role.into(),
                        spacers,
                        pieces: piece.into_iter().collect(),
                        ..TurnedPieces::new(part, fit.clone())
                    };
                    found.push((axis.length(), pins));
                }
            }
        }
        let alone = found.len() == 1;
        let mut found: Vec<TurnedPieces> = found.into_iter().map(|(_, pins)| pins).collect();
        for (index, pins) in found.iter_mut().enumerate().filter(|_| !alone) {
            let number = index + 1;
            pins.part.name = format!("pin-{number}");
            // Pins of one length may have other spacers.
            pins.part.title = pins.part.title.replace("Pin", &format!("Pin {number}"));
        }
        found
    }

    /// Whether a shaft is on an axis.
    fn has_shaft(&self, axis: &Axis) -> bool {
        let &(body, at) = &axis.holes[0];
        let is_here = |part: &ShaftPart| {
            part.is_plate && part.body == body && (part.at - at).norm() < ONE * axis.size
        };
        let shafts = self.shafts().iter();
        shafts.flat_map(|shaft| &shaft.parts).any(is_here)
    }

    /// Places of a point of a body over the period, mm.
    pub(super) fn places_of(&self, body: usize, at: Point) -> Vec<Point> {
        let place = |share: f64| self.place(body, at, share * self.period());
        SHARES.into_iter().map(place).collect()
    }

    /// Axes of the holes in the plates.
    pub(super) fn axes(&self) -> Vec<Axis> {
        let mut axes: Vec<Axis> = Vec::new();
        for body in 0..self.bodies.len() {
            let bottom = self.bottom(body);
            let top = bottom + self.thickness(body);
            for (_, at) in self.hole_places(body).into_iter().flatten() {
                let places = self.places_of(body, at);
                match axes.iter_mut().find(|axis| axis.is_one(&places)) {
                    Some(axis) => {
                        axis.span = [axis.span[0].min(bottom), axis.span[1].max(top)];
                        axis.holes.push((body, at));
                        axis.plates.push([bottom, top]);
                    }
                    None => axes.push(Axis {
                        places,
                        holes: vec![(body, at)],
                        plates: vec![[bottom, top]],
                        span: [bottom, top],
                        size: self.design.plates.pin_diameter,
                    }),
                }
            }
        }
        axes
    }
}

/// Whether spacers of two pins are the same at the same heights.
fn are_alike(one: &[(Spacer, f64)], other: &[(Spacer, f64)]) -> bool {
    let mut both = one.iter().zip(other);
    let same = |((a, low), (b, high)): (&(Spacer, f64), &(Spacer, f64))| {
        let off = (a.length - b.length).abs().max((low - high).abs());
        a.is_shim == b.is_shim && off < ONE
    };
    one.len() == other.len() && both.all(same)
}
