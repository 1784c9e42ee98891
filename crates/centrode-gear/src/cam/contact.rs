//! Contact of cam and follower, in the cam's own frame.

use std::f64::consts::{FRAC_PI_2, PI};

use centrode_geometry::{Jet, Point, Vector};

use super::design::Follower;
use super::disc::DiscCam;
use centrode_kinematics::formula::Taylor;
use centrode_kinematics::transmission::MotionJet;

/// Cam and follower at one input, in the frame of the cam: its axis is the origin, and the slide or the arm's pivot
/// lies on the x axis at the input zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Cam angle, rad.
    pub input: f64,
    /// The follower's motion.
    pub motion: MotionJet,
    /// Centre of the roller, mm; `None` for a flat face.
    pub roller: Option<Point>,
    /// Curvature of the path of the roller's centre, 1/mm, positive where it is convex.
    pub pitch_curvature: Option<f64>,
    /// Contact point on the profile, mm.
    pub point: Point,
    /// Unit normal of the profile there, out of the cam.
    pub normal: Vector,
    /// Curvature of the profile, 1/mm, positive where it is convex; where the profile is undercut it
    /// has no meaning.
    pub curvature: f64,
    /// Angle from the direction in which the follower is lifted to the normal, rad,
    /// counter-clockwise positive.
    pub pressure_angle: f64,
    /// Position of the contact on a flat face, mm: to the left of the slide, or from the pivot along the arm.
    pub face: Option<f64>,
    /// Regularity, above zero where the profile is regular, at most zero where it is undercut. For a roller of radius r: 1 minus
    /// r times the curvature of its centre's path. For a flat face: the radius of curvature over that of the base circle.
    pub regularity: f64,
}

impl DiscCam {
    /// Polar angle of the slide or pivot in the cam's frame.
    fn direction(&self, input: f64) -> Taylor {
        // Seen from the cam the follower turns against the cam's own sense.
        let sense = self.sense();
        let mut angle = Taylor::constant(sense * input);
        angle.0[1] = sense;
        angle
    }

    /// Direction of the arm from its pivot, minus pi, and the angle between arm and centre line.
    fn arm(&self, input: f64, motion: &MotionJet, lifts: f64) -> (Taylor, Taylor) {
        let swing = Taylor::constant(self.start_angle()) + motion.series();
        let heading = self.direction(input) + swing * Taylor::constant(lifts);
        (heading, swing)
    }

    /// Roller centre or flat face, in the cam's frame.
    fn rider(&self, input: f64, motion: &MotionJet) -> Rider {
        let c = Taylor::constant;
        match self.follower() {
            Follower::TranslatingRoller(follower) => {
                let (sin, cos) = self.direction(input).sin_cos();
                let along = c(self.start_distance()) + motion.series();
                let aside = c(follower.offset);
                Rider::Roller(along * cos - aside * sin, along * sin + aside * cos)
            }
            Follower::SwingingRoller(follower) => {
                let (sin, cos) = self.direction(input).sin_cos();
                let (heading, _) = self.arm(input, motion, follower.lifts.sign());
                let (arm_sin, arm_cos) = heading.sin_cos();
                let (distance, length) = (c(follower.center_distance), c(follower.arm_length));
                Rider::Roller(
                    distance * cos - length * arm_cos,
                    distance * sin - length * arm_sin,
                )
            }
            Follower::TranslatingFlat(_) => Rider::Face(
                self.direction(input),
                c(self.base_radius()) + motion.series(),
            ),
            Follower::SwingingFlat(follower) => {
                let lifts = follower.lifts.sign();
                let (heading, swing) = self.arm(input, motion, lifts);
                let (sin, _) = swing.sin_cos();
                let distance = c(follower.center_distance) * sin - c(follower.face_offset);
                Rider::Face(heading - c(lifts * FRAC_PI_2), distance)
            }
        }
    }

    /// Jet of the path of the roller's centre, the pitch curve; `None` for a flat face.
    #[must_use]
    pub fn roller_center(&self, input: f64) -> Option<Jet> {
        match self.rider(input, &self.motion().at(input)) {
            Rider::Roller(x, y) => Some(jet(&x, &y)),
            Rider::Face(..) => None,
        }
    }

    /// Rotation rate of a flat face in the cam's frame, per radian, positive in the follower's sense about the cam;
    /// one for a roller.
    pub(super) fn face_rate(&self, input: f64) -> f64 {
        match self.rider(input, &self.motion().at(input)) {
            Rider::Roller(..) => 1.0,
            Rider::Face(angle, _) => angle.0[1] * self.sense(),
        }
    }

    /// Analyses the contact at an input.
    ///
    /// The profile is the envelope of the follower. For a roller the contact is at the roller's radius from its centre, along the
    /// normal of the centre's path. For a flat face at the distance h from the axis it is `h n + h' t`, where h' is the
    /// derivative of h by the angle of the face's normal n.
    #[must_use]
    pub fn contact(&self, input: f64) -> Contact {
        let motion = self.motion().at(input);
        match self.rider(input, &motion) {
            Rider::Roller(x, y) => self.roller_contact(input, motion, &jet(&x, &y)),
            Rider::Face(angle, distance) => self.face_contact(input, motion, &angle, &distance),
        }
    }

    fn roller_contact(&self, input: f64, motion: MotionJet, center: &Jet) -> Contact {
        let radius = self.follower().roller_radius().unwrap_or(0.0);
        let tangent = center.first.normalize() * self.sense();
        let normal = Vector::new(tangent.y, -tangent.x);
        let pitch_curvature = center.curvature() * self.sense();
        let regularity = 1.0 - radius * pitch_curvature;
        let lift = self.lift_direction(input, &motion, &center.point);
        Contact {
            input,
            motion,
            roller: Some(center.point),
            pitch_curvature: Some(pitch_curvature),
            point: center.point - normal * radius,
            normal,
            curvature: pitch_curvature / regularity,
            pressure_angle: between(&lift, &normal),
            face: None,
            regularity,
        }
    }

    fn face_contact(
        &self,
        input: f64,
        motion: MotionJet,
        angle: &Taylor,
        distance: &Taylor,
    ) -> Contact {
        let slope = distance.differentiated() / angle.differentiated();
        let bend = slope.0[1] / angle.0[1];
        let radius = distance.0[0] + bend;
        let (sin, cos) = angle.0[0].sin_cos();
        let (normal, tangent) = (Vector::new(cos, sin), Vector::new(-sin, cos));
        let point = Point::from(normal * distance.0[0] + tangent * slope.0[0]);
        let lift = self.lift_direction(input, &motion, &point);
        let face = match self.follower() {
            Follower::SwingingFlat(follower) => {
                let arm = self.direction(input).0[0]
                    + PI
                    + follower.lifts.sign() * (self.start_angle() + motion.position);
                (point - self.pivot(input, follower.center_distance))
                    .dot(&Vector::new(arm.cos(), arm.sin()))
            }
            _ => slope.0[0],
        };
        Contact {
            input,
            motion,
            roller: None,
            pitch_curvature: None,
            point,
            normal,
            curvature: 1.0 / radius,
            pressure_angle: between(&lift, &normal),
            face: Some(face),
            regularity: radius / self.base_radius(),
        }
    }

    /// Position of the arm's pivot in the cam's frame.
    fn pivot(&self, input: f64, distance: f64) -> Point {
        let angle = self.sense() * input;
        Point::new(distance * angle.cos(), distance * angle.sin())
    }

    /// Unit direction in which a lift moves the follower's point.
    fn lift_direction(&self, input: f64, motion: &MotionJet, point: &Point) -> Vector {
        let about_pivot = |distance: f64, lifts: f64| {
            let arm = point - self.pivot(input, distance);
            Vector::new(-arm.y, arm.x).normalize() * lifts
        };
        match self.follower() {
            Follower::SwingingRoller(follower) => {
                let (heading, _) = self.arm(input, motion, follower.lifts.sign());
                let (sin, cos) = heading.0[0].sin_cos();
                Vector::new(sin, -cos) * follower.lifts.sign()
            }
            Follower::SwingingFlat(follower) => {
                about_pivot(follower.center_distance, follower.lifts.sign())
            }
            Follower::TranslatingRoller(_) | Follower::TranslatingFlat(_) => {
                let angle = self.sense() * input;
                Vector::new(angle.cos(), angle.sin())
            }
        }
    }
}

/// Part of the follower that touches the cam.
enum Rider {
    /// Coordinates of the roller's centre.
    Roller(Taylor, Taylor),
    /// Angle of a flat face's normal, and the face's distance from the axis.
    Face(Taylor, Taylor),
}

fn jet(x: &Taylor, y: &Taylor) -> Jet {
    let (x, y) = (x.derivatives(), y.derivatives());
    Jet {
        point: Point::new(x[0], y[0]),
        first: Vector::new(x[1], y[1]),
        second: Vector::new(x[2], y[2]),
        third: Vector::new(x[3], y[3]),
    }
}

/// Angle from one direction to another.
fn between(from: &Vector, to: &Vector) -> f64 {
    from.perp(to).atan2(from.dot(to))
}
