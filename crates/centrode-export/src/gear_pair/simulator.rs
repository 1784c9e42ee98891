use super::{GearPairFilesError, motion, solid};
use crate::model::{Joint, JointKind, Link, Mimic, Model};
use centrode_mechanism::gear::{GearPair, Member};

/// Angle, rad, below which a law of motion counts as linear: float noise over a whole cycle.
const LINEAR: f64 = 1e-9;

/// A frame with both gears turning about z, the driver at its origin.
pub(super) fn model(pair: &GearPair) -> Result<Model, GearPairFilesError> {
    let (slope, offset, error) = motion::line(pair);
    // At the driver polar angle phi the driver has turned by -phi, the driven gear by its driven angle.
    let mimic = (error <= LINEAR).then(|| Mimic {
        joint: joint_name(Member::Driver),
        multiplier: -slope,
        offset: 0.0,
    });
    let law = if mimic.is_some() {
        "The law of motion is linear and written as a mimic joint.".to_owned()
    } else {
        format!(
            "The law of motion is not linear: it is in motion.csv, with driver_joint = -driver_angle_rad \
             and driven_joint = driven_angle_rad. No mimic joint is written; the best one, multiplier \
             {:?} and offset {offset:?} rad, would be off by {error:?} rad.",
            -slope,
        )
    };
    let mut links = vec![Link {
        name: "base".into(),
        mass: None,
        mesh: None,
    }];
    let mut joints = Vec::new();
    for member in [Member::Driver, Member::Driven] {
        let density = pair.gear(member).body().density;
        links.push(Link {
            name: member.name().into(),
            mass: Some(solid(pair, member)?.mass_properties(density)),
            mesh: Some(format!("{}.stl", member.name())),
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
            axis: [0.0, 0.0, 1.0],
            mimic: mimic.clone().filter(|_| is_driven),
        });
    }
    Ok(Model {
        name: pair.name().to_owned(),
        note: law,
        links,
        joints,
    })
}

fn joint_name(member: Member) -> String {
    format!("{}_joint", member.name())
}
