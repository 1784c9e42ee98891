use std::collections::BTreeSet;

use centrode_formats::step::{Component, Exact};
use centrode_formats::threemf::Object;
use centrode_geometry::{Mesh, Shell, SolidError, Tolerance};
use centrode_kinematics::machine::{Form, LinkedMachine, Part, Shape, Supply};
use nalgebra::Isometry3;

/// Colours of links, one after the other.
const COLORS: [[u8; 3]; 8] = [
    [0x8c, 0x95, 0x9f],
    [0x4e, 0x79, 0xa7],
    [0xf2, 0x8e, 0x2b],
    [0x59, 0xa1, 0x4f],
    [0xe1, 0x57, 0x59],
    [0x76, 0xb7, 0xb2],
    [0xed, 0xc9, 0x48],
    [0xb0, 0x7a, 0xa1],
];

/// Colour of shafts and pins, with their rings and keys.
const MOUNTED: [u8; 3] = [0x5a, 0x60, 0x68];

/// Poses of a body's pieces in the machine, each with the name of its link.
type Places = Vec<(String, Isometry3<f64>)>;

/// A shape of the machine with the poses of its pieces.
struct Placed<'a> {
    shape: &'a Shape,
    color: [u8; 3],
    material: String,
    items: Places,
}

/// The bodies of a machine as meshes, each once, with names and poses.
pub(super) struct Whole<'a> {
    bodies: Vec<(Placed<'a>, Vec<Mesh>)>,
}

impl<'a> Whole<'a> {
    /// Meshes of every body of the machine, without its surroundings, within a tolerance.
    pub(super) fn new(
        machine: &'a LinkedMachine,
        tolerance: Tolerance,
    ) -> Result<Self, SolidError> {
        let bodies = placed(machine).into_iter().map(|placed| {
            let meshes = meshes(&placed.shape.form, tolerance)?;
            Ok((placed, meshes))
        });
        let bodies = bodies.collect::<Result<_, SolidError>>()?;
        Ok(Self { bodies })
    }

    /// Bodies in their positions as the general arrangement shows the machine.
    pub(super) fn objects(&self) -> Vec<Object<'_>> {
        let bodies = self.bodies.iter();
        bodies
            .flat_map(|(placed, meshes)| {
                let (name, alone) = (placed.shape.short_name(), meshes.len() == 1);
                meshes.iter().enumerate().map(move |(number, mesh)| Object {
                    name: match alone {
                        true => name.to_owned(),
                        false => format!("{name} {}", number + 1),
                    },
                    mesh,
                    color: Some(placed.color),
                    material: placed.material.clone(),
                    items: placed.items.clone(),
                })
            })
            .collect()
    }
}

/// Exact bodies in their positions as the general arrangement shows the machine; without bodies that exist only as meshes.
pub(super) fn components(machine: &LinkedMachine) -> Vec<Component<'_>> {
    let shapes = placed(machine).into_iter();
    let components = shapes.filter_map(|placed| {
        let shell = |shell: Shell| vec![Exact::Shell(shell)];
        let bodies = match &placed.shape.form {
            Form::Solids(solids) => solids.iter().map(Exact::Solid).collect(),
            Form::Turned(part) => shell(part.solid().ok()?.shell()),
            Form::Body(body) => shell(body.shell()?),
            Form::Mesh(..) => return None,
        };
        Some(Component {
            name: placed.shape.short_name().into(),
            bodies,
            color: placed.color,
            material: placed.material,
            items: placed.items,
        })
    });
    components.collect()
}

/// The shapes of links that belong to the machine, not to its surroundings.
fn placed(machine: &LinkedMachine) -> Vec<Placed<'_>> {
    let required = vec![true; machine.links.len()];
    let places = machine.places(machine.arrangement.input, &required);
    let mut items = vec![Places::new(); machine.shapes.len()];
    for (index, (link, place)) in machine.links.iter().zip(places).enumerate() {
        let own = machine.parts.iter().any(|part| part.links.contains(&index));
        if let Some(place) = place.filter(|_| own) {
            for (shape, at) in link.bodies() {
                items[shape].push((link.name.clone(), place * at));
            }
        }
    }
    let mounted = machine.links.iter().flat_map(|link| &link.mounted);
    let mounted: BTreeSet<usize> = mounted.map(|body| body.shape).collect();
    let mut colors = COLORS.into_iter().cycle();
    let shapes = machine.shapes.iter().enumerate().zip(items);
    let placed = shapes.map(|((index, shape), items)| Placed {
        shape,
        color: match mounted.contains(&index) {
            true => MOUNTED,
            false => colors.next().unwrap_or_default(),
        },
        material: material(machine, index),
        items,
    });
    placed.filter(|placed| !placed.items.is_empty()).collect()
}

/// Material of a shape: that of the part with its name, otherwise the only material of the parts on its links that are not
/// bought; empty if there are several.
fn material(machine: &LinkedMachine, index: usize) -> String {
    let shape = &machine.shapes[index];
    if let Form::Turned(part) = &shape.form {
        return part.material.clone();
    }
    let named = |part: &&Part| {
        let file = part.file.as_str();
        match part.supply {
            Supply::Bought => part.word() == shape.short_name(),
            _ => !file.is_empty() && (file == shape.part || file == shape.short_name()),
        }
    };
    if let Some(part) = machine.parts.iter().find(named) {
        return part.material.clone();
    }
    let on = |link: &usize| machine.links[*link].shape == Some(index);
    let parts = machine
        .parts
        .iter()
        .filter(|part| part.supply != Supply::Bought && part.links.iter().any(on));
    let mut materials: Vec<&str> = parts.map(|part| &*part.material).collect();
    materials.retain(|material| !material.is_empty());
    materials.dedup();
    match materials[..] {
        [only] => only.into(),
        _ => String::new(),
    }
}

/// Closed meshes of a body, one per solid: solids that touch would not form one closed mesh.
fn meshes(form: &Form, tolerance: Tolerance) -> Result<Vec<Mesh>, SolidError> {
    match form {
        Form::Solids(solids) => solids.iter().map(|solid| solid.mesh(tolerance)).collect(),
        Form::Mesh(mesh, _) => Ok(vec![mesh.clone()]),
        Form::Turned(part) => Ok(vec![part.solid()?.mesh(tolerance)?]),
        Form::Body(body) => Ok(vec![body.mesh(tolerance)?]),
    }
}
