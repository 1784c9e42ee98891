use std::sync::Arc;

use centrode_geometry::{Point, extremes, piece_ends};

use super::copies::copying;
use super::resolve::{Builder, blame};
use super::{
    BodyPoint, DyadKind, MachineBody, MachineDyad, MachineDyadSpec, MachineError, MachineLawSpec,
    Mount, Pin, Side,
};
use centrode_kinematics::linkage::{Branch, Coordinate, JointId, Line, LinkId, Linkage};
use centrode_kinematics::machine::{Constant, JointKind};
use centrode_kinematics::transmission::Transmission;

/// Number of parts of a cycle; in each the motion of a slide has few extremes.
const PARTS: u32 = 8;

impl Builder<'_> {
    fn line(&self, key: &str, word: &str, angle: f64) -> Result<(usize, Line), MachineError> {
        let BodyPoint { body, at } = self.place(key, word)?;
        let line = Line {
            link: self.bodies[body].link,
            through: at,
            angle,
        };
        Ok((body, line))
    }

    fn joint(&mut self, key: &str, word: &str) -> Result<(usize, Point, JointId), MachineError> {
        let BodyPoint { body, at } = self.place(key, word)?;
        let joint = self.linkage.point(self.bodies[body].link, at);
        Ok((body, at, joint.map_err(blame(key))?))
    }

    pub(super) fn push(&mut self, name: &str, link: LinkId, mount: Mount) -> usize {
        self.bodies.push(MachineBody {
            name: name.into(),
            link,
            mount: Some(mount),
        });
        self.bodies.len() - 1
    }

    pub(super) fn add_body(&mut self, name: &str) -> Result<(), MachineError> {
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
        if let Some(mesh) = &body.mesh {
            return self.add_meshed(name, body, mesh);
        }
        let (Some(on), Some(law)) = (&body.on, &body.law) else {
            return Ok(());
        };
        let law = match &law.follows {
            Some(cam) => self.following(name, body, cam)?,
            None => self.law(name, law, body.slides.is_some())?,
        };
        let key = format!("bodies.{name}.on");
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

    /// Motion of a body that slides or turns by a law.
    fn law(
        &mut self,
        name: &str,
        law: &MachineLawSpec,
        slides: bool,
    ) -> Result<Arc<dyn Transmission>, MachineError> {
        let by = match &law.by {
            Some(by) => Some(self.turn_of(&format!("bodies.{name}.law.by"), by)?),
            None => None,
        };
        let law = law.resolve(self.design.input.turns, slides, by);
        let law = law.map_err(|error| MachineError::Law {
            body: name.into(),
            error,
        })?;
        Ok(self.ahead_of(name, law))
    }

    /// The law of a body: for a copy that runs ahead of its original the law shifted along the input, otherwise unchanged.
    pub(super) fn ahead_of(&self, name: &str, law: Arc<dyn Transmission>) -> Arc<dyn Transmission> {
        match self.expansion.ahead.get(name) {
            Some(&by) => copying::ahead(law, by),
            None => law,
        }
    }

    /// Turn of a body on its own pin; the body is already built.
    fn turn_of(&mut self, key: &str, name: &str) -> Result<Arc<dyn Transmission>, MachineError> {
        // The motions of dyads built before are needed.
        self.follow()?;
        let body = self.body_named(name);
        let mount = body.and_then(|body| self.bodies[body].mount.as_ref());
        match mount {
            Some(mount) if mount.kind == JointKind::Turning => Ok(Arc::clone(&mount.law)),
            _ => Err(MachineError::NoTurn {
                key: key.into(),
                body: name.into(),
            }),
        }
    }

    pub(super) fn add_dyad(
        &mut self,
        name: &str,
        dyad: &MachineDyadSpec,
    ) -> Result<(), MachineError> {
        let key = format!("dyads.{name}");
        let word = |word: &Option<String>| word.clone().unwrap_or_default();
        let [from_key, to_key] = ["from", "to"].map(|end| format!("{key}.{end}"));
        let branch = match dyad.side.map(Side::sign) {
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
                let one = self.turning(&key, first, bars.first, from, p_at);
                let other = self.turning(&key, second, bars.second, to, q_at);
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
                let bar = self.turning(&key, first, made.link, from, at);
                let block = self.sliding(&key, second, made.block, guide, line);
                self.pins
                    .push(Pin::new([bar, block], Point::new(length(0), 0.0)));
                [bar, block]
            }
            DyadKind::GuideThroughBlock => {
                let (from, _, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (to, at, q) = self.joint(&to_key, &word(&dyad.to))?;
                let offset = dyad.offset.unwrap_or(0.0);
                let made = self.linkage.rpr(p, q, offset, branch).map_err(wrong)?;
                let guide = self.turning(&key, second, made.link, to, at);
                let line = Line {
                    link: made.link,
                    through: Point::new(0.0, offset),
                    angle: 0.0,
                };
                let block = self.sliding(&key, first, made.block, guide, line);
                self.pins.push(Pin::new([block, from], origin));
                [block, guide]
            }
            DyadKind::TwoSliders => {
                let turn = dyad.second_direction.unwrap_or(0.0);
                let (guide, line) = self.line(&format!("{key}.line"), &word(&dyad.line), angle)?;
                let second_key = format!("{key}.second_line");
                let (other, across) = self.line(&second_key, &word(&dyad.second_line), turn)?;
                let made = self.linkage.prp(line, across).map_err(wrong)?;
                let block = self.sliding(&key, first, made.block, guide, line);
                let mate = self.sliding(&key, second, made.link, other, across);
                self.pins.push(Pin::new([block, mate], origin));
                [block, mate]
            }
            DyadKind::Yoke => {
                let slot = dyad.slot.unwrap_or(0.0);
                let (from, _, p) = self.joint(&from_key, &word(&dyad.from))?;
                let (guide, line) = self.line(&format!("{key}.line"), &word(&dyad.line), angle)?;
                let made = self.linkage.rpp(p, line, slot).map_err(wrong)?;
                let yoke = self.sliding(&key, second, made.link, guide, line);
                let along = Line {
                    link: made.link,
                    through: origin,
                    angle: slot,
                };
                let block = self.sliding(&key, first, made.block, yoke, along);
                self.pins.push(Pin::new([block, from], origin));
                [block, yoke]
            }
        };
        self.dyads.push(MachineDyad {
            name: name.into(),
            kind: dyad.kind,
            bodies: made,
        });
        Ok(())
    }

    /// Adds a body of a dyad that turns on a pin; its motion is computed when all dyads are built.
    fn turning(&mut self, key: &str, name: &str, link: LinkId, carrier: usize, at: Point) -> usize {
        let against = self.bodies[carrier].link;
        let law = Arc::new(Constant(0.0));
        let body = self.push(name, link, Mount::turning(carrier, at, law));
        let of = Coordinate::Angle { link, against };
        self.followed.push((body, of, key.into()));
        body
    }

    /// Adds a body of a dyad that slides along a line; its motion is computed when all dyads are built.
    fn sliding(
        &mut self,
        key: &str,
        name: &str,
        link: LinkId,
        carrier: usize,
        line: Line,
    ) -> usize {
        let law = Arc::new(Constant(0.0));
        let body = self.push(name, link, Mount::sliding(carrier, &line, law, [0.0; 2]));
        let of = Coordinate::Along { link, line };
        self.followed.push((body, of, key.into()));
        body
    }
}

/// Minimum and maximum value of a law over the cycle.
pub(super) fn range(law: &dyn Transmission, linkage: &Linkage) -> [f64; 2] {
    let ends = piece_ends(0.0, linkage.period(), PARTS, linkage.breaks());
    extremes(|input| law.at(input).position, &ends).map(|extreme| extreme.value)
}
