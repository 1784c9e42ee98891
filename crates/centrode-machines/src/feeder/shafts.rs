//! Shafts and pins of a feeder, turned to the heights of the parts on them.

use centrode_geometry::Point;

use super::{Feeder, FeederPart, GearBody, Plate};
use centrode_kinematics::machine::{Bar, Fit, Key, TurnedPiece, TurnedPieces};

impl Feeder {
    /// Tolerance classes, ISO 286: of the holes of the cams' pins, which are pressed in, and of these pins, ISO 8734.
    pub const CAM_PIN_FIT: [&str; 2] = ["H7", "m6"];

    /// Tolerance classes, ISO 286: of the crank's hole, which is pressed on, and of its seat on the shaft.
    pub const CRANK_FIT: [&str; 2] = ["H7", "r6"];

    /// All turned parts for the given plates of the links, and the dowels.
    #[must_use]
    pub fn turned(&self, plates: &[Plate]) -> Vec<TurnedPieces> {
        let mut all: Vec<TurnedPieces> = self.pins(plates).into();
        all.extend(self.shafts());
        all.extend(self.cam_pins());
        all
    }

    /// Pins of the cams: half of them reach from the driven gear to the entry cam, half to the exit cam; `None` if
    /// there are no cams.
    fn cam_pins(&self) -> Option<TurnedPieces> {
        let (spec, body) = (&self.design().gears, self.design().gears.body());
        let stops = spec.drive().ok()?.stops();
        let room = 2.0 * spec.width + self.design().plates.gap;
        let fit = Fit::new("pins of the cams", spec.cam_pin(), Self::CAM_PIN_FIT);
        let bar = Bar::dowel(fit, [0.0, room], f64::INFINITY);
        let [middle, entry, _] = self.gear_levels(true);
        let gears = self.gears().ok();
        // The ends of the pins are flush with the cams.
        let levels = [entry, middle + bar.bottom()];
        let cams = gears.iter().flat_map(|gears| gears.cams()).zip(levels);
        let at = cams.flat_map(|(cam, z)| cam.pins.iter().map(move |at| [at.x, at.y, z]));
        // If the gears cannot be cut, the positions of the pins are not known: zero stands for them.
        let at = at.chain(std::iter::repeat([0.0; 3]));
        let on_gear = |at| TurnedPiece::upright(GearBody::NAMES[1], at);
        let made = bar.turned("pin-cam", "Pin of a cam", body.shaft_stock(), "");
        self.has_cams().then(|| TurnedPieces {
            pieces: at.take(2 * stops as usize).map(on_gear).collect(),
            ..made.bought_as("pressed into the driven gear")
        })
    }

    /// Pins of the joints: loose in all their holes, with a retaining ring at each end.
    fn pins(&self, plates: &[Plate]) -> [TurnedPieces; 4] {
        let spec = &self.design().plates;
        let level = |part: FeederPart| {
            let plate = plates.iter().find(|plate| plate.part == part);
            let bottom = plate.map_or(0.0, |plate| plate.bottom);
            [bottom, bottom + spec.thickness]
        };
        let [rear, _] = level(FeederPart::Frame);
        // The second frame plate is above all other plates.
        let front = level(FeederPart::Effector)[1] + spec.gap + spec.thickness;
        let (gap, free) = (spec.gap, f64::INFINITY);
        let general = &self.design().drawing.general_tolerance;
        // Spacers hold the plates of the frame apart: the room between them counts as a part.
        let frame = [
            [rear, rear + spec.thickness],
            [rear + spec.thickness, front - spec.thickness],
            [front - spec.thickness, front],
        ];
        let [b, c, _] = self.six_bar().joints(self.start());
        let d = Point::new(self.six_bar().four_bar().lengths()[3], 0.0);
        let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
        [
            (
                ["pin-b", "Pin B"],
                FeederPart::Crank,
                b,
                [level(FeederPart::Crank)[0], level(FeederPart::Coupler)[1]],
                [gap, gap],
                vec![level(FeederPart::Crank), level(FeederPart::Coupler)],
            ),
            (
                ["pin-c", "Pin C"],
                FeederPart::Rocker,
                c,
                [level(FeederPart::Coupler)[0], level(FeederPart::Slider)[1]],
                [gap, gap],
                [FeederPart::Coupler, FeederPart::Rocker, FeederPart::Slider]
                    .map(level)
                    .into(),
            ),
            (
                ["pin-d", "Pin D"],
                FeederPart::Frame,
                d,
                [rear, front],
                [free, free],
                frame.into(),
            ),
            (
                ["pin-f", "Pin F"],
                FeederPart::Frame,
                self.six_bar().pivot(),
                [level(FeederPart::Effector)[0], front],
                [gap, free],
                vec![level(FeederPart::Effector), frame[2]],
            ),
        ]
        .map(|([name, title], link, axis, span, room, parts)| {
            let bar = Bar::new(fit.clone(), span).held(room).through(&parts);
            let at = axis - self.place(link, self.start()).translation.vector;
            TurnedPieces {
                pieces: vec![bar.piece(link.name(), at)],
                axis: Some(axis.coords.into()),
                ..bar.turned(name, title, spec.pin_stock(), general)
            }
        })
    }

    /// Shafts of the crank and of the intermittent gear, which turn in the rear frame plate.
    fn shafts(&self) -> [TurnedPieces; 2] {
        let (body, plates) = (self.design().gears.body(), &self.design().plates);
        let [middle, entry, exit] = self.gear_levels(self.has_cams());
        let (gap, free) = (plates.gap, f64::INFINITY);
        let ([rear, front], plate) = ([-gap - plates.thickness, -gap], [0.0, plates.thickness]);
        let key = body.keyway;
        let key = key.and_then(|hub| Key::fitting(hub, body.width));
        // The keyway with half-round ends is as long as the key, which is in the middle of its hub.
        let beyond = key.map_or(0.0, |key| 0.5 * (body.width - key.length));
        // Bar from the lowest hub up to a height, with a retaining ring on both sides of each hub.
        let through = |hubs: &[f64], end: f64| {
            let bar = Bar::new(body.seat(""), [hubs[0], end]).ring(hubs[0], false, free);
            let hubs = hubs.iter().map(|&low| [low, low + body.width]);
            let last = hubs.clone().fold(free, |_, hub| hub[1]);
            let on = |bar: Bar, hub: [f64; 2]| {
                let bar = bar.ring(hub[1], true, gap);
                bar.through(&[hub]).key(key, hub)
            };
            let bar = hubs.fold(bar, on).through(&[[rear, front]]);
            bar.keyed(body.keyway, [f64::NEG_INFINITY, last - beyond])
        };
        // In the thin crank a key with round ends would transmit force over less than half its length. A key with square ends
        // uses the whole length of the seat.
        let square = body.keyway;
        let square = square.and_then(|hub| Key::square(hub, plates.thickness));
        let before = 0.5 * body.keyway.map_or(0.0, |keyway| keyway.width);
        let crank = through(&[middle], plates.thickness)
            .ring(rear, false, gap)
            .ring(front, true, gap)
            .keyed(body.keyway, [front - before, free])
            .seat([0.0, free], Self::CRANK_FIT[1])
            .key(square, plate);
        let hubs = match self.has_cams() {
            true => vec![entry, middle, exit],
            false => vec![middle],
        };
        // If the crank does not reach as far as this shaft, there is more room for its ring.
        let reach = self.six_bar().four_bar().lengths()[0] + 0.5 * plates.width;
        let distance = self.design().gears.center_distance();
        let room = match reach < distance - 0.5 * body.bore {
            true => gap + plates.thickness,
            false => gap,
        };
        let own = through(&hubs, front).ring(front, true, room);
        let general = &self.design().drawing.general_tolerance;
        let made = |bar: &Bar, [name, title, link, role]: [&str; 4], x: f64| TurnedPieces {
            role: role.into(),
            pieces: vec![bar.piece(link, Point::origin())],
            axis: Some([x, 0.0]),
            ..bar.turned(name, title, body.shaft_stock(), general)
        };
        let link = FeederPart::Crank.name();
        let mut crank = made(&crank, ["shaft-a", "Shaft A", link, "of the crank"], 0.0);
        crank.part.notes =
            vec!["The crank is pressed on its seat and key, flush with the end.".into()];
        let role = "of the intermittent gear";
        let names = ["shaft-g", "Shaft G", GearBody::NAMES[0], role];
        [crank, made(&own, names, -distance)]
    }
}
