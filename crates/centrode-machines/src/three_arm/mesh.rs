use super::{ThreeArm, ThreeArmLink};

/// Two gears of a chain in mesh.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum GearMesh {
    /// The sun and the intermediate gear of a chain.
    Sun(u32),
    /// The planet and the intermediate gear of a chain.
    Planet(u32),
}

/// Pose of two gears in mesh, relative to the line from the sun's or planet's axis to the intermediate gear's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshPose {
    /// Polar angle of the sun or planet at that line, rad: the driver angle of the pair.
    pub driver: f64,
    /// Turn of the intermediate gear from that line, rad: the driven angle of the pair.
    pub driven: f64,
}

impl ThreeArm {
    /// Every mesh, chain by chain.
    pub fn meshes(&self) -> impl Iterator<Item = GearMesh> + use<> {
        (0..self.arms()).flat_map(|k| [GearMesh::Sun(k), GearMesh::Planet(k)])
    }

    /// Pose of the gears of a mesh at a carrier turn, computed from the links alone.
    ///
    /// Teeth that are laid out once for the pair of sun and intermediate gear fit every mesh at every input if, and only if, this
    /// is a pose of that pair: the driven angle belongs to the driver angle. This holds for any tooth count, bend and number of
    /// arms. Every mesh has the mean ratio 1, so every tooth meets one space only. All chains repeat the first one. A planet is
    /// the same part as the sun; the train sets it so that it meets the intermediate gear at the polar angle at which the sun
    /// would.
    #[must_use]
    pub fn mesh_pose(&self, mesh: GearMesh, input: f64) -> MeshPose {
        let (driver, driven) = match mesh {
            GearMesh::Sun(k) => (ThreeArmLink::Sun, ThreeArmLink::Intermediate(k)),
            GearMesh::Planet(k) => (ThreeArmLink::Planet(k), ThreeArmLink::Intermediate(k)),
        };
        let (driver, driven) = (self.link(driver, input), self.link(driven, input));
        let line = driven.origin.position - driver.origin.position;
        let direction = line.y.atan2(line.x);
        MeshPose {
            driver: direction - driver.angle.position,
            driven: driven.angle.position - direction,
        }
    }
}
