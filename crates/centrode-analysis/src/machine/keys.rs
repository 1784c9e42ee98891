//! Keys of the shafts under the torque that they transmit.

use centrode_geometry::Extreme;
use centrode_kinematics::machine::Key;
use centrode_machines::machine::{Hold, Machine, MachineShaft, ShaftPart};

use crate::Report;
use crate::forces::Forces;
use crate::key_pressure::LoadedKey;

/// Key of a part on a shaft whose torque follows from the forces of the machine.
pub(super) struct KeyUnderLoad<'a> {
    shaft: &'a MachineShaft,
    part: &'a ShaftPart,
    key: Key,
    /// Meshes whose forces the key transmits, and whether the gear is the driven one there.
    meshes: Vec<(usize, bool)>,
    /// Joint whose drive the key transmits.
    drive: Option<usize>,
}

/// The keys whose torque is known. The torque of a gear's key follows from the forces of its meshes. If exactly one other part
/// is fixed on the shaft, the torque of its key follows from these forces and the drive of the shaft; how several other parts
/// would share the torque is not known. The inertia of gears and shafts is omitted; of copies only the original is checked.
pub(super) fn under_load(composed: &Machine) -> Vec<KeyUnderLoad<'_>> {
    let shafts = composed.shafts().iter();
    let originals = shafts.filter(|shaft| composed.original(&shaft.name) == shaft.name);
    originals
        .flat_map(|shaft| on_shaft(composed, shaft))
        .collect()
}

fn on_shaft<'a>(composed: &Machine, shaft: &'a MachineShaft) -> Vec<KeyUnderLoad<'a>> {
    let meshes = |part: &ShaftPart| match part.is_plate {
        true => Vec::new(),
        false => composed.meshes_of(&part.name),
    };
    let fixed = shaft.parts.iter().filter(|part| part.hold.is_fixed());
    let (gears, others): (Vec<_>, Vec<_>) = fixed
        .map(|part| (part, meshes(part)))
        .partition(|(_, meshes)| !meshes.is_empty());
    let all = gears.iter().flat_map(|(_, meshes)| meshes).copied();
    let all: Vec<(usize, bool)> = all.collect();
    let drive = shaft.is_driven.then(|| shaft.body - 1);
    let key = |part: &'a ShaftPart, meshes, drive| match part.hold {
        Hold::Keyed(key) => Some(KeyUnderLoad {
            shaft,
            part,
            key,
            meshes,
            drive,
        }),
        _ => None,
    };
    let other = match others[..] {
        [(part, _)] => key(part, all, drive),
        _ => None,
    };
    let of_gears = gears
        .into_iter()
        .filter_map(|(part, meshes)| key(part, meshes, None));
    of_gears.chain(other).collect()
}

impl KeyUnderLoad<'_> {
    /// Magnitude of the torque that the key transmits, N mm: the moment of the teeth's forces about the shaft's axis, with the
    /// drive.
    pub(super) fn torque(&self, composed: &Machine, forces: &Forces, input: f64) -> f64 {
        let axis = composed.place(self.shaft.body, self.shaft.at, input);
        let of_mesh = |&(mesh, is_driven): &(usize, bool)| {
            let found = &forces.meshes[mesh];
            let moment = (found.at.xy() - axis.coords).perp(&found.force.xy());
            if is_driven { moment } else { -moment }
        };
        let drive = self.drive.map_or(0.0, |joint| forces.joints[joint].drive);
        (drive + self.meshes.iter().map(of_mesh).sum::<f64>()).abs()
    }
}

/// Reports the maximum pressure on the keys under their maximum torques, and the keys that are overloaded.
pub(super) fn check(
    composed: &Machine,
    keys: &[KeyUnderLoad<'_>],
    torques: &[Extreme],
    report: &mut Report,
) {
    let mut maximum: Option<f64> = None;
    for (under, torque) in keys.iter().zip(torques) {
        let (shaft, part) = (&under.shaft.hub, under.part);
        let gears = composed.gears().iter();
        let gear = gears.map(|gear| (&gear.name, gear.gear().body()));
        let cam = composed
            .cams()
            .iter()
            .map(|cam| (&cam.name, cam.part.body()));
        let mut wheels = gear.chain(cam);
        let material = match part.is_plate {
            true => Some(&composed.design().plates.material),
            false => wheels
                .find(|(name, _)| **name == part.name)
                .map(|(_, body)| &body.material),
        };
        let (Some(hub), Some(material)) = (shaft.keyway, material) else {
            continue;
        };
        if torque.value < 0.0 {
            continue;
        }
        let loaded = LoadedKey {
            key: under.key,
            hub,
            face: part.span[1] - part.span[0],
            diameter: shaft.bore,
            materials: &[&shaft.material, material],
            torque: *torque,
            part: &part.name,
        };
        let pressure = loaded.pressure();
        maximum = Some(maximum.map_or(pressure, |known| known.max(pressure)));
        loaded.check(report);
    }
    let figure = maximum.map(|pressure| ("key_pressure_max", pressure));
    report.values.extend(figure);
}
