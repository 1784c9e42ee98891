use super::model;
use crate::ExportError;
use centrode_formats::stl;
use centrode_geometry::{Tolerance, checkpoint};
use centrode_kinematics::machine::LinkedMachine;
use nalgebra::Isometry3;
use serde::Serialize;

/// Head of a machine in space: the files of its meshes, its links, and their poses.
#[derive(Serialize)]
struct Head<'a> {
    shapes: Vec<StlFile>,
    /// Bodies of the links.
    links: Vec<Placed<'a>>,
    /// Inputs at which their positions are given, rad.
    input: &'a [f64],
}

#[derive(Serialize)]
struct StlFile {
    file: String,
    bytes: usize,
}

#[derive(Serialize)]
struct Placed<'a> {
    name: &'a str,
    shape: usize,
}

/// The machine in space: each mesh as the STL file that goes with the simulator models, and the pose of each body of a link at
/// every given input.
///
/// The bytes are: length of the head (u32), head (JSON, filled with blanks to a multiple of four bytes); for each body in turn x,
/// y, z (mm) and the quaternion x, y, z, w at every input (f32); the STL files in the order of the head. All little-endian.
///
/// # Errors
/// [`ExportError`] where a mesh or the head cannot be made.
pub fn spatial(
    machine: &LinkedMachine,
    input: &[f64],
    tolerance: Tolerance,
) -> Result<Vec<u8>, ExportError> {
    let no_solid = |source| ExportError::no_solid("link")(source);
    let mut shapes = Vec::new();
    let mut files = Vec::new();
    for shape in &machine.shapes {
        checkpoint();
        let (file, mesh) = model::shown(shape, tolerance).map_err(no_solid)?;
        let stl = stl::write(&mesh);
        shapes.push(StlFile {
            file,
            bytes: stl.len(),
        });
        files.push(stl);
    }
    let links = machine.links.iter().enumerate();
    let seen: Vec<(usize, Isometry3<f64>, Placed<'_>)> = links
        .flat_map(|(index, link)| {
            let bodies = link.bodies();
            bodies.map(move |(shape, place)| {
                let name = match Some(shape) == link.shape {
                    true => &link.name,
                    false => machine.shapes[shape].short_name(),
                };
                (index, place, Placed { name, shape })
            })
        })
        .collect();
    let mut places: Vec<Vec<f32>> = vec![Vec::with_capacity(7 * input.len()); seen.len()];
    let required = vec![true; machine.links.len()];
    for &now in input {
        checkpoint();
        let all = machine.places(now, &required);
        for ((link, body, _), places) in seen.iter().zip(&mut places) {
            let place = all[*link].unwrap_or_default() * body;
            places.extend(place.translation.vector.iter().map(|&x| x as f32));
            places.extend(place.rotation.coords.iter().map(|&x| x as f32));
        }
    }
    let links = seen.into_iter().map(|(.., placed)| placed).collect();
    let mut head = serde_json::to_vec(&Head {
        shapes,
        links,
        input,
    })?;
    head.resize(head.len().next_multiple_of(4), b' ');
    let mut bytes = (head.len() as u32).to_le_bytes().to_vec();
    bytes.append(&mut head);
    for number in places.into_iter().flatten() {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
    for mut file in files {
        bytes.append(&mut file);
    }
    Ok(bytes)
}
