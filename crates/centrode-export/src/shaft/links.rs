use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use centrode_gear::Member;
use centrode_geometry::{MassProperties, Mesh, Shell, SolidError, Tolerance};
use centrode_groove::{GRAVITY, ShaftSolid, SpiralShaft};
use centrode_kinematics::machine::{
    self, Form, GearMesh, Guide, GuideForce, Input, Joint, Linear, Link, Load, Piecewise, Quantity,
    Shape, SolidBody,
};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use nalgebra::{Matrix3, Point3};

use super::machine::{Gears, Parts};
use super::{arrangement, figures, slider_solid};
use crate::{ExportError, gear_pair};

/// Distance beyond the slider's path that the joint of the box permits, mm.
const ROOM: f64 = 1.0;
/// Edge of the cube whose inertia the box has, mm.
const CUBE: f64 = 100.0;

/// The gears, the driver first.
pub(super) const MEMBERS: [Member; 2] = [Member::Driver, Member::Driven];

/// Name of the link that the slider moves.
pub(super) const BOX: &str = "box";

/// Prefix of the gears' files in a moving box's bundle.
pub(super) const GEARS: &str = "gears-";

/// The shaft lying along x of the world, the slider on top of it; the box slides, the slider swivels on its pin, and
/// elliptic gears, if any, are at the near end.
pub(super) fn machine(parts: &Parts<'_>) -> Result<machine::LinkedMachine, ExportError> {
    let shaft = parts.shaft;
    let mut machine = drawn(parts)?;
    let block = slider_solid(shaft)?;
    let seen = machine.shape(Shape {
        name: "shaft-body".into(),
        part: "shaft".into(),
        form: Form::Body(Arc::new(Grooved(shaft.clone()))),
    });
    let cut = machine.solids("slider-body", "slider", vec![block.clone()]);
    let block = block.mass_properties(shaft.slider().density);
    let carried = carried(shaft.load().mass - block.mass);
    for (name, mass, shape) in [
        ("shaft", shaft.mass_properties()?, Some(seen)),
        (BOX, carried, None),
        ("slider", block, Some(cut)),
    ] {
        if let Some(link) = machine.link_named(name) {
            machine.links[link].mass = Some(mass);
            machine.links[link].shape = shape;
        }
    }
    if let Some(gears) = &parts.gears {
        for member in MEMBERS {
            let link = machine.link_named(member.name()).unwrap_or(0);
            let names = [&*format!("{GEARS}{}", member.name()), member.name()];
            gear_pair::embody(&mut machine, link, &gears.pair, member, names)?;
        }
    }
    arrangement::annotate(parts, &mut machine)?;
    Ok(machine)
}

/// The machine with its motion and its drawn lines, without bodies.
pub(super) fn drawn(parts: &Parts<'_>) -> Result<machine::LinkedMachine, ExportError> {
    let shaft = parts.shaft;
    let (groove, slider) = (shaft.groove(), shaft.slider());
    let mut machine = machine::LinkedMachine {
        name: parts.name.into(),
        title: parts.title.into(),
        input: Input {
            name: if parts.gears.is_some() {
                "driver"
            } else {
                "shaft"
            }
            .into(),
            period: shaft.cycle(),
            speed: shaft.load().speed(),
        },
        note: format!(
            "The box has the mass moved and the inertia of a cube of {CUBE} mm, and no friction. Slider and groove do not touch."
        ),
        gravity: [0.0, 0.0, -1e3 * GRAVITY],
        ..machine::LinkedMachine::default()
    };
    let links = ["base", "frame", "shaft", BOX, "slider"];
    let [base, frame, turned, carriage, slid] = links.map(|name| machine.link(Link::new(name)));
    // The frame's z axis, along the shaft, is on the world's x axis; its x axis, towards the slider, points upwards.
    machine.joint(Joint::fixed(base, frame).turned([PI, -FRAC_PI_2, 0.0]));
    let (turn, stroke) = (turn(parts), parts.stroke.clone());
    let against = turn.clone();
    let back = FromFn::new(
        against.period(),
        -against.advance(),
        against.breaks(),
        move |input| MotionJet::default().plus(-1.0, &against.at(input)),
    );
    let turning = machine.joint(Joint::turning(frame, turned, Arc::new(back)));
    let (low, high) = shaft.traverse().reach();
    let (axis, range) = ([0.0, 0.0, 1.0], [low - ROOM, high + ROOM]);
    let swivel = swivel(&turn, &stroke, groove.radius());
    let boxed = Joint::sliding(frame, carriage, axis, range, stroke).led_by(turning);
    let boxed = machine.joint(boxed);
    let swivelling = Joint::turning(carriage, slid, Arc::new(swivel))
        .at([groove.radius() - slider.reach, 0.0, 0.0])
        // The slider's length is along y, its width along z, its pin along x.
        .turned([FRAC_PI_2, 0.0, FRAC_PI_2])
        .led_by(turning);
    let swivelling = machine.joint(swivelling);
    loads(&mut machine, shaft, boxed);
    columns(&mut machine, parts, [turning, boxed, swivelling], &turn);
    figures::develop(parts, &turn, [boxed, swivelling], &mut machine)?;
    if let Some(gears) = &parts.gears {
        let solid = ShaftSolid::new(groove, shaft.body())?;
        let [end, _] = solid.whole();
        let driver = hang(gears, end, [frame, turned], turning, &mut machine);
        let [low, _] = solid.ends();
        figures::gears(gears, shaft, low, [driver, turning], &mut machine);
    }
    Ok(machine)
}

/// The grooved shaft as a body.
#[derive(Debug)]
struct Grooved(SpiralShaft);

impl SolidBody for Grooved {
    fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, SolidError> {
        // Shaft and groove were checked when the machine was made.
        Ok(self.0.mesh(tolerance).unwrap_or_default())
    }

    fn shell(&self) -> Option<Shell> {
        self.0.shell().ok()
    }
}

/// Turn of the shaft by the input, rad.
fn turn(parts: &Parts<'_>) -> Arc<dyn Transmission> {
    match &parts.gears {
        Some(gears) => Arc::new(*gears.drive),
        None => Arc::new(Linear::new(0.0, 1.0)),
    }
}

/// Lead angle under the slider by the input, rad: the angle by which the slider has swivelled.
fn swivel(turn: &Arc<dyn Transmission>, stroke: &Arc<dyn Transmission>, radius: f64) -> Piecewise {
    let (turn, stroke) = (turn.clone(), stroke.clone());
    let (period, breaks) = (stroke.period(), stroke.breaks());
    Piecewise::fit(&FromFn::new(period, 0.0, breaks, move |input| {
        MotionJet::at_rest((stroke.at(input).velocity / turn.at(input).velocity / radius).atan())
    }))
}

/// The groove that moves the box, and the friction of the rails on it.
fn loads(machine: &mut machine::LinkedMachine, shaft: &SpiralShaft, joint: usize) {
    let load = *shaft.load();
    machine.guides.push(Guide {
        joint,
        radius: shaft.groove().radius(),
        friction: load.groove_friction,
    });
    let stroke = machine.joints[joint].law.clone();
    let (period, breaks) = (stroke.period(), stroke.breaks());
    let law = FromFn::new(period, 0.0, breaks, move |input| {
        MotionJet::at_rest(load.rail_force(&stroke.at(input)))
    });
    let effort = Quantity::Law(Arc::new(law));
    machine.loads.push(Load::Joint { joint, effort });
}

/// Columns of the table: shaft, box and slider with their speeds at the design's input speed, and forces.
fn columns(
    machine: &mut machine::LinkedMachine,
    parts: &Parts<'_>,
    [shaft, carriage, slider]: [usize; 3],
    turn: &Arc<dyn Transmission>,
) {
    let omega = parts.shaft.load().speed();
    let joint = |joint, order: u8, sign: f64| {
        Quantity::rate(joint, order, sign * omega.powi(i32::from(order)))
    };
    machine.input_columns("angle of the input");
    let places = [
        (
            "shaft_angle_rad",
            "rad",
            "turn of the shaft",
            joint(shaft, 0, -1.0),
        ),
        (
            "shaft_speed_rad_per_s",
            "rad/s",
            "speed of the shaft",
            joint(shaft, 1, -1.0),
        ),
        (
            "position_mm",
            "mm",
            "position of the box along the shaft",
            joint(carriage, 0, 1.0),
        ),
        (
            "velocity_mm_per_s",
            "mm/s",
            "speed of the box",
            joint(carriage, 1, 1.0),
        ),
        (
            "acceleration_mm_per_s2",
            "mm/s²",
            "acceleration of the box",
            joint(carriage, 2, 1.0),
        ),
        (
            "jerk_mm_per_s3",
            "mm/s³",
            "jerk of the box",
            joint(carriage, 3, 1.0),
        ),
        (
            "lead_angle_rad",
            "rad",
            "lead angle, by which the slider swivels",
            joint(slider, 0, 1.0),
        ),
        (
            "lead_angle_speed_rad_per_s",
            "rad/s",
            "speed of the swivel",
            joint(slider, 1, 1.0),
        ),
    ];
    for (name, unit, meaning, quantity) in places {
        machine.column(name, unit, meaning, quantity);
    }
    let law = machine.joints[carriage].law.clone();
    let (load, groove) = (*parts.shaft.load(), parts.shaft.groove().clone());
    let force = Arc::new(move |turn: &dyn Transmission, input: f64| {
        let lead = groove.lead_angle(turn.at(input).position);
        load.force(law.at(input), lead, groove.radius())
    });
    let (period, breaks) = (parts.shaft.cycle(), machine.joints[carriage].law.breaks());
    let mut add = |name: &str, unit: &str, meaning: &str, of: fn(&GuideForce, f64) -> f64| {
        let (turn, force) = (turn.clone(), force.clone());
        let law = FromFn::new(period, 0.0, breaks.clone(), move |input| {
            MotionJet::at_rest(of(&force(turn.as_ref(), input), turn.at(input).velocity))
        });
        machine.column(name, unit, meaning, Quantity::Law(Arc::new(law)))
    };
    add("push_N", "N", "force that moves the box", |f, _| f.push);
    add(
        "normal_force_N",
        "N",
        "force on the groove's wall",
        |f, _| f.normal,
    );
    add(
        "transverse_force_N",
        "N",
        "force across the shaft",
        |f, _| f.transverse,
    );
    let torque = add("shaft_torque_Nmm", "N mm", "torque on the shaft", |f, _| {
        f.torque
    });
    add(
        "input_torque_Nmm",
        "N mm",
        "torque on the input",
        |f, rate| f.torque * rate,
    );
    machine.joints[shaft].load = Some(torque);
}

/// Mass properties of the box; only its mass is known.
fn carried(mass: f64) -> MassProperties {
    // If the slider alone exceeds the moved mass, the box still has a small mass.
    let mass = mass.max(1e-3);
    MassProperties {
        mass,
        center: Point3::origin(),
        inertia: Matrix3::identity() * (mass * CUBE * CUBE / 6.0),
    }
}

/// Adds the driver on the frame and its mate on the shaft, whose near end is at the height `end`; returns the driver's joint.
fn hang(
    gears: &Gears<'_>,
    end: f64,
    [frame, shaft]: [usize; 2],
    turning: usize,
    machine: &mut machine::LinkedMachine,
) -> usize {
    let links = MEMBERS.map(|member| machine.link(Link::new(member.name())));
    let law = Linear::new(-gears.drive.phase - gears.slowest(), 1.0);
    let at = [-gears.pair.center_distance(), 0.0, end];
    let joint = machine.joint(Joint::turning(frame, links[0], Arc::new(law)).at(at));
    let meaning = "turn of the gear that drives, from its zero";
    machine.column("driver_angle_rad", "rad", meaning, Quantity::joint(joint));
    let fixed = Joint::fixed(shaft, links[1]).at([0.0, 0.0, end]);
    machine.joint(fixed.turned([0.0, 0.0, gears.rest()]));
    machine
        .meshes
        .push(GearMesh::new(links, turning, gears.pair.pressure_angle()));
    joint
}
