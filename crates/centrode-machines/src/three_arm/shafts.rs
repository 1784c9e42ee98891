//! Shafts and pins of a three-arm mechanism, turned to the heights of the parts on them.

use std::f64::consts::PI;

use super::making::{BEARING, PRESSED, SLIDING, STEEL};
use super::{Pusher, ThreeArm};
use crate::arm::ArmBody;
use centrode_gear::design::BodySpec;
use centrode_kinematics::machine::{
    Bar, Fit, Key, TurnedPart, TurnedPiece, TurnedPieces, TurnedStep,
};

/// Length of the carrier's shaft behind the gearbox, in shaft diameters.
const DRIVEN_END: f64 = 3.0;
/// Share of the fork's thickness by which its pin may be too short, so that pins of standard length can be used.
const SHORT: f64 = 0.3;

impl ThreeArm {
    /// All turned parts, dowels and screws. Gears without a bore have no shafts; without a gearbox there are no shafts at all.
    #[must_use]
    pub fn turned(&self, pusher: &Pusher, arm: &ArmBody) -> Vec<TurnedPieces> {
        let mut all = self.shafts(arm);
        all.extend(self.pins(pusher, arm));
        let carrier = self.carrier_screws(arm).and_then(Result::ok);
        all.extend(
            carrier.map(|screws| screws.screws(&["carrier".into()], "of the carrier's plates")),
        );
        let covers = self.cover_screws(pusher, arm).and_then(Result::ok);
        let arms: Vec<String> = (0..self.arms()).map(|k| format!("arm_{k}")).collect();
        all.extend(covers.map(|screws| screws.screws(&arms, "of the covers of the arms")));
        all
    }

    /// Pieces at a position of a link, one per chain.
    fn on_chains(&self, link: &str, at: [f64; 3]) -> Vec<TurnedPiece> {
        let piece = |k| TurnedPiece::upright(&format!("{link}_{k}"), at);
        (0..self.arms()).map(piece).collect()
    }

    /// Shafts through both plates of the carrier; those of the planets go on through the arms.
    fn shafts(&self, arm: &ArmBody) -> Vec<TurnedPieces> {
        let Some(gearbox) = self.gearbox() else {
            return Vec::new();
        };
        let (design, [rear, front]) = (self.design(), gearbox.spans);
        let (clearance, free) = (design.gearbox.clearance, f64::INFINITY);
        let beyond = self.arm_level() + span(arm, "cover-front").map_or(0.0, |[_, top]| top);
        let between = self.shaft(
            &design.intermediate,
            self.on_chains("intermediate", [0.0; 3]),
            "shaft-intermediate",
            "Shaft of an intermediate gear",
            [rear[0], front[1]],
            [free, clearance],
        );
        let planet = self.shaft(
            &design.planet,
            self.on_chains("planet", [0.0; 3]),
            "shaft-planet",
            "Shaft of a planet gear",
            [rear[0], beyond],
            [free; 2],
        );
        let all = [self.carrier_shaft(), between, planet];
        all.into_iter().flatten().collect()
    }

    /// Shaft of the sun. It is fixed, and the carrier turns about it. `None` if there is no gearbox, or the sun has no
    /// bore.
    #[must_use]
    pub fn carrier_shaft(&self) -> Option<TurnedPieces> {
        let (design, [rear, front]) = (self.design(), self.gearbox()?.spans);
        let behind = rear[0] - DRIVEN_END * design.sun.bore;
        let mut made = self.shaft(
            &design.sun,
            vec![TurnedPiece::upright("sun", [0.0; 3])],
            "shaft-carrier",
            "Shaft of the carrier",
            [behind, front[1]],
            [0.0, design.gearbox.clearance],
        )?;
        made.part.notes =
            vec!["Fixed at its free end, to be cut to length. The carrier turns about it.".into()];
        Some(made)
    }

    /// A shaft in the bore of a gear, between two heights, with room for retaining rings beyond them; `links` are its pieces.
    fn shaft(
        &self,
        body: &BodySpec,
        links: Vec<TurnedPiece>,
        name: &str,
        title: &str,
        span: [f64; 2],
        room: [f64; 2],
    ) -> Option<TurnedPieces> {
        let [rear, front] = self.gearbox().filter(|_| body.bore > 0.0)?.spans;
        let general = &self.design().drawing.general_tolerance;
        let [_, end] = span;
        let bar = Bar::new(body.seat(""), span).held(room);
        // On the shaft: the carrier's plates, the spacers between them and, if the shaft goes on, the parts that hold the arm.
        let arm = (end > front[1]).then_some([front[1], end]);
        let between = [rear, [rear[1], front[0]], front];
        let on_it: Vec<[f64; 2]> = between.into_iter().chain(arm).collect();
        let (hub, key) = ([0.0, body.width], body.keyway);
        let key = key.and_then(|hub| Key::fitting(hub, body.width));
        let bar = bar.through(&on_it).keyed(body.keyway, hub);
        let mut bar = bar.key(key, hub);
        // The bearings are at the outer faces of the plates, against the retaining rings.
        if let Some(bearing) = self.bearing(body.bore) {
            for low in [rear[0], front[1] - bearing.width] {
                bar = bar.bearing(bearing, low, BEARING[1]);
            }
        }
        // Keyways of shaft and gear are on one line.
        let seat = |piece: TurnedPiece| TurnedPiece {
            at: [0.0, 0.0, bar.bottom()],
            turn: [0.0, 0.0, body.keyway_angle],
            ..piece
        };
        Some(TurnedPieces {
            pieces: links.into_iter().map(seat).collect(),
            ..bar.turned(name, title, body.shaft_stock(), general)
        })
    }

    /// Pins of fork, roller and push rod.
    fn pins(&self, pusher: &Pusher, arm: &ArmBody) -> Vec<TurnedPieces> {
        let spec = pusher.fork_spec();
        let (fork, cam) = (pusher.fork_span(), pusher.cam_span());
        let wide = |name: &str| span(arm, name).unwrap_or([0.0, 1.0]);
        // The cam is behind the fork and covers the pivot: the pin cannot go on behind the fork.
        let [_, cover] = wide("cover-front");
        let stock = STEEL.treated(&spec.pin_heat_treatment);
        // From the rear face of the fork to the outside of the front cover. If no pin has this length, it begins a little in
        // the fork.
        let [pressed, _] = pusher.pivot_fit().fits([""; 2]);
        let bar = Bar::dowel(pressed, [fork[0], cover], SHORT * spec.width);
        let pivot = bar.turned("pin-fork", "Pin of the fork", stock, "");
        let mut pivot = pivot.bought_as("of the fork, pressed into the front cover");
        pivot.part.notes = vec!["Pressed into the front cover, flush with its outside.".into()];
        let at = pusher.pivot();
        pivot.pieces = self.on_chains("arm", [at.x, at.y, bar.bottom()]);
        // From the roller, which is behind the fork, through the fork.
        let room = [fork[0].min(cam[0]), fork[1].max(cam[1])];
        let [pressed, _] = pusher.roller_fit().fits([""; 2]);
        let bar = Bar::dowel(pressed, room, f64::INFINITY);
        let roller = bar.turned("pin-roller", "Pin of the roller", stock, "");
        let mut roller = roller.bought_as("of the roller, pressed into the fork");
        roller.pieces = self.on_chains("fork", [spec.arm_length, 0.0, bar.bottom()]);
        let thin = 0.5 * spec.slot_width;
        let [under, over] = wide("push-rod");
        let rod = TurnedPart {
            name: "pin-rod".into(),
            title: "Pin of the push rod".into(),
            steps: vec![
                TurnedStep::plain(thin, over - under, PRESSED[1]),
                TurnedStep::plain(spec.slot_width, under - fork[0], SLIDING[1]),
            ],
            keyway: None,
            held: Vec::new(),
            chamfer: 0.0,
            material: stock.material.into(),
            density: stock.density,
            heat_treatment: stock.heat_treatment.into(),
            notes: vec![
                "Thin end pressed into the rod. The wide end runs in the fork's slot.".into(),
            ],
        };
        let at = [
            0.5 * pusher.stroke(),
            -self.design().arm.pusher_offset,
            over,
        ];
        let mut pieces = self.on_chains("push_rod", at);
        for piece in &mut pieces {
            // The fork is behind the rod: the pin points to the rear.
            piece.turn = [PI, 0.0, 0.0];
        }
        let rod = TurnedPieces {
            pieces,
            ..TurnedPieces::new(rod, Fit::new("", thin, PRESSED))
        };
        let all = [pivot, roller, rod].into_iter();
        all.filter(|pin| pin.fit.size > 0.0).collect()
    }
}

/// Extent of a part of the arm along the planet's axis, mm.
fn span(arm: &ArmBody, name: &str) -> Option<[f64; 2]> {
    let part = arm.parts().iter().find(|part| part.name == name)?;
    Some(part.span)
}
