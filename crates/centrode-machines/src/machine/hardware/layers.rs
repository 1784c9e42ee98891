//! Orders of the plates along the shafts in which no pin runs into a plate.

use std::collections::{BTreeMap, BTreeSet};

use centrode_geometry::{COMPUTED, checkpoint};

use crate::machine::hardware::pins::Axis;
use crate::machine::hardware::plates::ONE;
use crate::machine::{BodyPoint, Machine};

/// Maximum number of plates without a layer whose orders are searched: each further plate doubles the work.
const MAX_PLATES: usize = 12;
/// Maximum number of orders that are returned.
const MAX_ORDERS: usize = 8;
/// Result of the search for orders of the plates that have no layer in the design.
#[derive(Clone, Debug, PartialEq)]
pub enum LayerOrders {
    /// Up to 8 orders in which no pin runs into a plate at the sampled inputs, each as layers by body.
    Free(Vec<BTreeMap<String, i32>>),
    /// No order is possible: in each, at least one of these pins runs into the plate named with it. One sentence per pin and
    /// plate.
    Blocked(Vec<String>),
    /// Number of plates without a layer, if it is more than 12, or the machine has more than 64 plates.
    Many(usize),
}

/// Plates in one layer: of a body, its copies and the blocks in their slots. The frame is the first unit.
struct Unit {
    name: String,
    bodies: Vec<usize>,
    layer: Option<i32>,
    /// Number of layers that the unit takes up.
    count: i32,
}

/// A pin or shaft: the units that it joins, one bit each, and the heights of gears, cams and rollers on it, mm.
struct Joined {
    name: String,
    units: u64,
    fixed: Option<[f64; 2]>,
}

/// State of the search for orders.
struct Search<'a> {
    composed: &'a Machine,
    units: &'a [Unit],
    pins: &'a [Joined],
    /// Indices of pins and units that meet if their heights overlap.
    hits: &'a BTreeSet<(usize, usize)>,
    first: i32,
    /// First layer that may stay empty.
    dense_until: i32,
    last: i32,
    /// States (layer, and units below it) from which no order was found.
    dead: BTreeSet<(i32, u64)>,
    found: Vec<Vec<i32>>,
    most: usize,
}

impl Machine {
    /// Orders of the plates without a layer of their own in which no pin runs into a plate, or the pins and plates that prevent
    /// every order. Gears and cams are not considered: check the machine with each order.
    #[must_use]
    pub fn layer_orders(&self) -> LayerOrders {
        let units = self.units();
        let free = units.iter().filter(|unit| unit.layer.is_none()).count();
        if free > MAX_PLATES || units.len() > 64 {
            return LayerOrders::Many(free);
        }
        let of_body = |body: usize| units.iter().position(|unit| unit.bodies.contains(&body));
        let (mut pins, mut hits) = (Vec::new(), BTreeSet::new());
        for axis in self.axes() {
            let joined = axis.holes.iter().filter_map(|hole| of_body(hole.body));
            let joined = joined.fold(0, |all, unit| all | 1_u64 << unit);
            let fixed = self.fixed_on(&axis);
            if joined.count_ones() + u32::from(fixed.is_some()) < 2 {
                continue;
            }
            let radius = 0.5 * self.diameter_on(&axis);
            for (number, unit) in units.iter().enumerate() {
                let mut bodies = unit.bodies.iter();
                let is_joined = joined & 1 << number != 0;
                if !is_joined && bodies.any(|&body| self.meets(axis.holes[0], radius, body)) {
                    hits.insert((pins.len(), number));
                }
            }
            pins.push(Joined {
                name: self.pin_name(&axis),
                units: joined,
                fixed,
            });
        }
        let search =
            |hits: &BTreeSet<(usize, usize)>, most: usize| self.orders(&units, &pins, hits, most);
        let found = search(&hits, MAX_ORDERS);
        if !found.is_empty() {
            let named = |layers: Vec<i32>| {
                let free = units
                    .iter()
                    .zip(layers)
                    .filter(|(unit, _)| unit.layer.is_none());
                free.map(|(unit, layer)| (unit.name.clone(), layer))
                    .collect()
            };
            return LayerOrders::Free(found.into_iter().map(named).collect());
        }
        // Conflicts that are necessary: without any one of them an order would be possible.
        let mut needed = hits.clone();
        for hit in hits {
            needed.remove(&hit);
            if !search(&needed, 1).is_empty() {
                needed.insert(hit);
            }
        }
        let words = needed.into_iter().map(|(pin, unit)| {
            let joined = (0..units.len()).filter(|k| pins[pin].units & 1 << k != 0);
            let joined: Vec<&str> = joined.map(|k| &*units[k].name).collect();
            let fixed = pins[pin].fixed.map_or("", |_| " and its gears or roller");
            format!(
                "the pin at {} joins {}{fixed} and hits the plate of {}",
                pins[pin].name,
                joined.join(", "),
                units[unit].name
            )
        });
        LayerOrders::Blocked(words.collect())
    }

    /// The machine with new layers for bodies and their copies.
    #[must_use]
    pub fn with_layers(&self, layers: &BTreeMap<String, i32>) -> Self {
        let mut made = Self {
            shafts: Default::default(),
            turned: Default::default(),
            passage: Default::default(),
            frame: Default::default(),
            ..self.clone()
        };
        for body in &self.bodies {
            if let Some(&layer) = layers.get(self.original(&body.name)) {
                made.design.set_layer(&body.name, layer);
            }
        }
        for (name, layer) in layers {
            let spec = made.written.bodies.entry(name.clone()).or_default();
            spec.layer = Some(*layer);
        }
        made
    }

    /// Units of the plates, the frame first.
    fn units(&self) -> Vec<Unit> {
        let pitch = self.plates().thickness + self.plates().gap;
        let mut units: Vec<Unit> = Vec::new();
        for body in (0..self.bodies.len()).filter(|&body| self.is_on_axes(body)) {
            let mut lying = body;
            while let (None, Some(guide)) = (self.layer_of(lying), self.guide(lying)) {
                lying = guide;
            }
            let name = self.original(&self.bodies[lying].name);
            let thick = (self.thickness(body) + self.plates().gap) / pitch;
            let count = (thick - COMPUTED).ceil() as i32;
            match units.iter_mut().find(|unit| unit.name == name) {
                Some(unit) => {
                    unit.bodies.push(body);
                    unit.count = unit.count.max(count);
                }
                None => units.push(Unit {
                    name: name.to_owned(),
                    bodies: vec![body],
                    layer: if lying == 0 {
                        Some(-1)
                    } else {
                        self.layer_of(lying)
                    },
                    count,
                }),
            }
        }
        units
    }

    /// Lowest and highest face of gears, cams and rollers on an axis, mm.
    fn fixed_on(&self, axis: &Axis) -> Option<[f64; 2]> {
        let BodyPoint { body, at } = axis.holes[0];
        let shaft = self.shaft_at(body, at).map(|(shaft, _)| shaft);
        let parts = shaft.into_iter().flat_map(|shaft| &shaft.parts);
        let wheels = parts.filter(|part| !part.is_plate).map(|part| part.span);
        let near = ONE * self.plates().pin_diameter;
        let is_on = |at: BodyPoint| axis.holes.iter().any(|hole| hole.is_near(at, near));
        let rollers = self.rollers().into_iter().filter(|(at, _)| is_on(*at));
        let rollers = rollers.map(|(_, (roller, low))| [low, low + roller.length]);
        let all = wheels.chain(rollers);
        all.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)])
    }

    fn diameter_on(&self, axis: &Axis) -> f64 {
        let BodyPoint { body, at } = axis.holes[0];
        let shaft = self.shaft_at(body, at);
        shaft.map_or(self.plates().pin_diameter, |(shaft, _)| shaft.hub.bore)
    }

    /// Name of a pin: a body and the name of its hole for the pin.
    fn pin_name(&self, axis: &Axis) -> String {
        let BodyPoint { body, at } = axis.holes[0];
        let mut holes = self.hole_places(body).into_iter().flatten();
        let name = holes.find(|hole| hole.1 == at).map(|hole| hole.0);
        format!("{}.{}", self.bodies[body].name, name.unwrap_or_default())
    }

    fn orders(
        &self,
        units: &[Unit],
        pins: &[Joined],
        hits: &BTreeSet<(usize, usize)>,
        most: usize,
    ) -> Vec<Vec<i32>> {
        let written = units.iter().filter_map(|unit| unit.layer);
        let lowest = written.clone().fold(-1, i32::min);
        let free = units.iter().filter(|unit| unit.layer.is_none());
        let room: i32 = free.map(|unit| unit.count).sum();
        let highest = units
            .iter()
            .filter_map(|unit| Some(unit.layer? + unit.count));
        let last = highest.fold(0, i32::max) + room;
        // Gears and cams are below the frame. Below the lower plate of a frame of two plates there is no other plate.
        let is_free = self.gears.is_empty() && self.cams.is_empty() && !self.has_frame_plates();
        let below = if is_free { room } else { 0 };
        for under in 0..=below {
            let mut search = Search {
                composed: self,
                units,
                pins,
                hits,
                first: lowest - under,
                dense_until: lowest,
                last,
                dead: BTreeSet::new(),
                found: Vec::new(),
                most,
            };
            search.place(search.first, 0, &mut vec![0; units.len()]);
            if !search.found.is_empty() {
                return search.found;
            }
        }
        Vec::new()
    }
}

impl Search<'_> {
    /// Fills the layers from `layer` on with the units that are not yet placed; false if no order was found.
    fn place(&mut self, layer: i32, placed: u64, layers: &mut Vec<i32>) -> bool {
        checkpoint();
        if placed.count_ones() as usize == self.units.len() {
            self.found.push(layers.clone());
            return true;
        }
        if layer > self.last || self.dead.contains(&(layer, placed)) {
            return false;
        }
        let is_here = |unit: &Unit| unit.layer == Some(layer);
        let units = 0..self.units.len();
        let fixed: Vec<usize> = units.clone().filter(|&k| is_here(&self.units[k])).collect();
        let mut good = false;
        if fixed.is_empty() {
            for unit in units.filter(|k| placed & 1 << k == 0) {
                let count = self.units[unit].count;
                let next = layer + count;
                let is_free = self.units[unit].layer.is_none();
                let mut written = self.units.iter().filter_map(|unit| unit.layer);
                if !is_free
                    || written.any(|at| (layer..next).contains(&at))
                    || !self.is_clear(unit, layer, placed)
                {
                    continue;
                }
                layers[unit] = layer;
                good |= self.place(next, placed | 1 << unit, layers);
                if self.found.len() >= self.most {
                    return true;
                }
            }
            let mut waiting = self.units.iter();
            if layer >= self.dense_until
                && waiting.any(|unit| unit.layer.is_some_and(|at| at > layer))
            {
                good |= self.place(layer + 1, placed, layers);
            }
        } else if fixed.iter().all(|&unit| self.is_clear(unit, layer, placed)) {
            for &unit in &fixed {
                layers[unit] = layer;
            }
            let here = fixed.iter().fold(placed, |all, unit| all | 1 << unit);
            let count = fixed.iter().map(|&unit| self.units[unit].count).max();
            let next = layer + count.unwrap_or(1);
            let mut written = self.units.iter().filter_map(|unit| unit.layer);
            let next = if written.any(|at| (layer + 1..next).contains(&at)) {
                layer + 1
            } else {
                next
            };
            good |= self.place(next, here, layers);
        }
        if !good {
            self.dead.insert((layer, placed));
        }
        good
    }

    /// Whether no pin runs into a unit in a layer, with the placed units below it and all others above it.
    fn is_clear(&self, unit: usize, layer: i32, placed: u64) -> bool {
        let plates = self.composed.plates();
        let [low, high] =
            [layer, layer + self.units[unit].count].map(|layer| plates.height_of(layer.into()));
        let mut hits = self.hits.iter().filter(|(_, hit)| *hit == unit);
        hits.all(|&(pin, _)| {
            let Joined { units, fixed, .. } = &self.pins[pin];
            let is_below = units & placed != 0 || fixed.is_some_and(|[bottom, _]| bottom < high);
            let is_above = units & !placed != 0 || fixed.is_some_and(|[_, top]| top > low);
            !(is_below && is_above)
        })
    }
}
