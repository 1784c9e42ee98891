use std::collections::BTreeMap;
use std::sync::Arc;

use centrode_geometry::{Point, extremes, pieces};

use super::design::FRAME;
use super::points::{BodyPoints, Reference, points_of};
use super::{
    Composed, ComposedBody, ComposedDesign, ComposedDyad, ComposedDyadSpec, ComposedError, Mount,
    Pin,
};
use crate::composed::DyadKind;
use crate::linkage::{Branch, Coordinate, Joint, Line, Link, Linkage, LinkageError, NotClosing};
use crate::transmission::Transmission;

/// Parts of a cycle in each of which a slide has few extremes.
const PARTS: u32 = 8;

/// Body or dyad to build, in whatever order its needs allow.
#[derive(Clone, Copy)]
enum Node<'a> {
    Body(&'a str),
    Dyad(&'a str, &'a ComposedDyadSpec),
}

/// A composed machine under construction.
struct Builder<'a> {
    design: &'a ComposedDesign,
    points: BodyPoints,
    linkage: Linkage,
    /// Bodies in the order of building, and those that dyads have yet to be followed for.
    bodies: Vec<ComposedBody>,
    dyads: Vec<ComposedDyad>,
    pins: Vec<Pin>,
    /// Joints whose motion follows from the closed linkage, by the body they carry, and the key that holds it.
    followed: Vec<(usize, Coordinate, String)>,
}

impl Composed {
    /// Resolves a design: bodies in the order in which they need each other, whatever their order in the file.
    ///
    /// # Errors
    /// [`ComposedError`] naming the key at fault.
    pub fn resolve(design: &ComposedDesign) -> Result<Self, ComposedError> {
        design.validate()?;
        holders(design)?;
        let mut builder = Builder {
            points: points_of(design)?,
            linkage: Linkage::with_turns(design.input.turns),
            bodies: vec![ComposedBody {
                name: FRAME.into(),
                link: Link::FRAME,
                mount: None,
            }],
            dyads: Vec::new(),
            pins: Vec::new(),
            followed: Vec::new(),
            design,
        };
        builder.build()?;
        builder.follow()?;
        Ok(Self {
            design: design.clone(),
            linkage: builder.linkage,
            bodies: builder.bodies,
            dyads: builder.dyads,
            pins: builder.pins,
            points: builder.points,
        })
    }
}

/// Checks that every body is held, and by one key.
fn holders(design: &ComposedDesign) -> Result<(), ComposedError> {
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
            return Err(ComposedError::HeldTwice { key, body, by });
        }
    }
    match design.bodies.keys().find(|name| !held.contains_key(*name)) {
        Some(body) => Err(ComposedError::Loose { body: body.clone() }),
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
    /// Builds everything, each as soon as what it needs is there.
    fn build(&mut self) -> Result<(), ComposedError> {
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
            let there = |body: &String| self.bodies.iter().any(|b| b.name == *body);
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

    /// Bodies that must be there before a node, each found with the point that is named.
    fn needs(&self, node: &Node<'_>) -> Result<Vec<String>, ComposedError> {
        let key = node.key();
        let words: Vec<(&str, &String)> = match node {
            Node::Body(name) => {
                let body = &self.design.bodies[*name];
                let on = body.on.iter().map(|on| ("on", on));
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
            let key = format!("{key}.{word_key}");
            let reference = match word_key {
                "fixed_to" => Reference::to_body(word),
                _ => Reference::to_point(&key, word)?,
            };
            reference.find(&key, &self.points)?;
            bodies.push(reference.body);
        }
        Ok(bodies)
    }

    /// The bodies that wait for each other.
    fn ring(&self, left: &[Node<'_>], needs: &[Vec<String>]) -> ComposedError {
        let makes = |node: &Node<'_>, body: &String| match node {
            Node::Body(name) => name == body,
            Node::Dyad(_, dyad) => dyad.bodies.contains(body),
        };
        // From node to a node it waits for, until one comes again.
        let (mut way, mut at) = (Vec::new(), 0);
        while !way.contains(&at) {
            way.push(at);
            let there = |body: &&String| !self.bodies.iter().any(|b| b.name == **body);
            let missing = needs[at].iter().find(there);
            let maker = missing.and_then(|body| left.iter().position(|node| makes(node, body)));
            at = maker.unwrap_or(at);
        }
        let start = way.iter().position(|step| *step == at).unwrap_or(0);
        ComposedError::Ring {
            key: left[at].key(),
            names: way[start..].iter().map(|step| left[*step].key()).collect(),
        }
    }

    /// A point of a body that is there: the body's index, the place in its axes.
    fn place(&self, key: &str, word: &str) -> Result<(usize, Point), ComposedError> {
        let reference = Reference::to_body(word);
        let at = reference.find(key, &self.points)?;
        let index = self.bodies.iter().position(|b| b.name == reference.body);
        Ok((index.unwrap_or(0), at))
    }

    fn line(&self, key: &str, word: &str, angle: f64) -> Result<(usize, Line), ComposedError> {
        let (body, through) = self.place(key, word)?;
        let link = self.bodies[body].link;
        Ok((
            body,
            Line {
                link,
                through,
                angle,
            },
        ))
    }

    fn joint(&mut self, key: &str, word: &str) -> Result<(usize, Point, Joint), ComposedError> {
        let (body, at) = self.place(key, word)?;
        let joint = self.linkage.point(self.bodies[body].link, at);
        Ok((body, at, joint.map_err(blame(key))?))
    }

    fn push(&mut self, name: &str, link: Link, mount: Mount) -> usize {
        self.bodies.push(ComposedBody {
            name: name.into(),
            link,
            mount: Some(mount),
        });
        self.bodies.len() - 1
    }

    fn add_body(&mut self, name: &str) -> Result<(), ComposedError> {
        let design = self.design;
        let body = &design.bodies[name];
        if let Some(to) = &body.fixed_to {
            let key = format!("bodies.{name}.fixed_to");
            let angle = body.turned.unwrap_or(0.0);
            let (carrier, line) = self.line(&key, to, angle)?;
            let link = self.linkage.fixed(line).map_err(blame(&key))?;
            self.push(name, link, Mount::fixed(carrier, line.through, angle));
            return Ok(());
        }
        let (Some(on), Some(law)) = (&body.on, &body.law) else {
            return Ok(());
        };
        let key = format!("bodies.{name}.on");
        let law = law.resolve(design.input.turns, body.slides.is_some());
        let law = law.map_err(|error| ComposedError::Law {
            body: name.into(),
            error,
        })?;
        if let Some(angle) = body.slides {
            let (carrier, line) = self.line(&key, on, angle)?;
            let link = self.linkage.sliding(line, Arc::clone(&law));
            let link = link.map_err(blame(&key))?;
            let range = range(law.as_ref(), &self.linkage);
            self.push(name, link, Mount::sliding(carrier, &line, law, range));
        } else {
            let (carrier, at, joint) = self.joint(&key, on)?;
            let link = self.linkage.turning(joint, Arc::clone(&law));
            self.push(
                name,
                link.map_err(blame(&key))?,
                Mount::turning(carrier, at, law),
            );
        }
        Ok(())
    }

    fn add_dyad(&mut self, name: &str, dyad: &ComposedDyadSpec) -> Result<(), ComposedError> {
        let key = format!("dyads.{name}");
        let word = |word: &Option<String>| word.clone().unwrap_or_default();
        let [from_key, to_key] = ["from", "to"].map(|end| format!("{key}.{end}"));
        let branch = match dyad.side.map(super::Side::sign) {
            Some(sign) if sign < 0.0 => Branch::Lower,
            _ => Branch::Upper,
        };
        let wrong = blame(&key);
        let [first, second] = [&dyad.bodies[0], &dyad.bodies[1]];
        let angle = dyad.direction.unwrap_or(0.0);
        let origin = Point::origin();
        let length = |i: usize| dyad.lengths.get(i).copied().unwrap_or(0.0);
        let made = match dyad.kind {
            DyadKind::TwoBars => {
                let (from, p_at, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (to, q_at, q) = self.joint(&to_key, &word(&dyad.to))?;
                let bars = self.linkage.rrr(p, q, (length(0), length(1)), branch);
                let bars = bars.map_err(wrong)?;
                let one = self.turning(&key, (first, bars.first), from, p_at);
                let other = self.turning(&key, (second, bars.second), to, q_at);
                self.pins
                    .push(Pin::new([one, other], Point::new(length(0), 0.0)));
                [one, other]
            }
            DyadKind::BarAndSlider => {
                let (from, at, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (guide, line) = self.line(&format!("{key}.line"), &word(&dyad.line), angle)?;
                let made = self
                    .linkage
                    .rrp(p, length(0), line, branch)
                    .map_err(wrong)?;
                let bar = self.turning(&key, (first, made.link), from, at);
                let block = self.sliding(&key, (second, made.block), guide, line);
                self.pins
                    .push(Pin::new([bar, block], Point::new(length(0), 0.0)));
                [bar, block]
            }
            DyadKind::GuideThroughBlock => {
                let (from, _, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (to, at, q) = self.joint(&to_key, &word(&dyad.to))?;
                let offset = dyad.offset.unwrap_or(0.0);
                let made = self.linkage.rpr(p, q, offset, branch).map_err(wrong)?;
                let guide = self.turning(&key, (second, made.link), to, at);
                let line = Line {
                    link: made.link,
                    through: Point::new(0.0, offset),
                    angle: 0.0,
                };
                let block = self.sliding(&key, (first, made.block), guide, line);
                self.pins.push(Pin::new([block, from], origin));
                [block, guide]
            }
            DyadKind::TwoSliders => {
                let turn = dyad.second_direction.unwrap_or(0.0);
                let (guide, line) = self.line(&format!("{key}.line"), &word(&dyad.line), angle)?;
                let second_key = format!("{key}.second_line");
                let (other, across) = self.line(&second_key, &word(&dyad.second_line), turn)?;
                let made = self.linkage.prp(line, across).map_err(wrong)?;
                let block = self.sliding(&key, (first, made.block), guide, line);
                let mate = self.sliding(&key, (second, made.link), other, across);
                self.pins.push(Pin::new([block, mate], origin));
                [block, mate]
            }
            DyadKind::Yoke => {
                let slot = dyad.slot.unwrap_or(0.0);
                let (from, _, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (guide, line) = self.line(&format!("{key}.line"), &word(&dyad.line), angle)?;
                let made = self.linkage.rpp(p, line, slot).map_err(wrong)?;
                let yoke = self.sliding(&key, (second, made.link), guide, line);
                let along = Line {
                    link: made.link,
                    through: origin,
                    angle: slot,
                };
                let block = self.sliding(&key, (first, made.block), yoke, along);
                self.pins.push(Pin::new([block, from], origin));
                [block, yoke]
            }
        };
        self.dyads.push(ComposedDyad {
            name: name.into(),
            kind: dyad.kind,
            bodies: made,
        });
        Ok(())
    }

    /// Adds a body of a dyad that turns on a pin; its motion is followed when all is built.
    fn turning(
        &mut self,
        key: &str,
        (name, link): (&str, Link),
        carrier: usize,
        at: Point,
    ) -> usize {
        let against = self.bodies[carrier].link;
        let law = Arc::new(crate::machine::Constant(0.0));
        let body = self.push(name, link, Mount::turning(carrier, at, law));
        let of = Coordinate::Angle { link, against };
        self.followed.push((body, of, key.into()));
        body
    }

    /// Adds a body of a dyad that slides along a line; its motion is followed when all is built.
    fn sliding(
        &mut self,
        key: &str,
        (name, link): (&str, Link),
        carrier: usize,
        line: Line,
    ) -> usize {
        let law = Arc::new(crate::machine::Constant(0.0));
        let body = self.push(name, link, Mount::sliding(carrier, &line, law, [0.0; 2]));
        let of = Coordinate::Along { link, line };
        self.followed.push((body, of, key.into()));
        body
    }

    /// Follows the joints of the dyads over the cycle, over which all of them must close.
    fn follow(&mut self) -> Result<(), ComposedError> {
        if let Some(NotClosing {
            dyad,
            open,
            input,
            missing,
        }) = self.linkage.not_closing()
        {
            return Err(ComposedError::DoesNotClose {
                dyad: self.dyads[dyad].name.clone(),
                open,
                input,
                missing,
            });
        }
        for (body, of, key) in std::mem::take(&mut self.followed) {
            let found = self.linkage.coordinate(of);
            let law = found.map_err(|error| match error {
                LinkageError::NoDirection { input, .. } => ComposedError::NoDirection {
                    key: key.clone(),
                    body: self.bodies[body].name.clone(),
                    input,
                },
                error => blame(&key)(error),
            })?;
            let range = range(&law, &self.linkage);
            if let Some(mount) = &mut self.bodies[body].mount {
                mount.follow(Arc::new(law), range);
            }
        }
        Ok(())
    }
}

/// Least and greatest value of a law over the cycle.
fn range(law: &dyn Transmission, linkage: &Linkage) -> [f64; 2] {
    let ends = pieces(0.0, linkage.period(), PARTS, linkage.breaks());
    extremes(|input| law.at(input).position, &ends).map(|extreme| extreme.value)
}

fn blame(key: &str) -> impl Fn(LinkageError) -> ComposedError {
    let key = key.to_owned();
    move |error| ComposedError::Linkage {
        key: key.clone(),
        error,
    }
}
