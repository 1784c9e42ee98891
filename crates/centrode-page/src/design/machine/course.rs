//! Motion of a dyad's ends, from which the lengths and lines of another type follow.

use centrode_geometry::{Point, Vector};
use centrode_machines::machine::{BodyPoint, Machine};
use serde_json::Value as Json;

/// Inputs of a period at which the old dyad is sampled.
const SAMPLES: u32 = 48;

/// Text of a key of the dyad, as written.
pub(super) fn written(spec: &Json, key: &str) -> Option<String> {
    Some(spec.get(key)?.as_str()?.to_owned())
}

/// Names of both ends as written: pins, or points of lines.
pub(super) fn ends(spec: &Json) -> Option<[String; 2]> {
    let words: Vec<String> = ["from", "to", "line", "second_line"]
        .iter()
        .filter_map(|key| written(spec, key))
        .collect();
    words.try_into().ok()
}

/// Motion of a dyad's ends and of its joint.
#[derive(Clone)]
pub(super) struct Course {
    /// The ends, in the axes of the frame, at every input.
    pub(super) ends: [Vec<Point>; 2],
    /// Poses of the bodies that hold the ends, at every input.
    pub(super) holders: [Vec<Frame>; 2],
    /// Position of the dyad's joint at every input, if it has one.
    pub(super) joint: Option<Vec<Point>>,
    /// The points that the type adds to its two bodies, with their names and their positions at every input.
    pub(super) given: [Vec<(String, Vec<Point>)>; 2],
}

impl Course {
    pub(super) fn new(machine: &Machine, name: &str, spec: &Json) -> Option<Self> {
        let inputs: Vec<f64> = (0..SAMPLES)
            .map(|i| machine.period() * f64::from(i) / f64::from(SAMPLES))
            .collect();
        let way = |BodyPoint { body, at }: BodyPoint| -> Vec<Point> {
            inputs.iter().map(|i| machine.place(body, at, *i)).collect()
        };
        let origin = |body: usize| BodyPoint {
            body,
            at: Point::origin(),
        };
        let found = |word: &String| match word.split_once('.') {
            Some(_) => machine.point_named(word),
            None => machine.body_named(word).map(origin),
        };
        let held = ends(spec)?;
        let [a, b] = [found(&held[0])?, found(&held[1])?];
        let frames = |body: usize| -> Vec<Frame> {
            let at = inputs.iter().map(|input| Frame {
                origin: machine.place(body, Point::origin(), *input),
                angle: machine.angle(body, *input).position,
            });
            at.collect()
        };
        let dyad = machine.dyads().iter().find(|dyad| dyad.name == name)?;
        let joint = written(spec, "joint");
        let joint = joint.and_then(|joint| {
            let bodies = dyad.bodies.iter();
            let mut places = bodies.filter_map(|body| {
                let word = format!("{}.{joint}", machine.bodies()[*body].name);
                machine.point_named(&word)
            });
            places.next()
        });
        let joint = joint.or_else(|| {
            // For a yoke, the point at which its slot crosses its line.
            (spec.get("type")? == "RPP").then(|| origin(dyad.bodies[1]))
        });
        let names = ["from", "to", "joint"].map(|key| written(spec, key));
        let names: Vec<String> = names
            .into_iter()
            .flatten()
            .filter_map(|word| Some(word.rsplit('.').next()?.to_owned()))
            .collect();
        let given = dyad.bodies.map(|body| {
            let own = &machine.bodies()[body].name;
            let spec = machine.whole().bodies.get(own);
            let is_written = |name: &str| {
                spec.is_some_and(|own| {
                    own.points.contains_key(name) || own.corners.contains_key(name)
                })
            };
            let names = names.iter().filter(|name| !is_written(name));
            let named = names.filter_map(|name| {
                let place = machine.point_named(&format!("{own}.{name}"))?;
                Some((name.clone(), way(place)))
            });
            named.collect()
        });
        Some(Self {
            ends: [way(a), way(b)],
            holders: [frames(a.body), frames(b.body)],
            joint: joint.map(way),
            given,
        })
    }

    pub(super) fn count(&self) -> usize {
        self.ends[0].len()
    }

    /// Distance of the ends, mm, at every input.
    fn apart(&self) -> impl Iterator<Item = f64> + '_ {
        let [a, b] = &self.ends;
        a.iter().zip(b).map(|(a, b)| (b - a).norm())
    }

    pub(super) fn farthest(&self) -> f64 {
        self.apart().fold(0.0, f64::max)
    }

    /// The motion with both ends of the dyad exchanged.
    pub(super) fn reversed(mut self) -> Self {
        self.ends.reverse();
        self.holders.reverse();
        self.given.reverse();
        self
    }

    /// Maximum distance of the first end from a line through a point of the second end's holder.
    pub(super) fn off(&self, through: Point, angle: f64) -> f64 {
        let along = unit(angle);
        let places = self.ends[0].iter().zip(&self.holders[1]);
        let off = places.map(|(a, holder)| along.perp(&(holder.seen(*a) - through)).abs());
        off.fold(0.0, f64::max)
    }
}

/// Axes of a body.
#[derive(Clone, Copy)]
pub(in crate::design) struct Frame {
    pub(in crate::design) origin: Point,
    pub(in crate::design) angle: f64,
}

impl Frame {
    /// Axes at a position, the first one along a vector.
    pub(super) fn along(origin: Point, way: Vector) -> Self {
        let angle = way.y.atan2(way.x);
        Self { origin, angle }
    }

    /// Coordinates of a position in these axes.
    pub(in crate::design) fn seen(&self, place: Point) -> Point {
        let (way, along) = (place - self.origin, unit(self.angle));
        Point::new(along.dot(&way), along.perp(&way))
    }
}

pub(super) fn unit(angle: f64) -> Vector {
    Vector::new(angle.cos(), angle.sin())
}
