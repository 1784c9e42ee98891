use centrode_geometry::{Crossing, Opening, Outline, Point};

use super::contour::{Contour, mirrored};
use super::spec::ArmBodySpec;
use centrode_spec::SpecError;
use centrode_spec::rule::{in_range, positive};

/// One part of an arm: its contour in the arm's frame and its position along the planet's axis.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmPart {
    /// Short name, used for file names.
    pub name: &'static str,
    /// Contour, counter-clockwise.
    pub outline: Outline,
    /// Contours of holes, counter-clockwise.
    pub holes: Vec<Outline>,
    /// Extent along the planet's axis, mm, from the middle of the housing.
    pub span: [f64; 2],
    /// Opening through a wall of the part, perpendicular to the planet's axis.
    pub opening: Option<Opening>,
}

/// A transplanting arm as a body: its outline, for clearances, and its parts.
#[derive(Clone, Debug)]
pub struct ArmBody {
    outline: Outline,
    tip: Point,
    parts: Vec<ArmPart>,
    contour: Contour,
    is_mirrored: bool,
}

/// Error of an arm that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArmError {
    /// A value outside its range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The clamp begins behind the planet's axis, or the housing's tube has no length.
    #[error(
        "the clamp leaves the housing {front} mm in front of the planet's axis, behind the rear end of the tube at {rear} mm: shorten the clamp ({clamp_length} mm)"
    )]
    NoTube {
        /// Middle of the tube's front end, mm.
        front: f64,
        /// Middle of its rear end, mm.
        rear: f64,
        /// Length of the clamp, mm.
        clamp_length: f64,
    },
    /// The clamp is too high for the round front of the tube.
    #[error(
        "a clamp {root_height} mm high at its root does not fit the front of the housing: at most about {most:.3} mm fits"
    )]
    ClampTooHigh {
        /// Height at the root, mm.
        root_height: f64,
        /// Maximum height that fits, mm.
        most: f64,
    },
    /// The clamp is shorter than its own rounded tip.
    #[error(
        "a clamp {clamp_length} mm long is too short for its heights {root_height} and {tip_height} mm"
    )]
    ClampTooShort {
        /// Length, mm.
        clamp_length: f64,
        /// Height at the root, mm.
        root_height: f64,
        /// Height at the tip, mm.
        tip_height: f64,
    },
    /// The push rod's bore does not go through the round front of the tube.
    #[error(
        "the push rod's bore of {bore} mm does not fit through the round front of the tube, whose radius is {tube_radius} mm: increase housing.tube_radius or reduce push_rod.diameter"
    )]
    NoBore {
        /// Width of the bore, mm.
        bore: f64,
        /// Outer radius of the tube, mm.
        tube_radius: f64,
    },
    /// A part inside is larger than the room for it.
    #[error("{inner} is {inner_size} mm, but {outer} leaves {outer_size} mm")]
    TooLarge {
        /// Key of the inner part.
        inner: &'static str,
        /// Its size, mm.
        inner_size: f64,
        /// Key of the outer part.
        outer: &'static str,
        /// Size of the room, mm.
        outer_size: f64,
    },
    /// The contour crosses itself.
    #[error("the arm's outline crosses itself at ({x}, {y}) mm")]
    Crossing {
        /// X coordinate, mm.
        x: f64,
        /// Y coordinate, mm.
        y: f64,
    },
}

/// Position and length of an arm's clamp, as the design gives them, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub(super) tip_distance: f64,
    pub(super) pusher_offset: f64,
    pub(super) clamp_length: f64,
}

impl ArmBody {
    /// Builds the arm whose clamp ends `tip_distance` (S) from the planet's axis, on a pusher's axis that passes
    /// it at `pusher_offset` (H), and is `clamp_length` long outside the housing; all mm.
    ///
    /// In the arm's frame the tip is at `(sqrt(S^2 - H^2), -H)`: the direction of the clamp is that of the
    /// tip turned by asin(H/S).
    ///
    /// # Errors
    /// [`ArmError`] with the violated rule.
    pub fn new(
        spec: &ArmBodySpec,
        tip_distance: f64,
        pusher_offset: f64,
        clamp_length: f64,
    ) -> Result<Self, ArmError> {
        spec.validate()?;
        let reach = Reach {
            tip_distance,
            pusher_offset,
            clamp_length,
        };
        let contour = reach.contour(spec)?;
        let other_side = pusher_offset < 0.0;
        let crossing = |Crossing { point, .. }: Crossing| ArmError::Crossing {
            x: point.x,
            y: point.y,
        };
        let too_high = ArmError::ClampTooHigh {
            root_height: spec.clamp.root_height,
            most: 2.0 * contour.room(),
        };
        let whole = contour.whole().ok_or(too_high)?;
        if let Some(at) = whole.crossing() {
            return Err(crossing(at));
        }
        let turned = |outline: Outline| {
            if other_side {
                mirrored(&outline).unwrap_or(outline)
            } else {
                outline
            }
        };
        let no_bore = ArmError::NoBore {
            bore: spec.rod_bore(),
            tube_radius: spec.housing.tube_radius,
        };
        let mut parts = parts(spec, &contour).ok_or(no_bore)?;
        for part in &mut parts {
            part.outline = turned(part.outline.clone());
            if other_side {
                for hole in &mut part.holes {
                    *hole = turned(hole.clone());
                }
                // The mirror swaps lower and upper corners.
                for ends in part
                    .opening
                    .iter_mut()
                    .flat_map(|o| [&mut o.outer, &mut o.inner])
                {
                    *ends = [1, 0].map(|i: usize| Point::new(ends[i].x, -ends[i].y));
                }
            }
        }
        Ok(Self {
            outline: turned(whole),
            tip: Point::new(contour.tip, -pusher_offset),
            parts,
            contour,
            is_mirrored: other_side,
        })
    }

    /// Contour of the whole arm as seen along the planet's axis, counter-clockwise: lines and arcs.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Contour of the housing moved inwards by a distance, mm; `None` if no area is left.
    #[must_use]
    pub fn within(&self, inset: f64) -> Option<Outline> {
        let belt = self.contour.belt(inset)?;
        match self.is_mirrored {
            true => mirrored(&belt),
            false => Some(belt),
        }
    }

    /// The clamp's tip, in the arm's frame.
    #[must_use]
    pub fn tip(&self) -> Point {
        self.tip
    }

    /// Housing with its covers, both flakes, push rod with pusher, and spring; the rod is thrown out.
    #[must_use]
    pub fn parts(&self) -> &[ArmPart] {
        &self.parts
    }
}

impl Reach {
    pub(super) fn contour(&self, spec: &ArmBodySpec) -> Result<Contour, ArmError> {
        let Self {
            tip_distance,
            pusher_offset,
            clamp_length,
        } = *self;
        positive("tip_distance", tip_distance)?;
        in_range(
            "pusher_offset",
            pusher_offset,
            [-tip_distance, tip_distance],
            " mm",
        )?;
        positive("clamp_length", clamp_length)?;
        let (housing, clamp) = (&spec.housing, &spec.clamp);
        let tip = (tip_distance * tip_distance - pusher_offset * pusher_offset).sqrt();
        let front = tip - clamp_length - housing.tube_radius;
        let rear = -housing.tube_back;
        if front <= rear {
            return Err(ArmError::NoTube {
                front,
                rear,
                clamp_length,
            });
        }
        let (root, end) = (0.5 * clamp.root_height, 0.5 * clamp.tip_height);
        if tip - end - front <= (root - end).abs() || clamp_length <= end {
            return Err(ArmError::ClampTooShort {
                clamp_length,
                root_height: clamp.root_height,
                tip_height: clamp.tip_height,
            });
        }
        fits(spec, front - rear)?;
        Ok(Contour {
            drum_radius: housing.drum_radius,
            tube_radius: housing.tube_radius,
            rear,
            front,
            offset: pusher_offset.abs(),
            tip,
            root,
            end,
        })
    }
}

/// Checks that every inner part is smaller than the one that encloses it.
fn fits(spec: &ArmBodySpec, tube_length: f64) -> Result<(), ArmError> {
    let (housing, clamp, rod, spring) = (&spec.housing, &spec.clamp, &spec.push_rod, &spec.spring);
    let tube = 2.0 * (housing.tube_radius - housing.wall);
    let walls = 2.0 * housing.wall;
    let coil = spring.outer_diameter - 2.0 * spring.wire_diameter;
    let flakes = clamp.opening + 2.0 * clamp.thickness;
    for (inner, inner_size, outer, outer_size) in [
        ("housing.wall", walls, "housing.width", housing.width),
        (
            "housing.bore",
            housing.bore,
            "housing.drum_radius",
            2.0 * (housing.drum_radius - housing.wall),
        ),
        (
            "housing.sleeve_bore",
            housing.sleeve_bore,
            "housing.drum_radius",
            2.0 * (housing.drum_radius - housing.wall),
        ),
        (
            "spring.outer_diameter",
            spring.outer_diameter,
            "housing.tube_radius",
            tube,
        ),
        (
            "clamp.root_height",
            clamp.root_height,
            "housing.tube_radius",
            2.0 * housing.tube_radius,
        ),
        (
            "push_rod.diameter",
            rod.diameter,
            "spring.outer_diameter",
            coil,
        ),
        ("clamp.opening", flakes, "housing.width", housing.width),
        (
            "push_rod.diameter",
            rod.diameter,
            "clamp.tip_height",
            clamp.tip_height,
        ),
        (
            "push_rod.pusher_height",
            rod.pusher_height,
            "clamp.tip_height",
            clamp.tip_height,
        ),
        (
            "spring.length",
            spring.length,
            "the housing's tube",
            tube_length,
        ),
    ] {
        if inner_size >= outer_size {
            return Err(ArmError::TooLarge {
                inner,
                inner_size,
                outer,
                outer_size,
            });
        }
    }
    Ok(())
}

/// The parts of an arm; `None` if the push rod does not leave the housing through the round front.
fn parts(spec: &ArmBodySpec, contour: &Contour) -> Option<Vec<ArmPart>> {
    let (clamp, rod, spring) = (&spec.clamp, &spec.push_rod, &spec.spring);
    let half = |size: f64| [-0.5 * size, 0.5 * size];
    let mut parts = Vec::new();
    let mut add = |name, outline: Option<Outline>, holes, span| {
        parts.extend(outline.map(|outline| ArmPart {
            name,
            outline,
            holes,
            span,
            opening: None,
        }));
    };
    let bore = |diameter: f64| -> Vec<Outline> {
        let hole = (diameter > 0.0).then(|| Outline::circle(Point::origin(), 0.5 * diameter));
        hole.into_iter().collect()
    };
    let [rear, front] = half(spec.housing.width);
    let wall = spec.housing.wall;
    let half_bore = 0.5 * spec.rod_bore();
    let (outside, on_outside) = contour.split(0.0, half_bore)?;
    let (cavity, on_cavity) = contour.split(wall, half_bore)?;
    add(
        "housing",
        Some(outside),
        vec![cavity],
        [rear + wall, front - wall],
    );
    let covers = [
        ("cover-rear", spec.housing.sleeve_bore, [rear, rear + wall]),
        ("cover-front", spec.housing.bore, [front - wall, front]),
    ];
    for (name, diameter, span) in covers {
        add(name, contour.housing(), bore(diameter), span);
    }
    let inner = 0.5 * clamp.opening;
    let outer = inner + clamp.thickness;
    add("flake-left", contour.flake(), Vec::new(), [inner, outer]);
    add("flake-right", contour.flake(), Vec::new(), [-outer, -inner]);
    // With the rod thrown out, the pusher reaches to the point where the rounding of the flakes begins.
    let face = contour.tip - contour.end;
    let neck = face - rod.pusher_length;
    let bar = contour.bar(spec.rod_end(), neck, 0.5 * rod.diameter);
    add("push-rod", Some(bar), Vec::new(), half(rod.diameter));
    let pusher = contour.bar(neck, face, 0.5 * rod.pusher_height);
    add("pusher", Some(pusher), Vec::new(), half(rod.diameter));
    // The spring is as far in front as the tube's round end lets it be: the fork's pin moves behind the spring.
    let half_coil = 0.5 * spring.outer_diameter;
    let room = spec.housing.tube_radius - wall;
    let seat = contour.front + (room * room - half_coil * half_coil).max(0.0).sqrt();
    let coil = contour.bar(seat - spring.length, seat, half_coil);
    add(
        "spring",
        Some(coil),
        Vec::new(),
        half(spring.outer_diameter),
    );
    for housing in parts.iter_mut().filter(|part| part.name == "housing") {
        housing.opening = Some(Opening {
            outer: on_outside,
            inner: on_cavity,
            span: half(spec.rod_bore()),
        });
    }
    Some(parts)
}
