use std::f64::consts::PI;

use centrode_geometry::{Outline, Point, Solid, SolidError, Vector};
use nalgebra::Isometry2;

use super::{Feeder, FeederError};
use crate::PinHole;
use centrode_gear::design::BodySpec;

/// A part of the six-bar, cut from plate.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum FeederPart {
    /// One of two plates, in front of the links and behind them, that hold the shafts A, D and F, and G of the intermittent gear.
    Frame,
    /// The crank AB.
    Crank,
    /// The coupler BC.
    Coupler,
    /// The rocker CD.
    Rocker,
    /// The end effector on the pivot F, with a slot for the slider.
    Effector,
    /// The slider on the pin C.
    Slider,
}

impl FeederPart {
    /// All parts.
    pub const ALL: [Self; 6] = [
        Self::Frame,
        Self::Crank,
        Self::Coupler,
        Self::Rocker,
        Self::Effector,
        Self::Slider,
    ];

    /// Name of the part's files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::Crank => "crank",
            Self::Coupler => "coupler",
            Self::Rocker => "rocker",
            Self::Effector => "effector",
            Self::Slider => "slider",
        }
    }

    /// Number of copies of the part in one six-bar.
    #[must_use]
    pub fn quantity(self) -> u32 {
        match self {
            Self::Frame => 2,
            _ => 1,
        }
    }

    /// Layer of the part's plate along the shafts; the rear frame plate is in layer -1.
    fn layer(self) -> f64 {
        match self {
            Self::Frame => -1.0,
            Self::Crank => 0.0,
            Self::Coupler => 1.0,
            Self::Rocker => 2.0,
            Self::Effector | Self::Slider => 3.0,
        }
    }
}

/// A part as a plate in its own axes: the first joint is the origin, the second one is on the x axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// The part.
    pub part: FeederPart,
    /// Contour.
    pub outline: Outline,
    /// Holes for the screws that hold the frame's plates together.
    pub screws: Vec<Outline>,
    /// Slot for the slider.
    pub slot: Option<Outline>,
    /// Joints by their letters, A to G; the tip has no hole.
    pub joints: Vec<PinHole>,
    /// Height of the lower face along the shafts, mm.
    pub bottom: f64,
    /// Thickness, mm.
    pub thickness: f64,
}

impl Plate {
    /// Joints with a hole.
    pub fn holes(&self) -> impl Iterator<Item = &PinHole> {
        self.joints.iter().filter(|joint| joint.hub.bore > 0.0)
    }

    /// Contours of all cut-outs: holes, slot, holes of screws.
    #[must_use]
    pub fn cut_outs(&self) -> Vec<Outline> {
        let others = self.slot.iter().chain(&self.screws).cloned();
        self.holes().map(PinHole::outline).chain(others).collect()
    }

    /// The plate moved in its plane, with its lower face at a height.
    ///
    /// # Errors
    /// [`SolidError`] if a number is not finite.
    pub fn solid_at(&self, motion: &Isometry2<f64>, bottom: f64) -> Result<Solid, SolidError> {
        let moved = |outline: &Outline| outline.transformed(motion);
        let holes = self.cut_outs().iter().map(moved).collect();
        Solid::new(moved(&self.outline), holes, bottom, bottom + self.thickness)
    }
}

impl Feeder {
    /// A part as a plate. Crank and driven gear are keyed to one shaft: with both keyways on one line the crank is at its rest
    /// position.
    ///
    /// # Errors
    /// [`FeederError::SlotMeetsPivot`] for an effector whose slot meets the hole of its pivot;
    /// [`FeederError::NoPlate`] if the joints give no contour.
    pub fn plate(&self, part: FeederPart) -> Result<Plate, FeederError> {
        let (spec, gears) = (&self.design().plates, &self.design().gears);
        let [crank, coupler, rocker, frame] = self.six_bar().four_bar().lengths();
        let joint = |name: &str, x: f64, y: f64, hub: &BodySpec| PinHole {
            name: name.into(),
            at: Point::new(x, y),
            hub: BodySpec {
                width: spec.thickness,
                ..hub.clone()
            },
        };
        let round = |bore, class: &str| BodySpec {
            bore,
            bore_fit: class.into(),
            ..BodySpec::default()
        };
        let pin = &round(spec.pin_diameter, &spec.hole_fit);
        let bearing = &round(gears.bore, &spec.bearing_fit);
        let pivot = self.six_bar().pivot();
        let joints = match part {
            FeederPart::Frame => vec![
                joint("A", 0.0, 0.0, bearing),
                joint("D", frame, 0.0, pin),
                joint("F", pivot.x, pivot.y, pin),
                joint("G", -gears.center_distance(), 0.0, bearing),
            ],
            FeederPart::Crank => {
                // At the rest position the x axis of the driven gear points away from the axis of the intermittent gear.
                let keyed = BodySpec {
                    keyway_angle: -self.start(),
                    bore_fit: Self::CRANK_FIT[0].into(),
                    shaft_fit: Self::CRANK_FIT[1].into(),
                    ..gears.body()
                };
                vec![joint("A", 0.0, 0.0, &keyed), joint("B", crank, 0.0, pin)]
            }
            FeederPart::Coupler => vec![joint("B", 0.0, 0.0, pin), joint("C", coupler, 0.0, pin)],
            FeederPart::Rocker => vec![joint("D", 0.0, 0.0, pin), joint("C", rocker, 0.0, pin)],
            FeederPart::Effector => vec![
                joint("F", 0.0, 0.0, pin),
                joint("E", self.six_bar().effector_length(), 0.0, &round(0.0, "")),
            ],
            FeederPart::Slider => vec![joint("C", 0.0, 0.0, pin)],
        };
        let slot = match part {
            FeederPart::Effector => Some(self.slot()?),
            _ => None,
        };
        let half = 0.5 * spec.width;
        let mut circles: Vec<(Point, f64)> = joints.iter().map(|j| (j.at, half)).collect();
        match (part, slot) {
            (FeederPart::Slider, _) => {
                let radius = 0.5 * spec.slot_width;
                let off = Vector::new(0.5 * spec.slider_length - radius, 0.0);
                circles = vec![
                    (Point::origin() - off, radius),
                    (Point::origin() + off, radius),
                ];
            }
            // If the slot ends beyond the tip, the plate reaches around the end of the slot.
            (_, Some([_, end])) => circles.push((Point::new(end, 0.0), half)),
            _ => {}
        }
        let no_plate = || FeederError::NoPlate(part.name());
        let contour = |[start, end]: [f64; 2]| {
            let radius = 0.5 * spec.slot_width;
            let ends = [start + radius, end - radius].map(|x| (Point::new(x, 0.0), radius));
            Outline::hull(&ends).ok_or_else(no_plate)
        };
        let plate = Plate {
            part,
            outline: Outline::hull(&circles).ok_or_else(no_plate)?,
            screws: Vec::new(),
            slot: slot.map(contour).transpose()?,
            joints,
            bottom: part.layer() * (spec.thickness + spec.gap),
            thickness: spec.thickness,
        };
        for (index, hole) in plate.holes().enumerate() {
            for other in plate.holes().take(index) {
                let distance = (hole.at - other.at).norm();
                let reach = hole.hub.bore_reach() + other.hub.bore_reach();
                if distance <= reach {
                    return Err(FeederError::HolesMeet {
                        part: part.name(),
                        joints: [other, hole].map(|hole| hole.name.clone()),
                        distance,
                        reach,
                    });
                }
            }
        }
        Ok(plate)
    }

    /// Ends of the effector's slot, as distances from its pivot, mm.
    fn slot(&self) -> Result<[f64; 2], FeederError> {
        let spec = &self.design().plates;
        let more = 0.5 * spec.slider_length + spec.slot_clearance;
        let start = self.six_bar().minimum_slider_distance() - more;
        let end = self.six_bar().maximum_slider_distance() + more;
        let radius = 0.5 * spec.pin_diameter;
        if start <= radius {
            return Err(FeederError::SlotMeetsPivot { start, radius });
        }
        Ok([start, end])
    }

    /// Pose of a part's own axes in the frame at a crank angle.
    #[must_use]
    pub fn place(&self, part: FeederPart, crank: f64) -> Isometry2<f64> {
        let bar = self.six_bar().four_bar();
        let [b, c, _] = self.six_bar().joints(crank);
        let d = Point::new(bar.lengths()[3], 0.0);
        let f = self.six_bar().pivot();
        let (origin, towards) = match part {
            FeederPart::Frame => return Isometry2::identity(),
            FeederPart::Crank => (Point::origin(), b),
            FeederPart::Coupler => (b, c),
            FeederPart::Rocker => (d, c),
            FeederPart::Effector => (f, c),
            FeederPart::Slider => (c, c + (c - f)),
        };
        let way = towards - origin;
        Isometry2::new(origin.coords, way.y.atan2(way.x))
    }

    /// Clearance between the rocker's shaft D and the effector's plate, which passes it, at an input, mm; negative if they
    /// overlap.
    #[must_use]
    pub fn shaft_clearance(&self, input: f64) -> f64 {
        let spec = &self.design().plates;
        let crank = self.crank(input).position;
        let place = self.place(FeederPart::Effector, crank);
        let d = Point::new(self.six_bar().four_bar().lengths()[3], 0.0);
        let d = place.inverse_transform_point(&d);
        let reach = self.six_bar().effector_length();
        let nearest = Point::new(d.x.clamp(0.0, reach), 0.0);
        (d - nearest).norm() - 0.5 * (spec.width + spec.pin_diameter)
    }

    /// The path of a joint or of the tip over one turn of the crank: B, C or E, by its index in
    /// [`SixBar::joints`](centrode_kinematics::linkage::SixBar::joints).
    #[must_use]
    pub fn path(&self, joint: usize, count: u32) -> Vec<Point> {
        (0..=count)
            .map(|i| {
                let crank = self.start() + 2.0 * PI * f64::from(i) / f64::from(count);
                self.six_bar().joints(crank)[joint.min(2)]
            })
            .collect()
    }
}
