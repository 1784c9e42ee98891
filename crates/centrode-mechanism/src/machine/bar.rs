use super::{Circlip, TurnedPart, TurnedStep, preferred_size};
use crate::gear::design::Keyway;

/// Share of a diameter that a chamfer at an end takes at most.
const CHAMFER: f64 = 1.0 / 16.0;
/// Lengths below which steps are none, mm: rounding.
const ROUNDING: f64 = 1e-9;

/// A bar of one diameter through the parts that it joins, at heights in its machine.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    diameter: f64,
    class: String,
    /// Lower and upper end, mm.
    span: [f64; 2],
    keyed: Vec<[f64; 2]>,
    /// Heights of the loaded walls of grooves, and whether the groove lies above it.
    grooves: Vec<(f64, bool)>,
    keyway: Option<Keyway>,
    /// Stretches of a class of their own.
    seats: Vec<([f64; 2], String)>,
}

impl Bar {
    /// A bar between two heights, of a diameter in a tolerance class.
    pub(crate) fn new(diameter: f64, class: &str, span: [f64; 2]) -> Self {
        Self {
            diameter,
            class: class.into(),
            span,
            keyed: Vec::new(),
            grooves: Vec::new(),
            keyway: None,
            seats: Vec::new(),
        }
    }

    /// Retaining rings at both ends where there is a ring of this size and room beyond them for its groove and land.
    pub(crate) fn held(self, room: [f64; 2]) -> Self {
        let [low, high] = self.span;
        self.ring(low, false, room[0]).ring(high, true, room[1])
    }

    /// A retaining ring below or above a height, where there is room for its groove; at an end the bar grows by what the land takes.
    pub(crate) fn ring(mut self, wall: f64, above: bool, room: f64) -> Self {
        let Some(ring) = Circlip::of_shaft(self.diameter) else {
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

    /// A keyway of the shaft for a hub's, between two heights.
    pub(crate) fn keyed(mut self, hub: Option<Keyway>, span: [f64; 2]) -> Self {
        if let Some(hub) = hub {
            self.keyway = Some(hub.of_shaft());
            self.keyed.push(span);
        }
        self
    }

    /// A stretch between two heights in a tolerance class of its own.
    pub(crate) fn seat(mut self, span: [f64; 2], class: &str) -> Self {
        self.seats.push((span, class.into()));
        self
    }

    /// Height of its lower end, mm.
    pub(crate) fn bottom(&self) -> f64 {
        self.span[0]
    }

    /// Cylinders one after another from the lower end.
    fn steps(&self) -> Vec<TurnedStep> {
        let ring = Circlip::of_shaft(self.diameter);
        let grooves: Vec<[f64; 2]> = self
            .grooves
            .iter()
            .map(|&(wall, above)| {
                let width = ring.map_or(0.0, |ring| ring.width);
                if above {
                    [wall, wall + width]
                } else {
                    [wall - width, wall]
                }
            })
            .collect();
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
                ..TurnedStep::plain(self.diameter, pair[1] - pair[0], class)
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

    /// The part that it is: names of its files and in words.
    pub(crate) fn part(
        &self,
        [name, title]: [&str; 2],
        (material, density): (&str, f64),
    ) -> TurnedPart {
        let steps = self.steps();
        let lands = [steps.first(), steps.last()].into_iter().flatten();
        let shortest = lands.map(|step| step.length).fold(f64::INFINITY, f64::min);
        let chamfer = (CHAMFER * self.diameter).min(0.5 * shortest);
        TurnedPart {
            name: name.into(),
            title: title.into(),
            steps,
            keyway: self.keyway,
            chamfer: preferred_size(chamfer.min(1.0)),
            material: material.into(),
            density,
            notes: Vec::new(),
        }
    }
}
