//! Pins of a composed machine, turned to the heights of the plates on them.

use centrode_geometry::Point;

use crate::machine::body::points::ROLLER;
use crate::machine::{BodyPoint, Machine, MachineCam, ShaftPart};
use centrode_kinematics::machine::{Bar, Circlip, Fit, Spacer, TurnedPiece, TurnedPieces};
use centrode_spec::digits::thousandths;

/// Distance, as a share of the pin's diameter, below which two axes count as one.
const ONE: f64 = 1e-6;

/// Room for a retaining ring in addition to its own, mm, because axial clearance may move the ring.
pub(super) const SPARE: f64 = 1.0;

/// Holes on one axis.
pub(in crate::machine) struct Axis {
    places: Vec<Point>,
    /// The holes on this axis.
    pub(in crate::machine) holes: Vec<BodyPoint>,
    /// Lower and upper faces of the plates with these holes, mm.
    pub(in crate::machine) plates: Vec<[f64; 2]>,
    /// Rollers of followers on it, with the height of their lower faces, mm.
    rollers: Vec<(Spacer, f64)>,
    /// Heights of the lowest and the highest face, mm.
    span: [f64; 2],
    /// Diameter of its pin, mm.
    size: f64,
}

/// A pin or shaft with its rings, as an obstacle for others near it.
struct Cylinders {
    /// The holes for it.
    holes: Vec<BodyPoint>,
    radius: f64,
    span: [f64; 2],
    rings: Vec<(Spacer, f64)>,
    /// Outer radii of retaining rings, and their heights, mm.
    held: Vec<(f64, [f64; 2])>,
}

impl Axis {
    /// Whether positions over the period, as [`Machine::places_of`] returns them, are those of this axis.
    pub(super) fn is_one(&self, places: &[Point]) -> bool {
        let near = ONE * self.size;
        let mut both = self.places.iter().zip(places);
        both.all(|(a, b)| (a - b).norm() < near)
    }

    /// Heights of the plates with a hole on this axis and of its rollers, mm.
    pub(in crate::machine) fn parts(&self) -> Vec<[f64; 2]> {
        let rollers = self.rollers.iter();
        let rollers = rollers.map(|(roller, at)| [*at, at + roller.length]);
        self.plates.iter().copied().chain(rollers).collect()
    }

    /// A ring on this axis, narrow enough to pass the cam of a roller next to it: a sleeve instead of a wider shim.
    fn clear_of_cams(&self, ring: Spacer, low: f64) -> (Spacer, f64) {
        let span = [low, low + ring.length];
        let is_next = |roller: &Spacer, at: f64| {
            let off = (at - span[1])
                .abs()
                .min((at + roller.length - span[0]).abs());
            off < ONE * self.size
        };
        let next = self
            .rollers
            .iter()
            .find(|(roller, at)| is_next(roller, *at));
        match next {
            Some((roller, _)) => (ring.beside(*roller), low),
            None => (ring, low),
        }
    }

    /// The hole in the body nearest to the frame.
    fn owner(&self) -> BodyPoint {
        let nearest = self.holes.iter().min_by_key(|hole| hole.body);
        nearest.copied().unwrap_or_default()
    }

    /// Height of the highest face, mm.
    pub(in crate::machine) fn top(&self) -> f64 {
        self.span[1]
    }

    fn length(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

impl Machine {
    /// Inputs at which axes of two bodies are compared, as shares of the period: equal there, they count as equal at every input.
    pub const SHARES: [f64; 4] = [0.0, 0.137, 0.411, 0.732];

    /// Shafts, the pins in plates without a shaft, and the posts of the frame.
    #[must_use]
    pub fn turned(&self) -> &[TurnedPieces] {
        self.turned.get_or_init(|| {
            let mut all = self.turned_shafts();
            all.extend(self.pins_in_plates());
            all.extend(self.posts());
            all
        })
    }

    /// The pins in the plates, equal ones together, the shortest first; each belongs to the body nearest to the frame.
    #[must_use]
    pub fn pins_in_plates(&self) -> Vec<TurnedPieces> {
        let mut axes = self.axes();
        for axis in axes.iter_mut().filter(|axis| !self.has_shaft(axis)) {
            let in_frame = axis.holes.iter().find(|hole| hole.body == 0);
            let upper = in_frame.and_then(|hole| self.top_part(hole.at, axis.size, axis.top()));
            if let Some(upper) = upper {
                let (body, at) = (0, upper.at);
                axis.holes.push(BodyPoint { body, at });
                axis.plates.push(upper.span);
                axis.span[1] = upper.span[1];
            }
        }
        axes.sort_by(|a, b| a.length().total_cmp(&b.length()));
        let mut bars: Vec<Cylinders> = axes.iter().map(|axis| self.cylinders(axis)).collect();
        // A single plate turns on a pin that is not part of the machine.
        let is_pin = |axis: &Axis| axis.parts().len() > 1 && !self.has_shaft(axis);
        let pins: Vec<usize> = (0..axes.len()).filter(|&n| is_pin(&axes[n])).collect();
        for &number in &pins {
            let axis = &axes[number];
            let rings = self.spacers(axis.owner(), axis.size, &axis.parts());
            let rings = rings.into_iter();
            let rings = rings.map(|(ring, low)| axis.clear_of_cams(ring, low));
            let is_free = |(ring, low): &(Spacer, f64)| {
                let span = [*low, low + ring.length];
                is_clear_of(&bars, number, 0.5 * ring.outer, span)
            };
            let rings: Vec<(Spacer, f64)> = rings.filter(is_free).collect();
            bars[number].rings.extend(rings);
        }
        let mut found: Vec<TurnedPieces> = Vec::new();
        for number in pins {
            let made = self.pin(&axes[number], &bars, number);
            let mut low = made.pieces[0].at[2];
            for step in &made.part.steps {
                let span = [low, low + step.length];
                let reach = step.ring.map(|ring| (ring.reach(), span));
                bars[number].held.extend(reach);
                low = span[1];
            }
            let alike = |known: &&mut TurnedPieces| {
                known.part.title == made.part.title
                    && known.part.steps == made.part.steps
                    && are_alike(&known.spacers, &made.spacers)
            };
            match found.iter_mut().find(alike) {
                Some(known) => known.pieces.extend(made.pieces),
                None => found.push(made),
            }
        }
        let alone = found.len() == 1;
        for (index, pins) in found.iter_mut().enumerate().filter(|_| !alone) {
            let number = index + 1;
            pins.part.name = format!("pin-{number}");
            // Pins of equal length may differ in their spacers.
            pins.part.title = pins.part.title.replace("Pin", &format!("Pin {number}"));
        }
        found
    }

    /// The pin of an axis; `bars` are all pins and shafts, `number` is the index of this pin.
    fn pin(&self, axis: &Axis, bars: &[Cylinders], number: usize) -> TurnedPieces {
        let spec = &self.design.plates;
        let own = axis.owner();
        let rings = bars[number].rings.iter();
        let raised = |[low, high]: [f64; 2]| {
            // Heights of many layers have rounding errors: round to 1e-9 mm.
            [low, high].map(|z| ((z - axis.span[0]) * 1e9).round() / 1e9)
        };
        let spans = rings.clone().map(|(ring, at)| [*at, at + ring.length]);
        let on_it: Vec<[f64; 2]> = axis
            .plates
            .iter()
            .copied()
            .chain(spans)
            .map(raised)
            .collect();
        let [_, length] = raised(axis.span);
        let general = &self.design.drawing.general_tolerance;
        let is_free = |reach: f64, span: [f64; 2]| is_clear_of(bars, number, reach, span);
        let [low, high] = axis.span;
        let room = [(low, false), (high, true)]
            .map(|(wall, is_above)| self.room_at(own, axis.size, wall, is_above, &is_free));
        let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
        let bar = Bar::new(fit, [0.0, length]).through(&on_it);
        let held = |room: [f64; 2]| bar.clone().held(room);
        // Axial clearance between the rings moves each of them by half of the clearance.
        let needed = Circlip::of_shaft(axis.size).map_or(0.0, Circlip::room);
        let moved = 0.5 * held(room).growth(general);
        let bar = held(room.map(|room| if needed + moved > room { 0.0 } else { room }));
        let bottom = axis.span[0] + bar.bottom() - 0.5 * bar.growth(general);
        let title = format!("Pin through {} mm", thousandths(length));
        let role = match bar.rings() {
            [true, true] => "",
            [false, false] => "no room for rings",
            _ => "room for one ring",
        };
        let name = &self.bodies[own.body].name;
        let given = self.design.bodies.get(name).map(|body| body.given_mass());
        let piece = TurnedPiece {
            is_counted: given.is_some_and(|given| given.mass.is_some()),
            ..TurnedPiece::upright(name, [own.at.x, own.at.y, bottom])
        };
        TurnedPieces {
            role: role.into(),
            spacers: rings.map(|(ring, at)| (*ring, at - bottom)).collect(),
            pieces: vec![piece],
            ..bar.turned("pin", &title, spec.pin_stock(), general)
        }
    }

    /// Room for a ring beyond a face of the outermost part on an axis, mm: the plates' gap, or more if a ring
    /// needs more, no part passes there, and `is_free` holds for the reach and the heights of the ring.
    pub(super) fn room_at(
        &self,
        own: BodyPoint,
        diameter: f64,
        wall: f64,
        is_above: bool,
        is_free: &dyn Fn(f64, [f64; 2]) -> bool,
    ) -> f64 {
        let gap = self.design.plates.gap;
        let Some(ring) = Circlip::of_shaft(diameter) else {
            return gap;
        };
        let needed = ring.room() + SPARE;
        let beyond = match is_above {
            true => [wall, wall + needed],
            false => [wall - needed, wall],
        };
        let is_free = is_free(ring.reach(), beyond) && self.is_clear(own, ring.reach(), beyond);
        gap.max(if is_free { needed } else { 0.0 })
    }

    /// Pin or shaft on an axis, as an obstacle for others.
    fn cylinders(&self, axis: &Axis) -> Cylinders {
        let BodyPoint { body, at } = axis.holes[0];
        let shaft = self.shaft_at(body, at).map(|(shaft, _)| shaft);
        let spans = shaft.into_iter().flat_map(|shaft| &shaft.parts);
        let spans = spans.map(|part| part.span).chain([axis.span]);
        let span = spans.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)]);
        Cylinders {
            holes: axis.holes.clone(),
            radius: 0.5 * shaft.map_or(axis.size, |shaft| shaft.hub.bore),
            span: span.unwrap_or(axis.span),
            rings: axis.rollers.clone(),
            held: Vec::new(),
        }
    }

    /// Whether a shaft is on an axis.
    fn has_shaft(&self, axis: &Axis) -> bool {
        let BodyPoint { body, at } = axis.holes[0];
        let is_here = |part: &ShaftPart| {
            part.is_plate && part.body == body && (part.at - at).norm() < ONE * axis.size
        };
        let shafts = self.shafts().iter();
        shafts.flat_map(|shaft| &shaft.parts).any(is_here)
    }

    /// Positions of a point of a body at the inputs [`Self::SHARES`], mm.
    pub(super) fn places_of(&self, body: usize, at: Point) -> Vec<Point> {
        let place = |share: f64| self.place(body, at, share * self.period());
        Self::SHARES.into_iter().map(place).collect()
    }

    /// Axes of the holes in the plates.
    pub(in crate::machine) fn axes(&self) -> Vec<Axis> {
        let mut axes: Vec<Axis> = Vec::new();
        for body in 0..self.bodies.len() {
            let bottom = self.bottom(body);
            let top = bottom + self.thickness(body);
            for (_, at) in self.hole_places(body).into_iter().flatten() {
                let places = self.places_of(body, at);
                match axes.iter_mut().find(|axis| axis.is_one(&places)) {
                    Some(axis) => {
                        axis.span = [axis.span[0].min(bottom), axis.span[1].max(top)];
                        axis.holes.push(BodyPoint { body, at });
                        axis.plates.push([bottom, top]);
                    }
                    None => axes.push(Axis {
                        places,
                        holes: vec![BodyPoint { body, at }],
                        plates: vec![[bottom, top]],
                        rollers: Vec::new(),
                        span: [bottom, top],
                        size: self.design.plates.pin_diameter,
                    }),
                }
            }
        }
        for (at, (roller, low)) in self.rollers() {
            let is_here = |axis: &&mut Axis| {
                let near = ONE * axis.size;
                axis.holes.iter().any(|hole| hole.is_near(at, near))
            };
            if let Some(axis) = axes.iter_mut().find(is_here) {
                axis.span = [axis.span[0].min(low), axis.span[1].max(low + roller.length)];
                axis.rollers.push((roller, low));
            }
        }
        axes
    }

    /// Rollers of the bodies that follow cams, each with its axis and the height of its lower face, mm. A roller has the width
    /// and the height of its cam.
    pub(in crate::machine) fn rollers(&self) -> Vec<(BodyPoint, (Spacer, f64))> {
        let of = |cam: &MachineCam, follower: &String| {
            let radius = cam.disc().follower().roller_radius()?;
            let at = self.points.get(follower)?.get(ROLLER)?.at;
            let (pin, width) = (self.design.plates.pin_diameter, cam.part.body().width);
            let roller = Spacer::roller(radius, pin, width)?;
            let body = self.body_named(follower)?;
            Some((BodyPoint { body, at }, (roller, self.cam_bottom(cam))))
        };
        let cams = self.cams.iter();
        let pairs = cams.flat_map(|cam| cam.followers.iter().map(move |name| (cam, name)));
        pairs.filter_map(|(cam, name)| of(cam, name)).collect()
    }
}

/// Whether a ring of a radius between two heights clears the other pins and shafts in the bodies that its own pin holds.
fn is_clear_of(all: &[Cylinders], own: usize, radius: f64, span: [f64; 2]) -> bool {
    let others = all.iter().enumerate().filter(|(other, _)| *other != own);
    let is_level = |[low, high]: [f64; 2]| low < span[1] && high > span[0];
    others.into_iter().all(|(_, other)| {
        let holes = all[own].holes.iter();
        let pairs = holes.flat_map(|a| other.holes.iter().map(move |b| (a, b)));
        let shared = pairs.filter(|(a, b)| a.body == b.body);
        let apart = shared.map(|(a, b)| (a.at - b.at).norm());
        let apart = apart.fold(f64::INFINITY, f64::min);
        let rings = other.rings.iter();
        let rings = rings.map(|(ring, low)| (0.5 * ring.outer, [*low, low + ring.length]));
        let held = other.held.iter().copied();
        let mut parts = rings.chain(held).chain([(other.radius, other.span)]);
        parts.all(|(reach, span)| !is_level(span) || apart > radius + reach)
    })
}

/// Whether the rings of two pins are equal and at equal heights.
fn are_alike(one: &[(Spacer, f64)], other: &[(Spacer, f64)]) -> bool {
    let mut both = one.iter().zip(other);
    let same = |((a, low), (b, high)): (&(Spacer, f64), &(Spacer, f64))| {
        a.is_like(*b) && (low - high).abs() < ONE
    };
    one.len() == other.len() && both.all(same)
}
