use centrode_geometry::{MassProperties, Point, Solid, SolidError};

use super::{Composed, ComposedBody, ComposedCam};
use crate::machine::{
    Closure, Form, GearMesh, Input, Joint, JointKind, Line, LineRole, Link, LinkPoint, Machine,
    Mark, Part, Quantity, Shape, Surface,
};

impl Composed {
    /// The machine as links and joints, each body a plate drawn round its points.
    ///
    /// # Errors
    /// [`SolidError`] where a plate is no solid.
    pub fn machine(&self) -> Result<Machine, SolidError> {
        let mut machine = Machine {
            name: self.design.name.clone(),
            title: self.design.title.clone(),
            input: Input {
                name: "input".into(),
                period: self.period(),
                speed: self.speed(),
            },
            ..Machine::default()
        };
        let meaning = "angle the driving shaft has turned by";
        machine.column("input_angle_rad", "rad", meaning, Quantity::Input(1.0));
        let time = Quantity::Input(1.0 / self.speed());
        machine.column("time_s", "s", "time at the design's speed", time);
        for (index, body) in self.bodies.iter().enumerate() {
            self.add_link(&mut machine, index)?;
            if let Some(mount) = &body.mount {
                self.add_joint(&mut machine, index, mount.carrier);
            }
        }
        // A pin a dyad; each body but the frame is carried by the joint before it.
        for (pin, dyad) in self.pins.iter().zip(&self.dyads) {
            machine.closures.push(Closure {
                links: pin.bodies,
                at: [pin.at.x, pin.at.y, 0.0],
                joints: dyad.bodies.map(|body| body - 1),
            });
        }
        // The frames of meshing links stand on the gears' axes.
        let centred = |gear: &usize| self.gears[*gear].at == Point::origin();
        for mesh in self
            .meshes
            .iter()
            .filter(|mesh| mesh.gears.iter().all(centred))
        {
            let pair = &self.gears[mesh.gears[0]].pair;
            let body = |gear: usize| self.body_named(&self.gears[gear].body_name).unwrap_or(0);
            machine.meshes.push(GearMesh {
                links: mesh.gears.map(body),
                joint: mesh.moved - 1,
                copy: 0,
                pressure_angle: Some(pair.design().tool.pressure_angle()),
            });
        }
        self.add_points(&mut machine);
        self.draw(&mut machine);
        self.list(&mut machine)?;
        Ok(machine)
    }

    /// Lists the plates, gears and cams as parts, each with the files of its name; copies are pieces of one part.
    fn list(&self, machine: &mut Machine) -> Result<(), SolidError> {
        for (index, body) in self.bodies.iter().enumerate() {
            let Some(solid) = self.plate(index)? else {
                continue;
            };
            let part = Part {
                name: body.name.clone(),
                mass: Some(solid.mass_properties(self.design.plates.density).mass),
                ..Part::default()
            };
            self.add_part(machine, part, (&body.name, &solid));
        }
        for gear in &self.gears {
            let solid = gear.solid(self.gear_bottom(gear))?;
            let own = gear.gear();
            let part = Part {
                name: gear.name.clone(),
                material: own.body().material.clone(),
                mass: Some(solid.mass_properties(own.body().density).mass),
                remark: format!("{} teeth", own.tooth_count()),
                ..Part::default()
            };
            self.add_part(machine, part, (&gear.body_name, &solid));
        }
        for cam in &self.cams {
            let solid = cam.solid(self.cam_bottom(cam))?;
            let own = cam.part.body();
            let part = Part {
                name: cam.name.clone(),
                material: own.material.clone(),
                mass: Some(solid.mass_properties(own.density).mass),
                remark: format!("moves {}", cam.followers.join(", ")),
                ..Part::default()
            };
            self.add_part(machine, part, (&cam.body_name, &solid));
        }
        Ok(())
    }

    /// Lists a part of a body; a copy is one more piece of the original.
    fn add_part(&self, machine: &mut Machine, part: Part, (body, solid): (&str, &Solid)) {
        let link = self.body_named(body);
        let original = self.original(&part.name);
        if let Some(listed) = machine.parts.iter_mut().find(|part| part.name == original) {
            listed.links.extend(link);
            return;
        }
        machine.part(Part {
            links: link.into_iter().collect(),
            file: part.name.clone(),
            place: machine.place_on_edge(body, solid.outline()),
            ..part
        });
    }

    /// Adds a body with its plate: shape, mass, surface to touch with.
    fn add_link(&self, machine: &mut Machine, body: usize) -> Result<(), SolidError> {
        let name = &self.bodies[body].name;
        let mut link = Link {
            name: name.clone(),
            ..Link::default()
        };
        let (mut solids, mut masses) = (Vec::new(), Vec::new());
        if let Some(solid) = self.plate(body)? {
            masses.push(solid.mass_properties(self.design.plates.density));
            link.surfaces.push(machine.surface(Surface {
                name: name.clone(),
                outline: solid.outline().clone(),
                span: [solid.bottom(), solid.top()],
                teeth: Vec::new(),
                coarseness: 1.0,
            }));
            solids.push(solid);
        }
        for gear in self.gears.iter().filter(|gear| gear.body_name == *name) {
            let solid = gear.solid(self.gear_bottom(gear))?;
            masses.push(solid.mass_properties(gear.gear().body().density));
            link.surfaces.push(machine.surface(gear.surface(&solid)));
            solids.push(solid);
        }
        for cam in self.cams.iter().filter(|cam| cam.body_name == *name) {
            let solid = cam.solid(self.cam_bottom(cam))?;
            masses.push(solid.mass_properties(cam.part.body().density));
            link.surfaces.push(machine.surface(cam.surface(&solid)));
            solids.push(solid);
        }
        if !solids.is_empty() {
            link.mass = MassProperties::together(&masses);
            link.shape = Some(machine.shape(Shape {
                name: format!("links/{name}"),
                part: String::new(),
                form: Form::Solids(solids),
            }));
        }
        machine.link(link);
        Ok(())
    }

    fn add_joint(&self, machine: &mut Machine, body: usize, carrier: usize) {
        let ComposedBody { name, mount, .. } = &self.bodies[body];
        let Some(mount) = mount else {
            return;
        };
        let joint = match mount.kind {
            JointKind::Fixed => Joint::fixed(carrier, body),
            JointKind::Turning => Joint::turning(carrier, body, mount.law.clone()),
            JointKind::Sliding(range) => {
                let along = ([1.0, 0.0, 0.0], range);
                Joint::sliding(carrier, body, along, mount.law.clone())
            }
        };
        let at = [mount.at.x, mount.at.y, 0.0];
        let joint = joint.at(at).turned([0.0, 0.0, mount.angle]);
        let joint = machine.joint(joint);
        let carrier = &self.bodies[carrier].name;
        let (unit, meaning) = match mount.kind {
            JointKind::Fixed => return,
            JointKind::Turning => ("rad", format!("angle of {name} against {carrier}")),
            JointKind::Sliding(_) => ("mm", format!("place of {name} along {carrier}")),
        };
        let column = format!("{}_joint_{unit}", name.replace('-', "_"));
        machine.column(&column, unit, &meaning, Quantity::joint(joint));
    }

    fn add_points(&self, machine: &mut Machine) {
        for (name, body, at) in self.points().filter(|(_, body, _)| *body > 0) {
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

    /// Draws every body, and the ways of the points on which nothing is held.
    fn draw(&self, machine: &mut Machine) {
        let followed = self.followed();
        let traced: Vec<usize> = (0..machine.points.len())
            .filter(|&point| followed.contains(&machine.points[point].name))
            .collect();
        for (index, body) in self.bodies.iter().enumerate() {
            let mut lines = Vec::new();
            if let Some((outline, holes)) = self.contours(index) {
                lines.push(Line::contour(LineRole::Body, &outline));
                lines.extend(holes.iter().map(|hole| Line::contour(LineRole::Hole, hole)));
            }
            let gears = self.gears.iter().filter(|gear| gear.body_name == body.name);
            lines.extend(gears.flat_map(|gear| gear.lines()));
            let cams = self.cams.iter().filter(|cam| cam.body_name == body.name);
            lines.extend(cams.flat_map(ComposedCam::lines));
            let roller = self.roller(&body.name);
            lines.extend(roller.map(|roller| Line::contour(LineRole::Body, &roller)));
            if index == 0 {
                let ways = traced.iter();
                lines.extend(ways.map(|&point| Line::trace(LineRole::Trace, point)));
            }
            let sketch = machine.sketch(&body.name, lines);
            machine.draw(&body.name, index, sketch);
        }
        // Links are drawn in their own order.
        let marks = self
            .points()
            .map(|(name, figure, at): (String, usize, Point)| Mark {
                name: name.rsplit('.').next().unwrap_or_default().to_owned(),
                figure,
                at: at.coords.into(),
            });
        machine.marks.extend(marks);
    }
}
