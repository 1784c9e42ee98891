//! The two bodies or obstacles of a clearance.

use crate::machine::{Machine, MachineError};

/// Body or obstacle of a clearance.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum ClearanceEnd {
    /// A body with its plate and gears; its index.
    Body(usize),
    /// An obstacle; its index.
    Obstacle(usize),
}

impl Machine {
    /// The bodies or obstacles with the given names, for their clearance; `key` is the key of the design that names them.
    ///
    /// # Errors
    /// [`MachineError`] for a name of neither, for two ends that move with one body, and for a block and the body with its slot.
    pub fn clearance_ends(
        &self,
        key: &str,
        names: [&str; 2],
    ) -> Result<[ClearanceEnd; 2], MachineError> {
        let end = |name: &str| {
            let mut obstacles = self.obstacles().iter();
            match obstacles.position(|obstacle| obstacle.name == name) {
                Some(obstacle) => Ok(ClearanceEnd::Obstacle(obstacle)),
                None => self.body_of(key, name).map(ClearanceEnd::Body),
            }
        };
        let ends = [end(names[0])?, end(names[1])?];
        let [one, other] = ends.map(|end| self.body_of_end(end));
        if one == other {
            let [first, second] = names;
            return Err(MachineError::refused(
                key,
                format!(
                    "{first} and {second} are both on {}: their clearance does not change",
                    self.bodies[one].name
                ),
            ));
        }
        let is_in = |[block, guide]: [usize; 2]| self.slotted(block) == Some(guide);
        if is_in([one, other]) || is_in([other, one]) {
            let [first, second] = names;
            return Err(MachineError::refused(
                key,
                format!(
                    "{first} and {second} slide on each other in a slot: their clearance is that of the fit"
                ),
            ));
        }
        Ok(ends)
    }

    /// Index of the body that an end of a clearance moves with.
    #[must_use]
    pub fn body_of_end(&self, end: ClearanceEnd) -> usize {
        match end {
            ClearanceEnd::Body(body) => body,
            ClearanceEnd::Obstacle(obstacle) => self.obstacles[obstacle].body,
        }
    }

    /// Name of an end of a clearance.
    #[must_use]
    pub fn name_of_end(&self, end: ClearanceEnd) -> &str {
        match end {
            ClearanceEnd::Body(body) => &self.bodies[body].name,
            ClearanceEnd::Obstacle(obstacle) => &self.obstacles[obstacle].name,
        }
    }
}
