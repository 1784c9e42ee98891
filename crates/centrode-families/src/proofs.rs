use centrode_analysis::{Proof, ProofError, prove};
use centrode_gear::GearPairError;
use centrode_spec::DesignError;

use super::Mechanism;

/// Reason why there is no certificate of a machine's gears.
#[derive(Debug, thiserror::Error)]
pub enum NotProved {
    /// No gears mesh all along its cycle.
    #[error(
        "there is no certificate for family {family:?} as designed: no pair of its gears meshes all along the cycle"
    )]
    NoPairs {
        /// Family of the design.
        family: &'static str,
    },
    /// It has no pair of that name.
    #[error("there is no pair {name:?}; there are {}", .known.join(", "))]
    Unknown {
        /// The requested name.
        name: String,
        /// Names of its pairs.
        known: Vec<String>,
    },
    /// It has several pairs where one is requested.
    #[error("there are several pairs: name one of {}", .known.join(", "))]
    Several {
        /// Names of its pairs.
        known: Vec<String>,
    },
    /// No teeth can be cut.
    #[error(transparent)]
    Teeth(#[from] GearPairError),
    /// The design cannot be written.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A pair has none.
    #[error("pair {name}: {error}")]
    Pair {
        /// Name of the pair.
        name: String,
        /// Why.
        #[source]
        error: Box<ProofError>,
    },
}

/// Certificate of a pair, or why it has none.
pub type Proved = Result<Proof, NotProved>;

impl dyn Mechanism {
    /// Certificates of the contact of its gear pairs at every driver angle: of that named, or of all; each by the pair's name.
    ///
    /// # Errors
    /// [`NotProved`] where there is no such pair, or no teeth can be cut; in the list, of a pair that has no certificate.
    pub fn proofs(&self, pair: Option<&str>) -> Result<Vec<(String, Proved)>, NotProved> {
        let mut pairs = self.pairs()?;
        if pairs.is_empty() {
            let family = self.design().family().word;
            return Err(NotProved::NoPairs { family });
        }
        if let Some(name) = pair {
            let known: Vec<String> = pairs.iter().map(|(name, _)| name.clone()).collect();
            pairs.retain(|(known, _)| known == name);
            if pairs.is_empty() {
                let name = name.to_owned();
                return Err(NotProved::Unknown { name, known });
            }
        }
        let design = self.design().to_toml()?;
        let proved = pairs.into_iter().map(|(name, pair)| {
            let proof = prove(&pair)
                .map(|proof| Proof {
                    design: design.clone(),
                    pair: name.clone(),
                    ..proof
                })
                .map_err(|error| NotProved::Pair {
                    name: name.clone(),
                    error: Box::new(error),
                });
            (name, proof)
        });
        Ok(proved.collect())
    }

    /// The certificate of the pair named, or of its only one.
    ///
    /// # Errors
    /// [`NotProved`], as for all its proofs; where there are several pairs and none is named, their names.
    pub fn proof(&self, pair: Option<&str>) -> Proved {
        let pairs = self.pairs()?;
        if pair.is_none() && pairs.len() > 1 {
            let known = pairs.into_iter().map(|(name, _)| name).collect();
            return Err(NotProved::Several { known });
        }
        let mut proofs = self.proofs(pair)?;
        proofs.swap_remove(0).1
    }
}
