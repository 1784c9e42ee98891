use centrode_geometry::{Mesh, SolidError, Tolerance};
use centrode_mechanism::machine::{Form, Machine, Shape};

use nalgebra::Isometry3;

use crate::step::{Component, Exact};
use crate::threemf::Object;

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

/// The bodies of a machine as meshes, each once, with what they are called.
pub(super) struct Whole {
    bodies: Vec<(usize, String, Mesh)>,
}

impl Whole {
    /// Meshes of every body that is made or bought, within a tolerance.
    pub(super) fn new(machine: &Machine, tolerance: Tolerance) -> Result<Self, SolidError> {
        let mut bodies = Vec::new();
        for (index, shape) in machine.shapes.iter().enumerate() {
            if links(machine, index).next().is_none() {
                continue;
            }
            let name = name(shape);
            let meshes = meshes(&shape.form, tolerance)?;
            let alone = meshes.len() == 1;
            for (number, mesh) in meshes.into_iter().enumerate() {
                let name = match alone {
                    true => name.to_owned(),
                    false => format!("{name} {}", number + 1),
                };
                bodies.push((index, name, mesh));
            }
        }
        Ok(Self { bodies })
    }

    /// Bodies in their places as the general arrangement shows the machine.
    pub(super) fn objects(&self, machine: &Machine) -> Vec<Object<'_>> {
        let items = items(machine);
        let bodies = self.bodies.iter();
        bodies
            .map(|(shape, name, mesh)| Object {
                name: name.clone(),
                mesh,
                color: Some(COLORS[shape % COLORS.len()]),
                items: items[*shape].clone(),
            })
            .collect()
    }
}

/// Exact bodies in their places as the general arrangement shows the machine; none of those known as meshes alone.
pub(super) fn components(machine: &Machine) -> Vec<Component<'_>> {
    let mut components = Vec::new();
    let shapes = machine.shapes.iter().zip(items(machine));
    for (index, (shape, items)) in shapes.enumerate() {
        let bodies = match &shape.form {
            _ if items.is_empty() => continue,
            Form::Solids(solids) => solids.iter().map(Exact::Solid).collect(),
            Form::Body(body) => body.shell().map(Exact::Shell).into_iter().collect(),
            Form::Mesh(..) => Vec::new(),
        };
        if !bodies.is_empty() {
            components.push(Component {
                name: name(shape).to_owned(),
                bodies,
                color: COLORS[index % COLORS.len()],
                items,
            });
        }
    }
    components
}

/// Name and place of each link that has a shape, by shapes.
fn items(machine: &Machine) -> Vec<Vec<(String, Isometry3<f64>)>> {
    let wanted = vec![true; machine.links.len()];
    let places = machine.places(machine.arrangement.input, &wanted);
    let of = |shape: usize| {
        let placed = links(machine, shape).filter_map(|link| {
            let place = places[link]?;
            Some((machine.links[link].name.clone(), place))
        });
        placed.collect()
    };
    (0..machine.shapes.len()).map(of).collect()
}

/// Links with a shape that belong to the machine, not to its surroundings.
fn links(machine: &Machine, shape: usize) -> impl Iterator<Item = usize> {
    let own = |link: &usize| machine.parts.iter().any(|part| part.links.contains(link));
    let links = machine.links.iter().enumerate();
    let seen = links.filter(move |(_, link)| link.shape == Some(shape));
    seen.map(|(index, _)| index).filter(own)
}

/// Name of a shape without its folder.
fn name(shape: &Shape) -> &str {
    shape.name.rsplit('/').next().unwrap_or_default()
}

/// Closed meshes of a body: several solids that touch would be none together.
fn meshes(form: &Form, tolerance: Tolerance) -> Result<Vec<Mesh>, SolidError> {
    match form {
        Form::Solids(solids) => solids.iter().map(|solid| solid.mesh(tolerance)).collect(),
        Form::Mesh(mesh, _) => Ok(vec![mesh.clone()]),
        Form::Body(body) => Ok(vec![body.mesh(tolerance)?]),
    }
}
