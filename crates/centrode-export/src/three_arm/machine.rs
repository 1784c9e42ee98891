use super::ThreeArmPart;
use crate::gear_pair::half_backlash;
use crate::plate::{Exactness, Hole, Plate, hold_apart};
use crate::{ExportError, cam, fit};
use centrode_formats::sheet::number;
use centrode_gear::{GearPair, Member};
use centrode_geometry::{Bounds, Outline, Point};
use centrode_kinematics::machine::{Fastening, Fit, Stock, TurnedPieces, with_bosses};
use centrode_machines::arm::{ArmBody, ArmPart};
use centrode_machines::three_arm::making::{self, LIGHT, PRESSED, RINGS, SLIDING, SPRING, STEEL};
use centrode_machines::three_arm::{GearboxBody, Pusher, ThreeArm};

/// Tolerance class, ISO 286, of the holes in which the shafts of the gears turn; the class of the shafts fits the gears.
const BEARING: &str = "F7";
/// Tolerance classes of openings that only give clearance, and of the parts in them.
pub(super) const PASSING: [&str; 2] = ["H11", "h11"];

/// A mechanism with every part resolved.
#[derive(Clone, Debug)]
pub(super) struct Parts<'a> {
    pub(super) mechanism: &'a ThreeArm,
    /// Sun with intermediate gear, planet with intermediate gear.
    pub(super) pairs: [GearPair; 2],
    pub(super) pusher: Pusher,
    pub(super) arm: ArmBody,
    pub(super) gearbox: GearboxBody,
    /// Contour and holes of the fork.
    fork: (Outline, Vec<Outline>),
    /// Screws of the carrier's plates, and of the covers of an arm.
    pub(super) screws: [Option<Fastening>; 2],
}

impl<'a> Parts<'a> {
    pub(super) fn new(mechanism: &'a ThreeArm) -> Result<Self, ExportError> {
        let pusher = mechanism.pusher()?;
        let gearbox = mechanism.gearbox().ok_or_else(no_gearbox)?;
        let fork = pusher.fork_outline().ok_or_else(no_fork)?;
        let arm = mechanism.arm_body()?;
        let screws = [
            mechanism.carrier_screws(&arm),
            mechanism.cover_screws(&pusher, &arm),
        ];
        Ok(Self {
            mechanism,
            pairs: mechanism.pairs()?,
            screws: screws.map(|screws| screws.and_then(Result::ok)),
            arm,
            pusher,
            gearbox,
            fork,
        })
    }

    /// The pair of a gear, and its member in the pair.
    pub(super) fn gear(&self, part: ThreeArmPart) -> Option<(&GearPair, Member)> {
        match part {
            ThreeArmPart::Sun => Some((&self.pairs[0], Member::Driver)),
            ThreeArmPart::Intermediate => Some((&self.pairs[0], Member::Driven)),
            ThreeArmPart::Planet => Some((&self.pairs[1], Member::Driver)),
            _ => None,
        }
    }

    /// Shafts and pins.
    pub(super) fn turned(&self) -> Vec<TurnedPieces> {
        self.mechanism.turned(&self.pusher, &self.arm)
    }

    /// Contour, holes and thickness of a part of the arm, by its name in the arm.
    pub(super) fn of_arm(&self, name: &str) -> Option<&ArmPart> {
        self.arm.parts().iter().find(|part| part.name == name)
    }

    /// Push rod and pusher as one part.
    pub(super) fn push_rod(&self) -> Option<Plate> {
        let [rod, pusher] = [self.of_arm("push-rod")?, self.of_arm("pusher")?];
        let [low, high] = [rod.outline.bounds(), pusher.outline.bounds()];
        let (start, neck, face) = (low.min.x, high.min.x, high.max.x);
        let p = Point::new;
        let outline = Outline::polygon(&[
            p(start, low.min.y),
            p(neck, low.min.y),
            p(neck, high.min.y),
            p(face, high.min.y),
            p(face, high.max.y),
            p(neck, high.max.y),
            p(neck, low.max.y),
            p(start, low.max.y),
        ]);
        let pin = p(
            0.5 * self.pusher.stroke(),
            -self.mechanism.design().arm.pusher_offset,
        );
        let hole = Outline::circle(pin, 0.25 * self.pusher.fork_spec().slot_width);
        let sizes = self.mechanism.arm_sizes();
        let bar = fit::keyway(sizes.rod_bore(), SLIDING[1]);
        let stock = STEEL.treated(&sizes.push_rod.heat_treatment);
        Some(
            self.plate(ThreeArmPart::PushRod, outline, vec![hole], rod.span, stock)
                .noted("x points from the hole to the pusher.")
                .noted("Hole for the pin that runs in the fork's slot.")
                .noted(&format!("Square bar {bar}, to slide in the housing.")),
        )
    }

    /// A plate in the frame of its files: the origin of the push rod is in its hole, that of the clamp in the middle of its root.
    pub(super) fn made(&self, part: ThreeArmPart) -> Option<Plate> {
        let plate = self.plate_of(part)?;
        let Bounds { min, max } = plate.outline.bounds();
        let middle = 0.5 * (min.y + max.y);
        Some(match part {
            ThreeArmPart::PushRod => plate.about(Point::new(0.5 * self.pusher.stroke(), middle)),
            ThreeArmPart::Clamp => {
                let root = 0.5 * self.mechanism.arm_sizes().clamp.root_height;
                plate.about(Point::new(min.x + root, middle))
            }
            _ => plate,
        })
    }

    fn bore_in_words(&self) -> String {
        let bore = fit::keyway(self.mechanism.arm_sizes().rod_bore(), SLIDING[0]);
        let at = number(-self.mechanism.design().arm.pusher_offset, 4);
        format!(
            "Square bore {bore} for the push rod, its middle at y = {at} and in the middle of the thickness."
        )
    }

    fn plate(
        &self,
        part: ThreeArmPart,
        outline: Outline,
        holes: Vec<Outline>,
        [bottom, top]: [f64; 2],
        stock: Stock<'_>,
    ) -> Plate {
        Plate {
            quantity: part.quantity(self.mechanism.arms()) as usize,
            holes: holes.into_iter().map(Hole::from).collect(),
            ..Plate::new(part.name(), part.title(), outline, top - bottom, stock)
        }
    }

    /// Fits of parts that turn, slide or are pressed in.
    pub(super) fn fits(&self) -> Vec<Fit> {
        let spec = self.pusher.fork_spec();
        let body = self.pairs[0].driver().body();
        let rod = self.mechanism.arm_sizes().rod_bore();
        let seats = [
            (ThreeArmPart::Sun, "shaft of the carrier in the sun"),
            (ThreeArmPart::Intermediate, "shafts of intermediate gears"),
            (ThreeArmPart::Planet, "shafts of planet gears"),
        ];
        let seats = seats.into_iter().filter_map(|(part, name)| {
            let (pair, member) = self.gear(part)?;
            Some(pair.gear(member).body().seat(name))
        });
        let in_carrier = match self.mechanism.bearing(body.bore) {
            Some(bearing) => {
                let [plate, shaft] = making::BEARING;
                vec![
                    Fit::new("bearings in the carrier", bearing.outer, [plate, RINGS]),
                    Fit::new("bearings on the shafts", bearing.bore, [RINGS, shaft]),
                ]
            }
            None => vec![Fit::new(
                "shafts in the carrier",
                body.bore,
                [BEARING, &body.shaft_fit],
            )],
        };
        let [pivot, swinging] = self
            .pusher
            .pivot_fit()
            .fits(["fork's pin in the front cover", "fork on its pin"]);
        let [pressed, rolling] = self
            .pusher
            .roller_fit()
            .fits(["roller's pin in the fork", "roller on its pin"]);
        let all = [
            pivot,
            swinging,
            pressed,
            rolling,
            Fit::of_width("slot of the fork", spec.slot_width, SLIDING),
            Fit::new("pin in the push rod", 0.5 * spec.slot_width, PRESSED),
            Fit::of_width("push rod in the housing", rod, SLIDING),
        ];
        let all = in_carrier.into_iter().chain(all).chain(seats);
        all.filter(|fit| fit.size > 0.0).collect()
    }

    /// A plate in its own frame; its holes have their tolerance classes.
    pub(super) fn plate_of(&self, part: ThreeArmPart) -> Option<Plate> {
        let mut plate = self.bare_plate(part)?;
        let (pivot, roller) = (self.pusher.pivot_fit(), self.pusher.roller_fit());
        let [carrier, covers] = self.screws.each_ref().map(Option::as_ref);
        let classes: &[&str] = match part {
            ThreeArmPart::Carrier => &[],
            ThreeArmPart::Fork => &[pivot.running, roller.pressed, SLIDING[0]],
            ThreeArmPart::Roller => &[roller.running],
            ThreeArmPart::PushRod => &[PRESSED[0]],
            ThreeArmPart::CoverRear => &[PASSING[0]],
            ThreeArmPart::CoverFront if self.mechanism.arm_sizes().housing.bore == 0.0 => {
                &[pivot.pressed]
            }
            ThreeArmPart::CoverFront => &[PASSING[0], pivot.pressed],
            _ => &[],
        };
        for (hole, class) in plate.holes.iter_mut().zip(classes) {
            hole.fit = (*class).into();
        }
        if part == ThreeArmPart::Carrier {
            plate = self.carrier(plate);
        }
        let through = match part {
            ThreeArmPart::Carrier => carrier,
            ThreeArmPart::CoverRear | ThreeArmPart::CoverFront => covers,
            _ => None,
        };
        plate
            .holes
            .extend(through.into_iter().flat_map(Hole::clearance));
        if let (ThreeArmPart::Housing, Some(covers)) = (part, covers) {
            plate.holes.extend(Hole::threads(covers));
        }
        Some(plate)
    }

    /// The carrier's plate with the classes of its holes, which depend on whether the hole holds a bearing.
    fn carrier(&self, mut plate: Plate) -> Plate {
        for hole in &mut plate.holes {
            let wide = hole.outline.bounds();
            let wide = wide.max.x - wide.min.x;
            let bodies = [
                ThreeArmPart::Sun,
                ThreeArmPart::Intermediate,
                ThreeArmPart::Planet,
            ]
            .into_iter();
            let bores = bodies.filter_map(|part| {
                let (pair, member) = self.gear(part)?;
                Some(pair.gear(member).body().bore)
            });
            let mut bearings = bores.filter_map(|bore| self.mechanism.bearing(bore));
            let class = match bearings.any(|bearing| (bearing.outer - wide).abs() < 1e-6) {
                true => making::BEARING[0],
                false => BEARING,
            };
            hole.fit = class.into();
        }
        if let Some((pair, _)) = self.gear(ThreeArmPart::Sun)
            && let Some(off) = half_backlash(pair, pair.backlash())
        {
            hold_apart(&mut plate.holes, pair.center_distance(), off);
        }
        plate
    }

    fn bare_plate(&self, part: ThreeArmPart) -> Option<Plate> {
        let light = |name: &str| {
            let sizes = self.mechanism.arm_sizes();
            let stock = LIGHT.treated(&sizes.housing.heat_treatment);
            let found = self.of_arm(name)?;
            let (outline, holes) = (found.outline.clone(), found.holes.clone());
            let plate = self.plate(part, outline, holes, found.span, stock);
            Some(Plate {
                classes: [String::new(), SLIDING[0].into()],
                opening: found.opening.clone(),
                ..plate
            })
        };
        let in_arm = "Drawn in the arm's frame: the planet's axis is the origin,";
        let along = "x points along the pusher's axis, the way the clamp does.";
        match part {
            ThreeArmPart::Carrier => {
                let body = &self.gearbox;
                let (outline, holes) = (body.outline.clone(), body.holes.clone());
                let stock = LIGHT.treated(&self.mechanism.design().gearbox.heat_treatment);
                let plate = self.plate(part, outline, holes, body.spans[0], stock);
                Some(plate.noted("x points from the sun's axis to the first intermediate gear's."))
            }
            ThreeArmPart::Fork => {
                let (outline, holes) = self.fork.clone();
                let stock = STEEL.treated(&self.pusher.fork_spec().heat_treatment);
                let plate = self.plate(part, outline, holes, self.pusher.fork_span(), stock);
                Some(plate.noted("x points from the pivot's hole to the roller's."))
            }
            ThreeArmPart::Roller => {
                let spec = self.pusher.fork_spec();
                let circle = |radius| Outline::circle(Point::origin(), radius);
                let holes = vec![circle(0.5 * spec.roller_bore)];
                let span = self.pusher.cam_span();
                let stock = STEEL.treated(&spec.heat_treatment);
                let mut roller = self.plate(part, circle(spec.roller_radius), holes, span, stock);
                roller.classes[0] = making::RIM.into();
                roller.exactness = Some(Exactness::Rim);
                for hole in &mut roller.holes {
                    hole.is_seat = true;
                }
                Some(roller)
            }
            ThreeArmPart::Spacer => {
                let screws = self.screws[0].as_ref()?;
                let quantity = part.quantity(self.mechanism.arms()) as usize;
                Some(Plate::spacer(screws, part.title(), quantity, STEEL))
            }
            ThreeArmPart::Housing => Some(
                self.housing(light("housing")?)
                    .noted(in_arm)
                    .noted(along)
                    .noted(&self.bore_in_words()),
            ),
            ThreeArmPart::CoverRear => Some(light("cover-rear")?.noted(in_arm).noted(along)),
            ThreeArmPart::CoverFront => {
                let mut cover = light("cover-front")?;
                let pin = self.pusher.pivot_fit().size;
                let seat = Outline::circle(self.pusher.pivot(), 0.5 * pin);
                cover.holes.extend((pin > 0.0).then(|| Hole::from(seat)));
                Some(cover.noted(in_arm).noted(along))
            }
            ThreeArmPart::Clamp => {
                let found = self.of_arm("flake-left")?;
                let sizes = self.mechanism.arm_sizes();
                let steel = SPRING.treated(&sizes.clamp.heat_treatment);
                let plate = self.plate(part, found.outline.clone(), Vec::new(), found.span, steel);
                Some(plate.noted("x points from the root in the housing to the tip."))
            }
            ThreeArmPart::PushRod => self.push_rod(),
            ThreeArmPart::Cam => Some(self.cam()),
            ThreeArmPart::Sun
            | ThreeArmPart::Intermediate
            | ThreeArmPart::Planet
            | ThreeArmPart::Assembly => None,
        }
    }

    /// The housing with bosses on its wall for the screws of the covers.
    fn housing(&self, plate: Plate) -> Plate {
        let Some(screws) = &self.screws[1] else {
            return plate;
        };
        let with_bosses = |mut hole: Hole| {
            let radius = screws.screw.diameter;
            if let Some(bossed) = with_bosses(&hole.outline, &screws.at, radius) {
                hole.outline = bossed;
            }
            hole
        };
        Plate {
            holes: plate.holes.into_iter().map(with_bosses).collect(),
            ..plate
        }
    }

    fn cam(&self) -> Plate {
        let part = ThreeArmPart::Cam;
        let quantity = part.quantity(self.mechanism.arms()) as usize;
        let spec = self.pusher.fork_spec();
        let cam = self.pusher.cam();
        let mut plate = cam::plate(cam, part.name(), part.title(), quantity)
            .noted("x points to the fork's pivot at the carrier's start:")
            .noted("timing by the mark on it.");
        // Half way from the bore to the minimum radius.
        let mark = 0.5 * (0.5 * cam.body().bore + cam.radii().0);
        plate.marks.push(Point::new(mark, 0.0));
        plate.noted(&format!(
            "The roller's arm is {:.3} mm long, its pivot {:.3} mm from the cam's axis.",
            spec.arm_length, spec.pivot_distance
        ))
    }
}

/// The carrier has no contour.
pub(super) fn no_gearbox() -> ExportError {
    ExportError::missing_at("gearbox", "the axes of the gears enclose nothing")
}

/// The fork has no contour.
pub(super) fn no_fork() -> ExportError {
    ExportError::missing_at("fork", "pivot, roller and slot enclose nothing")
}
