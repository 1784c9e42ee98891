//! The frame of a machine whose hardware is designed in full: two plates, below and above all moving parts, with posts at their
//! corners.

use centrode_geometry::{Bounds, Outline, Point, Solid, SolidError, Vector};

use crate::PinHole;
use crate::machine::design::FRAME;
use crate::machine::hardware::pins::SPARE;
use crate::machine::hardware::plates::ONE;
use crate::machine::hardware::spacing::Passing;
use crate::machine::{BodyPoint, Hardware, Hold, Machine, MachineError, MachineShaft, ShaftPart};
use centrode_gear::design::BodySpec;
use centrode_kinematics::machine::{Bar, Circlip, Fastening, Fit, JointKind, Stock, TurnedPieces};
use centrode_spec::digits::thousandths;

/// Distance of the posts from the moving parts, mm. Ten times less leaves no room for deviations; ten times more wastes plate.
const ASIDE: f64 = 2.0;
/// Diameter of a post, in diameters of its screws: the wall around the thread is half a diameter thick.
const POST: f64 = 2.0;
/// Minimum length of thread that a screw enters, in its diameters.
const ENTERED: f64 = 1.0;

/// A shaft or pin that only one plate of the frame holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Overhang {
    /// Name.
    pub name: String,
    /// Indices of the bodies that turn about it on the frame.
    pub bodies: Vec<usize>,
    /// Diameter, mm.
    pub diameter: f64,
    /// Length in the frame, mm.
    pub length: f64,
    /// Maximum distance of a part on it from the middle of this length, mm.
    pub arm: f64,
    /// Materials of the frame and of the shaft.
    pub materials: [String; 2],
}

/// Contour of both plates of a frame and the screws into its posts.
#[derive(Clone, Debug)]
pub(in crate::machine) struct FramePlates {
    outline: Outline,
    screws: Fastening,
    /// Lower and upper faces of both plates, mm.
    spans: [[f64; 2]; 2],
    /// The lower plate, as an obstacle for rings near it.
    pub(in crate::machine) lower: Passing,
}

/// A bore of the frame with the shaft in it, if there is one, and the faces of the parts on its axis, mm.
struct FrameAxis<'a> {
    hole: PinHole,
    shaft: Option<&'a MachineShaft>,
    spans: Vec<[f64; 2]>,
    /// Whether the shaft or pin reaches the upper plate.
    reaches_top: bool,
}

impl Machine {
    /// Name of the upper plate of the frame, and of its files.
    pub const FRAME_TOP: &str = "frame-top";
    /// Name of the files of the posts between the plates.
    pub(in crate::machine) const POSTS: &str = "frame-post";

    /// Whether the frame consists of two plates around all moving parts: hardware is `full`, and the design draws no frame.
    pub(in crate::machine) fn has_frame_plates(&self) -> bool {
        self.design.hardware() == Hardware::Full && !self.drawn.contains_key(FRAME)
    }

    /// Lower and upper faces of both plates of the frame, mm. Between them and the parts there is room for the rings of all pins
    /// and shafts.
    pub(super) fn frame_spans(&self) -> [[f64; 2]; 2] {
        let spec = &self.design.plates;
        let hubs = self.gears.iter().map(|gear| gear.gear().body().bore);
        let hubs = hubs.chain(self.cams.iter().map(|cam| cam.part.body().bore));
        let rings = hubs
            .chain([spec.pin_diameter])
            .filter_map(Circlip::of_shaft);
        let room = rings
            .map(|ring| ring.room() + SPARE)
            .fold(spec.gap, f64::max);
        let [low, high] = self.extent_from(1);
        let thickness = self.thickness(0);
        let [low, high] = [low - room, high + room];
        [[low - thickness, low], [high, high + thickness]]
    }

    /// Screws into the posts, without their positions.
    fn post_screws(&self) -> Result<Fastening, MachineError> {
        let thickness = self.thickness(0);
        let [[low, _], [_, high]] = self.frame_spans();
        let of = |diameter| Fastening::new(diameter, [low, high], thickness, ENTERED);
        let refused = |why: String| MachineError::Refused {
            key: "hardware".into(),
            why: format!(
                "{why}: hardware = \"full\" needs a frame of two plates on posts; draw frame.outline, or use \"list\""
            ),
        };
        match Fastening::largest(None, thickness, of) {
            Some(Ok(screws)) => Ok(screws),
            Some(Err(error)) => Err(refused(error.to_string())),
            None => Err(refused(format!(
                "no screw of ISO 4762 suits plates of {} mm",
                thousandths(thickness)
            ))),
        }
    }

    /// Checks that the frame can be screwed together.
    pub(in crate::machine) fn check_frame(&self) -> Result<(), MachineError> {
        match self.has_frame_plates() {
            true => self.post_screws().map(|_| ()),
            false => Ok(()),
        }
    }

    /// Both plates of the frame; `None` if it is drawn or given.
    pub(super) fn frame_plates(&self) -> Option<&FramePlates> {
        let made = || {
            let screws = self.post_screws().ok()?;
            let post = POST * screws.screw.diameter;
            let aside = Vector::repeat(ASIDE + 0.5 * post);
            let Bounds { min, max } = self.swept();
            // Rounded outwards to whole millimetres.
            let min = (min - aside).map(f64::floor);
            let max = (max + aside).map(f64::ceil);
            let at = vec![min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
            let rounded: Vec<(Point, f64)> = at.iter().map(|at| (*at, post)).collect();
            let outline = Outline::hull(&rounded)?;
            let spans = self.frame_spans();
            let lower = Passing::new(0, spans[0], outline.clone())?;
            Some(FramePlates {
                outline,
                screws: Fastening { at, ..screws },
                spans,
                lower,
            })
        };
        let is_made = self.has_frame_plates();
        is_made.then(|| self.frame.get_or_init(made).as_ref())?
    }

    /// Contour of both plates of the frame.
    pub(super) fn frame_outline(&self) -> Option<&Outline> {
        self.frame_plates().map(|frame| &frame.outline)
    }

    /// Screws through both plates of the frame into the posts between them; `None` if it has no such plates.
    #[must_use]
    pub fn frame_screws(&self) -> Option<&Fastening> {
        self.frame_plates().map(|frame| &frame.screws)
    }

    /// Whether a shaft or pin on the frame can reach from a height, mm, to the upper plate without meeting another part.
    fn reaches_top(&self, at: Point, diameter: f64, from: f64) -> bool {
        let tops = self.frame_plates().map(|frame| frame.spans[1][0]);
        let own = BodyPoint { body: 0, at };
        tops.is_some_and(|top| self.is_clear(own, 0.5 * diameter, [from, top]))
    }

    /// The upper plate of the frame as a part on a shaft or pin that reaches it from a height, mm; `None` if the shaft or pin
    /// does not reach it.
    pub(super) fn top_part(&self, at: Point, diameter: f64, from: f64) -> Option<ShaftPart> {
        let frame = self
            .frame_plates()
            .filter(|_| self.reaches_top(at, diameter, from));
        frame.map(|frame| ShaftPart {
            name: Self::FRAME_TOP.into(),
            body: 0,
            at,
            is_plate: true,
            span: frame.spans[1],
            hold: Hold::Turning,
        })
    }

    /// Axes of the bores of the frame, with the parts on them.
    fn frame_axes(&self) -> Vec<FrameAxis<'_>> {
        let axes = self.axes();
        let holes = self.pin_holes(0).into_iter().flatten();
        let found = holes.filter_map(|hole| {
            let is_here = |held: &BodyPoint| held.body == 0 && held.at == hole.at;
            let axis = axes.iter().find(|axis| axis.holes.iter().any(is_here))?;
            let shaft = self.shaft_at(0, hole.at).map(|(shaft, _)| shaft);
            let spans: Vec<[f64; 2]> = match shaft {
                Some(shaft) => shaft.parts.iter().map(|part| part.span).collect(),
                None => axis.parts(),
            };
            let tops = spans.iter().map(|span| span[1]);
            let top = tops.fold(f64::NEG_INFINITY, f64::max);
            Some(FrameAxis {
                reaches_top: self.reaches_top(hole.at, hole.hub.bore, top),
                hole,
                shaft,
                spans,
            })
        });
        found.collect()
    }

    /// Holes of the upper plate of the frame, for the shafts and pins that reach it.
    #[must_use]
    pub fn top_holes(&self) -> Vec<PinHole> {
        let spec = &self.design.plates;
        let reaching = self
            .frame_axes()
            .into_iter()
            .filter(|axis| axis.reaches_top);
        let plain = |FrameAxis { hole, .. }| PinHole {
            hub: BodySpec {
                bore: hole.hub.bore,
                bore_fit: spec.hole_fit.clone(),
                shaft_fit: spec.pin_fit.clone(),
                ..BodySpec::default()
            },
            ..hole
        };
        reaching.map(plain).collect()
    }

    /// The upper plate of the frame; `None` if it has none.
    ///
    /// # Errors
    /// [`SolidError`] if a number is not finite.
    pub fn top_plate(&self) -> Result<Option<Solid>, SolidError> {
        let Some(frame) = self.frame_plates() else {
            return Ok(None);
        };
        let holes = self.top_holes();
        let holes = holes.iter().map(PinHole::outline);
        let holes = holes.chain(frame.screws.clearance_holes()).collect();
        let [low, high] = frame.spans[1];
        Solid::new(frame.outline.clone(), holes, low, high).map(Some)
    }

    /// Posts between the plates of the frame, and the screws into them.
    pub(in crate::machine) fn posts(&self) -> Vec<TurnedPieces> {
        let Some(FramePlates { screws, spans, .. }) = self.frame_plates() else {
            return Vec::new();
        };
        let spec = &self.design.plates;
        let [[_, low], [high, _]] = *spans;
        let diameter = POST * screws.screw.diameter;
        let stock = Stock::new(&spec.material, spec.density);
        let general = &self.design.drawing.general_tolerance;
        let bar = Bar::new(Fit::new("", diameter, ["", ""]), [low, high]);
        let mut posts = bar.turned(Self::POSTS, "Post", stock, general);
        let thread = screws.screw.thread();
        posts.part.notes.push(match screws.thread_depth() {
            Some(depth) => format!("{thread}, {} deep, in both ends.", thousandths(depth)),
            None => format!("{thread} through."),
        });
        let at = screws.at.iter();
        posts.pieces = at.map(|at| bar.piece(FRAME, *at)).collect();
        posts.role = format!("{thread} in both ends");
        vec![
            posts,
            screws.screws(&[FRAME.to_owned()], "of the frame's posts"),
        ]
    }

    /// Pins and shafts without the posts and screws of the frame.
    #[must_use]
    pub fn turned_in_plates(&self) -> Vec<&TurnedPieces> {
        let all = self.turned().iter();
        let made =
            all.filter(|pieces| pieces.standard.is_none() && pieces.part.name != Self::POSTS);
        made.collect()
    }

    /// Shafts and pins that only one plate of the frame holds.
    #[must_use]
    pub fn overhangs(&self) -> Vec<Overhang> {
        let length = self.thickness(0);
        let middle = self.bottom(0) + 0.5 * length;
        let plates = &self.design.plates;
        let alone = self
            .frame_axes()
            .into_iter()
            .filter(|axis| !axis.reaches_top);
        let found = alone.map(
            |FrameAxis {
                 hole, shaft, spans, ..
             }| {
                let off = spans
                    .iter()
                    .map(|[low, high]| (0.5 * (low + high) - middle).abs());
                let is_on_it = |body: &usize| {
                    let mount = self.bodies[*body].mount.as_ref();
                    mount.is_some_and(|mount| {
                        let turns = mount.carrier == 0 && mount.kind == JointKind::Turning;
                        turns && (mount.at - hole.at).norm() < ONE * plates.pin_diameter
                    })
                };
                let material = shaft.map_or(&plates.material, |shaft| &shaft.hub.material);
                Overhang {
                    name: match shaft {
                        Some(shaft) => format!("shaft of {}", shaft.name),
                        None => format!("pin of {FRAME}.{}", hole.name),
                    },
                    bodies: (1..self.bodies.len()).filter(is_on_it).collect(),
                    diameter: hole.hub.bore,
                    length,
                    arm: off.fold(0.0, f64::max),
                    materials: [plates.material.clone(), material.clone()],
                }
            },
        );
        found.filter(|overhang| overhang.arm > 0.0).collect()
    }

    /// Bounds of all moving parts over the cycle and of the bores of the frame, in the frame's axes, mm.
    fn swept(&self) -> Bounds {
        let passage = self.passage();
        let moved = passage.parts.iter().flat_map(|part| {
            let (body, corners) = (part.body, part.corners.iter());
            corners.flat_map(move |&at| passage.frames.path(0, BodyPoint { body, at }))
        });
        let bores = self.hole_places(0).into_iter().flatten();
        let bores = bores.flat_map(|(_, at)| {
            let reach = Vector::repeat(self.boss(0, at).max(self.design.plates.pin_diameter));
            [at - reach, at + reach]
        });
        moved.chain(bores).fold(Bounds::EMPTY, Bounds::with)
    }
}
