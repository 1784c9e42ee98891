//! Comparison of forces with closed forms, virtual work and energy.

mod closed_forms;
mod picker;
mod teeth;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{Jet, MassProperties, Point};
use centrode_kinematics::linkage::{Branch, Line, LinkId as Bar, Linkage, LinkageError};
use centrode_kinematics::machine::{
    Axes, Closure, Constant, Contact, FrameJet, GearMesh, Input, Joint, Linear, Link,
    LinkedMachine, Load, PitchCurves, Quantity,
};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use nalgebra::{Matrix3, Point3};

use super::*;

type Law = Arc<dyn Transmission>;

fn law(f: impl Fn(f64) -> MotionJet + Send + Sync + 'static) -> Law {
    Arc::new(FromFn::new(TAU, 0.0, Vec::new(), f))
}

fn turning(slope: f64) -> Law {
    Arc::new(Linear::new(0.0, slope))
}

fn number(value: f64) -> Quantity {
    Quantity::Law(Arc::new(Constant(value)))
}

fn machine(names: &[&str]) -> LinkedMachine {
    let mut machine = LinkedMachine {
        input: Input {
            name: "crank".into(),
            period: TAU,
            speed: 1.0,
        },
        ..LinkedMachine::default()
    };
    for name in names {
        machine.link(Link::new(*name));
    }
    machine
}

fn mass(mass: f64, [x, y]: [f64; 2], inertia: f64) -> MassProperties {
    MassProperties {
        mass,
        center: Point3::new(x, y, 0.0),
        inertia: Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, inertia)),
    }
}

/// Drive, pin force and so on of a joint.
fn reaction(forces: &Forces, joint: usize) -> Vector3<f64> {
    forces.joints[joint].reaction.expect("determined").force
}

/// A torque on a link, N mm.
fn torque(link: usize, size: f64) -> Load {
    Load::Torque {
        link,
        torque: [0.0, 0.0, size].map(number),
        axes: Axes::World,
    }
}

/// Law of the angle of a bar, against another one where there is one.
fn angle(linkage: &Arc<Linkage>, bar: Bar, less: Option<Bar>) -> Law {
    let linkage = linkage.clone();
    law(move |phi| {
        let pose = linkage.at(phi).expect("it turns");
        let own = pose.body(bar).angle;
        less.map_or(own, |less| own.plus(-1.0, &pose.body(less).angle))
    })
}

/// A four-bar of crank, coupler, rocker and frame, and its three moving bars.
fn four_bar([a, b, c, d]: [f64; 4]) -> (Arc<Linkage>, [Bar; 3]) {
    let mut linkage = Linkage::new();
    let mut build = || {
        let p = linkage.point(Bar::FRAME, Point::origin())?;
        let q = linkage.point(Bar::FRAME, Point::new(d, 0.0))?;
        let (crank, tip) = linkage.crank(p, a, 0.0)?;
        let bars = linkage.rrr(tip, q, (b, c), Branch::Upper)?;
        Ok::<_, LinkageError>([crank, bars.first, bars.second])
    };
    let bars = build().expect("a linkage");
    (Arc::new(linkage), bars)
}

fn near(found: f64, required: f64, share: f64) {
    let off = (found - required).abs();
    assert!(off <= share * (1.0 + required.abs()), "{found} {required}");
}

/// A crank of 30 mm, a rod of 100 mm, a piston on the x axis.
fn slider_crank(piston: f64) -> LinkedMachine {
    let (r, l) = (30.0, 100.0);
    let mut found = machine(&["frame", "crank", "rod", "piston"]);
    // sin b = r sin t / l.
    let lean = move |t: f64| {
        let (sin, cos) = t.sin_cos();
        let beta = (r * sin / l).asin();
        let first = r * cos / (l * beta.cos());
        let second = -r * sin / (l * beta.cos()) + first * first * beta.tan();
        [beta, first, second]
    };
    let rod = law(move |t| {
        let [beta, first, second] = lean(t);
        MotionJet {
            position: -beta - t,
            velocity: -first - 1.0,
            acceleration: -second,
            jerk: 0.0,
        }
    });
    let way = law(move |t| {
        let [beta, first, second] = lean(t);
        let ((sin, cos), (sb, cb)) = (t.sin_cos(), beta.sin_cos());
        MotionJet {
            position: r * cos + l * cb,
            velocity: -r * sin - l * sb * first,
            acceleration: -r * cos - l * (cb * first * first + sb * second),
            jerk: 0.0,
        }
    });
    found.joint(Joint::turning(0, 1, turning(1.0)));
    found.joint(Joint::turning(1, 2, rod).at([r, 0.0, 0.0]));
    found.joint(Joint::sliding(0, 3, [1.0, 0.0, 0.0], [0.0, 200.0], way));
    found.closures.push(Closure {
        links: [2, 3],
        at: [l, 0.0, 0.0],
        joints: [1, 2],
    });
    found.links[3].mass = Some(mass(piston, [0.0, 0.0], 100.0));
    found
}

/// Circular gears of 20 and 40 mm with 20 degree flanks, a load on the driven one.
fn gears(load: f64) -> LinkedMachine {
    let mut found = machine(&["frame", "pinion", "wheel"]);
    found.joint(Joint::turning(0, 1, turning(1.0)));
    found.joint(Joint::turning(0, 2, turning(-0.5)).at([60.0, 0.0, 0.0]));
    found
        .meshes
        .push(GearMesh::new([1, 2], 1, 20_f64.to_radians()));
    found.loads.push(torque(2, load));
    found
}

#[test]
fn what_has_no_single_answer_is_refused_by_name() {
    let refused = |machine: LinkedMachine| {
        let found = Balance::new(machine).map(|_| ());
        found.expect_err("refused").to_string()
    };
    let mut twice = gears(1.0);
    let third = twice.link(Link::new("idler"));
    twice.joint(Joint::turning(0, third, turning(1.0)).at([60.0, 60.0, 0.0]));
    twice.meshes.push(GearMesh {
        links: [third, 2],
        ..twice.meshes[0].clone()
    });
    let stated = refused(twice);
    for words in [
        "wheel is driven by both",
        "the mesh of pinion and wheel and the mesh of idler and wheel",
    ] {
        assert!(stated.contains(words), "{stated}");
    }
    let mut far = gears(1.0);
    far.meshes[0].links = [0, 1];
    let stated = refused(far);
    assert!(
        stated.contains("the mesh of frame and pinion cannot move wheel"),
        "{stated}"
    );
    let mut light = gears(1.0);
    light.links[1].mass = Some(mass(-1.0, [0.0; 2], 0.0));
    assert!(refused(light).contains("the mass of pinion is -1 kg"));
    let mut ring = gears(1.0);
    ring.meshes.clear();
    ring.joints[0].leader = Some(1);
    ring.joints[1].leader = Some(0);
    assert!(refused(ring).contains("the leading joint"));
    // Stretched, the rod passes no torque: the piston cannot be driven from the crank's side by any force.
    let mut dead = slider_crank(1.0);
    dead.closures[0].joints = [0, 1];
    let balance = Balance::new(dead).expect("the piston drives");
    assert!(balance.at(1.0, 1.0).is_ok());
    let error = balance.at(1.0, 1e300).expect_err("too fast").to_string();
    assert!(error.contains("not finite"), "{error}");
    let error = balance.at(0.0, 1.0).expect_err("dead");
    assert!(
        error
            .to_string()
            .contains("at the input 0 rad no force on the pin of rod and piston")
    );
}
