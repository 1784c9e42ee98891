use centrode_kinematics::machine::{Contact, Joint, Load, Quantity};
use centrode_kinematics::transmission::MotionJet;
use centrode_machines::three_arm::Pusher;

use super::limbs::Limbs;
use super::links::{Builder, Laws};

impl Builder<'_> {
    /// Fork and rod of a chain on their arm: the cam moves the fork, and the fork moves the rod against its spring.
    pub(super) fn pushed(
        &mut self,
        pusher: &Pusher,
        k: u32,
        [cam, arm]: [usize; 2],
        limbs: &Limbs,
    ) {
        let back = move |laws: &Laws, pusher: &Pusher, input: f64| {
            pusher.retraction(laws.mechanism.own_input(input, k))
        };
        let name = format!("fork_{k}");
        let fork = self.bodied(&name, Some(limbs.fork));
        let law = self.law(0.0, move |laws, input| {
            let pusher = laws.pusher.as_ref();
            let turned = pusher.map(|pusher| pusher.fork_angle(&back(laws, pusher, input)));
            turned.unwrap_or_default()
        });
        let pivot = pusher.pivot();
        let joint = Joint::turning(arm, fork, law).at([pivot.x, pivot.y, 0.0]);
        let joint = self.machine.joint(joint);
        self.column(joint, &name, "rad", "fork against its arm");
        self.machine.contacts.push(Contact {
            links: [cam, fork],
            joint,
            at: [pusher.fork_spec().arm_length, 0.0, 0.0],
            normal: None,
            line: None,
        });
        let name = format!("push_rod_{k}");
        let rod = self.bodied(&name, Some(limbs.rod));
        let law = self.law(0.0, move |laws, input| {
            let pusher = laws.pusher.as_ref();
            let back = pusher.map(|pusher| back(laws, pusher, input));
            MotionJet::default().plus(-1.0, &back.unwrap_or_default())
        });
        let (axis, range) = ([1.0, 0.0, 0.0], [-pusher.stroke(), 0.0]);
        let joint = Joint::sliding(arm, rod, axis, range, law);
        let joint = self.machine.joint(joint);
        let meaning = "push rod along its arm's x axis, zero thrown out";
        self.column(joint, &name, "mm", meaning);
        if let (Some(pin), Some(slot)) = (pusher.pin(), pusher.slot()) {
            self.machine.contacts.push(Contact {
                links: [fork, rod],
                joint,
                at: [pin.x, pin.y, 0.0],
                normal: Some([-slot.y, slot.x, 0.0]),
                line: None,
            });
        }
        let spring = self.mechanism.arm_sizes().spring;
        let effort = self.law(0.0, move |laws, input| {
            let pusher = laws.pusher.as_ref();
            let back = pusher.map_or(0.0, |pusher| back(laws, pusher, input).position);
            MotionJet::at_rest(spring.preload + spring.rate * back)
        });
        let effort = Quantity::Law(effort);
        self.machine.loads.push(Load::Joint { joint, effort });
    }
}
