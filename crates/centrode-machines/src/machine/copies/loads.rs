//! Copies of loads.

use nalgebra::{Rotation2, Vector2};

use super::{ChainCopy, Spin};
use crate::machine::body::points::Reference;
use crate::machine::{LoadAxes, MachineDesign, MachineError};

impl ChainCopy<'_> {
    /// Adds the loads on the bodies that are copied. A load is turned if the copy is the turned original. It runs ahead by an
    /// input if the copy has the pose that the original has later.
    pub(super) fn loads(&mut self, design: &MachineDesign) -> Result<(), MachineError> {
        for (name, load) in &design.loads {
            if !self.bodies.contains(&Reference::to_body(&load.on).body) {
                continue;
            }
            let key = format!("loads.{name}");
            let mut copy = load.clone();
            copy.on = self.word(&format!("{key}.on"), &load.on)?;
            if let (Spin::Still, LoadAxes::World, Some(force)) =
                (self.spin, load.axes, &mut copy.force)
            {
                let turned = Rotation2::new(self.turn) * Vector2::from(*force);
                *force = turned.into();
            }
            let taken = self.whole.loads.contains_key(&self.copy(name));
            let copied = self.name(name, taken)?;
            if load.expression.is_some() || load.over.is_some() {
                let what = format!("load {name}, which changes with the input,");
                let ahead = self.ahead(&key, &what)?;
                self.run_ahead(format!("loads.{copied}"), ahead);
            }
            self.whole.loads.insert(copied, copy);
        }
        Ok(())
    }
}
