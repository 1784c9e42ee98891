//! STEP files, ISO 10303-214: exact solids for CAD, no facets.

mod assembly;
mod brep;
mod contour;
mod opened;
mod part21;
mod shell;

use centrode_geometry::{Segment, Shell, Solid, Tolerance};
use part21::{Data, Id, Text};
use thiserror::Error;

pub use assembly::{Component, Exact, write_assembly};
pub use brep::poles;

/// Reason why a solid cannot be written as STEP.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A point of a contour is not a finite number.
    #[error("contour {contour} (0 is the outer one) has a point that is not finite")]
    NotFinite {
        /// Index of the contour, the outer one first.
        contour: usize,
    },
    /// A vertex of a shell is not a finite point.
    #[error("vertex {vertex} is not finite")]
    NotFiniteVertex {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A shell with a gap.
    #[error("the faces do not form a closed body: an edge does not belong to two faces")]
    Open,
    /// A contour that encloses nothing a CAD kernel can distinguish from a point or a line.
    #[error("contour {contour} (0 is the outer one) encloses no area")]
    NoRegion {
        /// Index of the contour, the outer one first.
        contour: usize,
    },
}

/// Writes a solid as STEP AP214 in millimetres, its product called `name`, the file described by `title`.
///
/// A straight side is a plane, an arc a cylinder, and a polynomial side the sweep of one Bézier curve, so the file contains the
/// exact solid without approximation. Sides shorter than 1e-6 mm, which a CAD kernel treats as points, are removed and their gaps
/// closed.
///
/// # Errors
/// [`StepError`] if a contour is not finite or encloses no area.
pub fn write(solid: &Solid, name: &str, title: &str) -> Result<Vec<u8>, StepError> {
    file(name, title, |data, name| brep::manifold(data, name, solid))
}

/// The sides of a solid's contours as in its file, the outer contour first, each with the material on its left; sides shorter
/// than the tolerance are removed and their gaps closed.
///
/// # Errors
/// [`StepError`] if a contour is not finite or encloses no area.
pub fn contours(solid: &Solid, shortest: Tolerance) -> Result<Vec<Vec<Segment>>, StepError> {
    contour::contours(solid, shortest.mm())
}

/// Writes a closed shell as STEP AP214 in millimetres, its product called `name`, the file described by `title`:
/// planes, cylinders, cones and ruled Bézier surfaces as they are.
///
/// # Errors
/// [`StepError`] if a vertex is not finite or the shell has a gap.
pub fn write_shell(shell: &Shell, name: &str, title: &str) -> Result<Vec<u8>, StepError> {
    file(name, title, |data, name| shell::manifold(data, name, shell))
}

/// Writes a file of one product with the solid that `solid` adds.
fn file(
    name: &str,
    title: &str,
    solid: impl FnOnce(&mut Data, &str) -> Result<Id, StepError>,
) -> Result<Vec<u8>, StepError> {
    let mut data = Data::default();
    let name_text = Text(name).to_string();
    let definition = Products::new(&mut data).add(&mut data, &name_text);
    let context = context(&mut data);
    let brep = solid(&mut data, &name_text)?;
    let origin = data.add("CARTESIAN_POINT('',(0.0,0.0,0.0))");
    let axis = data.add("DIRECTION('',(0.0,0.0,1.0))");
    let reference = data.add("DIRECTION('',(1.0,0.0,0.0))");
    let frame = data.add(format_args!(
        "AXIS2_PLACEMENT_3D('',{origin},{axis},{reference})"
    ));
    let shape = data.add(format_args!(
        "ADVANCED_BREP_SHAPE_REPRESENTATION({name_text},({frame},{brep}),{context})"
    ));
    let property = data.add(format_args!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
    data.add(format_args!(
        "SHAPE_DEFINITION_REPRESENTATION({property},{shape})"
    ));
    Ok(finished(&data, name, title))
}

/// The file of these entities.
fn finished(data: &Data, name: &str, title: &str) -> Vec<u8> {
    // A fixed date: equal designs give equal bytes.
    let header = format!(
        "ISO-10303-21;\nHEADER;\n\
         FILE_DESCRIPTION(({}),'2;1');\n\
         FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'centrode','centrode','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\n\
         ENDSEC;\nDATA;\n",
        Text(title),
        Text(&format!("{name}.step")),
    );
    let file = [
        header.as_str(),
        data.lines(),
        "ENDSEC;\nEND-ISO-10303-21;\n",
    ];
    file.concat().into_bytes()
}

/// Application and context of all products of a file.
#[derive(Clone, Copy, Debug)]
struct Products {
    application: Id,
    context: Id,
}

impl Products {
    fn new(data: &mut Data) -> Self {
        let application =
            data.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
        data.add(format_args!(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"
        ));
        let context = data.add(format_args!(
            "PRODUCT_CONTEXT('',{application},'mechanical')"
        ));
        Self {
            application,
            context,
        }
    }

    /// Writes a product; returns its definition.
    fn add(self, data: &mut Data, name: &str) -> Id {
        let Self {
            application,
            context,
        } = self;
        let product = data.add(format_args!("PRODUCT({name},{name},'',({context}))"));
        data.add(format_args!(
            "PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"
        ));
        let formation = data.add(format_args!(
            "PRODUCT_DEFINITION_FORMATION('','',{product})"
        ));
        let stage = data.add(format_args!(
            "PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"
        ));
        data.add(format_args!(
            "PRODUCT_DEFINITION('design','',{formation},{stage})"
        ))
    }
}

/// Writes the units, millimetres and radians, and the distance below which two points count as one.
fn context(data: &mut Data) -> Id {
    let length = data.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    let angle = data.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid_angle = data.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let accuracy = data.add(format_args!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),{length},'distance_accuracy_value','')"
    ));
    data.add(format_args!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({accuracy}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))REPRESENTATION_CONTEXT('',''))"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::{Outline, Point, Segment};

    fn count(file: &str, entity: &str) -> usize {
        file.matches(&format!("={entity}(")).count()
    }

    #[test]
    fn a_tube_has_two_caps_and_two_half_cylinders_a_contour() {
        let circle = |radius| Outline::circle(Point::origin(), radius);
        let tube = Solid::new(circle(20.0), vec![circle(8.0)], 0.0, 12.0).expect("has height");
        let bytes = write(&tube, "tube", "a tube").expect("written");
        assert_eq!(bytes, write(&tube, "tube", "a tube").expect("again"));
        let file = String::from_utf8(bytes).expect("text");
        assert_eq!(count(&file, "ADVANCED_FACE"), 6);
        assert_eq!(count(&file, "CYLINDRICAL_SURFACE"), 4);
        assert_eq!(count(&file, "EDGE_CURVE"), 12);
        // Every edge is walked once in each direction.
        for edge in file.lines().filter(|line| line.contains("=EDGE_CURVE(")) {
            let id = edge.split('=').next().expect("numbered");
            for way in ["T", "F"] {
                let use_of = format!("ORIENTED_EDGE('',*,*,{id},.{way}.)");
                assert_eq!(file.matches(&use_of).count(), 1, "{edge}");
            }
        }
    }

    #[test]
    fn sides_too_short_for_a_kernel_are_closed_up() {
        let p = Point::new;
        let square = [
            p(0.0, 0.0),
            p(9.0, 0.0),
            p(9.0, 9.0),
            p(0.0, 9.0),
            p(0.0, 1e-8),
        ];
        let solid = |points: &[Point]| {
            Solid::new(Outline::polygon(points), vec![], 0.0, 1.0).expect("has height")
        };
        let file =
            String::from_utf8(write(&solid(&square), "", "").expect("written")).expect("text");
        assert_eq!(count(&file, "PLANE"), 6);
        assert_eq!(count(&file, "VERTEX_POINT"), 8);
    }

    #[test]
    fn contours_without_area_or_number_are_refused() {
        let p = Point::new;
        let outer = Outline::circle(Point::origin(), 5.0);
        let with = |hole: Outline| {
            let solid = Solid::new(outer.clone(), vec![hole], 0.0, 1.0).expect("has height");
            write(&solid, "", "")
        };
        let there_and_back = Outline::new(vec![
            Segment::Line(p(0.0, 0.0), p(1.0, 0.0)),
            Segment::Line(p(1.0, 0.0), p(0.0, 0.0)),
        ])
        .expect("closed");
        assert_eq!(
            with(there_and_back),
            Err(StepError::NoRegion { contour: 1 })
        );
        let empty = Outline::new(vec![]).expect("closed");
        assert_eq!(with(empty), Err(StepError::NoRegion { contour: 1 }));
        let wild = Outline::circle(p(f64::INFINITY, 0.0), 1.0);
        assert_eq!(with(wild), Err(StepError::NotFinite { contour: 1 }));
    }
}
