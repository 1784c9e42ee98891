use super::{contact_body, motion, solid};
use crate::ExportError;
use crate::model::{Joint, JointKind, Link, Mimic, Model, shown_tolerance};
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::{GearPair, Member};

/// Name of the STL file, without its end, that shows a gear, and the tolerance of the mesh in it: the gear's own file,
/// or another where that has too many triangles for simulators.
pub(crate) fn shown(
    pair: &GearPair,
    member: Member,
    tolerance: Tolerance,
) -> Result<(String, Tolerance), ExportError> {
    let solid = solid(pair, member)?;
    let coarse = shown_tolerance(tolerance, |t| solid.mesh_faces(t));
    let end = if coarse == tolerance { "" } else { "-body" };
    Ok((format!("{}{end}", member.name()), coarse))
}

/// A frame with both gears turning about z, the driver at its origin.
///
/// Its note tells the law of motion and how truly the convex bodies stand for the teeth.
pub(crate) fn model(pair: &GearPair, tolerance: Tolerance) -> Result<Model, ExportError> {
    let (slope, offset, error) = motion::line(pair);
    // At the driver polar angle phi the driver has turned by -phi, the driven gear by its driven angle.
    let mimic = (error <= motion::LINEAR).then(|| Mimic {
        joint: joint_name(Member::Driver),
        multiplier: -slope,
        offset: 0.0,
    });
    let law = if mimic.is_some() {
        "The law of motion is linear and written as a mimic joint.".to_owned()
    } else {
        format!(
            "The law of motion is not linear: it is in motion.csv, as motion.json describes, with driver_joint = -driver_angle_rad \
             and driven_joint = driven_angle_rad. No mimic joint is written; the best one, multiplier \
             {:?} and offset {offset:?} rad, would be off by {error:?} rad.",
            -slope,
        )
    };
    let mut links = vec![Link {
        name: "base".into(),
        mass: None,
        mesh: None,
        collision: Vec::new(),
    }];
    let mut joints = Vec::new();
    let mut excess: f64 = 0.0;
    for member in [Member::Driver, Member::Driven] {
        let density = pair.gear(member).body().density;
        let touching = contact_body::all(pair.gear(member), member.name(), tolerance);
        excess = excess.max(touching.excess);
        links.push(Link {
            name: member.name().into(),
            mass: Some(solid(pair, member)?.mass_properties(density)),
            mesh: Some(format!("{}.stl", shown(pair, member, tolerance)?.0)),
            collision: touching.bodies,
        });
        let is_driven = member == Member::Driven;
        joints.push(Joint {
            name: joint_name(member),
            kind: JointKind::Continuous,
            parent: "base".into(),
            child: member.name().into(),
            origin: [
                if is_driven {
                    pair.center_distance()
                } else {
                    0.0
                },
                0.0,
                0.0,
            ],
            turn: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            mimic: mimic.clone().filter(|_| is_driven),
        });
    }
    Ok(Model {
        name: pair.name().to_owned(),
        note: format!(
            "{law} Teeth touch as convex bodies, of flanks and tip without fillets, over a hub without bore; these stand \
             out of the gears by at most {excess:.1e} mm."
        ),
        links,
        joints,
    })
}

pub(super) fn joint_name(member: Member) -> String {
    format!("{}_joint", member.name())
}
