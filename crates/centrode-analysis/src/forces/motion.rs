use centrode_kinematics::machine::{Joint, JointKind};
use centrode_kinematics::transmission::MotionJet;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

/// Motion of a link as a function of the input, in the axes of the first link: rad and mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkMotion {
    pub(super) turn: Matrix3<f64>,
    pub(super) place: Vector3<f64>,
    /// First and second derivative of the turn.
    pub(super) spin: [Vector3<f64>; 2],
    /// First and second derivative of the position.
    pub(super) way: [Vector3<f64>; 2],
}

/// A joint's frame on the link that carries it, computed once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    turn: Matrix3<f64>,
    origin: Vector3<f64>,
    axis: Unit<Vector3<f64>>,
    kind: JointKind,
}

impl Seat {
    pub(super) fn new(joint: &Joint) -> Self {
        let [x, y, z] = joint.turn;
        Self {
            turn: *Rotation3::from_euler_angles(x, y, z).matrix(),
            origin: joint.origin.into(),
            axis: Unit::new_unchecked(joint.axis.into()),
            kind: joint.kind,
        }
    }
}

impl LinkMotion {
    /// The first link: it is fixed.
    pub(super) fn still() -> Self {
        Self {
            turn: Matrix3::identity(),
            place: Vector3::zeros(),
            spin: [Vector3::zeros(); 2],
            way: [Vector3::zeros(); 2],
        }
    }

    /// Motion of a vector fixed to the link: its first and second derivative.
    pub(super) fn carried(&self, arm: Vector3<f64>) -> [Vector3<f64>; 2] {
        let [spin, spin_up] = self.spin;
        let first = spin.cross(&arm);
        [first, spin_up.cross(&arm) + spin.cross(&first)]
    }

    /// First and second derivative of the position of a point of the link, given in the axes of the first link.
    pub(super) fn point(&self, at: Vector3<f64>) -> [Vector3<f64>; 2] {
        let [first, second] = self.carried(at - self.place);
        [self.way[0] + first, self.way[1] + second]
    }

    /// Motion of the link that a joint carries on this link, and the joint's axis in the axes of the first link.
    pub(super) fn next(&self, seat: &Seat, by: &MotionJet) -> (Self, Vector3<f64>) {
        let frame = self.turn * seat.turn;
        let axis = frame * seat.axis.into_inner();
        let mut arm = self.turn * seat.origin;
        let mut next = *self;
        match seat.kind {
            JointKind::Fixed => next.turn = frame,
            JointKind::Turning => {
                next.turn = frame * Rotation3::from_axis_angle(&seat.axis, by.position).matrix();
                next.spin[0] += axis * by.velocity;
                next.spin[1] += axis * by.acceleration + self.spin[0].cross(&axis) * by.velocity;
            }
            JointKind::Sliding(_) => {
                next.turn = frame;
                arm += axis * by.position;
                // The Coriolis term has the factor 2.
                next.way[0] += axis * by.velocity;
                next.way[1] +=
                    axis * by.acceleration + self.spin[0].cross(&axis) * (2.0 * by.velocity);
            }
        }
        let [first, second] = self.carried(arm);
        next.place += arm;
        next.way[0] += first;
        next.way[1] += second;
        (next, axis)
    }
}
