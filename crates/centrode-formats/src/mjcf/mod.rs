//! MJCF, the model files of `MuJoCo`.

use crate::model::{Convex, JointKind, Model, ModelJoint, ModelLink};
use crate::xml::{comment, escaped};
use centrode_geometry::MassProperties;
use nalgebra::UnitQuaternion;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::iter::successors;
use thiserror::Error;

/// Metres per millimetre.
const METRE: f64 = 1e-3;

/// Options of the solver: stiff contacts, resolved finely, so that a tooth sinks into its mate by less than a
/// micrometre under a small load.
const OPTIONS: &str = r#"  <compiler angle="radian" autolimits="true"/>
  <option timestep="0.0002" ccd_tolerance="1e-9" ccd_iterations="100"/>
  <default>
    <default class="visual">
      <geom type="mesh" contype="0" conaffinity="0" group="2" mass="0"/>
    </default>
    <default class="collision">
      <geom type="mesh" condim="1" solref="0.001 1" group="3" mass="0" rgba="0.8 0.5 0.2 0.5"/>
    </default>
  </default>
"#;

/// Reason why a model could not be written.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MjcfError {
    /// A joint names a link that the model lacks.
    #[error("joint {joint:?} names link {link:?}, which is not in the model")]
    Link {
        /// The joint.
        joint: String,
        /// The missing link.
        link: String,
    },
    /// A link is not connected to the first one by exactly one chain of joints.
    #[error(
        "link {link:?} must be connected to the first link by one chain of joints, not by {ways}"
    )]
    Tree {
        /// The link.
        link: String,
        /// Number of chains; 0 may mean a ring.
        ways: usize,
    },
    /// A link that moves has no mass.
    #[error("link {link:?} moves but has no mass")]
    Massless {
        /// The link.
        link: String,
    },
}

/// Pin between two links that is not in the tree of joints and closes a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Name.
    pub name: String,
    /// First link.
    pub first: String,
    /// Second link.
    pub second: String,
    /// The point in the frame of the first, mm; where all joints are zero the links meet there.
    pub at: [f64; 3],
}

/// Writes a model as MJCF: metres, kilograms, radians; visible meshes by the names of files next to it, scaled from mm; convex
/// collision bodies inline.
///
/// # Errors
/// [`MjcfError`] if the links do not form a tree or a moving link has no mass.
pub fn write(model: &Model) -> Result<Vec<u8>, MjcfError> {
    write_closed(model, &[])
}

/// Writes a model with loops, closed by stiff equality constraints.
///
/// # Errors
/// Those of [`write()`], and if a closure names a link that the model lacks.
pub fn write_closed(model: &Model, closures: &[Closure]) -> Result<Vec<u8>, MjcfError> {
    is_tree(model)?;
    for closure in closures {
        for end in [&closure.first, &closure.second] {
            if !model.links.iter().any(|link| link.name == *end) {
                return Err(MjcfError::Link {
                    joint: closure.name.clone(),
                    link: end.clone(),
                });
            }
        }
    }
    let mut xml = format!("<mujoco model={}>\n", quoted(&model.name));
    if !model.note.is_empty() {
        line(
            &mut xml,
            1,
            format_args!("<!-- {} -->", comment(&model.note)),
        );
    }
    xml.push_str(OPTIONS);
    xml.push_str("  <asset>\n");
    let mut written = BTreeSet::new();
    for link in &model.links {
        assets(&mut xml, link, &mut written);
    }
    xml.push_str("  </asset>\n  <worldbody>\n");
    line(&mut xml, 2, format_args!(r#"<light pos="0 0 1"/>"#));
    if let Some(root) = model.links.first() {
        geoms(&mut xml, root, 2);
        children(&mut xml, model, root, 2)?;
    }
    xml.push_str("  </worldbody>\n");
    equalities(&mut xml, model, closures);
    xml.push_str("</mujoco>\n");
    Ok(xml.into_bytes())
}

/// Checks that one joint carries every link except the first, and that a chain of joints connects each link to the first.
fn is_tree(model: &Model) -> Result<(), MjcfError> {
    let index = |joint: &ModelJoint, end: &str| {
        let found = model.links.iter().position(|link| link.name == end);
        found.ok_or_else(|| MjcfError::Link {
            joint: joint.name.clone(),
            link: end.to_owned(),
        })
    };
    let ends = model.joints.iter();
    let ends = ends.map(|j| Ok([index(j, &j.parent)?, index(j, &j.child)?]));
    let ends: Vec<[usize; 2]> = ends.collect::<Result<_, _>>()?;
    let carrier = |link: &usize| ends.iter().find(|[_, child]| child == link);
    for (index, link) in model.links.iter().enumerate() {
        let carriers = ends.iter().filter(|[_, child]| *child == index).count();
        let ways = carriers + usize::from(index == 0);
        // Links that are each carried once, but have no chain to the first link, form a ring.
        let chain = successors(Some(index), |link| Some(carrier(link)?[0]));
        let is_ring = || chain.take(ends.len() + 2).count() > ends.len() + 1;
        let ways = if ways == 1 && is_ring() { 0 } else { ways };
        if ways != 1 {
            let link = link.name.clone();
            return Err(MjcfError::Tree { link, ways });
        }
    }
    Ok(())
}

fn assets<'a>(xml: &mut String, link: &'a ModelLink, written: &mut BTreeSet<&'a str>) {
    for (index, seen) in link.meshes.iter().enumerate() {
        // Several links may have bodies from the same file.
        let name = asset(link, index);
        if index > 0 && !written.insert(name) {
            continue;
        }
        let (name, file) = (quoted(name), quoted(&seen.file));
        let scale = numbers([METRE; 3]);
        line(
            xml,
            2,
            format_args!("<mesh name={name} file={file} scale={scale}/>"),
        );
    }
    for Convex { name, mesh } in &link.collision {
        if !written.insert(name) {
            continue;
        }
        let name = quoted(name);
        let vertices = numbers(mesh.vertices.iter().flatten().map(|x| x * METRE));
        line(
            xml,
            2,
            format_args!("<mesh name={name} vertex={vertices}/>"),
        );
    }
}

/// Name of a visible mesh of a link: the first has the name of the link, others that of their file.
fn asset(link: &ModelLink, index: usize) -> &str {
    match index {
        0 => &link.name,
        _ => &link.meshes[index].file,
    }
}

fn geoms(xml: &mut String, link: &ModelLink, depth: usize) {
    for (index, seen) in link.meshes.iter().enumerate() {
        let (name, mut place) = (quoted(asset(link, index)), String::new());
        if seen.at != [0.0; 3] {
            place = format!(" pos={}", numbers(seen.at.map(|x| x * METRE)));
        }
        place += &quaternion(seen.turn);
        line(
            xml,
            depth,
            format_args!(r#"<geom class="visual" mesh={name}{place}/>"#),
        );
    }
    for body in &link.collision {
        let mesh = quoted(&body.name);
        line(
            xml,
            depth,
            format_args!(r#"<geom class="collision" mesh={mesh}/>"#),
        );
    }
}

/// Attribute of a turn by roll, pitch and yaw; empty if all three are zero.
fn quaternion(turn: [f64; 3]) -> String {
    match turn {
        [0.0, 0.0, 0.0] => String::new(),
        [x, y, z] => {
            let turn = UnitQuaternion::from_euler_angles(x, y, z).into_inner();
            format!(" quat={}", numbers([turn.w, turn.i, turn.j, turn.k]))
        }
    }
}

/// Writes the links that a link carries, each with the links that it carries in turn.
fn children(
    xml: &mut String,
    model: &Model,
    of: &ModelLink,
    depth: usize,
) -> Result<(), MjcfError> {
    for joint in model.joints.iter().filter(|j| j.parent == of.name) {
        let Some(link) = model.links.iter().find(|l| l.name == joint.child) else {
            continue;
        };
        let place = numbers(joint.origin.map(|x| x * METRE));
        let name = quoted(&link.name);
        let turn = quaternion(joint.turn);
        line(
            xml,
            depth,
            format_args!("<body name={name} pos={place}{turn}>"),
        );
        moves(xml, joint, depth + 1);
        match link.mass {
            Some(mass) => inertial(xml, &mass, depth + 1),
            None if joint.kind == JointKind::Fixed => {}
            None => {
                return Err(MjcfError::Massless {
                    link: link.name.clone(),
                });
            }
        }
        geoms(xml, link, depth + 1);
        children(xml, model, link, depth + 1)?;
        line(xml, depth, format_args!("</body>"));
    }
    Ok(())
}

/// Writes the joint of a body on its carrier.
fn moves(xml: &mut String, joint: &ModelJoint, depth: usize) {
    let (name, axis) = (quoted(&joint.name), numbers(joint.axis));
    match joint.kind {
        JointKind::Fixed => {}
        JointKind::Continuous => line(
            xml,
            depth,
            format_args!(r#"<joint name={name} type="hinge" axis={axis}/>"#),
        ),
        JointKind::Sliding(range) => {
            let range = numbers(range.map(|x| x * METRE));
            line(
                xml,
                depth,
                format_args!(r#"<joint name={name} type="slide" axis={axis} range={range}/>"#),
            );
        }
    }
}

fn inertial(xml: &mut String, mass: &MassProperties, depth: usize) {
    // kg mm² to kg m².
    let i = mass.inertia * (METRE * METRE);
    let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let inertia = numbers(pairs.map(|at| i[at]));
    let place = numbers([mass.center.x, mass.center.y, mass.center.z].map(|x| x * METRE));
    let mass = numbers([mass.mass]);
    line(
        xml,
        depth,
        format_args!("<inertial pos={place} mass={mass} fullinertia={inertia}/>"),
    );
}

/// Stiffness of a closure: its links are apart by less than a hundredth of a micrometre under the weight of its links.
const CLOSED: &str = r#"solref="0.0004 1" solimp="0.9999 0.9999 0.001""#;

fn equalities(xml: &mut String, model: &Model, closures: &[Closure]) {
    let followers = model
        .joints
        .iter()
        .filter_map(|j| j.mimic.as_ref().map(|m| (j, m)));
    let mut lines = String::new();
    for (joint, mimic) in followers {
        let (follower, followed) = (quoted(&joint.name), quoted(&mimic.joint));
        let law = numbers([mimic.offset, mimic.multiplier, 0.0, 0.0, 0.0]);
        line(
            &mut lines,
            2,
            format_args!("<joint joint1={follower} joint2={followed} polycoef={law}/>"),
        );
    }
    for closure in closures {
        let name = quoted(&closure.name);
        let [first, second] = [&closure.first, &closure.second].map(|link| quoted(link));
        let at = numbers(closure.at.map(|x| x * METRE));
        line(
            &mut lines,
            2,
            format_args!(
                r"<connect name={name} body1={first} body2={second} anchor={at} {CLOSED}/>"
            ),
        );
    }
    if !lines.is_empty() {
        *xml += &format!("  <equality>\n{lines}  </equality>\n");
    }
}

fn line(xml: &mut String, depth: usize, words: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = writeln!(xml, "{:1$}{words}", "", 2 * depth);
}

/// Numbers as the value of an attribute, with the fewest digits that read back to the same numbers.
fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let words: Vec<String> = values
        .into_iter()
        .map(|x| format!("{:?}", x + 0.0))
        .collect();
    format!("\"{}\"", words.join(" "))
}

/// Words as the value of an attribute.
fn quoted(words: &str) -> String {
    format!("\"{}\"", escaped(words))
}

#[cfg(test)]
mod tests;
