use centrode_analysis::{Proof, ProofError, prove};
use centrode_gear::GearPairError;
use centrode_spec::DesignError;

use super::Mechanism;

/// Reason why there is no certificate of a machine's gears.
#[derive(Debug, thiserror::Error)]
pub enum NotProved {
    /// No gears of the machine mesh all along the cycle.
    #[error(
        "there is no certificate for this design of family {family:?}: none of its gear pairs is in mesh over the whole cycle"
    )]
    NoPairs {
        /// Family of the design.
        family: &'static str,
    },
    /// The machine has no pair of that name.
    #[error("there is no pair {name:?}; there are {}", .known.join(", "))]
    Unknown {
        /// The requested name.
        name: String,
        /// Names of its pairs.
        known: Vec<String>,
    },
    /// The machine has several pairs, but a single one is requested.
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
    /// A pair has no certificate.
    #[error("pair {name}: {error}")]
    Pair {
        /// Name of the pair.
        name: String,
        /// Reason.
        #[source]
        error: Box<ProofError>,
    },
}

/// Certificate of a pair, or the reason why it has none.
pub type Proved = Result<Proof, NotProved>;

impl dyn Mechanism {
    /// Certificates of the contact of gear pairs at every driver angle, each with the name of its pair: of the named pair, or
    /// of all.
    ///
    /// # Errors
    /// [`NotProved`] if there is no such pair, or its teeth cannot be cut; in the list, for each pair without a certificate.
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

    /// The certificate of the named pair, or of the only pair.
    ///
    /// # Errors
    /// [`NotProved`], as for the certificates of all pairs; [`NotProved::Several`] if there are several pairs and none is named.
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
