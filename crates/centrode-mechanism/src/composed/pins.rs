//! Pins of a composed machine, turned to the heights of the plates on them.

use centrode_geometry::Point;

use super::Composed;
use crate::digits::thousandths;
use crate::machine::{Bar, Fit, TurnedPiece, TurnedPieces};

/// Shares of the period at which plates on one pin have their holes on one axis.
const SHARES: [f64; 4] = [0.0, 0.137, 0.411, 0.732];
/// Distance, as a share of the pin's diameter, within which axes are one.
const ONE: f64 = 1e-6;

/// How a pin is held where there is no room for rings.
const BONDED: &str = "No room for rings: bonded into one of its plates with a retaining compound.";

/// Holes on one axis.
struct Axis {
    places: Vec<Point>,
    /// The bodies with a hole there, and its place in their axes.
    holes: Vec<(usize, Point)>,
    /// Lower and upper faces of the plates with these holes, mm.
    plates: Vec<[f64; 2]>,
    /// From the lowest face to the highest, mm.
    span: [f64; 2],
}

impl Axis {
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
    /// The pins in the plates, those of one length together, the shortest first; each belongs to the body nearest to the frame.
    #[must_use]
    pub fn pins_in_plates(&self) -> Vec<TurnedPieces> {
        let spec = &self.design.plates;
        let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
        let general = &self.design.drawing.general_tolerance;
        let mut found: Vec<(f64, TurnedPieces)> = Vec::new();
        let mut axes = self.axes();
        axes.sort_by(|a, b| a.length().total_cmp(&b.length()));
        // A single plate turns on a pin of what is around the machine.
        for axis in axes.into_iter().filter(|axis| axis.holes.len() > 1) {
            let bar = Bar::new(spec.pin_diameter, &spec.pin_fit, [0.0, axis.length()]);
            let bar = bar.held([spec.gap; 2]).through(&axis.parts());
            let bottom = axis.span[0] + bar.bottom();
            let own = axis.holes.iter().min_by_key(|(body, _)| *body);
            let piece = own.map(|&(body, at)| {
                let name = &self.bodies[body].name;
                let spec = self.design.bodies.get(name);
                TurnedPiece {
                    is_counted: spec.is_some_and(|body| body.given_mass().mass.is_some()),
                    ..TurnedPiece::upright(name, [at.x, at.y, bottom])
                }
            });
            let known = found.last_mut();
            match known.filter(|(long, _)| axis.length() - *long < ONE * spec.pin_diameter) {
                Some((_, pins)) => pins.pieces.extend(piece),
                None => {
                    let title = format!("Pin through {} mm", thousandths(axis.length()));
                    let material = (&*spec.material, spec.density);
                    let mut part = bar.part(["pin", &title], material, general);
                    let role = if bar.is_held() { "" } else { "without rings" };
                    part.notes.extend((!bar.is_held()).then(|| BONDED.into()));
                    let pins = TurnedPieces {
                        role: role.into(),
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
            pins.part.name = format!("pin-{}", index + 1);
        }
        found
    }

    fn axes(&self) -> Vec<Axis> {
        let near = ONE * self.design.plates.pin_diameter;
        let mut axes: Vec<Axis> = Vec::new();
        for body in 0..self.bodies.len() {
            let Ok(Some(plate)) = self.plate(body) else {
                continue;
            };
            for hole in self.pin_holes(body).into_iter().flatten() {
                let place = |share: f64| self.place(body, hole.at, share * self.period());
                let places: Vec<Point> = SHARES.into_iter().map(place).collect();
                let is_one = |axis: &&mut Axis| {
                    let mut both = axis.places.iter().zip(&places);
                    both.all(|(a, b)| (a - b).norm() < near)
                };
                let [bottom, top] = [plate.bottom(), plate.top()];
                match axes.iter_mut().find(is_one) {
                    Some(axis) => {
                        axis.span = [axis.span[0].min(bottom), axis.span[1].max(top)];
                        axis.holes.push((body, hole.at));
                        axis.plates.push([bottom, top]);
                    }
                    None => axes.push(Axis {
                        places,
                        holes: vec![(body, hole.at)],
                        plates: vec![[bottom, top]],
                        span: [bottom, top],
                    }),
                }
            }
        }
        axes
    }
}
