use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use super::body::points::{BodyPoint, BodyPoints, Reference, followed_cam, points_of};
use super::build::range;
use super::copies::expansion::Expansion;
use super::design::FRAME;
use super::gears::gearing::{Meshing, gears_of};
use super::hardware::plates::drawn;
use super::{
    Hardware, Machine, MachineBody, MachineCam, MachineDesign, MachineDyad, MachineDyadSpec,
    MachineError, MachineFigure, MachineGear, Over, Pin,
};
use centrode_kinematics::linkage::{Coordinate, LinkId, Linkage, LinkageError, NotClosing};
use centrode_kinematics::machine::JointKind;
use centrode_kinematics::transmission::Remembered;

/// Body or dyad to build, in any order that its needs allow.
#[derive(Clone, Copy)]
enum Node<'a> {
    Body(&'a str),
    Dyad(&'a str, &'a MachineDyadSpec),
}

/// A composed machine under construction.
#[derive(Clone)]
pub(super) struct Builder<'a> {
    pub(super) design: &'a MachineDesign,
    /// Names of copies and their originals, and the inputs by which laws run ahead.
    pub(super) expansion: &'a Expansion,
    /// The machine without its copies, if it has any: ranges of slides and cams of the copies are taken from it.
    pub(super) bare: Option<&'a Machine>,
    pub(super) points: BodyPoints,
    pub(super) linkage: Linkage,
    /// Bodies in the order of building; those that dyads make get their motion later.
    pub(super) bodies: Vec<MachineBody>,
    pub(super) dyads: Vec<MachineDyad>,
    pub(super) pins: Vec<Pin>,
    pub(super) gears: Vec<MachineGear>,
    pub(super) meshes: Vec<Meshing>,
    /// Cams that already have a follower.
    pub(super) cams: BTreeMap<String, MachineCam>,
    /// Joints whose motion follows from the closed linkage: the body they carry, its coordinate, and the key of the dyad.
    pub(super) followed: Vec<(usize, Coordinate, String)>,
}

impl Machine {
    /// Resolves a design: bodies are built in the order in which they depend on each other, not in the order of the file.
    ///
    /// # Errors
    /// [`MachineError`] with the key at fault.
    pub fn resolve(design: &MachineDesign) -> Result<Self, MachineError> {
        design.validate()?;
        // The order of a file is for readers: it must not move a plate to another layer.
        let mut sorted = design.clone();
        sorted.sort_parts();
        if !design.copies.is_empty() {
            return Self::with_copies(&sorted, design);
        }
        let none = Expansion::default();
        let mut builder = Builder::assembled(&sorted, &none, None)?;
        builder.cut_cams()?;
        builder.finished(design)
    }
}

/// Checks that every body is held, and by one key only.
fn holders(design: &MachineDesign) -> Result<(), MachineError> {
    let of_bodies = design.bodies.iter().flat_map(|(name, body)| {
        let keys = [
            ("on", body.on.is_some()),
            ("fixed_to", body.fixed_to.is_some()),
        ];
        let given = keys.into_iter().filter(|(_, given)| *given);
        given.map(move |(key, _)| (name, format!("bodies.{name}.{key}")))
    });
    let of_dyads = design.dyads.iter().flat_map(|(name, dyad)| {
        let bodies = dyad.bodies.iter();
        bodies.map(move |body| (body, format!("dyads.{name}.bodies")))
    });
    let mut held = BTreeMap::from([(FRAME.to_owned(), FRAME.to_owned())]);
    for (body, key) in of_bodies.chain(of_dyads) {
        if let Some(by) = held.insert(body.clone(), key.clone()) {
            let body = body.clone();
            return Err(MachineError::HeldTwice { key, body, by });
        }
    }
    match design.bodies.keys().find(|name| !held.contains_key(*name)) {
        Some(body) => Err(MachineError::Loose { body: body.clone() }),
        None => Ok(()),
    }
}

impl Node<'_> {
    fn key(&self) -> String {
        match self {
            Self::Body(name) => format!("bodies.{name}"),
            Self::Dyad(name, _) => format!("dyads.{name}"),
        }
    }
}

impl<'a> Builder<'a> {
    /// Bodies and dyads of a design with their motion, without the cams that are cut to this motion. If the copies of the design
    /// are written out, `bare` is the machine without them.
    pub(super) fn assembled(
        design: &'a MachineDesign,
        expansion: &'a Expansion,
        bare: Option<&'a Machine>,
    ) -> Result<Self, MachineError> {
        holders(design)?;
        let points = points_of(design, expansion)?;
        let mut builder = Self {
            gears: gears_of(design, &points)?,
            meshes: Vec::new(),
            cams: BTreeMap::new(),
            points,
            linkage: Linkage::with_turns(design.input.turns),
            bodies: vec![MachineBody {
                name: FRAME.into(),
                link: LinkId::FRAME,
                mount: None,
            }],
            dyads: Vec::new(),
            pins: Vec::new(),
            followed: Vec::new(),
            expansion,
            bare,
            design,
        };
        builder.build()?;
        builder.follow()?;
        Ok(builder)
    }

    /// The machine as far as it is built, not checked.
    pub(super) fn so_far(self, written: &MachineDesign) -> Machine {
        Machine {
            written: written.clone(),
            design: self.design.clone().into(),
            linkage: self.linkage,
            bodies: self.bodies,
            dyads: self.dyads,
            pins: self.pins,
            points: self.points,
            drawn: BTreeMap::new(),
            figures: Vec::new(),
            gears: self.gears,
            meshes: self.meshes,
            cams: self.cams.into_values().collect(),
            expansion: self.expansion.clone(),
            loads: Vec::new(),
            obstacles: Vec::new(),
            shafts: OnceLock::new(),
            turned: OnceLock::new(),
            passage: OnceLock::new(),
            frame: OnceLock::new(),
        }
        .sized()
    }

    /// The machine with all its parts, checked.
    pub(super) fn finished(self, written: &MachineDesign) -> Result<Machine, MachineError> {
        self.check_loops()?;
        self.check_cams()?;
        let (design, loads) = (self.design, self.loads()?);
        let mut made = Machine {
            drawn: drawn(design)?,
            loads,
            ..self.so_far(written)
        };
        if design.hardware() != Hardware::None {
            made.check_sizes()?;
        }
        made.check_names()?;
        made.check_frame()?;
        made.check_drawn()?;
        made.obstacles = made.obstacles_of_design()?;
        let goals = design.goals.iter();
        let figures = goals.map(|(name, goal)| {
            let figure = made.figure(&format!("goals.{name}.figure"), &goal.figure)?;
            if matches!(figure, MachineFigure::Clearance(_)) && goal.over != Some(Over::Minimum) {
                let key = format!("goals.{name}.over");
                let why = "must be \"minimum\" for the figure clearance";
                return Err(MachineError::refused(key, why));
            }
            Ok(figure)
        });
        made.figures = figures.collect::<Result<_, MachineError>>()?;
        Ok(made)
    }

    /// Builds all bodies and dyads, each as soon as the bodies that it needs are built.
    fn build(&mut self) -> Result<(), MachineError> {
        let design = self.design;
        let held = design.bodies.iter();
        let held = held.filter(|(_, body)| body.on.is_some() || body.fixed_to.is_some());
        let bodies = held.map(|(name, _)| Node::Body(name));
        let dyads = design
            .dyads
            .iter()
            .map(|(name, dyad)| Node::Dyad(name, dyad));
        let mut left: Vec<Node<'a>> = bodies.chain(dyads).collect();
        let mut needs = Vec::new();
        for node in &left {
            needs.push(self.needs(node)?);
        }
        while !left.is_empty() {
            let there = |body: &String| self.body_named(body).is_some();
            let ready = needs.iter().position(|need| need.iter().all(there));
            let Some(next) = ready else {
                return Err(self.ring(&left, &needs));
            };
            needs.remove(next);
            match left.remove(next) {
                Node::Body(name) => self.add_body(name)?,
                Node::Dyad(name, dyad) => self.add_dyad(name, dyad)?,
            }
        }
        Ok(())
    }

    /// Bodies that must be built before a node. Checks that every point that the node names exists.
    fn needs(&self, node: &Node<'_>) -> Result<Vec<String>, MachineError> {
        let key = node.key();
        let words: Vec<(&str, &String)> = match node {
            Node::Body(name) => {
                let body = &self.design.bodies[*name];
                let on = body
                    .on
                    .iter()
                    .map(|on| (if body.mesh.is_some() { "carrier" } else { "on" }, on));
                let fixed = body.fixed_to.iter().map(|to| ("fixed_to", to));
                on.chain(fixed).collect()
            }
            Node::Dyad(_, dyad) => {
                let words = [
                    ("from", &dyad.from),
                    ("to", &dyad.to),
                    ("line", &dyad.line),
                    ("second_line", &dyad.second_line),
                ];
                let given = words.into_iter();
                given
                    .filter_map(|(key, word)| Some((key, word.as_ref()?)))
                    .collect()
            }
        };
        let mut bodies = Vec::new();
        for (word_key, word) in words {
            let by_body = matches!(word_key, "fixed_to" | "carrier");
            let word_key = if word_key == "carrier" {
                "on"
            } else {
                word_key
            };
            let key = format!("{key}.{word_key}");
            let reference = match by_body {
                true => Reference::to_body(word),
                false => Reference::to_point(&key, word)?,
            };
            reference.find(&key, &self.points)?;
            bodies.push(reference.body);
        }
        if let Node::Body(name) = node
            && let Some(by) = self.design.bodies[*name]
                .law
                .as_ref()
                .and_then(|law| law.by.as_ref())
        {
            let reference = Reference::to_body(by);
            reference.find(&format!("{key}.law.by"), &self.points)?;
            bodies.push(reference.body);
        }
        if let Node::Body(name) = node
            && let Some(mesh) = &self.design.bodies[*name].mesh
        {
            let with = self.gear(&format!("{key}.mesh.with"), &mesh.with)?;
            bodies.push(self.gears[with].body_name.clone());
        }
        if let Node::Body(name) = node
            && let Some((_, cam)) = followed_cam(self.design, name, &self.design.bodies[*name])?
        {
            let about = cam.about.iter().map(|about| about.as_str());
            let seats = about.chain([cam.on.as_str()]);
            bodies.extend(seats.map(|word| Reference::to_body(word).body));
        }
        Ok(bodies)
    }

    /// The error of bodies that depend on each other.
    fn ring(&self, left: &[Node<'_>], needs: &[Vec<String>]) -> MachineError {
        let makes = |node: &Node<'_>, body: &String| match node {
            Node::Body(name) => name == body,
            Node::Dyad(_, dyad) => dyad.bodies.contains(body),
        };
        // From each node to a node on which it depends, until a node appears again.
        let (mut way, mut at) = (Vec::new(), 0);
        while !way.contains(&at) {
            way.push(at);
            let there = |body: &&String| self.body_named(body).is_none();
            let missing = needs[at].iter().find(there);
            let maker = missing.and_then(|body| left.iter().position(|node| makes(node, body)));
            at = maker.unwrap_or(at);
        }
        let start = way.iter().position(|step| *step == at).unwrap_or(0);
        MachineError::Ring {
            key: left[at].key(),
            names: way[start..].iter().map(|step| left[*step].key()).collect(),
        }
    }

    /// Index of a body that is already built.
    pub(super) fn body_named(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// A point of a body that is already built.
    pub(super) fn place(&self, key: &str, word: &str) -> Result<BodyPoint, MachineError> {
        let reference = Reference::to_body(word);
        let at = reference.find(key, &self.points)?;
        let body = self.body_named(&reference.body).unwrap_or(0);
        Ok(BodyPoint { body, at })
    }

    /// The machine without copies, and in it the index of the body, or of its original if the body is a copy.
    pub(super) fn original(&self, body: &str) -> Option<(&'a Machine, usize)> {
        let bare = self.bare?;
        Some((bare, bare.body_named(self.expansion.original(body))?))
    }

    /// Computes the motion of the dyads' joints over the cycle. All dyads must close at every input.
    pub(super) fn follow(&mut self) -> Result<(), MachineError> {
        let dyads = self.linkage.not_closing().into_iter();
        let dyads: Vec<(String, NotClosing)> = dyads
            .map(|found| (self.dyads[found.dyad].name.clone(), found))
            .collect();
        if !dyads.is_empty() {
            return Err(MachineError::DoesNotClose { dyads });
        }
        for (body, of, key) in std::mem::take(&mut self.followed) {
            let found = self.linkage.coordinate(of);
            let law = found.map_err(|error| match error {
                LinkageError::NoDirection { input, .. } => MachineError::NoDirection {
                    key: key.clone(),
                    body: self.bodies[body].name.clone(),
                    input,
                },
                error => blame(&key)(error),
            })?;
            let (linkage, original) = (&self.linkage, self.original(&self.bodies[body].name));
            let known =
                original.and_then(
                    |(bare, body)| match bare.bodies[body].mount.as_ref()?.kind {
                        JointKind::Sliding(range) => Some(range),
                        _ => None,
                    },
                );
            if let Some(mount) = &mut self.bodies[body].mount {
                let law = Arc::new(Remembered::new(law));
                mount.follow(law, |law| known.unwrap_or_else(|| range(law, linkage)));
            }
        }
        Ok(())
    }
}

pub(super) fn blame(key: &str) -> impl Fn(LinkageError) -> MachineError {
    let key = key.to_owned();
    move |error| MachineError::Linkage {
        key: key.clone(),
        error,
    }
}
