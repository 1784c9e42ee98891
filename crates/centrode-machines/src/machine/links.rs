use centrode_geometry::{Outline, SolidError};

use super::hardware::pieces::Pieces;
use super::load::MachineLoad;
use super::{BodyPoint, Hardware, Hold, Machine, MachineBody};
use centrode_kinematics::machine::{
    Blank, Closure, Fit, GearMesh, Input, Joint, JointKind, Line, LineRole, Link, LinkPoint,
    LinkedMachine, Mark, Part, PitchCurves, Quantity, Surface,
};

impl Machine {
    /// The machine as links and joints: each body is a plate drawn round its points, with the pins in the plates.
    ///
    /// # Errors
    /// [`SolidError`] if a plate is not a solid.
    pub fn machine(&self) -> Result<LinkedMachine, SolidError> {
        let pieces = self.all_pieces()?;
        let mut machine = self.linked(&pieces);
        for (link, pieces) in machine.links.iter_mut().zip(&pieces) {
            link.mass = pieces.together();
        }
        self.list(&mut machine, &pieces);
        self.list_fits(&mut machine);
        match self.design.hardware() {
            Hardware::None => {}
            Hardware::List => self.list_axes(&mut machine),
            Hardware::Full => {
                for pieces in self.turned() {
                    machine.add_turned(pieces, String::new());
                }
            }
        }
        self.list_brackets(&mut machine);
        self.list_given(&mut machine);
        machine.arrangement.drawing = self.design.drawing.clone();
        machine.arrangement.notes.extend(self.meshing_notes());
        Ok(machine)
    }

    /// The machine as links and joints for pictures and clearances: without masses, pins and a list of parts.
    ///
    /// # Errors
    /// [`SolidError`] if a plate is not a solid.
    pub fn outlined(&self) -> Result<LinkedMachine, SolidError> {
        Ok(self.linked(&self.all_pieces()?))
    }

    fn all_pieces(&self) -> Result<Vec<Pieces<'_>>, SolidError> {
        let pieces = (0..self.bodies.len()).map(|body| self.pieces(body));
        pieces.collect()
    }

    /// Links and joints with their lines for pictures.
    fn linked(&self, pieces: &[Pieces<'_>]) -> LinkedMachine {
        let mut machine = LinkedMachine {
            name: self.design.name.clone(),
            title: self.design.title.clone(),
            input: Input {
                name: "input".into(),
                period: self.period(),
                speed: self.speed(),
            },
            gravity: self
                .design
                .gravity
                .map_or([0.0; 3], |[x, y]| [1e3 * x, 1e3 * y, 0.0]),
            loads: self.loads.iter().flat_map(MachineLoad::parts).collect(),
            ..LinkedMachine::default()
        };
        machine.input_columns("angle of the driving shaft");
        for (index, body) in self.bodies.iter().enumerate() {
            self.add_link(&mut machine, index, &pieces[index]);
            if let Some(mount) = &body.mount {
                self.add_joint(&mut machine, index, mount.carrier);
            }
        }
        // One pin per dyad. Joint `body - 1` carries a body; the frame has none.
        for (pin, dyad) in self.pins.iter().zip(&self.dyads) {
            machine.closures.push(Closure {
                links: pin.bodies,
                at: [pin.at.x, pin.at.y, 0.0],
                joints: dyad.bodies.map(|body| body - 1),
            });
        }
        for mesh in &self.meshes {
            let driver = &self.gears[mesh.gears[0]];
            let pair = &driver.pair;
            let body = |gear: usize| self.body_named(&self.gears[gear].body_name).unwrap_or(0);
            let axis = |gear: usize| {
                let at = self.gears[gear].at;
                [at.x, at.y, 0.0]
            };
            machine.meshes.push(GearMesh {
                links: mesh.gears.map(body),
                joint: mesh.moved - 1,
                copy: 0,
                pressure_angle: Some(pair.pressure_angle()),
                axes: mesh.gears.map(axis),
                // Gears in mesh transmit force even while they dwell.
                pitch: Some(PitchCurves {
                    driven: pair.shared_rolling(),
                    zero: driver.mount,
                }),
            });
        }
        machine.contacts = self.contacts();
        self.add_points(&mut machine);
        self.draw(&mut machine, pieces);
        machine
    }

    /// Lists the plates, the bodies of given masses, the gears and the cams as parts, each with the files of its name. Copies
    /// are further pieces of the original's part.
    fn list(&self, machine: &mut LinkedMachine, pieces: &[Pieces<'_>]) {
        for (index, (body, made)) in self.bodies.iter().zip(pieces).enumerate() {
            let outline = made.plate.as_ref().map(|plate| plate.outline());
            if outline.is_none() && made.mass().is_none() {
                continue;
            }
            let material = outline.map_or("", |_| &self.design.plates.material);
            let part = Part {
                name: body.name.clone(),
                material: material.to_owned(),
                blank: outline.and_then(|outline| Blank::plate(outline, self.thickness(index))),
                mass: made.mass().map(|own| own.mass),
                ..Part::default()
            };
            self.add_part(machine, part, &body.name, outline);
            if let Some(top) = &made.top {
                machine.part(Part {
                    name: Self::FRAME_TOP.into(),
                    links: vec![0],
                    material: self.design.plates.material.clone(),
                    blank: Blank::plate(top.outline(), self.thickness(0)),
                    mass: Some(top.mass_properties(self.design.plates.density).mass),
                    file: Self::FRAME_TOP.into(),
                    ..Part::default()
                });
            }
        }
        let mut gears: Vec<_> = pieces.iter().flat_map(|made| &made.gears).collect();
        gears.sort_by_key(|piece| &piece.of.name);
        for piece in gears {
            let gear = piece.of.gear();
            let part = Part {
                name: piece.of.name.clone(),
                material: gear.body().material.clone(),
                blank: Blank::round(gear.outline(), gear.body().width),
                mass: Some(piece.mass().mass),
                remark: stated(
                    format!("{} teeth, on {}", gear.tooth_count(), piece.of.body_name),
                    self.hold_remark(&piece.of.name),
                ),
                ..Part::default()
            };
            self.add_part(
                machine,
                part,
                &piece.of.body_name,
                Some(piece.solid.outline()),
            );
        }
        let mut cams: Vec<_> = pieces.iter().flat_map(|made| &made.cams).collect();
        cams.sort_by_key(|piece| &piece.of.name);
        for piece in cams {
            let part = Part {
                name: piece.of.name.clone(),
                material: piece.of.part.body().material.clone(),
                blank: Blank::plate(piece.solid.outline(), piece.of.part.body().width),
                mass: Some(piece.mass().mass),
                remark: stated(
                    format!(
                        "moves {}, on {}",
                        piece.of.followers.join(", "),
                        piece.of.body_name
                    ),
                    self.hold_remark(&piece.of.name),
                ),
                ..Part::default()
            };
            self.add_part(
                machine,
                part,
                &piece.of.body_name,
                Some(piece.solid.outline()),
            );
        }
    }

    /// Lists the fits of seats and plates on shafts, of pins in plates, and of blocks in guides.
    fn list_fits(&self, machine: &mut LinkedMachine) {
        let spec = &self.design.plates;
        for shaft in self.shafts() {
            let hub = &shaft.hub;
            let seats = ("seats on shafts", [&*hub.bore_fit, &hub.shaft_fit]);
            let plates = (
                "plates that turn on shafts",
                [&*spec.hole_fit, &spec.pin_fit],
            );
            let holds = || shaft.parts.iter().map(|part| part.hold);
            let found = [
                (holds().any(Hold::is_fixed), seats),
                (holds().any(|hold| hold == Hold::Turning), plates),
            ];
            for (_, (name, classes)) in found.into_iter().filter(|(is_found, _)| *is_found) {
                machine.fit(Fit::new(name, hub.bore, classes));
            }
        }
        // Holes that no shaft of the machine fills are for pins.
        let of_shafts: usize = self
            .shafts()
            .iter()
            .map(|shaft| shaft.parts.iter().filter(|part| part.is_plate).count())
            .sum();
        let holes = (0..self.bodies.len()).filter_map(|body| self.hole_places(body));
        if holes.map(|holes| holes.len()).sum::<usize>() > of_shafts {
            let classes = [&*spec.hole_fit, &spec.pin_fit];
            machine.fit(Fit::new("pins in plates", spec.pin_diameter, classes));
        }
        for (index, body) in self.bodies.iter().enumerate() {
            let height = self
                .guided(index)
                .filter(|_| self.original(&body.name) == body.name);
            if let Some(height) = height.filter(|_| self.pin_holes(index).is_some()) {
                let name = format!("{} in its guide", body.name);
                machine.fit(Fit::of_width(&name, height, Self::GUIDE_FIT));
            }
        }
    }

    /// Lists a part of a body; a copy is a further piece of the original's part.
    fn add_part(
        &self,
        machine: &mut LinkedMachine,
        part: Part,
        body: &str,
        outline: Option<&Outline>,
    ) {
        let link = self.body_named(body);
        let original = self.original(&part.name);
        if let Some(listed) = machine.parts.iter_mut().find(|part| part.name == original) {
            listed.links.extend(link);
            return;
        }
        machine.part(Part {
            links: link.into_iter().collect(),
            file: outline.map_or_else(String::new, |_| part.name.clone()),
            place: outline.and_then(|outline| machine.place_on_edge(body, outline)),
            ..part
        });
    }

    /// Adds a body with its plate, gears and cams: shape, mass, and surfaces for contact.
    fn add_link(&self, machine: &mut LinkedMachine, body: usize, pieces: &Pieces<'_>) {
        let name = &self.bodies[body].name;
        let mut link = Link::new(name.clone());
        let plates = pieces.plate.iter().map(|plate| (name.as_str(), plate));
        let top = pieces.top.iter().map(|top| (Self::FRAME_TOP, top));
        for (name, solid) in plates.chain(top) {
            link.surfaces
                .push(machine.surface(Surface::of_solid(name, solid)));
        }
        for piece in &pieces.gears {
            let surface = piece.of.surface(&piece.solid);
            link.surfaces.push(machine.surface(surface));
        }
        for piece in &pieces.cams {
            let surface = piece.of.surface(&piece.solid);
            link.surfaces.push(machine.surface(surface));
        }
        let solids = pieces.solids();
        if !solids.is_empty() {
            link.shape = Some(machine.solids(&format!("links/{name}"), "", solids));
        }
        machine.link(link);
    }

    fn add_joint(&self, machine: &mut LinkedMachine, body: usize, carrier: usize) {
        let MachineBody { name, mount, .. } = &self.bodies[body];
        let Some(mount) = mount else {
            return;
        };
        let joint = match mount.kind {
            JointKind::Fixed => Joint::fixed(carrier, body),
            JointKind::Turning => Joint::turning(carrier, body, mount.law.clone()),
            JointKind::Sliding(range) => {
                let along = [1.0, 0.0, 0.0];
                Joint::sliding(carrier, body, along, range, mount.law.clone())
            }
        };
        let at = [mount.at.x, mount.at.y, 0.0];
        let joint = joint.at(at).turned([0.0, 0.0, mount.angle]);
        let joint = machine.joint(joint);
        let carrier = &self.bodies[carrier].name;
        let (unit, meaning) = match mount.kind {
            JointKind::Fixed => return,
            JointKind::Turning => ("rad", format!("angle of {name} relative to {carrier}")),
            JointKind::Sliding(_) => ("mm", format!("position of {name} along {carrier}")),
        };
        let column = format!("{}_joint_{unit}", name.replace('-', "_"));
        machine.column(&column, unit, &meaning, Quantity::joint(joint));
    }

    fn add_points(&self, machine: &mut LinkedMachine) {
        for (name, BodyPoint { body, at }) in self.points().filter(|(_, point)| point.body > 0) {
            let point = machine.points.len();
            let column = name.replace(['.', '-'], "_");
            machine.points.push(LinkPoint {
                name: name.clone(),
                link: body,
                at: [at.x, at.y, 0.0],
            });
            for (axis, letter) in ["x", "y"].into_iter().enumerate() {
                let quantity = Quantity::Point { point, axis };
                let meaning = format!("{letter} of point {name}");
                machine.column(&format!("{column}_{letter}_mm"), "mm", &meaning, quantity);
            }
        }
    }

    /// Draws every body, and the paths of the points that hold no other body.
    fn draw(&self, machine: &mut LinkedMachine, pieces: &[Pieces<'_>]) {
        let followed = self.followed();
        let traced: Vec<usize> = (0..machine.points.len())
            .filter(|&point| followed.contains(&machine.points[point].name))
            .collect();
        for (index, body) in self.bodies.iter().enumerate() {
            let mut lines = Vec::new();
            if let Some(plate) = &pieces[index].plate {
                let holes = plate.holes().iter();
                lines.push(Line::contour(LineRole::Body, plate.outline()));
                lines.extend(holes.map(|hole| Line::contour(LineRole::Hole, hole)));
            }
            let bar = self.bar(index);
            lines.extend(bar.map(|bar| Line::contour(LineRole::Body, &bar)));
            let gears = pieces[index].gears.iter();
            lines.extend(gears.flat_map(|piece| piece.of.lines()));
            let cams = pieces[index].cams.iter();
            lines.extend(cams.flat_map(|piece| piece.of.lines()));
            let roller = self.roller(&body.name);
            lines.extend(roller.map(|roller| Line::contour(LineRole::Body, &roller)));
            if index == 0 {
                lines.extend(self.given_frame());
                let ways = traced.iter();
                lines.extend(ways.map(|&point| Line::trace(LineRole::Trace, point)));
            }
            let sketch = machine.sketch(&body.name, lines);
            machine.draw(&body.name, index, sketch);
        }
        // Links are drawn in their order, so that the index of a body is the index of its figure.
        let marks = self
            .points()
            .map(|(name, point): (String, BodyPoint)| Mark {
                name: name.rsplit('.').next().unwrap_or_default().to_owned(),
                figure: point.body,
                at: point.at.coords.into(),
            });
        machine.marks.extend(marks);
        self.draw_obstacles(machine);
    }
}

/// A remark, followed by the note on how the part is held.
fn stated(remark: String, hold: Option<&str>) -> String {
    match hold {
        Some(hold) => format!("{remark}; {hold}"),
        None => remark,
    }
}
