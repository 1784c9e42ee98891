//! Copies of dyads.

use super::ChainCopy;
use crate::machine::{MachineDyadSpec, MachineError};

impl ChainCopy<'_> {
    pub(super) fn dyad(
        &mut self,
        name: &str,
        dyad: &MachineDyadSpec,
    ) -> Result<MachineDyadSpec, MachineError> {
        let key = |end: &str| format!("dyads.{name}.{end}");
        let mut copy = dyad.clone();
        copy.bodies = dyad.bodies.each_ref().map(|body| self.copy(body));
        copy.from = self.optional(&key("from"), &dyad.from)?;
        copy.to = self.optional(&key("to"), &dyad.to)?;
        copy.line = self.optional(&key("line"), &dyad.line)?;
        copy.second_line = self.optional(&key("second_line"), &dyad.second_line)?;
        copy.direction = self.direction(dyad.line.as_ref(), dyad.direction);
        copy.second_direction = self.direction(dyad.second_line.as_ref(), dyad.second_direction);
        Ok(copy)
    }
}
