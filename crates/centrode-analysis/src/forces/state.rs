use centrode_kinematics::machine::{Axes, GuideForce, JointKind, LinkedMachine, Load, Quantity};
use centrode_kinematics::transmission::MotionJet;
use nalgebra::Vector3;

use super::elimination::eliminated;
use super::motion::LinkMotion;
use super::ready::{Balance, Follower, Step};
use super::tie::{Lines, Tie, TieKind};
use super::{Forces, ForcesError, JointForce, LinkLoad, Reaction, ToothForce};

/// Millimetres per metre: 1 kg mm/s² is a thousandth of a newton.
const MM: f64 = 1000.0;

/// A force and its moment about the origin of the first link.
#[derive(Clone, Copy, Debug)]
struct Wrench {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl Wrench {
    fn zero() -> Self {
        Self {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        }
    }

    fn new(at: Vector3<f64>, force: Vector3<f64>) -> Self {
        Self {
            force,
            moment: at.cross(&force),
        }
    }

    fn add(&mut self, factor: f64, other: &Self) {
        self.force += other.force * factor;
        self.moment += other.moment * factor;
    }
}

/// Motion of the links, and the force and moment that each joint must supply to the links that it carries.
struct State<'a> {
    machine: &'a LinkedMachine,
    input: f64,
    jets: Vec<MotionJet>,
    links: Vec<LinkMotion>,
    axes: Vec<Vector3<f64>>,
    passed: Vec<Wrench>,
    drives: Vec<f64>,
    loads: Vec<LinkLoad>,
    /// Kinetic and potential energy, N mm.
    energy: [f64; 2],
}

impl Balance {
    /// Forces at an input (rad) with a constant speed (rad/s). The design's speed is that of the machine's input; zero holds
    /// the machine still.
    ///
    /// The torque of the input follows from virtual work: the sum of the forces or torques of the drives, each times the
    /// derivative of its joint by the input. It equals the torque from the virtual work of inertia, weight and loads.
    ///
    /// # Errors
    /// [`ForcesError::Dead`] in a dead position, [`ForcesError::NotFinite`] for forces that are not finite.
    pub fn at(&self, input: f64, speed: f64) -> Result<Forces, ForcesError> {
        let mut state = State::new(self, input, speed);
        let machine = &*self.machine;
        let count = |list: usize| vec![Vector3::zeros(); list];
        let tooth = ToothForce {
            normal: None,
            force: Vector3::zeros(),
            at: Vector3::zeros(),
        };
        let mut forces = Forces {
            input_torque: 0.0,
            joints: Vec::with_capacity(machine.joints.len()),
            closures: count(machine.closures.len()),
            meshes: vec![tooth; machine.meshes.len()],
            contacts: count(machine.contacts.len()),
            guides: vec![GuideForce::new(0.0, 0.0, 0.0, 0.0); machine.guides.len()],
            loads: std::mem::take(&mut state.loads),
            kinetic_energy: state.energy[0],
            potential_energy: state.energy[1],
        };
        for step in &self.steps {
            match step {
                Step::Follower(follower) => state.lead(follower, &mut forces.guides),
                Step::Ties(ties) => {
                    let solved = state.tied(ties);
                    let solved = solved.ok_or_else(|| ForcesError::Dead {
                        input,
                        links: named(machine, ties),
                    })?;
                    for (tie, (lines, sizes)) in ties.iter().zip(solved) {
                        let force = state.apply(tie, &lines, sizes);
                        match tie.kind {
                            TieKind::Closure(i) => forces.closures[i] = force,
                            TieKind::Contact(i) => forces.contacts[i] = force,
                            TieKind::Mesh(i) => {
                                let known = machine.meshes[i].pressure_angle;
                                forces.meshes[i] = ToothForce {
                                    normal: known.map(|_| sizes[0]),
                                    force,
                                    at: lines.at,
                                };
                            }
                        }
                    }
                }
            }
        }
        for joint in 0..machine.joints.len() {
            let drive = state.drives[joint];
            if self.is_driven(joint) {
                forces.input_torque += drive * state.jets[joint].velocity;
            }
            let reaction = (!self.hidden[joint]).then(|| state.reaction(joint));
            forces.joints.push(JointForce { drive, reaction });
        }
        // If any term is not finite, the sum is not finite.
        let sum = forces.joints.iter().map(|joint| joint.drive).sum::<f64>();
        if !(sum + forces.input_torque + forces.kinetic_energy).is_finite() {
            return Err(ForcesError::NotFinite { input, speed });
        }
        Ok(forces)
    }
}

/// Names of the links that ties hold.
fn named(machine: &LinkedMachine, ties: &[Tie]) -> String {
    let all = ties.iter().map(|tie| tie.words(machine));
    all.collect::<Vec<_>>().join(" and ")
}

impl<'a> State<'a> {
    fn new(balance: &'a Balance, input: f64, speed: f64) -> Self {
        let machine = &*balance.machine;
        let joints = machine.joints.len();
        let mut state = Self {
            machine,
            input,
            jets: machine.joints.iter().map(|j| j.law.at(input)).collect(),
            links: vec![LinkMotion::still(); machine.links.len()],
            axes: vec![Vector3::zeros(); joints],
            passed: vec![Wrench::zero(); joints],
            drives: vec![0.0; joints],
            loads: vec![LinkLoad::default(); machine.links.len()],
            energy: [0.0; 2],
        };
        for &joint in &balance.order {
            let about = &machine.joints[joint];
            let parent = state.links[about.parent];
            let (next, axis) = parent.next(&balance.seats[joint], &state.jets[joint]);
            state.links[about.child] = next;
            state.axes[joint] = axis;
        }
        state.inertia(balance, speed);
        for load in &machine.loads {
            state.load(balance, load, input);
        }
        for &joint in balance.order.iter().rev() {
            if let Some(carrier) = balance.carrier[machine.joints[joint].parent] {
                let passed = state.passed[joint];
                state.passed[carrier].add(1.0, &passed);
            }
        }
        for joint in 0..joints {
            state.drives[joint] += state.along(joint, &state.passed[joint]);
        }
        state
    }

    /// Adds the forces that accelerate and lift every mass.
    fn inertia(&mut self, balance: &Balance, speed: f64) {
        let gravity = Vector3::from(self.machine.gravity);
        for mass in &balance.masses {
            let link = &self.links[mass.link];
            let at = link.place + link.turn * mass.center;
            let [way, bend] = link.point(at).map(|x| x * speed);
            let [spin, spin_up] = link.spin.map(|x| x * speed);
            let inertia = |by: &Vector3<f64>| link.turn * (mass.inertia * link.turn.tr_mul(by));
            let swirl = inertia(&spin);
            let force = (bend * speed - gravity) * (mass.mass / MM);
            let mut wrench = Wrench::new(at, force);
            let moment = (inertia(&spin_up) * speed + spin.cross(&swirl)) / MM;
            wrench.moment += moment;
            self.loads[mass.link].raise(force.norm(), moment.norm());
            if let Some(carrier) = balance.carrier[mass.link] {
                self.passed[carrier].add(1.0, &wrench);
            }
            self.energy[0] += (mass.mass * way.norm_squared() + spin.dot(&swirl)) / (2.0 * MM);
            self.energy[1] -= mass.mass * gravity.dot(&at) / MM;
        }
    }

    /// Subtracts the force or torque of a load.
    fn load(&mut self, balance: &Balance, load: &Load, input: f64) {
        let values = |of: &[Quantity; 3]| {
            Vector3::from([0, 1, 2].map(|k| self.machine.value(&of[k], input)))
        };
        let (link, wrench, torque) = match load {
            Load::Mass { .. } => return,
            Load::Joint { joint, effort } => {
                let size = self.machine.value(effort, input);
                self.drives[*joint] -= size;
                let joint = &self.machine.joints[*joint];
                let [force, torque] = match joint.kind {
                    JointKind::Turning => [0.0, size.abs()],
                    _ => [size.abs(), 0.0],
                };
                self.loads[joint.child].raise(force, torque);
                return;
            }
            Load::Force {
                link,
                at,
                force,
                axes,
            } => {
                let motion = &self.links[*link];
                let at = motion.place + motion.turn * Vector3::from(*at);
                (
                    *link,
                    Wrench::new(at, in_world(motion, values(force), *axes)),
                    0.0,
                )
            }
            Load::Torque { link, torque, axes } => {
                let moment = in_world(&self.links[*link], values(torque), *axes);
                let force = Vector3::zeros();
                (*link, Wrench { force, moment }, moment.norm())
            }
        };
        self.loads[link].raise(wrench.force.norm(), torque);
        if let Some(carrier) = balance.carrier[link] {
            self.passed[carrier].add(-1.0, &wrench);
        }
    }

    /// Part of a wrench along or about the axis of a joint.
    fn along(&self, joint: usize, wrench: &Wrench) -> f64 {
        let axis = &self.axes[joint];
        match self.machine.joints[joint].kind {
            JointKind::Fixed => 0.0,
            JointKind::Sliding(_) => axis.dot(&wrench.force),
            JointKind::Turning => axis.dot(&self.about(joint, wrench)),
        }
    }

    /// Moment of a wrench about the origin of the link that a joint carries.
    fn about(&self, joint: usize, wrench: &Wrench) -> Vector3<f64> {
        let place = &self.links[self.machine.joints[joint].child].place;
        wrench.moment - place.cross(&wrench.force)
    }

    /// Transfers the drive of a joint to the joint that leads it.
    fn lead(&mut self, follower: &Follower, guides: &mut [GuideForce]) {
        let [own, leader] = [follower.joint, follower.leader].map(|joint| {
            let jet = self.jets[joint];
            // At rest the accelerations replace the velocities.
            if jet.velocity == 0.0 {
                jet.acceleration
            } else {
                jet.velocity
            }
        });
        let slope = if leader == 0.0 { 0.0 } else { own / leader };
        let drive = self.drives[follower.joint];
        self.drives[follower.leader] += match follower.guide {
            None => drive * slope,
            Some((index, guide)) => {
                let push = drive * own.signum();
                let lead = (slope / guide.radius).atan();
                guides[index] = GuideForce::new(push, lead, guide.radius, guide.friction);
                guides[index].torque * leader.signum()
            }
        };
    }

    /// Lines and sizes of the forces of ties for which the joints that they move need no drive.
    fn tied(&self, ties: &[Tie]) -> Option<Vec<(Lines, [f64; 2])>> {
        let lines = ties
            .iter()
            .map(|tie| tie.lines(self.machine, &self.links, &self.axes, self.input));
        let mut lines: Vec<Lines> = lines.collect::<Option<_>>()?;
        let mut sizes = self.solved(ties, &lines)?;
        let mut leans = false;
        for ((tie, lines), size) in ties.iter().zip(&mut lines).zip(&sizes) {
            if let TieKind::Mesh(_) = tie.kind {
                // The sign of the force now determines which flanks are loaded.
                let driver = &self.links[tie.links[0]];
                *lines = tie.flank(self.machine, lines, driver, size[0]);
                leans = true;
            }
        }
        if leans {
            sizes = self.solved(ties, &lines)?;
        }
        Some(lines.into_iter().zip(sizes).collect())
    }

    /// Sizes along the lines of ties.
    fn solved(&self, ties: &[Tie], lines: &[Lines]) -> Option<Vec<[f64; 2]>> {
        let count = ties.iter().map(|tie| tie.held.len()).sum();
        let mut rows = Vec::with_capacity(count);
        for &joint in ties.iter().flat_map(|tie| &tie.held) {
            let mut row = Vec::with_capacity(count + 1);
            for (tie, lines) in ties.iter().zip(lines) {
                let sign = tie.sign(joint);
                let unit = |along: &Vector3<f64>| self.along(joint, &Wrench::new(lines.at, *along));
                let own = lines.along.iter().take(tie.held.len());
                row.extend(own.map(|along| sign * unit(along)));
            }
            row.push(self.drives[joint]);
            rows.push(row);
        }
        let mut found = eliminated(rows)?.into_iter();
        let mut sizes = |tie: &Tie| {
            let mut own = [0.0; 2];
            for (own, next) in own.iter_mut().zip(found.by_ref().take(tie.held.len())) {
                *own = next;
            }
            own
        };
        Some(ties.iter().map(&mut sizes).collect())
    }

    /// Subtracts the force of a tie from the forces that joints must supply, and returns it: the force on the tie's second
    /// link.
    fn apply(&mut self, tie: &Tie, lines: &Lines, sizes: [f64; 2]) -> Vector3<f64> {
        let mut force = Vector3::zeros();
        for (along, size) in lines.along.iter().zip(sizes).take(tie.held.len()) {
            force += along * size;
        }
        let wrench = Wrench::new(lines.at, force);
        for &(joint, sign) in &tie.between {
            self.passed[joint].add(-sign, &wrench);
            self.drives[joint] -= sign * self.along(joint, &wrench);
        }
        for &joint in &tie.held {
            self.drives[joint] = 0.0;
        }
        force
    }

    /// Force and moment that a joint supplies, without the drive and the loads along its axis.
    fn reaction(&self, joint: usize) -> Reaction {
        let passed = &self.passed[joint];
        let axis = &self.axes[joint];
        let square = |of: Vector3<f64>| of - axis * axis.dot(&of);
        let (force, moment) = (passed.force, self.about(joint, passed));
        match self.machine.joints[joint].kind {
            JointKind::Fixed => Reaction { force, moment },
            JointKind::Turning => Reaction {
                force,
                moment: square(moment),
            },
            JointKind::Sliding(_) => Reaction {
                force: square(force),
                moment,
            },
        }
    }
}

/// Converts components in the axes of the world or of a link to the axes of the world.
fn in_world(link: &LinkMotion, components: Vector3<f64>, axes: Axes) -> Vector3<f64> {
    match axes {
        Axes::World => components,
        Axes::Link => link.turn * components,
    }
}
