//! Geometry and laws in the form of a machine's plain file.

use std::fmt::Display;
use std::sync::Arc;

use centrode_geometry::{
    Arc as Bow, MassProperties, Mesh, Opening, Outline, Point, PolySegment, Segment, Solid, Vector,
};
use nalgebra::Matrix3;
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, Error as _};
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Form, Piecewise, TurnedPart};
use crate::transmission::Transmission;

/// One segment of a closed contour; the parameter of a curve runs from -1 to 1.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum Edge {
    /// A straight line.
    Line {
        /// First point, mm.
        from: [f64; 2],
        /// Last point, mm.
        to: [f64; 2],
    },
    /// A circular arc.
    Arc {
        /// First point, mm.
        from: [f64; 2],
        /// Last point, mm.
        to: [f64; 2],
        /// Tangent of a quarter of the turned angle, positive counter-clockwise.
        bulge: f64,
    },
    /// A polynomial of degree 13.
    Curve {
        /// First point, mm.
        from: [f64; 2],
        /// Last point, mm.
        to: [f64; 2],
        /// Coefficients of the powers of the parameter, x and y, constant first, mm.
        coefficients: Vec<[f64; 2]>,
    },
}

/// A closed contour: segments in order.
type Contour = Vec<Edge>;

fn contour(outline: &Outline) -> Contour {
    let at = |p: &Point| [p.x, p.y];
    let edge = |segment: &Segment| match segment {
        Segment::Line(from, to) => Edge::Line {
            from: at(from),
            to: at(to),
        },
        Segment::Arc(Bow { start, end, bulge }) => Edge::Arc {
            from: at(start),
            to: at(end),
            bulge: *bulge,
        },
        Segment::Poly(spline) => Edge::Curve {
            from: at(&spline.start()),
            to: at(&spline.end()),
            coefficients: spline.coefficients().iter().map(|c| [c.x, c.y]).collect(),
        },
    };
    outline.segments().iter().map(edge).collect()
}

fn outline(contour: Contour) -> Result<Outline, String> {
    let edge = |edge: Edge| -> Result<Segment, String> {
        Ok(match edge {
            Edge::Line { from, to } => Segment::Line(from.into(), to.into()),
            Edge::Arc { from, to, bulge } => Segment::Arc(Bow {
                start: from.into(),
                end: to.into(),
                bulge,
            }),
            Edge::Curve {
                from,
                to,
                coefficients,
            } => {
                let count = coefficients.len();
                let coefficients: Vec<Vector> = coefficients.into_iter().map(Into::into).collect();
                let coefficients = coefficients
                    .try_into()
                    .map_err(|_| format!("a curve must have 14 coefficients, not {count}"))?;
                Segment::Poly(PolySegment::new(from.into(), to.into(), coefficients))
            }
        })
    };
    let segments: Vec<Segment> = contour.into_iter().map(edge).collect::<Result<_, _>>()?;
    if segments.is_empty() {
        return Err("a contour must have at least one segment".into());
    }
    Outline::new(segments).map_err(|e| e.to_string())
}

/// An opening through a wall of an extrusion.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OpeningFile {
    /// Its corners on the outline, mm.
    outer: [[f64; 2]; 2],
    /// Its corners on the hole, mm.
    inner: [[f64; 2]; 2],
    /// Lower and upper end, mm.
    span: [f64; 2],
}

/// An extrusion along z.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Extrusion {
    /// Outer contour.
    outline: Contour,
    /// Contours of the holes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    holes: Vec<Contour>,
    /// Lower and upper face, mm.
    span: [f64; 2],
    /// Holes through a wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    opening: Option<OpeningFile>,
}

/// A body in space.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum FormFile {
    /// Extrusions along z.
    Solids {
        /// Each of them.
        solids: Vec<Extrusion>,
    },
    /// A shaft or pin.
    Turned {
        /// The part, from z = 0 upwards.
        part: TurnedPart,
    },
    /// A closed triangle mesh.
    Mesh {
        /// Corners, mm.
        vertices: Vec<[f64; 3]>,
        /// Indices of the corners of each triangle, counter-clockwise seen from outside.
        faces: Vec<[u32; 3]>,
        /// How far it may lie off the body, mm.
        off: f64,
    },
}

impl Serialize for Form {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let file = match self {
            Self::Solids(solids) => FormFile::Solids {
                solids: solids.iter().map(extrusion).collect(),
            },
            Self::Mesh(mesh, off) => FormFile::Mesh {
                vertices: mesh.vertices.clone(),
                faces: mesh.faces.clone(),
                off: *off,
            },
            Self::Turned(part) => FormFile::Turned { part: part.clone() },
            Self::Body(_) => return Err(S::Error::custom("this body must be meshed first")),
        };
        file.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Form {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match FormFile::deserialize(deserializer)? {
            FormFile::Solids { solids } => {
                let solids = solids.into_iter().map(solid).collect::<Result<_, _>>();
                Ok(Self::Solids(solids.map_err(D::Error::custom)?))
            }
            FormFile::Turned { part } => match part.solid() {
                Ok(_) => Ok(Self::Turned(part)),
                Err(error) => Err(D::Error::custom(error)),
            },
            FormFile::Mesh {
                vertices,
                faces,
                off,
            } => {
                let count = vertices.len();
                let inside = |corner: &u32| (*corner as usize) < count;
                if !faces.iter().flatten().all(inside) {
                    return Err(D::Error::custom(format!(
                        "a face refers to a vertex that does not exist: there are {count}"
                    )));
                }
                Ok(Self::Mesh(Mesh { vertices, faces }, off))
            }
        }
    }
}

fn extrusion(solid: &Solid) -> Extrusion {
    let pair = |ends: &[Point; 2]| ends.map(|p| [p.x, p.y]);
    Extrusion {
        outline: contour(solid.outline()),
        holes: solid.holes().iter().map(contour).collect(),
        span: [solid.bottom(), solid.top()],
        opening: solid.opening().map(|opening| OpeningFile {
            outer: pair(&opening.outer),
            inner: pair(&opening.inner),
            span: opening.span,
        }),
    }
}

fn solid(file: Extrusion) -> Result<Solid, String> {
    let holes = file.holes.into_iter().map(outline);
    let holes = holes.collect::<Result<_, _>>()?;
    let [bottom, top] = file.span;
    let solid = Solid::new(outline(file.outline)?, holes, bottom, top);
    let solid = solid.map_err(|e| e.to_string())?;
    match file.opening {
        None => Ok(solid),
        Some(OpeningFile { outer, inner, span }) => {
            let pair = |ends: [[f64; 2]; 2]| ends.map(Point::from);
            let opening = Opening {
                outer: pair(outer),
                inner: pair(inner),
                span,
            };
            solid.with_opening(opening).map_err(|e| e.to_string())
        }
    }
}

/// Mass, center of mass and inertia.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MassFile {
    /// Mass, kg.
    mass: f64,
    /// Center of mass, mm.
    center: [f64; 3],
    /// Rows of the inertia tensor about the center of mass, kg mm^2.
    inertia: [[f64; 3]; 3],
}

impl From<&MassProperties> for MassFile {
    fn from(found: &MassProperties) -> Self {
        let inertia = &found.inertia;
        Self {
            mass: found.mass,
            center: found.center.coords.into(),
            inertia: [0, 1, 2].map(|i| [0, 1, 2].map(|j| inertia[(i, j)])),
        }
    }
}

impl From<MassFile> for MassProperties {
    fn from(file: MassFile) -> Self {
        Self {
            mass: file.mass,
            center: file.center.into(),
            inertia: Matrix3::from_fn(|i, j| file.inertia[i][j]),
        }
    }
}

/// Reads a value from its form in the file.
fn read<'de, D, F, T, E>(
    deserializer: D,
    make: impl FnOnce(F) -> Result<T, E>,
) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    F: DeserializeOwned,
    E: Display,
{
    make(F::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// An outline as a contour.
pub(super) mod contours {
    use super::{
        Contour, Deserializer, Outline, Serialize as _, Serializer, contour, outline, read,
    };

    pub(in super::super) type File = Contour;

    pub(in super::super) fn serialize<S: Serializer>(
        of: &Outline,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        contour(of).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Outline, D::Error> {
        read(deserializer, outline)
    }
}

/// The mass of a link that has one.
pub(super) mod masses {
    use super::{Deserializer, MassFile, MassProperties, Serialize as _, Serializer, read};
    use std::convert::Infallible;

    pub(in super::super) type File = Option<MassFile>;

    pub(in super::super) fn serialize<S: Serializer>(
        of: &Option<MassProperties>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        of.as_ref().map(MassFile::from).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<MassProperties>, D::Error> {
        let made = |file: File| Ok::<_, Infallible>(file.map(MassProperties::from));
        read(deserializer, made)
    }
}

/// A law as its pieces.
pub(super) mod laws {
    use super::{Arc, Deserializer, Piecewise, Serialize as _, Serializer, Transmission, read};

    pub(in super::super) type File = Piecewise;

    pub(in super::super) fn serialize<S: Serializer>(
        of: &Arc<dyn Transmission>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        of.pieces().serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Arc<dyn Transmission>, D::Error> {
        let sound = |law: Piecewise| {
            let made: Option<Arc<dyn Transmission>> = law.is_sound().then(|| Arc::new(law) as _);
            made.ok_or("the pieces of a law must follow each other from 0 to its period, and all numbers must be finite")
        };
        read(deserializer, sound)
    }
}
