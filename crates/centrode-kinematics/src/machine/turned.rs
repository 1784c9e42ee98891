use centrode_geometry::{MassProperties, SolidError, Turned, TurnedSection, TurnedSlot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Bearing, Circlip, Fit, Key, Spacer};
use crate::machine::Keyway;

/// A shaft or pin: a part turned from round bar about its axis z, its lower end at z = 0, with a keyway where it has one.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TurnedPart {
    /// Name that its files begin with.
    pub name: String,
    /// Title of its drawing.
    pub title: String,
    /// Cylinders one after another, z upwards.
    pub steps: Vec<TurnedStep>,
    /// Keyway of the steps that have one, along x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keyway: Option<Keyway>,
    /// Lengths between ring grooves with deviations of their own, because general tolerances could leave the parts between the
    /// rings less than 0.05 mm of axial clearance.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<HeldLength>,
    /// Chamfer of 45° at both ends, mm; 0 for none.
    pub chamfer: f64,
    /// Material.
    pub material: String,
    /// Density, kg/m^3.
    pub density: f64,
    /// Heat treatment; empty if there is none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
    /// Further notes of its sheet.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A cylinder of a turned part.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TurnedStep {
    /// Diameter, mm.
    pub diameter: f64,
    /// Length, mm.
    pub length: f64,
    /// Tolerance class of its diameter, ISO 286; empty where general tolerances hold.
    pub class: String,
    /// Whether the keyway goes through it.
    pub is_keyed: bool,
    /// Ring whose groove it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ring: Option<Circlip>,
}

/// Length between two grooves of a turned part that holds other parts between their rings.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HeldLength {
    /// Walls of the grooves above the lower end, mm.
    pub span: [f64; 2],
    /// Lower and upper deviation of the length, mm.
    pub deviations: [f64; 2],
}

/// A turned part and its pieces in a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnedPieces {
    /// The part.
    pub part: TurnedPart,
    /// Its fit where it runs or sits.
    pub fit: Fit,
    /// Purpose, in words; may be empty.
    pub role: String,
    /// Designation by which it is bought; `None` if it is made from its sheet.
    pub standard: Option<String>,
    /// Keys on each piece.
    pub keys: Vec<SeatedKey>,
    /// Bearings on each piece, with the height of their lower face above the part's lower end, mm.
    pub bearings: Vec<(Bearing, f64)>,
    /// Rings in the gaps between the parts on each piece, with the height of their lower face above the part's lower end, mm.
    pub spacers: Vec<(Spacer, f64)>,
    /// Positions of its pieces.
    pub pieces: Vec<TurnedPiece>,
    /// Its axis in the figure of the first link, mm, where it is seen there.
    pub axis: Option<[f64; 2]>,
}

/// A key in the keyway of a turned part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeatedKey {
    /// The key.
    pub key: Key,
    /// Its lower end above that of the part, mm.
    pub at: f64,
}

/// Place of a piece of a turned part.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnedPiece {
    /// Name of the link that it belongs to.
    pub link: String,
    /// Its lower end in the link's frame, mm.
    pub at: [f64; 3],
    /// Its turn there as roll, pitch and yaw: about the link's x, then y, then z axis, rad.
    pub turn: [f64; 3],
    /// Whether the given mass of the link includes the piece: then the piece adds none.
    pub is_counted: bool,
}

impl HeldLength {
    /// Middle of its deviations, mm.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * (self.deviations[0] + self.deviations[1])
    }
}

impl TurnedStep {
    /// A plain cylinder of a diameter and length (mm), in a tolerance class.
    #[must_use]
    pub fn plain(diameter: f64, length: f64, class: &str) -> Self {
        Self {
            diameter,
            length,
            class: class.into(),
            ..Self::default()
        }
    }
}

impl TurnedPart {
    /// Length over all, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.steps.iter().map(|step| step.length).sum()
    }

    /// Maximum diameter, mm.
    #[must_use]
    pub fn diameter(&self) -> f64 {
        let diameters = self.steps.iter().map(|step| step.diameter);
        diameters.fold(0.0, f64::max)
    }

    /// Stretches of the keyway above the lower end, mm, and whether their lower and upper ends are half round, as an end mill
    /// leaves them: where the part continues with the same diameter but without the keyway.
    #[must_use]
    pub fn keyways(&self) -> Vec<([f64; 2], [bool; 2])> {
        let half = 0.5 * self.keyway.map_or(0.0, |key| key.width);
        // Lower end, upper end, and the steps between.
        let mut found: Vec<([f64; 2], [usize; 2])> = Vec::new();
        let mut at = 0.0;
        for (index, step) in self.steps.iter().enumerate() {
            let from = at;
            at += step.length;
            if !step.is_keyed {
                continue;
            }
            match found.last_mut().filter(|(_, steps)| steps[1] + 1 == index) {
                Some((span, steps)) => (span[1], steps[1]) = (at, index),
                None => found.push(([from, at], [index; 2])),
            }
        }
        let ends_in = |own: usize, other: Option<usize>| {
            let other = other.and_then(|other| self.steps.get(other));
            other.is_some_and(|step| step.diameter == self.steps[own].diameter)
        };
        let rounded = |(span, [first, last]): ([f64; 2], [usize; 2])| {
            let ends = [
                ends_in(first, first.checked_sub(1)),
                ends_in(last, Some(last + 1)),
            ];
            let both = if first == last && ends == [true; 2] {
                2.0
            } else {
                1.0
            };
            let room = |step: usize| self.steps[step].length >= both * half * (1.0 - 1e-9);
            (span, [ends[0] && room(first), ends[1] && room(last)])
        };
        found.into_iter().map(rounded).collect()
    }

    /// Its keyway as a slot of the body.
    fn slot(&self) -> Option<TurnedSlot> {
        self.keyway.map(|key| TurnedSlot {
            width: key.width,
            floor: 0.5 * self.diameter() - key.depth,
            rounded: true,
        })
    }

    /// Distance of the keyway's floor from the axis, mm; zero if it has none.
    pub(super) fn key_foot(&self) -> f64 {
        self.slot().map_or(0.0, |slot| slot.floor)
    }

    /// Exact body, from z = 0.
    ///
    /// # Errors
    /// [`SolidError::Turned`] if a step has no extent, or does not contain its keyway or chamfer.
    pub fn solid(&self) -> Result<Turned, SolidError> {
        let c = self.chamfer;
        let last = self.steps.len().saturating_sub(1);
        let mut sections = Vec::new();
        for (index, step) in self.steps.iter().enumerate() {
            let radius = 0.5 * step.diameter;
            let [first, final_one] = [index == 0, index == last];
            let slotted = step.is_keyed;
            let cone = |radii: [f64; 2]| TurnedSection {
                length: c,
                radii,
                slotted,
            };
            let cut = [first, final_one].into_iter().filter(|end| *end).count();
            let straight = TurnedSection {
                slotted,
                ..TurnedSection::cylinder(step.length - cut as f64 * c, radius)
            };
            sections.extend(first.then(|| cone([radius - c, radius])));
            sections.push(straight);
            sections.extend(final_one.then(|| cone([radius, radius - c])));
        }
        if c == 0.0 {
            sections.retain(|section| section.length > 0.0);
        }
        Turned::new(0.0, sections, self.slot())
    }

    /// Mass of one, kg; `None` if the part is no valid solid.
    #[must_use]
    pub fn mass(&self) -> Option<f64> {
        Some(self.mass_properties()?.mass)
    }

    /// Mass of one with its center and inertia; `None` if the part is no valid solid.
    #[must_use]
    pub fn mass_properties(&self) -> Option<MassProperties> {
        let body = self.solid().ok()?;
        Some(body.moments().mass_properties(self.density))
    }
}

impl TurnedPieces {
    /// A part with its fit, without pieces yet.
    #[must_use]
    pub fn new(part: TurnedPart, fit: Fit) -> Self {
        Self {
            part,
            fit,
            role: String::new(),
            standard: None,
            keys: Vec::new(),
            bearings: Vec::new(),
            spacers: Vec::new(),
            pieces: Vec::new(),
            axis: None,
        }
    }

    /// The parts, with their purpose in words if they are bought by a standard: other parts state it on their sheets.
    #[must_use]
    pub fn bought_as(mut self, role: &str) -> Self {
        if self.standard.is_some() {
            self.role = role.into();
        }
        self
    }
}

impl TurnedPiece {
    /// A piece upright on a link, its lower end at a point, mm.
    #[must_use]
    pub fn upright(link: &str, at: [f64; 3]) -> Self {
        Self {
            link: link.into(),
            at,
            turn: [0.0; 3],
            is_counted: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Bar, Stock};
    use super::*;

    const STEEL: Stock<'_> = Stock::new("steel", 7850.0);
    const HUB: Keyway = Keyway {
        width: 5.0,
        depth: 2.3,
    };

    fn lengths(part: &TurnedPart) -> Vec<(f64, f64, bool)> {
        let step = |step: &TurnedStep| {
            (
                step.diameter,
                (1e6 * step.length).round() / 1e6,
                step.is_keyed,
            )
        };
        part.steps.iter().map(step).collect()
    }

    #[test]
    fn a_pin_is_held_by_rings_where_there_is_room_for_them() {
        let pin = |room: [f64; 2]| {
            let bar = Bar::new(Fit::new("", 10.0, ["", "f7"]), [0.0, 18.0]).held(room);
            bar.turned("pin", "Pin", STEEL, "ISO 2768-mK").part
        };
        // DIN 471 for 10 mm: groove 9.6 mm in diameter and 1.1 mm wide, a land of 0.6 mm beyond.
        let both = pin([2.0, 2.0]);
        let land = (10.0, 0.6, false);
        let groove = (9.6, 1.1, false);
        let plain = (10.0, 18.0, false);
        assert_eq!(lengths(&both), [land, groove, plain, groove, land]);
        assert_eq!(both.chamfer, 0.3);
        assert_eq!(lengths(&pin([1.0, 2.0])), [plain, groove, land]);
        assert_eq!(lengths(&pin([0.0, 0.0])), [plain]);
    }

    #[test]
    fn a_length_between_rings_has_deviations_where_general_tolerances_leave_no_clearance() {
        let held = |parts: &[[f64; 2]], general: &str| {
            let bar = Bar::new(Fit::new("", 16.0, ["", "h6"]), [0.0, 60.0]).ring(0.0, false, 9.0);
            let bar = bar.ring(15.0, true, 2.0).through(parts);
            let shaft = bar.turned("shaft", "Shaft", STEEL, general).part;
            let stated = |held: &HeldLength| {
                let long = held.span[1] - held.span[0];
                ((1e6 * long).round() / 1e6, held.deviations)
            };
            let all: Vec<(f64, [f64; 2])> = shaft.held.iter().map(stated).collect();
            // What lies beyond keeps its length.
            let longer: f64 = all.iter().map(|(long, _)| long - 15.0).sum();
            assert!((shaft.length() - 62.3 - longer).abs() < 1e-9);
            all
        };
        // 15 +- 0.2 in 15, two rings of 1 mm in grooves of 1.1 mm: 0.05 are left of 15.05 + 0.2 - 15.2.
        let even = [-0.05, 0.05];
        assert_eq!(held(&[[0.0, 15.0]], "ISO 2768-mK"), [(15.1, even)]);
        // +- 0.1 of class f: 0.05 are left of 14.95 + 0.2 - 15.1.
        assert_eq!(held(&[[0.0, 15.0]], "ISO 2768-fH"), [(15.0, even)]);
        // Parts of 14 mm in 15 mm always have clearance; parts outside the rings are not held.
        assert_eq!(held(&[[0.5, 14.5]], "ISO 2768-mK"), []);
        assert_eq!(held(&[[20.0, 35.0]], "ISO 2768-mK"), []);
    }

    #[test]
    fn a_keyway_of_a_shaft_goes_through_the_grooves_in_it() {
        let bar = Bar::new(Fit::new("", 16.0, ["", "h6"]), [0.0, 60.0]).ring(0.0, false, 9.0);
        let bar = bar.ring(15.0, true, 2.0).keyed(Some(HUB), [-9.0, 20.0]);
        let shaft = bar.turned("shaft", "Shaft", STEEL, "ISO 2768-mK").part;
        let steps = [
            (16.0, 1.2, true),
            (15.2, 1.1, true),
            (16.0, 15.0, true),
            (15.2, 1.1, true),
            (16.0, 3.9, true),
            (16.0, 40.0, false),
        ];
        assert_eq!(lengths(&shaft), steps);
        // DIN 6885-1: 3 mm deep in a shaft of 12 to 17 mm.
        assert!((shaft.keyway.expect("a keyway").depth - 3.0).abs() < 1e-12);
        // From the lower end on, and half round towards the rest of the shaft.
        let [([from, to], ends)] = shaft.keyways()[..] else {
            panic!("{:?}", shaft.keyways());
        };
        assert_eq!((from, ends), (0.0, [false, true]));
        assert!((to - 22.3).abs() < 1e-9);
        let body = shaft.solid().expect("a body");
        assert!(body.shell().is_closed());
        let round = std::f64::consts::PI * 64.0 * 62.3;
        assert!(body.volume() < round && body.volume() > 0.95 * round);
    }
}
