//! Products in their positions: one file with every body once, coloured, and each piece with its name.

use centrode_geometry::{Shell, Solid};
use nalgebra::Isometry3;

use super::part21::{Data, Id, List, Real, Text};
use super::{Products, StepError, brep, context, finished, shell};

/// A body of a [`Component`].
#[derive(Clone, Debug)]
pub enum Exact<'a> {
    /// An extrusion.
    Solid(&'a Solid),
    /// Faces on exact surfaces.
    Shell(Shell),
}

/// A product of an assembly, and each of its positions.
#[derive(Clone, Debug)]
pub struct Component<'a> {
    /// Name.
    pub name: String,
    /// Bodies in its own frame, mm.
    pub bodies: Vec<Exact<'a>>,
    /// Red, green and blue.
    pub color: [u8; 3],
    /// Material; may be empty.
    pub material: String,
    /// Name and position of each piece.
    pub items: Vec<(String, Isometry3<f64>)>,
}

/// Writes products in their positions as one STEP AP214 file in millimetres, called `name`, the assembly `title`.
///
/// Each body is as exact as in [`super::write`] and is in the file once, for any number of pieces.
///
/// # Errors
/// [`StepError`] if a body cannot be written.
pub fn write_assembly(
    components: &[Component<'_>],
    name: &str,
    title: &str,
) -> Result<Vec<u8>, StepError> {
    let mut data = Data::default();
    let products = Products::new(&mut data);
    let context = context(&mut data);
    let whole = products.add(&mut data, &Text(title).to_string());
    let root = frame(&mut data, &Isometry3::identity());
    let (mut seats, mut pieces, mut styled) = (vec![root], Vec::new(), Vec::new());
    for component in components {
        let name = Text(&component.name).to_string();
        let product = products.add(&mut data, &name);
        let origin = frame(&mut data, &Isometry3::identity());
        let mut content = vec![origin];
        for body in &component.bodies {
            let body = match body {
                Exact::Solid(solid) => brep::manifold(&mut data, &name, solid)?,
                Exact::Shell(shell) => shell::manifold(&mut data, &name, shell)?,
            };
            content.push(body);
            styled.push(colored(&mut data, body, component.color));
        }
        let shape = data.add(format_args!(
            "ADVANCED_BREP_SHAPE_REPRESENTATION({name},{},{context})",
            List(&content)
        ));
        represent(&mut data, product, shape);
        if !component.material.is_empty() {
            made_of(&mut data, product, &component.material, context);
        }
        for (name, place) in &component.items {
            let seat = frame(&mut data, place);
            seats.push(seat);
            pieces.push((name, product, shape, origin, seat));
        }
    }
    let shape = data.add(format_args!(
        "SHAPE_REPRESENTATION({},{},{context})",
        Text(name),
        List(&seats)
    ));
    represent(&mut data, whole, shape);
    for (index, (name, product, part, origin, seat)) in pieces.into_iter().enumerate() {
        let name = Text(name);
        let usage = data.add(format_args!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{}',{name},'',{whole},{product},$)",
            index + 1
        ));
        let placed = data.add(format_args!("PRODUCT_DEFINITION_SHAPE('','',{usage})"));
        let moved = data.add(format_args!(
            "ITEM_DEFINED_TRANSFORMATION('','',{origin},{seat})"
        ));
        let relation = data.add(format_args!(
            "(REPRESENTATION_RELATIONSHIP('','',{part},{shape})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})SHAPE_REPRESENTATION_RELATIONSHIP())"
        ));
        data.add(format_args!(
            "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{placed})"
        ));
    }
    data.add(format_args!(
        "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},{context})",
        List(&styled)
    ));
    Ok(finished(&data, name, title))
}

/// Ties a shape to its product.
fn represent(data: &mut Data, product: Id, shape: Id) {
    let property = data.add(format_args!("PRODUCT_DEFINITION_SHAPE('','',{product})"));
    data.add(format_args!(
        "SHAPE_DEFINITION_REPRESENTATION({property},{shape})"
    ));
}

/// Names the material of a product, by the recommended practices of CAx-IF.
fn made_of(data: &mut Data, product: Id, material: &str, context: Id) {
    let material = Text(material).to_string();
    let named = data.add(format_args!(
        "DESCRIPTIVE_REPRESENTATION_ITEM({material},{material})"
    ));
    let stated = data.add(format_args!(
        "REPRESENTATION('material name',({named}),{context})"
    ));
    let property = data.add(format_args!(
        "PROPERTY_DEFINITION('material property','material name',{product})"
    ));
    data.add(format_args!(
        "PROPERTY_DEFINITION_REPRESENTATION({property},{stated})"
    ));
}

/// A frame: origin, z and x axis.
fn frame(data: &mut Data, place: &Isometry3<f64>) -> Id {
    let turn = place.rotation.to_rotation_matrix();
    let numbers = |axis: [f64; 3]| axis.map(Real);
    let [x, z] = [0, 2].map(|i| numbers(turn.matrix().column(i).into_owned().into()));
    let at = numbers(place.translation.vector.into());
    let at = data.add(format_args!("CARTESIAN_POINT('',{})", List(&at)));
    let [z, x] = [z, x].map(|axis| data.add(format_args!("DIRECTION('',{})", List(&axis))));
    data.add(format_args!("AXIS2_PLACEMENT_3D('',{at},{z},{x})"))
}

/// Colours a body.
fn colored(data: &mut Data, body: Id, color: [u8; 3]) -> Id {
    let [red, green, blue] = color.map(|share| Real(f64::from(share) / 255.0));
    let color = data.add(format_args!("COLOUR_RGB('',{red},{green},{blue})"));
    let filled = data.add(format_args!("FILL_AREA_STYLE_COLOUR('',{color})"));
    let filled = data.add(format_args!("FILL_AREA_STYLE('',({filled}))"));
    let filled = data.add(format_args!("SURFACE_STYLE_FILL_AREA({filled})"));
    let side = data.add(format_args!("SURFACE_SIDE_STYLE('',({filled}))"));
    let usage = data.add(format_args!("SURFACE_STYLE_USAGE(.BOTH.,{side})"));
    let style = data.add(format_args!("PRESENTATION_STYLE_ASSIGNMENT(({usage}))"));
    data.add(format_args!("STYLED_ITEM('',({style}),{body})"))
}
