//! Tables of the axes, and the parts from the customer: the frame, guides and springs.

use centrode_geometry::Point;

use crate::machine::design::FRAME;
use crate::machine::hardware::pins::Axis;
use crate::machine::{BodyPoint, Hardware, Hold, Machine, Mount};
use centrode_kinematics::machine::{
    ArrangementTable, JointKind, Line, LineRole, LinkedMachine, Part, SpacerKind, Supply,
    TurnedPiece, TurnedPieces,
};
use centrode_spec::digits::{rounded, thousandths};

/// Distance below which two axes count as one, mm: above rounding, far below any clearance.
const ONE: f64 = 1e-6;

/// Headings of the table of an axis.
const ON_AXIS: [&str; 5] = ["height, mm", "part", "size", "how", "supply"];
/// Headings of the table of the frame.
const IN_FRAME: [&str; 5] = ["for", "x, mm", "y, mm", "size", "remark"];

/// A part on an axis: heights of its lower and upper face, mm, and the cells of its table row except the first.
type Row = ([f64; 2], [String; 4]);

impl Machine {
    /// Lists shafts and pins, and the fasteners on them, as given parts. Adds a table per axis of the parts on it, from the top
    /// down. Copies have the table of their originals.
    pub(in crate::machine) fn list_axes(&self, machine: &mut LinkedMachine) {
        let axes = self.axes();
        let points = self
            .points()
            .map(|(name, point)| (name, self.places_of(point.body, point.at)));
        let points: Vec<(String, Vec<Point>)> = points.collect();
        for pieces in self.turned() {
            let size = format!(
                "Ø{} {}",
                thousandths(pieces.part.diameter()),
                classes(pieces)
            );
            let size = format!("{size} x {}", thousandths(pieces.part.length()));
            let links = pieces.pieces.iter();
            let links: Vec<usize> = links
                .filter_map(|piece| machine.link_named(&piece.link))
                .collect();
            machine.part(Part {
                material: pieces.part.material.clone(),
                ..Part::given(&pieces.part.title, links.clone(), size.clone())
            });
            for fastener in pieces.fasteners() {
                let bought = Part::bought(fastener.name, links.clone());
                machine.part(match fastener.file {
                    Some(_) => Part {
                        supply: Supply::Given,
                        ..bought
                    },
                    None => bought,
                });
            }
            let keyway = pieces.part.keyway.map(|key| {
                let [width, depth] = [key.width, key.depth].map(thousandths);
                format!(", keyway {width} x {depth}")
            });
            let role = Some(&pieces.role).filter(|role| !role.is_empty());
            let role = role.map(|role| format!(", {role}"));
            let words = keyway.unwrap_or_default() + &role.unwrap_or_default();
            let originals = pieces.pieces.iter();
            for piece in originals.filter(|piece| self.original(&piece.link) == piece.link) {
                let axis = self.axis_name(piece, &points);
                machine.arrangement.tables.push(ArrangementTable {
                    title: format!("Axis {axis}: {size}{words}"),
                    headings: ON_AXIS.map(String::from).into(),
                    rows: self.rows(pieces, piece, &axes),
                });
            }
        }
    }

    /// Lists the other parts from the customer: the frame if it has no plate, guides, and parts that hold followers on their
    /// cams.
    pub(in crate::machine) fn list_given(&self, machine: &mut LinkedMachine) {
        if self.design.hardware() == Hardware::None {
            return;
        }
        self.list_drives(machine);
        let mut held = self.bores();
        for index in 1..self.bodies.len() {
            // The guide of a copy is a further piece of its original's guide.
            let name = self.original(&self.bodies[index].name);
            let original = self.body_named(name).unwrap_or(index);
            let guided = self
                .sliding(original)
                .filter(|_| self.slotted(original).is_none());
            let Some((mount, height, travel)) = guided else {
                continue;
            };
            let (size, travel) = (thousandths(height), thousandths(travel));
            let carrier = &self.bodies[mount.carrier].name;
            let angle = rounded(mount.angle.to_degrees(), 3);
            let size = format!("{size} {}", Self::GUIDE_FIT[0]);
            let along = format!("along {angle}°, stroke {travel} mm");
            let own = self.bodies[index].mount.iter();
            machine.part(Part::given(
                &format!("Guide of {name}"),
                own.map(|own| own.carrier).collect(),
                format!("{size} on {carrier}, {along}"),
            ));
            if mount.carrier == 0 && index == original {
                let [x, y] = [mount.at.x, mount.at.y].map(thousandths);
                held.push([format!("guide of {name}"), x, y, size, along]);
            }
        }
        for cam in &self.cams {
            for follower in &cam.followers {
                let name = self.original(follower);
                machine.part(Part::given(
                    &format!("Spring of {name}"),
                    self.body_named(follower).into_iter().collect(),
                    format!("or a groove: keeps {name} on {}", self.original(&cam.name)),
                ));
            }
        }
        if let Some(screws) = self.frame_screws() {
            let remark = "under the lower plate of the frame, at the posts";
            machine.part(Part::given("Foot", vec![0; screws.at.len()], remark.into()));
        }
        if !self.has_plate(0) && !held.is_empty() {
            let remark = "bores and guides: see table Frame";
            machine.part(Part::given(FRAME, vec![0], remark.into()));
            machine.arrangement.tables.push(ArrangementTable {
                title: "Frame (given): bores and guides".into(),
                headings: IN_FRAME.map(String::from).into(),
                rows: held.into_iter().map(Vec::from).collect(),
            });
        }
    }

    /// Bores and guides of a given frame, for the picture.
    pub(in crate::machine) fn given_frame(&self) -> Vec<Line> {
        if self.has_plate(0) {
            return Vec::new();
        }
        let holes = self.pin_holes(0).into_iter().flatten();
        let bores = holes.map(|hole| Line::contour(LineRole::Adjacent, &hole.outline()));
        let guides = (1..self.bodies.len()).flat_map(|body| {
            let guide = self.sliding(body).filter(|(mount, ..)| mount.carrier == 0);
            let Some((mount, height, travel)) = guide else {
                return Vec::new();
            };
            let JointKind::Sliding([low, _]) = mount.kind else {
                return Vec::new();
            };
            let high = low + travel;
            let seat = mount.seat();
            let side = |side: f64| {
                let ends = [low - height, high + height];
                let ends = ends.map(|along| seat * Point::new(along, side * 0.5 * height));
                Line::chain(LineRole::Adjacent, &ends)
            };
            [1.0, -1.0].map(side).into()
        });
        bores.chain(guides).collect()
    }

    /// Joint of a body that slides as a block, the height of the block and its stroke, mm.
    fn sliding(&self, body: usize) -> Option<(&Mount, f64, f64)> {
        let mount = self.bodies[body].mount.as_ref()?;
        let height = self.guided(body).filter(|_| self.has_plate(body))?;
        match mount.kind {
            JointKind::Sliding([low, high]) => Some((mount, height, high - low)),
            _ => None,
        }
    }

    /// Rows of the table of the frame: its bores.
    fn bores(&self) -> Vec<[String; 5]> {
        let holes = self.pin_holes(0).into_iter().flatten();
        let bottom = self.bottom(0);
        let heights = [bottom, bottom + self.thickness(0)].map(thousandths);
        let row = |hole: crate::PinHole| {
            let [x, y] = [hole.at.x, hole.at.y].map(thousandths);
            let size = format!("Ø{} {}", thousandths(hole.hub.bore), hole.hub.bore_fit);
            let remark = format!("assumed from {} to {}", heights[0], heights[1]);
            [hole.name, x, y, size, remark]
        };
        holes.map(row).collect()
    }

    /// Name of the axis of a shaft or pin: the name of a point on it, or that of the body if there is no such point.
    fn axis_name(&self, piece: &TurnedPiece, points: &[(String, Vec<Point>)]) -> String {
        let body = self.body_named(&piece.link).unwrap_or(0);
        let here = self.places_of(body, Point::new(piece.at[0], piece.at[1]));
        let is_here = |(_, places): &&(String, Vec<Point>)| {
            let mut both = here.iter().zip(places);
            both.all(|(a, b)| (a - b).norm() < ONE)
        };
        let named = points.iter().find(is_here);
        named.map_or_else(|| piece.link.clone(), |(name, _)| name.clone())
    }

    /// Rows of the table of an axis, from the top down.
    fn rows(&self, pieces: &TurnedPieces, piece: &TurnedPiece, axes: &[Axis]) -> Vec<Vec<String>> {
        let at = Point::new(piece.at[0], piece.at[1]);
        let body = self.body_named(&piece.link).unwrap_or(0);
        let mut rows: Vec<Row> = self.parts_on(BodyPoint { body, at }, pieces, axes);
        let bottom = piece.at[2];
        for fastener in pieces.fasteners() {
            let low = bottom + fastener.at[2];
            let mut ring = pieces.spacers.iter();
            let ring = ring
                .find(|(ring, at)| ring.name() == fastener.name && (bottom + at - low).abs() < ONE);
            let supply = match fastener.file {
                Some(_) => Supply::Given,
                None => Supply::Bought,
            };
            // Keys are listed with the part that they hold.
            if pieces
                .keys
                .iter()
                .any(|seated| seated.key.name() == fastener.name)
            {
                continue;
            }
            let (span, how) = match ring {
                Some((ring, _)) => {
                    let how = match ring.kind {
                        SpacerKind::Roller => "turns on it",
                        SpacerKind::Shim | SpacerKind::Sleeve => "between",
                    };
                    ([low, low + ring.length], how)
                }
                None => ([low, low], "in its groove"),
            };
            let cells = [
                fastener.name,
                String::new(),
                how.into(),
                supply.name().into(),
            ];
            rows.push((span, cells));
        }
        rows.sort_by(|(a, _), (b, _)| (b[0] + b[1]).total_cmp(&(a[0] + a[1])));
        let row = |([low, high], cells): Row| {
            let height = match high - low < ONE {
                true => thousandths(low),
                false => format!("{} to {}", thousandths(low), thousandths(high)),
            };
            std::iter::once(height).chain(cells).collect()
        };
        rows.into_iter().map(row).collect()
    }

    /// Plates, gears and cams on a shaft or pin.
    fn parts_on(&self, point: BodyPoint, pieces: &TurnedPieces, axes: &[Axis]) -> Vec<Row> {
        let made = |body: usize, is_plate: bool| match is_plate && !self.has_plate(body) {
            true => Supply::Given,
            false => Supply::Made,
        };
        let plates = &self.design.plates;
        let shaft = self.shafts().iter().find(|shaft| {
            let name = format!("shaft-{}", self.original(&shaft.name));
            shaft.body == point.body
                && (shaft.at - point.at).norm() < ONE
                && pieces.part.name == name
        });
        if let Some(shaft) = shaft {
            let size = |class: &str| format!("Ø{} {class}", thousandths(shaft.hub.bore));
            let row = |part: &crate::machine::ShaftPart| {
                let (size, how) = match part.hold {
                    Hold::Keyed(key) => (size(&shaft.hub.bore_fit), key.name()),
                    Hold::Given => (size(&shaft.hub.bore_fit), "fixed on it, no key".into()),
                    Hold::Turning => (size(&plates.hole_fit), "turns on it".into()),
                    Hold::Bracket => (String::new(), "on a bracket, clear of it".into()),
                    Hold::Loose => (String::new(), "bore or keyway differs from shaft".into()),
                };
                let supply = made(part.body, part.is_plate).name().into();
                (part.span, [part.name.clone(), size, how, supply])
            };
            return shaft.parts.iter().map(row).collect();
        }
        let is_here = |axis: &&Axis| axis.holes.iter().any(|hole| hole.is_near(point, ONE));
        let axis = axes.iter().find(is_here);
        let row = |(hole, &span): (&BodyPoint, &[f64; 2])| {
            let name = self.bodies[hole.body].name.clone();
            let size = format!("Ø{} {}", thousandths(plates.pin_diameter), plates.hole_fit);
            let supply = made(hole.body, true).name().into();
            (span, [name, size, "turns on it".into(), supply])
        };
        let rows = axis.map(|axis| axis.holes.iter().zip(&axis.plates).map(row).collect());
        rows.unwrap_or_default()
    }
}

/// Tolerance classes of the steps of a shaft or pin except the grooves, each once.
fn classes(pieces: &TurnedPieces) -> String {
    let steps = pieces.part.steps.iter().filter(|step| step.ring.is_none());
    let mut classes: Vec<&str> = steps.map(|step| &*step.class).collect();
    classes.sort_unstable();
    classes.dedup();
    classes.join(" and ")
}
