use std::f64::consts::TAU;

use centrode_geometry::Point;
use centrode_mechanism::three_arm::{Chain, LinkMotion, ThreeArm};

/// One carrier turn, its train solved once at every input: each arm does what the first does, later.
pub(super) struct Turn<'a> {
    inputs: Vec<f64>,
    chains: Vec<Chain<'a>>,
    arms: u32,
}

impl<'a> Turn<'a> {
    /// At as many inputs as asked for or a few more, so that every arm comes by at each.
    pub(super) fn of(mechanism: &'a ThreeArm, fewest: u32) -> Self {
        let arms = mechanism.arms();
        let count = fewest.next_multiple_of(arms);
        let input = |i: u32| TAU * f64::from(i) / f64::from(count);
        let inputs: Vec<f64> = (0..=count).map(input).collect();
        let chains = inputs.iter().map(|&phi| mechanism.chain(0, phi)).collect();
        Self {
            inputs,
            chains,
            arms,
        }
    }

    /// Carrier turns from zero to a whole one, rad.
    pub(super) fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// The first chain at every input.
    pub(super) fn chains(&self) -> &[Chain<'a>] {
        &self.chains
    }

    /// The first arm's tip at every input.
    pub(super) fn tips(&self) -> impl Iterator<Item = Point> {
        self.chains.iter().map(|chain| chain.tip().position)
    }

    /// Intermediate gear, planet and arm of a chain at every input.
    pub(super) fn links(&self, chain: u32) -> impl Iterator<Item = [LinkMotion; 3]> {
        let count = self.inputs.len() - 1;
        let late = count / self.arms as usize * (chain % self.arms) as usize;
        let [begun, done] = [0, count].map(|i| self.chains[i].links());
        (0..=count).map(move |i| {
            if i >= late {
                return self.chains[i - late].links();
            }
            // The turn before this one.
            let mut links = self.chains[i + count - late].links();
            for ((link, begun), done) in links.iter_mut().zip(&begun).zip(&done) {
                link.angle.position += begun.angle.position - done.angle.position;
            }
            links
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_mechanism::design::DesignSpec as _;
    use centrode_mechanism::three_arm::design::ThreeArmDesign;

    #[test]
    fn every_arm_does_what_the_first_does_later() {
        for arms in ["2", "3", "5"] {
            let text = ThreeArmDesign::TEMPLATE.replace("arms = 3", &format!("arms = {arms}"));
            let design = ThreeArmDesign::from_toml(&text).expect("sound");
            let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
            let turn = Turn::of(&mechanism, 32);
            assert!(turn.inputs().len() > 32);
            for arm in 0..mechanism.arms() {
                for (&phi, links) in turn.inputs().iter().zip(turn.links(arm)) {
                    for (got, want) in links.iter().zip(mechanism.chain(arm, phi).links()) {
                        let off = (got.origin.position - want.origin.position).norm();
                        assert!(off < 1e-9, "{off} mm at {phi}");
                        let off = (got.angle.position - want.angle.position).abs();
                        assert!(off < 1e-11, "{off} rad at {phi}");
                    }
                }
            }
        }
    }
}
