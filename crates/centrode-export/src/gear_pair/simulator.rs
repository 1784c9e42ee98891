use super::{GearPairFilesError, motion, solid, tooth_body};
use crate::model::{Joint, JointKind, Link, Mimic, Model};
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::{GearPair, Member};

/// A frame with both gears turning about z, the driver at its origin.
pub(super) fn model(pair: &GearPair) -> Result<Model, GearPairFilesError> {
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
    for member in [Member::Driver, Member::Driven] {
        let density = pair.gear(member).body().density;
        links.push(Link {
            name: member.name().into(),
            mass: Some(solid(pair, member)?.mass_properties(density)),
            mesh: Some(format!("{}.stl", member.name())),
            collision: Vec::new(),
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

/// The model with a convex body for each tooth, and how truly they stand for the teeth in its note.
pub(super) fn with_teeth(mut model: Model, pair: &GearPair, tolerance: Tolerance) -> Model {
    let mut hollow: f64 = 0.0;
    for member in [Member::Driver, Member::Driven] {
        let teeth = tooth_body::all(pair.gear(member), tolerance);
        hollow = teeth.iter().map(|t| t.hollow).fold(hollow, f64::max);
        if let Some(link) = model.links.iter_mut().find(|l| l.name == member.name()) {
            link.collision = teeth.into_iter().map(|t| t.body).collect();
        }
    }
    model.note +=
        " The teeth touch as convex bodies, one a tooth, of flanks and tip without fillets";
    model.note += &if hollow > tolerance.mm() {
        format!("; over hollow flanks these stand out by up to {hollow:.4} mm.")
    } else {
        ".".to_owned()
    };
    model
}

pub(super) fn joint_name(member: Member) -> String {
    format!("{}_joint", member.name())
}
