use centrode_geometry::{Outline, Point};
use centrode_mechanism::arm::{ArmBody, ArmPart};
use centrode_mechanism::gear::{GearPair, Member};
use centrode_mechanism::three_arm::{GearboxBody, Pusher, ThreeArm};

use super::Part;
use super::plate::Plate;
use crate::ExportError;
use crate::drawing::Anchor;
use crate::sheet::Table;

/// Material of carrier and housings, with its density in kg/m^3.
const LIGHT: (&str, f64) = ("aluminium alloy", 2700.0);
/// Material of what carries load, with its density in kg/m^3.
const STEEL: (&str, f64) = ("steel", 7850.0);

/// A mechanism with every part resolved.
#[derive(Clone, Debug)]
pub(super) struct Machine<'a> {
    pub(super) mechanism: &'a ThreeArm,
    /// Sun with intermediate gear, planet with intermediate gear.
    pub(super) pairs: [GearPair; 2],
    pub(super) pusher: Pusher,
    pub(super) arm: ArmBody,
    pub(super) gearbox: GearboxBody,
    /// Contour and holes of the fork.
    fork: (Outline, Vec<Outline>),
}

impl<'a> Machine<'a> {
    pub(super) fn new(mechanism: &'a ThreeArm) -> Result<Self, ExportError> {
        let pusher = mechanism.pusher()?;
        let gearbox = mechanism.gearbox().ok_or_else(no_gearbox)?;
        let fork = pusher.fork_outline().ok_or_else(no_fork)?;
        Ok(Self {
            mechanism,
            pairs: mechanism.pairs()?,
            arm: mechanism.arm_body()?,
            pusher,
            gearbox,
            fork,
        })
    }

    /// The pair and the member of it that a gear is.
    pub(super) fn gear(&self, part: Part) -> Option<(&GearPair, Member)> {
        match part {
            Part::Sun => Some((&self.pairs[0], Member::Driver)),
            Part::Intermediate => Some((&self.pairs[0], Member::Driven)),
            Part::Planet => Some((&self.pairs[1], Member::Driver)),
            _ => None,
        }
    }

    /// Contour, holes and thickness of a part of the arm, by its name there.
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
        Some(
            self.plate(Part::PushRod, outline, vec![hole], rod.span, STEEL)
                .noted("Drawn in the arm's frame, thrown out.")
                .noted("Hole for the pin that runs in the fork's slot."),
        )
    }

    fn bore_in_words(&self) -> String {
        let bore = self.mechanism.arm_sizes().rod_bore();
        format!(
            "Square bore {bore:.2} through the front for the push rod, on the pusher's axis and in the middle of the thickness."
        )
    }

    fn plate(
        &self,
        part: Part,
        outline: Outline,
        holes: Vec<Outline>,
        [bottom, top]: [f64; 2],
        (material, density): (&str, f64),
    ) -> Plate {
        Plate {
            part,
            quantity: part.quantity(self.mechanism.arms()),
            outline,
            holes,
            opening: None,
            thickness: top - bottom,
            material: material.into(),
            density,
            notes: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// A part that is a plate, in its own frame.
    pub(super) fn plate_of(&self, part: Part) -> Option<Plate> {
        let light = |name: &str| {
            let found = self.of_arm(name)?;
            let (outline, holes) = (found.outline.clone(), found.holes.clone());
            let plate = self.plate(part, outline, holes, found.span, LIGHT);
            Some(Plate {
                opening: found.opening.clone(),
                ..plate
            })
        };
        let in_arm = "Drawn in the arm's frame: the planet's axis is the origin,";
        let along = "x points along the pusher's axis, the way the clamp does.";
        match part {
            Part::Carrier => {
                let body = &self.gearbox;
                let (outline, holes) = (body.outline.clone(), body.holes.clone());
                let plate = self.plate(part, outline, holes, body.spans[0], LIGHT);
                Some(plate.noted("x points from the sun's axis to the first intermediate gear's."))
            }
            Part::Fork => {
                let (outline, holes) = self.fork.clone();
                let plate = self.plate(part, outline, holes, self.pusher.fork_span(), STEEL);
                Some(plate.noted("x points from the pivot's hole to the roller's."))
            }
            Part::Roller => {
                let spec = self.pusher.fork_spec();
                let circle = |radius| Outline::circle(Point::origin(), radius);
                let holes = vec![circle(0.5 * spec.roller_bore)];
                let span = self.pusher.cam_span();
                Some(self.plate(part, circle(spec.roller_radius), holes, span, STEEL))
            }
            Part::Housing => Some(
                light("housing")?
                    .noted(in_arm)
                    .noted(along)
                    .noted(&self.bore_in_words()),
            ),
            Part::CoverRear => Some(light("cover-rear")?.noted(in_arm).noted(along)),
            Part::CoverFront => Some(light("cover-front")?.noted(in_arm).noted(along)),
            Part::Clamp => {
                let found = self.of_arm("flake-left")?;
                let steel = ("spring steel", STEEL.1);
                let plate = self.plate(part, found.outline.clone(), Vec::new(), found.span, steel);
                Some(plate.noted(in_arm).noted(along))
            }
            Part::PushRod => self.push_rod(),
            Part::Cam => Some(self.cam()),
            Part::Sun | Part::Intermediate | Part::Planet | Part::Assembly => None,
        }
    }

    fn cam(&self) -> Plate {
        let cam = self.pusher.cam();
        let body = cam.body();
        let disc = cam.disc();
        let outline = cam.profile().outline().clone();
        let holes = cam.bore().into_iter().collect();
        let material = (body.material.as_str(), body.density);
        let mut plate = self.plate(Part::Cam, outline, holes, self.pusher.cam_span(), material);
        let spec = self.pusher.fork_spec();
        plate.notes = vec![
            "Exact profile: cam.step, points cam.csv.".into(),
            "x points to the fork's pivot at the carrier's start.".into(),
            format!(
                "Base radius {:.4}, roller Ø{:.3} on an arm of {:.3},",
                disc.base_radius(),
                2.0 * spec.roller_radius,
                spec.arm_length
            ),
            format!("pivot {:.3} from the cam's axis.", spec.pivot_distance),
        ];
        plate.tables = vec![profile(&self.pusher)];
        plate
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

/// The cam's profile by cam angle.
fn profile(pusher: &Pusher) -> Table {
    let disc = pusher.cam().disc();
    let rows = (0..72).map(|i| {
        let degrees = 5.0 * f64::from(i);
        let contact = disc.contact(degrees.to_radians());
        let at = contact.point;
        let polar = at.y.atan2(at.x).to_degrees().rem_euclid(360.0);
        vec![
            format!("{degrees:.0}"),
            format!("{polar:.3}"),
            format!("{:.4}", at.coords.norm()),
            format!("{:.4}", contact.motion.position.to_degrees()),
            format!("{:.2}", contact.pressure_angle.to_degrees()),
        ]
    });
    Table {
        title: "Profile".into(),
        headings: ["cam °", "polar °", "R", "fork °", "pressure °"]
            .map(String::from)
            .to_vec(),
        columns: vec![Anchor::Right; 5],
        rows: rows.collect(),
        notes: vec!["all points: cam.csv".into()],
    }
}
