use super::*;
use crate::model::{Mimic, Seen};
use centrode_geometry::{Mesh, Point};
use nalgebra::{Matrix3, Point3};

fn sample() -> Model {
    let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
    let body = |name: &str| ModelLink {
        name: name.into(),
        mass: Some(MassProperties {
            mass: 0.25,
            center: Point3::new(1.0, 2.0, 5.0),
            inertia: Matrix3::new(10.0, 1.0, 0.0, 1.0, 12.0, 0.0, 0.0, 0.0, 20.0),
        }),
        meshes: vec![Seen::upright(format!("{name}.stl"))],
        collision: vec![Convex {
            name: format!("{name}_tooth_0"),
            mesh: Mesh::prism(&corners.map(|[x, y]| Point::new(x, y)), -4.0, 0.0),
        }],
    };
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
    Model {
        name: "\"a\" & <b>".into(),
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
                    multiplier: -2.0,
                    offset: 0.5,
                }),
            ),
        ],
    }
}

#[test]
fn lengths_are_metres_and_text_is_escaped() {
    let text = String::from_utf8(write(&sample()).expect("written")).expect("text");
    for part in [
        r#"<mujoco model="&quot;a&quot; &amp; &lt;b&gt;">"#,
        "<!-- law - - in motion.csv -->",
        r#"<mesh name="driven" file="driven.stl" scale="0.001 0.001 0.001"/>"#,
        r#"vertex="0.0 0.0 -0.004 0.002 0.0 -0.004 0.0 0.002 -0.004 0.0 0.0 0.0 "#,
        r#"<body name="driven" pos="0.0525 0.0 0.0">"#,
        r#"<joint joint1="driven_joint" joint2="driver_joint" polycoef="0.5 -2.0 0.0 0.0 0.0"/>"#,
        r#"<geom class="collision" mesh="driven_tooth_0"/>"#,
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(text.contains(r#"pos="0.001 0.002 0.005" mass="0.25""#));
}

#[test]
fn further_meshes_of_a_link_stand_in_their_places_and_are_named_once() {
    let mut model = sample();
    let pin = Seen {
        file: "pin.stl".into(),
        at: [0.0, 5.0, -3.0],
        turn: [0.0, std::f64::consts::PI, 0.0],
    };
    for link in &mut model.links[1..] {
        link.meshes.push(pin.clone());
    }
    let text = String::from_utf8(write(&model).expect("written")).expect("text");
    assert_eq!(text.matches(r#"<mesh name="pin.stl" "#).count(), 1);
    let geom = r#"<geom class="visual" mesh="pin.stl" pos="0.0 0.005 -0.003" quat=""#;
    assert_eq!(text.matches(geom).count(), 2, "{text}");
}

#[test]
fn what_is_no_tree_of_bodies_is_refused() {
    let mut lost = sample();
    lost.joints[0].child = "lost".into();
    assert!(matches!(write(&lost), Err(MjcfError::Link { .. })));
    let mut twice = sample();
    twice.joints[1].child = "driver".into();
    assert!(matches!(
        write(&twice),
        Err(MjcfError::Tree { ways: 2, .. })
    ));
    let mut ring = sample();
    ring.joints[0].parent = "driven".into();
    ring.joints[1].parent = "driver".into();
    assert!(matches!(write(&ring), Err(MjcfError::Tree { ways: 0, .. })));
    let mut light = sample();
    light.links[2].mass = None;
    let driven = "driven".to_owned();
    assert_eq!(write(&light), Err(MjcfError::Massless { link: driven }));
}
