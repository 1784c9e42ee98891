//! Forms of a new dyad in the position of the old one.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use serde_json::json;

use super::course::{Course, Frame, unit, written};
use super::{Form, Retype, short};
use centrode_geometry::{Point, Vector};

/// Inputs of a period at which the new dyad may have the pose of the old one.
const SAMPLES: usize = 6;
/// Directions of a line that are tried.
const DIRECTIONS: u32 = 4;
/// Length of a bar, as a multiple of the distance that it must reach.
const ROOM: f64 = 1.02;
/// Distance below which two points coincide; and distance of a new point from one with which it would coincide, mm.
const NEAR: f64 = 1e-3;
const BESIDE: f64 = 20.0;
/// Sine of the angle between two lines below which they fix a body badly.
const FLAT: f64 = 0.3;

impl Retype<'_> {
    /// Keys of the new type if the motion is not known.
    pub(super) fn plain(&self) -> Vec<Form> {
        let keys = match self.word {
            "RRR" => json!({ "joint": self.joint(), "lengths": [100.0, 100.0], "side": "left" }),
            "RRP" => {
                json!({ "joint": self.joint(), "lengths": [100.0], "side": "forward", "line_deg": 0.0 })
            }
            "RPR" => json!({ "side": "forward" }),
            "PRP" => json!({ "joint": self.joint(), "line_deg": 0.0, "second_line_deg": 90.0 }),
            "RPP" => json!({ "line_deg": 0.0, "slot_deg": 90.0 }),
            _ => return Vec::new(),
        };
        let keys = keys.as_object().cloned().unwrap_or_default();
        let frames = [Frame::along(Point::origin(), Vector::new(1.0, 0.0)); 2];
        vec![Form {
            keys,
            point: None,
            stand: 0,
            frames,
        }]
    }

    /// Forms of the new type between two ends.
    pub(super) fn forms(&self, course: &Course) -> Vec<Form> {
        let stands = (0..SAMPLES).map(|i| i * course.count() / SAMPLES);
        let stands: Vec<usize> = stands.collect();
        match self.word {
            "RRR" => self.two_bars(course, &stands),
            "RPR" => stands
                .iter()
                .take(1)
                .map(|&stand| guide(course, stand))
                .collect(),
            "RRP" | "RPP" | "PRP" => self.on_lines(course, &stands),
            _ => Vec::new(),
        }
    }

    fn two_bars(&self, course: &Course, stands: &[usize]) -> Vec<Form> {
        let form = |stand: usize, joint: Point| {
            let [a, b] = [0, 1].map(|end| course.ends[end][stand]);
            let [one, other] = [joint - a, joint - b];
            let side = if (b - a).perp(&one) > 0.0 {
                "left"
            } else {
                "right"
            };
            let lengths = [short(one.norm()), short(other.norm())];
            let keys = json!({ "joint": self.joint(), "lengths": lengths, "side": side });
            Form {
                keys: keys.as_object().cloned().unwrap_or_default(),
                point: None,
                stand,
                frames: [Frame::along(a, one), Frame::along(b, other)],
            }
        };
        let mut found = Vec::new();
        for &stand in stands {
            found.extend(course.joint.iter().map(|joint| form(stand, joint[stand])));
        }
        // Bars of equal length close wherever they are long enough.
        for side in [1.0, -1.0] {
            let [a, b] = [0, 1].map(|end| course.ends[end][0]);
            let (way, length) = (b - a, 0.75 * course.farthest());
            let high = (length.powi(2) - 0.25 * way.norm_squared()).max(0.0).sqrt();
            let across = Vector::new(-way.y, way.x) / way.norm().max(1e-12);
            found.push(form(0, a + way * 0.5 + across * (side * high)));
        }
        found
    }

    /// Forms with a line on the holder of the second end.
    fn on_lines(&self, course: &Course, stands: &[usize]) -> Vec<Form> {
        let local = |at: &Point, stand: usize| course.holders[1][stand].seen(*at);
        let mut found = Vec::new();
        for &stand in stands {
            let a = course.ends[0][stand];
            let joint = course.joint.as_ref().map_or_else(
                || a + (course.ends[1][stand] - a) * 0.5,
                |joint| joint[stand],
            );
            let place = local(&joint, stand);
            let last = course.count() - 1;
            let beside = [stand.saturating_sub(1), (stand + 1).min(last)].map(|at| {
                course
                    .joint
                    .as_ref()
                    .map_or_else(|| local(&course.ends[0][at], at), |j| local(&j[at], at))
            });
            let tangent = beside[1] - beside[0];
            let tangent = tangent.y.atan2(tangent.x);
            for turn in 0..DIRECTIONS {
                let angle = tangent + f64::from(turn) * FRAC_PI_4;
                found.extend(self.on_line(course, stand, joint, place, angle));
            }
        }
        // The line through the second end itself.
        let place = local(&course.ends[1][0], 0);
        for turn in 0..DIRECTIONS {
            let angle = f64::from(turn) * FRAC_PI_4;
            let through = course.ends[1][0];
            if let Some(form) = self.on_line(course, 0, through, place, angle) {
                found.push(Form {
                    point: None,
                    ..form
                });
            }
        }
        found
    }

    /// The new form with its joint at a given position, unmoved, on a line on the holder of the second end.
    fn on_line(
        &self,
        course: &Course,
        stand: usize,
        joint: Point,
        place: Point,
        angle: f64,
    ) -> Option<Form> {
        let a = course.ends[0][stand];
        let line = unit(course.holders[1][stand].angle + angle);
        let bar = joint - a;
        let degrees = short(angle.to_degrees());
        let mut point = place;
        let (keys, first) = match self.word {
            "RRP" => {
                let reach = ROOM * course.off(place, angle);
                let length = short(bar.norm().max(reach));
                if length <= 0.0 {
                    return None;
                }
                let side = if line.dot(&bar) >= 0.0 {
                    "forward"
                } else {
                    "backward"
                };
                let keys = json!({ "joint": self.joint(), "lengths": [length], "side": side, "line_deg": degrees });
                (keys, Frame::along(a, bar))
            }
            "RPP" => {
                let slot = line.perp(&bar).atan2(line.dot(&bar));
                let slot = if slot.sin().abs() < FLAT {
                    FRAC_PI_2
                } else {
                    slot
                };
                let mut keys = json!({ "line_deg": degrees, "slot_deg": short(slot.to_degrees()) });
                if let Some(joint) = written(self.spec, "joint") {
                    keys["joint"] = joint.into();
                }
                (keys, Frame::along(a, unit(line.y.atan2(line.x) + slot)))
            }
            _ => {
                let [own, other] = [0, 1].map(|end| course.holders[end][stand].angle);
                let across = line.y.atan2(line.x) + FRAC_PI_2;
                let way = match bar.norm() > 0.0 && line.perp(&bar.normalize()).abs() > FLAT {
                    true => bar.y.atan2(bar.x),
                    false => across,
                };
                // Lines on two bodies that turn relative to each other are parallel at some inputs.
                let turned = |i: usize| course.holders[1][i].angle - course.holders[0][i].angle;
                let most = (0..course.count()).map(|i| (turned(i) - turned(stand)).abs());
                let is_alone = most.fold(0.0, f64::max) > 1.2;
                // In this case both lines are on the holder of the second end, one of them through that end.
                let end = course.holders[1][stand].seen(course.ends[1][stand]);
                let to_end = place - end;
                if to_end.norm() < NEAR {
                    point += unit(angle) * BESIDE;
                }
                let alone = match to_end.norm() > NEAR
                    && unit(angle).perp(&to_end.normalize()).abs() > FLAT
                {
                    true => to_end.y.atan2(to_end.x),
                    false => across - other,
                };
                let from = if is_alone { alone } else { way - own };
                let keys = json!({
                    "joint": self.joint(),
                    "line_deg": short(from.to_degrees()),
                    "second_line_deg": degrees,
                    "alone": is_alone,
                });
                (
                    keys,
                    Frame::along(joint, unit(if is_alone { across } else { way })),
                )
            }
        };
        Some(Form {
            keys: keys.as_object().cloned().unwrap_or_default(),
            point: Some([short(point.x), short(point.y)]),
            stand,
            frames: [first, Frame::along(joint, line)],
        })
    }
}

/// A guide that turns about the second end, through a block on the first.
fn guide(course: &Course, stand: usize) -> Form {
    let [a, b] = [0, 1].map(|end| course.ends[end][stand]);
    let keys = json!({ "side": "forward" });
    Form {
        keys: keys.as_object().cloned().unwrap_or_default(),
        point: None,
        stand,
        frames: [Frame::along(a, a - b), Frame::along(b, a - b)],
    }
}
