//! Gears of pairs and their meshes as written in the design file.

pub(super) mod gearing;
pub(super) mod mesh;
pub(super) mod pair_figure;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::{Machine, MachineGear};
use centrode_gear::{GearPair, Member};
use centrode_spec::degrees;

/// Gear of a pair.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GearRole {
    /// The driver of the pair.
    Driver,
    /// The driven gear.
    Driven,
}

/// A gear of a pair on a body.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineGearSpec {
    /// Name of the pair.
    pub pair: String,
    /// Gear of the pair: driver or driven; whichever of the two moves the other in this machine.
    pub role: GearRole,
    /// Point of a body on which its axis is, `frame.O`; or the body alone for its origin.
    pub on: String,
    /// Angle at which it is mounted, of its own axes against the body's, rad (degrees in the file).
    #[serde(default, rename = "mount_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub mount: f64,
}

/// Mesh that holds a body on the one that carries it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineMeshSpec {
    /// Gear of the body, with its axis at the body's origin.
    pub gear: String,
    /// Gear of another body of the same pair, whose axis the carrier carries, too.
    pub with: String,
    /// Direction from that gear's axis to the body's, in the carrier's axes, rad (degrees in the file); they are the pair's
    /// centre distance apart.
    #[serde(rename = "direction_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub direction: f64,
}

/// Two gears that mesh next to those by which bodies are held: checked.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineLoopSpec {
    /// The two gears.
    pub gears: [String; 2],
}

impl Machine {
    /// Gear pairs of the meshes that move a body carried by this body.
    #[must_use]
    pub fn carried_pairs(&self, body: usize) -> Vec<&GearPair> {
        let carrier = |moved: usize| Some(self.bodies[moved].mount.as_ref()?.carrier);
        let meshes = self.meshes.iter();
        let own = meshes.filter(|mesh| carrier(mesh.moved) == Some(body));
        own.map(|mesh| &*self.gears[mesh.gears[0]].pair).collect()
    }

    /// The gears that a gear meshes with, in the order of their names.
    #[must_use]
    pub fn mates(&self, gear: &str) -> Vec<&MachineGear> {
        let both = self.in_mesh().flat_map(|[a, b]| [[a, b], [b, a]]);
        let own = both.filter(|[one, _]| self.gears[*one].name == gear);
        let mut mates: Vec<usize> = own.map(|[_, other]| other).collect();
        mates.sort_unstable();
        mates.dedup();
        mates.into_iter().map(|mate| &self.gears[mate]).collect()
    }

    /// Indices of the two gears of each mesh: of the meshes that hold bodies, then of those of the table `meshes`.
    fn in_mesh(&self) -> impl Iterator<Item = [usize; 2]> {
        let named = |name: &String| self.gears.iter().position(|gear| gear.name == *name);
        let beside = self.design.meshes.values();
        let beside =
            beside.filter_map(move |mesh| Some([named(&mesh.gears[0])?, named(&mesh.gears[1])?]));
        self.meshes.iter().map(|mesh| mesh.gears).chain(beside)
    }

    /// Notes on the tooth that runs in each space, with the names of the gears; copies have the notes of their originals.
    pub(in crate::machine) fn meshing_notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        for both in self.in_mesh() {
            let [driver, driven] = match self.gears[both[0]].member {
                Member::Driver => both,
                Member::Driven => [both[1], both[0]],
            }
            .map(|gear| &self.gears[gear]);
            let counted = match driver.gear().tooth_count() == driven.gear().tooth_count() {
                true => "",
                false => ", counted on from turn to turn",
            };
            let [of, mate] = [driver, driven].map(|gear| self.original(&gear.name));
            let note = format!("Tooth k of {of} runs in space k - 1 of {mate}{counted}.");
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        notes
    }
}
