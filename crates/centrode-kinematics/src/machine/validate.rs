use super::{Arrangement, JointKind, LinePath, LinkedMachine, Load, Quantity, Seat};

/// Reason why a machine is not valid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkedMachineError {
    /// A reference to an item that does not exist.
    #[error("{from} refers to {kind} {index}, but the number of such items is {count}")]
    Missing {
        /// Item that contains the reference.
        from: String,
        /// Kind of the item referred to.
        kind: &'static str,
        /// Index of the item referred to.
        index: usize,
        /// Number of items of this kind.
        count: usize,
    },
    /// A link is not connected to the first link by exactly one chain of joints.
    #[error(
        "link {link:?} must be connected to the first link by exactly one chain of joints, not by {ways}"
    )]
    Tree {
        /// The link.
        link: String,
        /// Number of chains; 0 may mean a ring.
        ways: usize,
    },
    /// A number that is not permitted.
    #[error("{what} must not be {value}")]
    Number {
        /// The number.
        what: String,
        /// Its value.
        value: f64,
    },
}

impl LinkedMachine {
    /// Checks that all references are valid, that the joints make the links a tree, and that numbers are finite.
    ///
    /// # Errors
    /// [`LinkedMachineError`] with the first error found.
    pub fn validate(&self) -> Result<(), LinkedMachineError> {
        for (what, value) in [("period", self.input.period), ("speed", self.input.speed)] {
            if !(value > 0.0 && value.is_finite()) {
                let what = format!("the {what} of the input");
                return Err(LinkedMachineError::Number { what, value });
            }
        }
        for (from, kind, index) in self.named() {
            let count = match kind {
                "link" => self.links.len(),
                "joint" => self.joints.len(),
                "shape" => self.shapes.len(),
                "surface" => self.surfaces.len(),
                "point" => self.points.len(),
                "sketch" => self.sketches.len(),
                "figure" => self.figures.len(),
                _ => self.columns.len(),
            };
            if index >= count {
                return Err(LinkedMachineError::Missing {
                    from,
                    kind,
                    index,
                    count,
                });
            }
        }
        for joint in &self.joints {
            let range = match joint.kind {
                JointKind::Sliding(range) => range,
                JointKind::Fixed | JointKind::Turning => [0.0; 2],
            };
            let [origin, turn, axis] = [joint.origin, joint.turn, joint.axis];
            let numbers = [origin, turn, axis].concat().into_iter().chain(range);
            if let Some(value) = numbers.into_iter().find(|number| !number.is_finite()) {
                let what = format!(
                    "a number of the joint of {:?}",
                    self.links[joint.child].name
                );
                return Err(LinkedMachineError::Number { what, value });
            }
        }
        self.bears_soundly()?;
        for part in &self.parts {
            if let Some(value) = part.mass.filter(|mass| !(*mass >= 0.0 && mass.is_finite())) {
                let what = format!("the mass of the part {:?}", part.name);
                return Err(LinkedMachineError::Number { what, value });
            }
        }
        let value = self.arrangement.input;
        if !value.is_finite() {
            let what = "the input of the arrangement".into();
            return Err(LinkedMachineError::Number { what, value });
        }
        self.is_tree()
    }

    /// Checks the numbers of gravity, loads, mounted bodies, meshes, contacts and guides.
    fn bears_soundly(&self) -> Result<(), LinkedMachineError> {
        let finite = |value: &f64| value.is_finite();
        let positive = |value: &f64| *value >= 0.0 && value.is_finite();
        let acute = |angle: &f64| angle.abs() < std::f64::consts::FRAC_PI_2;
        type Rule<'a> = &'a dyn Fn(&f64) -> bool;
        let mut all: Vec<(&str, &[f64], Rule<'_>)> = vec![("gravity", &self.gravity, &finite)];
        for load in &self.loads {
            all.push(("a number of a load", load.numbers(), &finite));
            if let Load::Mass { mass, .. } = load {
                all.push(("the mass of a load", std::slice::from_ref(mass), &positive));
            }
        }
        for body in self.links.iter().flat_map(|link| &link.mounted) {
            all.push(("the position of a body", &body.at, &finite));
            all.push(("the rotation of a body", &body.turn, &finite));
        }
        for mesh in &self.meshes {
            let angle = mesh.pressure_angle.as_slice();
            all.push(("the pressure angle of a mesh", angle, &acute));
            all.push(("the axis of a gear", mesh.axes.as_flattened(), &finite));
            if let Some(pitch) = &mesh.pitch {
                let zero = std::slice::from_ref(&pitch.zero);
                all.push(("the zero angle of a mesh's pitch curves", zero, &finite));
            }
        }
        for contact in &self.contacts {
            all.push(("the position of a contact", &contact.at, &finite));
            let normal = contact.normal.as_ref().map_or(&[][..], |normal| normal);
            all.push(("the normal of a contact", normal, &finite));
        }
        for guide in &self.guides {
            let (radius, friction) = (&guide.radius, &guide.friction);
            all.push((
                "the radius of a guide",
                std::slice::from_ref(radius),
                &positive,
            ));
            all.push((
                "the friction of a guide",
                std::slice::from_ref(friction),
                &positive,
            ));
        }
        for (what, values, good) in all {
            if let Some(&value) = values.iter().find(|value| !good(value)) {
                let what = what.into();
                return Err(LinkedMachineError::Number { what, value });
            }
        }
        Ok(())
    }

    /// Every reference by index: the item that contains it, the kind referred to, and the index.
    fn named(&self) -> Vec<(String, &'static str, usize)> {
        let mut all = Vec::new();
        for link in &self.links {
            let from = || format!("link {:?}", link.name);
            all.extend(link.bodies().map(|(shape, _)| (from(), "shape", shape)));
            all.extend(link.surfaces.iter().map(|&s| (from(), "surface", s)));
        }
        for (index, joint) in self.joints.iter().enumerate() {
            let from = || format!("joint {index}");
            all.extend([joint.parent, joint.child].map(|link| (from(), "link", link)));
            all.extend(joint.leader.map(|leader| (from(), "joint", leader)));
            all.extend(joint.load.map(|load| (from(), "column", load)));
        }
        for closure in &self.closures {
            all.extend(closure.links.map(|link| ("a closure".into(), "link", link)));
            all.extend(
                closure
                    .joints
                    .map(|joint| ("a closure".into(), "joint", joint)),
            );
        }
        for mesh in &self.meshes {
            all.extend(mesh.links.map(|link| ("a mesh".into(), "link", link)));
            all.push(("a mesh".into(), "joint", mesh.joint));
        }
        for contact in &self.contacts {
            all.extend(contact.links.map(|link| ("a contact".into(), "link", link)));
            all.push(("a contact".into(), "joint", contact.joint));
        }
        all.extend(
            self.guides
                .iter()
                .map(|guide| ("a guide".into(), "joint", guide.joint)),
        );
        for load in &self.loads {
            let (kind, index) = match *load {
                Load::Force { link, .. } | Load::Torque { link, .. } | Load::Mass { link, .. } => {
                    ("link", link)
                }
                Load::Joint { joint, .. } => ("joint", joint),
            };
            all.push(("a load".into(), kind, index));
            all.extend(load.sizes().iter().filter_map(|size| size.named("a load")));
        }
        for point in &self.points {
            all.push((format!("point {:?}", point.name), "link", point.link));
        }
        for column in &self.columns {
            all.extend(column.quantity.named(&format!("column {:?}", column.name)));
        }
        for sketch in &self.sketches {
            let from = || format!("sketch {:?}", sketch.name);
            let traced = sketch.lines.iter().filter_map(|line| match line.path {
                LinePath::Trace(point) => Some((from(), "point", point)),
                LinePath::Contour(_) | LinePath::Chain(_) => None,
            });
            all.extend(traced);
        }
        for figure in &self.figures {
            let from = format!("figure {:?}", figure.name);
            match &figure.seat {
                Seat::Link(link) => all.push((from.clone(), "link", *link)),
                Seat::Free(by) => all.extend(by.iter().filter_map(|q| q.named(&from))),
            }
            all.push((from, "sketch", figure.sketch));
        }
        for mark in &self.marks {
            all.push((format!("mark {:?}", mark.name), "figure", mark.figure));
        }
        all.extend(self.listed());
        all
    }

    /// References by index in the parts list and the arrangement.
    fn listed(&self) -> Vec<(String, &'static str, usize)> {
        let mut all = Vec::new();
        for part in &self.parts {
            let from = || format!("part {:?}", part.name);
            all.extend(part.links.iter().map(|&link| (from(), "link", link)));
            all.extend(part.place.map(|place| (from(), "figure", place.figure)));
        }
        let Arrangement {
            dimensions,
            callouts,
            seen_through,
            columns,
            ..
        } = &self.arrangement;
        let ends = dimensions.iter().flat_map(|dimension| dimension.ends);
        let places = ends.chain(callouts.iter().map(|callout| callout.place));
        let from = || "the arrangement".to_owned();
        all.extend(places.map(|place| (from(), "figure", place.figure)));
        all.extend(
            seen_through
                .iter()
                .map(|&figure| (from(), "figure", figure)),
        );
        all.extend(columns.iter().map(|&column| (from(), "column", column)));
        all
    }

    fn is_tree(&self) -> Result<(), LinkedMachineError> {
        let ends: Vec<[usize; 2]> = self.joints.iter().map(|j| [j.parent, j.child]).collect();
        match loose_link(self.links.len(), &ends) {
            None => Ok(()),
            Some((link, ways)) => Err(LinkedMachineError::Tree {
                link: self.links[link].name.clone(),
                ways,
            }),
        }
    }
}

impl Quantity {
    /// Kind and index of the joint or point that it refers to, with the item `from` that contains it; `None` for others.
    fn named(&self, from: &str) -> Option<(String, &'static str, usize)> {
        let (kind, index) = match *self {
            Self::Joint { joint, .. } => ("joint", joint),
            Self::Point { point, .. } | Self::PointSpeed { point, .. } => ("point", point),
            Self::Input(_) | Self::Law(_) => return None,
        };
        Some((from.into(), kind, index))
    }
}

/// The first link that is not connected to link 0 by exactly one chain of joints, and the number of its chains: 0 may mean a
/// ring. Each joint is given by its parent and child.
fn loose_link(links: usize, joints: &[[usize; 2]]) -> Option<(usize, usize)> {
    (0..links).find_map(|link| {
        let carriers = joints.iter().filter(|[_, child]| *child == link).count();
        let ways = carriers + usize::from(link == 0);
        if ways != 1 {
            return Some((link, ways));
        }
        // Links that are each carried once but never lead to the first one form a ring.
        let (mut at, mut steps) = (link, 0);
        while let Some([parent, _]) = joints.iter().find(|[_, child]| *child == at) {
            (at, steps) = (*parent, steps + 1);
            if steps > joints.len() {
                return Some((link, 0));
            }
        }
        None
    })
}
