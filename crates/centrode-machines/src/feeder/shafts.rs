//! Shafts and pins of a feeder, turned to the heights of what is on them.

use centrode_geometry::Point;

use super::{Feeder, FeederPart, GearBody, Plate};
use centrode_kinematics::machine::{
    Bar, Dowel, Fit, Key, SeatedKey, TurnedPart, TurnedPiece, TurnedPieces,
};

impl Feeder {
    /// Tolerance classes, ISO 286, of the holes into which the pins of the cams are pressed and of the pins, ISO 8734.
    pub const CAM_PIN_FIT: [&str; 2] = ["H7", "m6"];

    /// Tolerance classes, ISO 286, of the crank's hole and of the seat of its shaft, on which it is pressed.
    pub const CRANK_FIT: [&str; 2] = ["H7", "r6"];

    /// All parts that are turned, for plates of the links, and the dowels.
    #[must_use]
    pub fn turned(&self, plates: &[Plate]) -> Vec<TurnedPieces> {
        let mut all: Vec<TurnedPieces> = self.pins(plates).into();
        all.extend(self.shafts());
        all.extend(self.cam_pins());
        all
    }

    /// Pins of the cams: half of them reach from the driven gear to the entry cam, half to the exit cam; none without cams.
    fn cam_pins(&self) -> Option<TurnedPieces> {
        let (spec, body) = (&self.design().gears, self.design().gears.body());
        let stops = spec.drive().ok()?.stops();
        let room = 2.0 * spec.width + self.design().plates.gap;
        let fit = Fit::new("pins of the cams", spec.cam_pin(), Self::CAM_PIN_FIT);
        let standard = Dowel::for_diameter(fit.size, room);
        let long = standard.map_or(room, |pin| pin.length);
        let bar = Bar::new(fit.size, &fit.shaft, [0.0, long]);
        let [middle, entry, _] = self.gear_levels(true);
        let gears = self.gears().ok();
        // Ends flush with the cams.
        let levels = [entry, middle + room - long];
        let cams = gears.iter().flat_map(|gears| gears.cams()).zip(levels);
        let at = cams.flat_map(|(cam, z)| cam.pins.iter().map(move |at| [at.x, at.y, z]));
        // Without gears none has a place.
        let at = at.chain(std::iter::repeat([0.0; 3]));
        let pieces = at.take(2 * stops as usize);
        let made = bar.part("pin-cam", "Pin of a cam", body.shaft_stock(), "");
        self.has_cams().then(|| TurnedPieces {
            role: standard
                .map_or("", |_| "pressed into the driven gear")
                .into(),
            standard: standard.map(Dowel::name),
            pieces: pieces
                .map(|at| TurnedPiece::upright(GearBody::NAMES[1], at))
                .collect(),
            ..TurnedPieces::new(made, fit)
        })
    }

    /// Pins of the joints, which float in all their holes, a ring at either end.
    fn pins(&self, plates: &[Plate]) -> [TurnedPieces; 4] {
        let spec = &self.design().plates;
        let level = |part: FeederPart| {
            let plate = plates.iter().find(|plate| plate.part == part);
            let bottom = plate.map_or(0.0, |plate| plate.bottom);
            [bottom, bottom + spec.thickness]
        };
        let [rear, _] = level(FeederPart::Frame);
        // The second frame plate stands above all others.
        let front = level(FeederPart::Effector)[1] + spec.gap + spec.thickness;
        let (gap, free) = (spec.gap, f64::INFINITY);
        let general = &self.design().drawing.general_tolerance;
        // The plates of the frame are held apart.
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
            let bar = Bar::new(spec.pin_diameter, &spec.pin_fit, span).held(room);
            let bar = bar.through(&parts);
            let at = axis - self.place(link, self.start()).translation.vector;
            let at = [at.x, at.y, bar.bottom()];
            let part = bar.part(name, title, spec.pin_stock(), general);
            TurnedPieces {
                pieces: vec![TurnedPiece::upright(link.name(), at)],
                axis: Some(axis.coords.into()),
                ..TurnedPieces::new(part, fit.clone())
            }
        })
    }

    /// Shafts of the crank and of the intermittent gear, which turn in the rear frame plate.
    fn shafts(&self) -> [TurnedPieces; 2] {
        let (body, plates) = (self.design().gears.body(), &self.design().plates);
        let [middle, entry, exit] = self.gear_levels(self.has_cams());
        let (gap, free) = (plates.gap, f64::INFINITY);
        let [rear, front] = [-gap - plates.thickness, -gap];
        let hub = |bottom: f64| [bottom, bottom + body.width];
        let stock = body.shaft_stock();
        let general = &self.design().drawing.general_tolerance;
        let fit = Fit::new("", body.bore, [&body.bore_fit, &body.shaft_fit]);
        let keyed = |bar: Bar, ends: [f64; 2]| bar.keyed(body.keyway, ends);
        let held = |bar: Bar| bar.ring(rear, false, gap).ring(front, true, gap);
        let crank = Bar::new(body.bore, &body.shaft_fit, [middle, plates.thickness]);
        let crank = crank.ring(middle, false, free);
        // Half round ends of keyways end with the keys, which stand in the middle of their hubs.
        let key_of_hub = |keyway| Key::fitting(keyway, body.width);
        let key_of_hub = body.keyway.and_then(key_of_hub);
        let beyond = key_of_hub.map_or(0.0, |key| 0.5 * (body.width - key.length));
        let crank = keyed(crank, [f64::NEG_INFINITY, hub(middle)[1] - beyond]);
        // A key with square ends leaves its whole seat to the straight part of the keyway.
        let before = 0.5 * body.keyway.map_or(0.0, |keyway| keyway.width);
        let crank = crank.ring(hub(middle)[1], true, gap);
        let crank = keyed(held(crank), [front - before, free]);
        let crank = crank.seat([0.0, free], Self::CRANK_FIT[1]);
        let crank = crank.through(&[hub(middle), [rear, front]]);
        let hubs = match self.has_cams() {
            true => vec![entry, middle, exit],
            false => vec![middle],
        };
        // The crank does not reach as far as this shaft.
        let reach = self.six_bar().four_bar().lengths()[0] + 0.5 * plates.width;
        let distance = self.design().gears.center_distance();
        let before = match reach < distance - 0.5 * body.bore {
            true => gap + plates.thickness,
            false => gap,
        };
        let own = Bar::new(body.bore, &body.shaft_fit, [hubs[0], front]);
        let own = own.ring(hubs[0], false, free);
        let own = hubs
            .iter()
            .fold(own, |bar, &bottom| bar.ring(hub(bottom)[1], true, gap));
        let last = hubs
            .iter()
            .fold(f64::NEG_INFINITY, |top, &bottom| top.max(hub(bottom)[1]));
        let own = keyed(own, [f64::NEG_INFINITY, last - beyond]).ring(front, true, before);
        let on_it = hubs.iter().map(|&bottom| hub(bottom));
        let own = own.through(&on_it.chain([[rear, front]]).collect::<Vec<_>>());
        let mut of_crank = crank.part("shaft-a", "Shaft A", stock, general);
        of_crank.notes =
            vec!["The crank is pressed on its seat and key, flush with the end.".into()];
        let on_shaft = |part: TurnedPart, bar: &Bar, link: &str| TurnedPieces {
            pieces: vec![TurnedPiece::upright(link, [0.0, 0.0, bar.bottom()])],
            ..TurnedPieces::new(part, fit.clone())
        };
        // In the middle of its hub.
        let seated = |key: Key, [low, high]: [f64; 2], bar: &Bar| SeatedKey {
            key,
            at: 0.5 * (low + high - key.length) - bar.bottom(),
        };
        let key = |bottom: f64, bar: &Bar| {
            let key = Key::fitting(body.keyway?, body.width)?;
            Some(seated(key, hub(bottom), bar))
        };
        let square = || {
            let key = Key::square(body.keyway?, plates.thickness)?;
            Some(seated(key, [0.0, plates.thickness], &crank))
        };
        [
            TurnedPieces {
                role: "of the crank".into(),
                // In the thin crank a key with round ends would bear over less than half its length.
                keys: [key(middle, &crank), square()]
                    .into_iter()
                    .flatten()
                    .collect(),
                axis: Some([0.0; 2]),
                ..on_shaft(of_crank, &crank, FeederPart::Crank.name())
            },
            TurnedPieces {
                role: "of the intermittent gear".into(),
                keys: hubs.iter().filter_map(|&low| key(low, &own)).collect(),
                axis: Some([-distance, 0.0]),
                ..on_shaft(
                    own.part("shaft-g", "Shaft G", stock, general),
                    &own,
                    GearBody::NAMES[0],
                )
            },
        ]
    }
}
