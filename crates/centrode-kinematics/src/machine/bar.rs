use centrode_geometry::Point;

use super::{
    Bearing, Circlip, Dowel, Fit, HeldLength, Key, SeatedKey, Spacer, Stock, TurnedPart,
    TurnedPiece, TurnedPieces, TurnedStep, general_deviation, preferred_size,
};
use crate::machine::Keyway;

/// Maximum chamfer at an end, relative to the diameter.
const CHAMFER: f64 = 1.0 / 16.0;
/// Length at or below which a step is omitted as rounding, mm.
const ROUNDING: f64 = 1e-9;
/// Minimum axial clearance of the parts between two rings, mm.
const CLEARANCE: f64 = 0.05;
/// Rounding step of the deviations of a length between grooves, and the width of its tolerance, mm.
const DEVIATION: [f64; 2] = [0.05, 0.1];

/// A bar of one diameter through the parts on one axis, described by heights in its machine. The shaft or pin with its rings,
/// keys, bearings and spacers follows from these heights.
#[derive(Clone, Debug)]
pub struct Bar {
    /// Its diameter and the fit of the parts on it.
    fit: Fit,
    /// Tolerance class of its diameter outside its seats.
    class: String,
    /// Parallel pin that is bought instead of a turned bar.
    standard: Option<Dowel>,
    /// Lower and upper end, mm.
    span: [f64; 2],
    keyed: Vec<[f64; 2]>,
    /// Heights of those walls of grooves that face the held parts, and whether the groove lies above its wall.
    grooves: Vec<(f64, bool)>,
    keyway: Option<Keyway>,
    /// Stretches with a tolerance class of their own.
    seats: Vec<([f64; 2], String)>,
    /// Lower and upper faces of the parts on it.
    parts: Vec<[f64; 2]>,
    /// Keys, bearings and spacers on it, each with the height of its lower end.
    keys: Vec<(Key, f64)>,
    bearings: Vec<(Bearing, f64)>,
    spacers: Vec<(Spacer, f64)>,
}

impl Bar {
    /// A bar between two heights, mm, of the size and shaft class of a fit.
    pub fn new(fit: Fit, span: [f64; 2]) -> Self {
        Self {
            class: fit.shaft.clone(),
            fit,
            standard: None,
            span,
            keyed: Vec::new(),
            grooves: Vec::new(),
            keyway: None,
            seats: Vec::new(),
            parts: Vec::new(),
            keys: Vec::new(),
            bearings: Vec::new(),
            spacers: Vec::new(),
        }
    }

    /// The longest parallel pin that has room between two heights, flush with the upper one; a turned bar between both if
    /// there is no such pin, or if the pin is shorter than the room by `short`, mm, or more.
    pub fn dowel(fit: Fit, [low, high]: [f64; 2], short: f64) -> Self {
        let standard = Dowel::for_diameter(fit.size, high - low);
        let standard = standard.filter(|pin| high - low - pin.length < short);
        let low = standard.map_or(low, |pin| high - pin.length);
        Self {
            standard,
            ..Self::new(fit, [low, high])
        }
    }

    /// The bar in another tolerance class than that of its fit.
    pub fn of_class(mut self, class: &str) -> Self {
        self.class = class.into();
        self
    }

    /// The bar through these parts, given by their lower and upper faces, mm: rings leave them axial clearance.
    pub fn through(mut self, parts: &[[f64; 2]]) -> Self {
        self.parts.extend_from_slice(parts);
        self
    }

    /// Adds retaining rings at both ends if there is a ring of this size and room (mm) beyond the end for its groove and land.
    pub fn held(self, room: [f64; 2]) -> Self {
        let [low, high] = self.span;
        self.ring(low, false, room[0]).ring(high, true, room[1])
    }

    /// Adds a retaining ring below or above a height if there is room for it; at an end the bar grows by groove and land.
    pub fn ring(mut self, wall: f64, above: bool, room: f64) -> Self {
        let Some(ring) = Circlip::of_shaft(self.fit.size) else {
            return self;
        };
        let [low, high] = self.span;
        let at_end = wall <= low || wall >= high;
        let needed = if at_end { ring.room() } else { ring.width };
        if needed > room {
            return self;
        }
        self.grooves.push((wall, above));
        if at_end {
            self.span = match above {
                true => [low, wall + needed],
                false => [wall - needed, high],
            };
        }
        self
    }

    /// Adds the shaft's keyway that mates with a hub's keyway, between two heights.
    pub fn keyed(mut self, hub: Option<Keyway>, span: [f64; 2]) -> Self {
        if let Some(hub) = hub {
            self.keyway = Some(hub.of_shaft());
            self.keyed.push(span);
        }
        self
    }

    /// Adds a keyway for a key with square ends, straight over the whole length between two heights. Its half round ends lie
    /// beyond this length, past any grooves there, or the keyway is open at the bar's end.
    pub fn keyed_square(self, hub: Option<Keyway>, [low, high]: [f64; 2]) -> Self {
        let half = 0.5 * hub.map_or(0.0, |hub| hub.width);
        let walls = self.walls();
        let past = walls.iter().fold(low - half, |end, &([a, b], _)| {
            let is_in_the_way = b > end && a - half < end && a < low;
            if is_in_the_way { a - half } else { end }
        });
        let beyond = walls.iter().rev().fold(high + half, |end, &([a, b], _)| {
            let is_in_the_way = a < end && b + half > end && b > high;
            if is_in_the_way { b + half } else { end }
        });
        let [first, last] = self.span;
        let past = if past > first + half {
            past
        } else {
            f64::NEG_INFINITY
        };
        let beyond = if beyond < last - half {
            beyond
        } else {
            f64::INFINITY
        };
        self.keyed(hub, [past, beyond])
    }

    /// Gives the stretch between two heights a tolerance class of its own.
    pub fn seat(mut self, span: [f64; 2], class: &str) -> Self {
        self.seats.push((span, class.into()));
        self
    }

    /// Adds a key in the middle between two heights, mm.
    pub fn key(mut self, key: Option<Key>, [low, high]: [f64; 2]) -> Self {
        self.keys
            .extend(key.map(|key| (key, 0.5 * (low + high - key.length))));
        self
    }

    /// Adds a bearing with its lower face at a height, mm, and a seat of a tolerance class.
    pub fn bearing(mut self, bearing: Bearing, low: f64, class: &str) -> Self {
        self.bearings.push((bearing, low));
        self.seat([low, low + bearing.width], class)
    }

    /// Adds spacers, each with the height of its lower face, mm; they count as parts on the bar.
    pub fn spaced(mut self, spacers: Vec<(Spacer, f64)>) -> Self {
        let spans = spacers.iter().map(|(ring, at)| [*at, at + ring.length]);
        self.parts.extend(spans);
        self.spacers.extend(spacers);
        self
    }

    /// Whether a ring is at the lower end, and whether at the upper.
    pub fn rings(&self) -> [bool; 2] {
        [false, true].map(|way| self.grooves.iter().any(|(_, above)| *above == way))
    }

    /// Lower and upper end of the keyway that was added last, mm.
    pub fn last_keyway(&self) -> Option<[f64; 2]> {
        self.keyed.last().copied()
    }

    /// Length by which the part is longer than the bar, mm: clearance between its rings.
    pub fn growth(&self, general: &str) -> f64 {
        match &self.held_lengths(general)[..] {
            [held] => held.middle(),
            _ => 0.0,
        }
    }

    /// The bar without the ring at its upper end, if that ring, moved by the clearance, does not fit into the room, mm.
    pub fn within(mut self, room: f64, general: &str) -> Self {
        let needed = Circlip::of_shaft(self.fit.size).map_or(0.0, Circlip::room);
        if needed + self.growth(general) <= room + ROUNDING {
            return self;
        }
        let [_, end] = self.span;
        let at_end = |&(wall, above): &(f64, bool)| above && wall + needed > end - ROUNDING;
        if let Some(ring) = self.grooves.iter().position(at_end) {
            self.span[1] = self.grooves.remove(ring).0;
        }
        self
    }

    /// Height of its lower end, mm.
    pub fn bottom(&self) -> f64 {
        self.span[0]
    }

    /// Lower and upper walls of its grooves, from the lowest on, and whether the ring in each holds the parts below it.
    fn walls(&self) -> Vec<([f64; 2], bool)> {
        let width = Circlip::of_shaft(self.fit.size).map_or(0.0, |ring| ring.width);
        let walls = self.grooves.iter().map(|&(wall, above)| match above {
            true => ([wall, wall + width], above),
            false => ([wall - width, wall], above),
        });
        let mut walls: Vec<_> = walls.collect();
        walls.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        walls
    }

    /// Lengths between ring grooves with deviations of their own, because general tolerances could leave the parts between the
    /// rings less than [`CLEARANCE`].
    ///
    /// A ring can move to the far wall of its groove. The clearance is smallest where the length and the grooves are shortest and
    /// the parts and rings thickest: l + (m - s) for each ring that is pushed away from the parts, minus the thicknesses, each
    /// with its deviation.
    fn held_lengths(&self, general: &str) -> Vec<HeldLength> {
        let slack =
            Circlip::of_shaft(self.fit.size).map_or(0.0, |ring| ring.width - ring.thickness);
        let between = |pair: &[([f64; 2], bool)]| {
            let ([_, low], lower_holds_below) = pair[0];
            let ([high, _], upper_holds_below) = pair[1];
            let inside = |part: &&[f64; 2]| part[0] > low - 1e-6 && part[1] < high + 1e-6;
            let parts: Vec<f64> = self
                .parts
                .iter()
                .filter(inside)
                .map(|p| p[1] - p[0])
                .collect();
            let thickest = parts.iter().map(|t| t + general_deviation(general, *t));
            let slacks = f64::from(!lower_holds_below) + f64::from(upper_holds_below);
            let length = high - low;
            let clearance = length + slack * slacks - thickest.sum::<f64>();
            if parts.is_empty() || clearance - general_deviation(general, length) >= CLEARANCE {
                return None;
            }
            let [step, width] = DEVIATION;
            // Rounded up to whole steps; the margin is for rounding.
            let minimum = ((CLEARANCE - clearance) / step - 1e-6).ceil() * step;
            let deviations = [minimum, minimum + width].map(|mm| (mm * 1e3).round() / 1e3);
            let span = [low, high].map(|z| z - self.span[0]);
            Some(HeldLength { span, deviations })
        };
        self.walls().windows(2).filter_map(between).collect()
    }

    /// Cylinders one after another from the lower end.
    fn steps(&self) -> Vec<TurnedStep> {
        let ring = Circlip::of_shaft(self.fit.size);
        let grooves: Vec<[f64; 2]> = self.walls().into_iter().map(|(walls, _)| walls).collect();
        let mut ends: Vec<f64> = self.span.to_vec();
        let seats: Vec<[f64; 2]> = self.seats.iter().map(|(span, _)| *span).collect();
        ends.extend(grooves.iter().chain(&self.keyed).chain(&seats).flatten());
        let [low, high] = self.span;
        ends.retain(|z| (low..=high).contains(z));
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| (*a - *b).abs() < ROUNDING);
        let step = |pair: &[f64]| {
            let middle = 0.5 * (pair[0] + pair[1]);
            let within = |spans: &[[f64; 2]]| spans.iter().any(|s| s[0] < middle && middle < s[1]);
            let seat = self.seats.iter().find(|(span, _)| within(&[*span]));
            let class = seat.map_or(&self.class, |(_, class)| class);
            let plain = TurnedStep {
                is_keyed: within(&self.keyed),
                ..TurnedStep::plain(self.fit.size, pair[1] - pair[0], class)
            };
            match ring.filter(|_| within(&grooves)) {
                Some(ring) => TurnedStep {
                    diameter: ring.groove,
                    class: ring.class().into(),
                    ring: Some(ring),
                    ..plain
                },
                None => plain,
            }
        };
        ends.windows(2).map(step).collect()
    }

    /// A piece upright on a link, its axis at a point in the link's frame, mm.
    pub fn piece(&self, link: &str, at: Point) -> TurnedPiece {
        TurnedPiece::upright(link, [at.x, at.y, self.bottom()])
    }

    /// The turned part with the parts on it, without pieces yet: name of its files, title, material and general tolerances.
    pub fn turned(&self, name: &str, title: &str, stock: Stock<'_>, general: &str) -> TurnedPieces {
        let above = |at: f64| at - self.bottom();
        let keys = self.keys.iter();
        let keys = keys.map(|&(key, at)| SeatedKey { key, at: above(at) });
        let bearings = self.bearings.iter();
        let spacers = self.spacers.iter();
        TurnedPieces {
            standard: self.standard.map(Dowel::name),
            keys: keys.collect(),
            bearings: bearings.map(|&(one, at)| (one, above(at))).collect(),
            spacers: spacers.map(|&(one, at)| (one, above(at))).collect(),
            ..TurnedPieces::new(self.part(name, title, stock, general), self.fit.clone())
        }
    }

    fn part(&self, name: &str, title: &str, stock: Stock<'_>, general: &str) -> TurnedPart {
        let (mut steps, mut held) = (self.steps(), self.held_lengths(general));
        lengthen(&mut steps, &mut held);
        let lands = [steps.first(), steps.last()].into_iter().flatten();
        let shortest = lands.map(|step| step.length).fold(f64::INFINITY, f64::min);
        let chamfer = (CHAMFER * self.fit.size).min(0.5 * shortest);
        TurnedPart {
            name: name.into(),
            title: title.into(),
            steps,
            keyway: self.keyway,
            held,
            chamfer: preferred_size(chamfer.min(1.0)),
            material: stock.material.into(),
            density: stock.density,
            heat_treatment: stock.heat_treatment.into(),
            notes: Vec::new(),
        }
    }
}

/// Makes the last step of a length between two grooves longer by the middle of its deviations, which are then symmetric. Steps
/// beyond keep their length, and the contour lies within all limits. Several such lengths stay unchanged: the parts on them would
/// move.
fn lengthen(steps: &mut [TurnedStep], held: &mut [HeldLength]) {
    let [length] = held else {
        return;
    };
    let ([lower, upper], middle) = (length.deviations, length.middle());
    let mut end = 0.0;
    let last = steps.iter_mut().find(|step| {
        end += step.length;
        end > length.span[1] - ROUNDING
    });
    if let Some(last) = last {
        last.length += middle;
        length.span[1] += middle;
        length.deviations = [lower - middle, upper - middle].map(|mm| (mm * 1e3).round() / 1e3);
    }
}
