//! 3MF packages: closed meshes with their unit, names, colours and positions.

use centrode_geometry::{Mesh, checkpoint};
use nalgebra::Isometry3;
use std::{
    collections::HashMap,
    fmt::Write as _,
    io::{Cursor, Write as _},
};
use thiserror::Error;

use crate::sheet::number;
use crate::xml::escaped;
use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

/// Reason why a package could not be made.
#[derive(Debug, Error)]
#[error("the 3MF package cannot be created: {0}")]
pub struct PackageError(#[from] zip::result::ZipError);

impl From<std::io::Error> for PackageError {
    fn from(error: std::io::Error) -> Self {
        Self(error.into())
    }
}

const TYPES: &str = concat!(
    r#"<?xml version="1.0" encoding="UTF-8"?>"#,
    "\n",
    r#"<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">"#,
    r#"<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>"#,
    r#"<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>"#,
    "</Types>\n",
);

const RELATIONS: &str = concat!(
    r#"<?xml version="1.0" encoding="UTF-8"?>"#,
    "\n",
    r#"<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">"#,
    r#"<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>"#,
    "</Relationships>\n",
);

/// Writes a mesh as a 3MF package in millimetres, its object called `name`, the model `title`.
///
/// Coordinates are single precision, as in readers; vertices that rounding makes equal are written once, so that the mesh stays
/// closed.
///
/// # Errors
/// [`PackageError`] if the package would be larger than the format holds.
pub fn write(mesh: &Mesh, name: &str, title: &str) -> Result<Vec<u8>, PackageError> {
    let items = vec![(String::new(), Isometry3::identity())];
    let (name, color, material) = (name.to_owned(), None, String::new());
    write_assembly(
        &[Object {
            name,
            mesh,
            color,
            material,
            items,
        }],
        title,
    )
}

/// A body of an assembly, and each of its positions.
#[derive(Clone, Debug)]
pub struct Object<'a> {
    /// Name.
    pub name: String,
    /// Closed mesh in its own frame, mm.
    pub mesh: &'a Mesh,
    /// Red, green and blue.
    pub color: Option<[u8; 3]>,
    /// Material, stated where it has a colour; may be empty.
    pub material: String,
    /// Name and position of each piece; a name may be empty.
    pub items: Vec<(String, Isometry3<f64>)>,
}

/// Writes bodies in their positions as one 3MF package in millimetres, each as in [`write()`].
///
/// # Errors
/// [`PackageError`] if the package would be larger than the format holds.
pub fn write_assembly(objects: &[Object<'_>], title: &str) -> Result<Vec<u8>, PackageError> {
    // A fixed date: equal meshes give equal bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut package = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, text) in [
        ("[Content_Types].xml", TYPES),
        ("_rels/.rels", RELATIONS),
        ("3D/3dmodel.model", &model(objects, title)),
    ] {
        package.start_file(path, options)?;
        package.write_all(text.as_bytes())?;
    }
    Ok(package.finish()?.into_inner())
}

fn model(objects: &[Object<'_>], title: &str) -> String {
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
         <metadata name=\"Title\">{}</metadata>\n<metadata name=\"Application\">centrode</metadata>\n\
         <resources>\n",
        escaped(title),
    );
    // The list of colours has its own id after those of the objects.
    let colors = objects.len() + 1;
    let bases = objects.iter().filter_map(|object| {
        let [r, g, b] = object.color?;
        let color = format!("#{r:02X}{g:02X}{b:02X}");
        let name = match &*object.material {
            "" => color.clone(),
            material => escaped(material),
        };
        Some(format!(
            "<base name=\"{name}\" displaycolor=\"{color}\"/>\n"
        ))
    });
    let bases: String = bases.collect();
    if !bases.is_empty() {
        xml += &format!("<basematerials id=\"{colors}\">\n{bases}</basematerials>\n");
    }
    let mut base = 0;
    for (index, object) in objects.iter().enumerate() {
        let color = object.color.map(|_| {
            base += 1;
            format!(" pid=\"{colors}\" pindex=\"{}\"", base - 1)
        });
        xml += &format!(
            "<object id=\"{}\" type=\"model\" name=\"{}\"{}>\n",
            index + 1,
            escaped(&object.name),
            color.unwrap_or_default()
        );
        body(&mut xml, object.mesh);
        xml += "</object>\n";
    }
    xml += "</resources>\n<build>\n";
    for (index, object) in objects.iter().enumerate() {
        for (name, place) in &object.items {
            xml += &item(index + 1, name, place);
        }
    }
    xml += "</build>\n</model>\n";
    xml
}

/// Adds the vertices and triangles of a mesh.
fn body(xml: &mut String, mesh: &Mesh) {
    let (vertices, faces) = single_precision(mesh);
    xml.push_str("<mesh>\n<vertices>\n");
    // Writing to a string cannot fail.
    for [x, y, z] in vertices {
        checkpoint();
        let _ = writeln!(xml, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    }
    xml.push_str("</vertices>\n<triangles>\n");
    for [a, b, c] in faces {
        checkpoint();
        let _ = writeln!(xml, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    xml.push_str("</triangles>\n</mesh>\n");
}

/// A piece in its position: the images of the axes, then of the origin.
fn item(object: usize, name: &str, place: &Isometry3<f64>) -> String {
    let mut words = format!("<item objectid=\"{object}\"");
    if *place != Isometry3::identity() {
        let matrix = place.to_homogeneous();
        let columns = (0..4).flat_map(|column| (0..3).map(move |row| (row, column)));
        let numbers = columns.map(|at| number(matrix[at], 9));
        let numbers: Vec<String> = numbers.collect();
        words += &format!(" transform=\"{}\"", numbers.join(" "));
    }
    if !name.is_empty() {
        words += &format!(" partnumber=\"{}\"", escaped(name));
    }
    words + "/>\n"
}

/// Vertices rounded to single precision, equal ones merged, and the remaining faces.
fn single_precision(mesh: &Mesh) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut numbers = HashMap::new();
    let mut vertices = Vec::with_capacity(mesh.vertices.len());
    let number: Vec<u32> = mesh
        .vertices
        .iter()
        .map(|v| {
            let rounded = v.map(|x| x as f32 + 0.0);
            *numbers.entry(rounded.map(f32::to_bits)).or_insert_with(|| {
                vertices.push(rounded);
                vertices.len() as u32 - 1
            })
        })
        .collect();
    let faces = mesh
        .faces
        .iter()
        .map(|face| face.map(|v| number[v as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    (vertices, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::{Outline, Point, Solid, Tolerance};
    use std::io::Read;

    fn tube() -> Mesh {
        let circle = |radius| Outline::circle(Point::origin(), radius);
        Solid::new(circle(20.0), vec![circle(8.0)], 0.0, 12.0)
            .expect("has height")
            .mesh(Tolerance::new(1e-2).expect("positive"))
            .expect("apart")
    }

    fn part(package: &[u8], path: &str) -> String {
        let mut archive = zip::ZipArchive::new(Cursor::new(package)).expect("a zip");
        let mut text = String::new();
        archive
            .by_name(path)
            .expect("in the package")
            .read_to_string(&mut text)
            .expect("text");
        text
    }

    #[test]
    fn a_package_holds_the_whole_mesh_and_is_the_same_twice() {
        let mesh = tube();
        let package = write(&mesh, "a \"b\"", "<c & d>").expect("made");
        assert_eq!(package, write(&mesh, "a \"b\"", "<c & d>").expect("again"));
        let model = part(&package, "3D/3dmodel.model");
        assert_eq!(model.matches("<vertex ").count(), mesh.vertices.len());
        assert_eq!(model.matches("<triangle ").count(), mesh.faces.len());
        assert!(model.contains("unit=\"millimeter\"") && model.contains("a &quot;b&quot;"));
        assert!(model.contains("&lt;c &amp; d&gt;"));
        assert!(part(&package, "_rels/.rels").contains("/3D/3dmodel.model"));
    }

    #[test]
    fn vertices_that_rounding_makes_one_leave_the_mesh_closed() {
        let p = Point::new;
        let points = [
            p(0.0, 10.0),
            p(90.0, 10.0),
            p(90.0, 10.0 + 1e-9),
            p(90.0, 60.0),
        ];
        let mesh = Solid::new(Outline::polygon(&points), vec![], 0.0, 5.0)
            .expect("has height")
            .mesh(Tolerance::new(1e-12).expect("positive"))
            .expect("simple");
        assert_eq!(mesh.vertices.len(), 8);
        let (vertices, faces) = single_precision(&mesh);
        let welded = Mesh {
            vertices: vertices.iter().map(|v| v.map(f64::from)).collect(),
            faces,
        };
        assert_eq!(welded.vertices.len(), 6);
        assert!(welded.is_watertight());
        assert!((welded.volume() - 0.5 * 90.0 * 50.0 * 5.0).abs() < 1e-3);
    }
}
