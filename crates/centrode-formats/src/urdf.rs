//! URDF robot descriptions.

use crate::model::{JointKind, Model, ModelLink};
use crate::xml::comment;
use thiserror::Error;
use urdf_rs::{
    Axis, Collision, Geometry, Inertia, Inertial, Joint, JointLimit, JointType, LinkName, Mass,
    Mimic, Pose, Robot, Vec3, Visual,
};

/// Metres per millimetre.
const METRE: f64 = 1e-3;

/// Reason why a model could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum UrdfError {
    /// A joint names a link that the model lacks.
    #[error("joint {joint:?} names link {link:?}, which is not in the model")]
    Link {
        /// The joint.
        joint: String,
        /// The missing link.
        link: String,
    },
    /// The URDF library refused.
    #[error("cannot write URDF: {0}")]
    Library(#[from] urdf_rs::UrdfError),
}

/// Setting for `MuJoCo` to search meshes in the folders of their file names; other readers ignore it.
const FOLDERS: &str = "\n  <mujoco><compiler strippath=\"false\"/></mujoco>";

/// Name of the STL file of a model's convex body, in a folder next to the URDF file.
///
/// One file per body: several bodies in one file, as in OBJ, become one hull in `MuJoCo` and one triangle mesh in others.
#[must_use]
pub fn collision_file(body: &str) -> String {
    format!("collision/{body}.stl")
}

/// Writes a model as URDF: metres, kilograms, radians; visible meshes by the names of files next to it, scaled from mm; convex
/// collision bodies by the names of [`collision_file`].
///
/// # Errors
/// [`UrdfError`] if a joint names a link that the model lacks.
pub fn write(model: &Model) -> Result<Vec<u8>, UrdfError> {
    for joint in &model.joints {
        for end in [&joint.parent, &joint.child] {
            if !model.links.iter().any(|link| link.name == *end) {
                return Err(UrdfError::Link {
                    joint: joint.name.clone(),
                    link: end.clone(),
                });
            }
        }
    }
    let robot = Robot {
        name: model.name.clone(),
        version: None,
        links: model.links.iter().map(link).collect(),
        joints: model.joints.iter().map(joint).collect(),
        materials: Vec::new(),
    };
    let xml = urdf_rs::write_to_string(&robot)?;
    Ok(with_note(&xml, &model.note).into_bytes())
}

/// Adds the note as a comment, and the setting for `MuJoCo`, inside the outermost element, where every reader permits them.
fn with_note(xml: &str, note: &str) -> String {
    let end = xml
        .find("<robot")
        .and_then(|at| xml[at..].find('>').map(|close| at + close + 1));
    let Some(end) = end else {
        return xml.to_owned();
    };
    let note = if note.is_empty() {
        String::new()
    } else {
        format!("\n  <!-- {} -->", comment(note))
    };
    format!("{}{note}{FOLDERS}{}", &xml[..end], &xml[end..])
}

fn metres(v: [f64; 3]) -> Vec3 {
    Vec3(v.map(|x| x * METRE + 0.0))
}

fn link(link: &ModelLink) -> urdf_rs::Link {
    let geometry = |filename: String| Geometry::Mesh {
        filename,
        scale: Some(Vec3([METRE; 3])),
    };
    let inertial = link.mass.map_or_else(Inertial::default, |m| {
        // kg mm² to kg m².
        let i = m.inertia * (METRE * METRE);
        Inertial {
            origin: Pose {
                xyz: metres([m.center.x, m.center.y, m.center.z]),
                rpy: Vec3([0.0; 3]),
            },
            mass: Mass { value: m.mass },
            inertia: Inertia {
                ixx: i[(0, 0)],
                ixy: i[(0, 1)] + 0.0,
                ixz: i[(0, 2)] + 0.0,
                iyy: i[(1, 1)],
                iyz: i[(1, 2)] + 0.0,
                izz: i[(2, 2)],
            },
        }
    });
    urdf_rs::Link {
        name: link.name.clone(),
        inertial,
        visual: link
            .meshes
            .iter()
            .map(|seen| Visual {
                origin: Pose {
                    xyz: metres(seen.at),
                    rpy: Vec3(seen.turn),
                },
                geometry: geometry(seen.file.clone()),
                ..Visual::default()
            })
            .collect(),
        collision: link
            .collision
            .iter()
            .map(|body| Collision {
                // Several links may have one body, but a reader requires unique names.
                name: Some(format!("{}/{}", link.name, body.name)),
                geometry: geometry(collision_file(&body.name)),
                ..Collision::default()
            })
            .collect(),
    }
}

fn joint(joint: &crate::model::ModelJoint) -> Joint {
    Joint {
        name: joint.name.clone(),
        joint_type: match joint.kind {
            JointKind::Fixed => JointType::Fixed,
            JointKind::Continuous => JointType::Continuous,
            JointKind::Sliding(_) => JointType::Prismatic,
        },
        origin: Pose {
            xyz: metres(joint.origin),
            rpy: Vec3(joint.turn.map(|angle| angle + 0.0)),
        },
        parent: LinkName {
            link: joint.parent.clone(),
        },
        child: LinkName {
            link: joint.child.clone(),
        },
        axis: Axis {
            xyz: Vec3(joint.axis),
        },
        // An endless joint has no limits; these state it for readers that require numbers.
        limit: JointLimit {
            effort: 1000.0,
            velocity: 1000.0,
            ..match joint.kind {
                JointKind::Sliding([lower, upper]) => JointLimit {
                    lower: lower * METRE,
                    upper: upper * METRE,
                    ..JointLimit::default()
                },
                _ => JointLimit::default(),
            }
        },
        calibration: None,
        dynamics: None,
        mimic: joint.mimic.as_ref().map(|mimic| Mimic {
            joint: mimic.joint.clone(),
            multiplier: Some(mimic.multiplier),
            offset: Some(mimic.offset),
        }),
        safety_controller: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Convex, Mimic, ModelJoint, Seen};
    use centrode_geometry::{Outline, Point, Solid, Tolerance};

    fn sample() -> Model {
        let disc = Solid::new(
            Outline::circle(Point::new(2.0, 0.0), 20.0),
            vec![],
            0.0,
            10.0,
        )
        .expect("has height");
        let turning = |name: &str, x: f64, mimic: Option<Mimic>| ModelJoint {
            name: format!("{name}_joint"),
            kind: JointKind::Continuous,
            parent: "base".into(),
            child: name.into(),
            origin: [x, 0.0, 0.0],
            turn: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            mimic,
        };
        let body = |name: &str| ModelLink {
            name: name.into(),
            mass: Some(disc.mass_properties(7850.0)),
            meshes: vec![Seen::upright(format!("{name}.stl"))],
            collision: vec![Convex {
                name: format!("{name}_hub"),
                mesh: disc
                    .mesh(Tolerance::new(0.1).expect("positive"))
                    .expect("a solid"),
            }],
        };
        Model {
            name: "pair".into(),
            note: "law -- in motion.csv".into(),
            links: vec![
                ModelLink {
                    name: "base".into(),
                    mass: None,
                    meshes: Vec::new(),
                    collision: Vec::new(),
                },
                body("driver"),
                body("driven"),
            ],
            joints: vec![
                turning("driver", 0.0, None),
                turning(
                    "driven",
                    52.5,
                    Some(Mimic {
                        joint: "driver_joint".into(),
                        multiplier: -1.0,
                        offset: 0.0,
                    }),
                ),
            ],
        }
    }

    #[test]
    fn a_model_reads_back_in_metres_and_kilograms() {
        let bytes = write(&sample()).expect("written");
        assert_eq!(bytes, write(&sample()).expect("written again"));
        let text = String::from_utf8(bytes).expect("text");
        assert!(text.contains("<!-- law - - in motion.csv -->"), "{text}");
        let robot = urdf_rs::read_from_string(&text).expect("readable");
        assert_eq!((robot.links.len(), robot.joints.len()), (3, 2));
        let inertial = &robot.links[1].inertial;
        let mass = 7850.0 * std::f64::consts::PI * 0.02_f64.powi(2) * 0.01;
        assert!((inertial.mass.value - mass).abs() < 1e-12);
        assert!((inertial.inertia.izz - 0.5 * mass * 0.02_f64.powi(2)).abs() < 1e-15);
        assert!((inertial.origin.xyz[0] - 0.002).abs() < 1e-15);
        assert!((robot.joints[1].origin.xyz[0] - 0.0525).abs() < 1e-15);
        let mimic = robot.joints[1].mimic.as_ref().expect("follows");
        assert_eq!(
            (mimic.joint.as_str(), mimic.multiplier),
            ("driver_joint", Some(-1.0))
        );
        let Geometry::Mesh { filename, scale } = &robot.links[2].visual[0].geometry else {
            panic!("a mesh")
        };
        assert_eq!(
            (filename.as_str(), scale.map(|s| s.0)),
            ("driven.stl", Some([0.001; 3]))
        );
        let [touching] = &robot.links[2].collision[..] else {
            panic!("one body to touch with")
        };
        assert!(
            matches!(&touching.geometry, Geometry::Mesh { filename, scale: Some(scale) }
                if filename == "collision/driven_hub.stl" && scale.0 == [0.001; 3])
        );
        assert!(text.contains("strippath=\"false\""), "{text}");
    }

    #[test]
    fn a_joint_to_nowhere_is_refused() {
        let mut model = sample();
        model.joints[0].child = "lost".into();
        assert!(matches!(write(&model), Err(UrdfError::Link { .. })));
    }
}
