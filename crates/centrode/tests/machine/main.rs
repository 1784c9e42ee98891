//! The machine of every shipped design, written out as a plain file and read back with the family's object dropped.

mod arrangement;

use std::fs;
use std::path::Path;

use centrode::FAMILIES;
use centrode::analysis::forces::{Balance, Forces};
use centrode::analysis::interference::{Clearance, LinkPair, between_links};
use centrode::export::linked::{picture, plain, read, schema, write};
use centrode::export::picture::{self as page, Picture};
use centrode::export::{Options, Package};
use centrode::formats::{Bundle, Format};
use centrode::geometry::Tolerance;
use centrode_kinematics::machine::{Form, JointKind, LineRole, LinkedMachine, Load, Mounted};
use nalgebra::{Matrix3, Point3, Vector3};

/// Name and machine of every shipped design that gives one.
fn machines() -> Vec<(String, LinkedMachine)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/designs");
    let mut names: Vec<_> = fs::read_dir(folder)
        .expect("checked in")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    names.sort();
    let machine = |path: &std::path::PathBuf| {
        let text = fs::read(path).expect("readable");
        let design = FAMILIES.read(&text).expect("a design");
        let machine = design.mechanism().ok()?.machine().ok()?;
        let name = path.file_stem()?.to_str()?.to_owned();
        Some((name, machine))
    };
    let found: Vec<_> = names.iter().filter_map(machine).collect();
    assert!(found.len() >= 10, "{} machines", found.len());
    found
}

/// Whether every position of a way is within a distance of another way.
fn along(one: &page::Path, other: &page::Path, within: f64) -> bool {
    let places = |path: &page::Path| -> Vec<Point3<f64>> {
        path.vertices
            .chunks_exact(3)
            .map(Point3::from_slice)
            .collect()
    };
    let mut line = places(other);
    line.extend(other.closed.then(|| line[0]));
    let away = |p: &Point3<f64>| {
        let to = |pair: &[Point3<f64>]| {
            let (chord, from) = (pair[1] - pair[0], p - pair[0]);
            let share = (from.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (from - chord * share).norm()
        };
        line.windows(2).map(to).fold(f64::INFINITY, f64::min)
    };
    line.len() > 2 && places(one).iter().all(|p| away(p) <= within)
}

/// Holds two pictures against each other: the same lines in the same places, all numbers within what they are rounded by.
fn assert_alike(one: &Picture, other: &Picture, (name, off): (&str, f64)) {
    let near = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= off)
    };
    assert!(!one.links.is_empty(), "{name}");
    assert_eq!(one.links.len(), other.links.len(), "{name}");
    for (a, b) in one.links.iter().zip(&other.links) {
        assert_eq!(a.name, b.name, "{name}");
        assert_eq!(a.paths.len(), b.paths.len(), "{name} {}", a.name);
        for (p, q) in a.paths.iter().zip(&b.paths) {
            assert_eq!((p.role, p.closed), (q.role, q.closed), "{name} {}", a.name);
            // Ways have the places that they need, which ones is a matter of rounding.
            let alike = near(&p.vertices, &q.vertices)
                || p.role == LineRole::Trace && along(p, q, 20.0 * off) && along(q, p, 20.0 * off);
            assert!(alike, "{name} {}", a.name);
        }
    }
    assert_eq!(one.motion.input_name, other.motion.input_name, "{name}");
    assert!(near(&one.motion.input, &other.motion.input), "{name}");
    let poses = one.motion.poses.iter().zip(&other.motion.poses);
    for ((a, b), link) in poses.zip(&one.links) {
        assert!(near(a, b), "{name} {}", link.name);
    }
    assert_eq!(one.marks, other.marks, "{name}");
    assert!(near(&one.extent, &other.extent), "{name}");
}

fn files(machine: &LinkedMachine, options: &Options) -> Bundle {
    in_formats(machine, &[Format::Csv, Format::Urdf, Format::Mjcf], options)
}

fn in_formats(machine: &LinkedMachine, formats: &[Format], options: &Options) -> Bundle {
    let mut package = Package::new("a machine", "", "", formats, options);
    package.machine(|| Ok(machine.clone())).expect("written");
    package.finish().expect("whole")
}

/// Minimum clearance of two links, lower bound of it: over the period, of links that mesh at some inputs (the teeth of a whole
/// period take minutes).
fn clearance(
    machine: &LinkedMachine,
    pair: [usize; 2],
    tolerance: Tolerance,
) -> Option<Vec<[f64; 2]>> {
    let figures = |found: Clearance| [found.minimum, found.lower_bound];
    let meshes = |links: [usize; 2]| links == pair || links == [pair[1], pair[0]];
    if !machine.meshes.iter().any(|mesh| meshes(mesh.links)) {
        let found = between_links(machine, pair, tolerance).ok()??;
        return Some(vec![figures(found)]);
    }
    let surfaces = pair.map(|link| {
        let own = machine.links[link].surfaces.iter();
        own.map(|&surface| &machine.surfaces[surface]).collect()
    });
    let links = LinkPair::new(machine, pair, surfaces, tolerance).ok()??;
    let inputs = (0..3).map(|i| machine.input.period * (0.11 + 0.31 * f64::from(i)));
    let found = inputs.map(|input| links.at(input).ok().map(figures));
    found.collect()
}

/// Names and clearances of the links that touch others in the plane, to within the tolerance.
fn clearances(machine: &LinkedMachine, tolerance: Tolerance) -> Vec<(String, Vec<[f64; 2]>)> {
    let touching: Vec<usize> = (0..machine.links.len())
        .filter(|link| !machine.links[*link].surfaces.is_empty())
        .collect();
    let mut found = Vec::new();
    for (i, &one) in touching.iter().enumerate() {
        for &other in &touching[i + 1..] {
            let pair = [one, other];
            let name = pair
                .map(|link| machine.links[link].name.as_str())
                .join(" and ");
            found.extend(clearance(machine, pair, tolerance).map(|figures| (name, figures)));
        }
    }
    found
}

#[test]
fn links_keep_the_same_clearance_in_the_machine_read_back_from_its_plain_file() {
    let tolerance = Tolerance::new(0.2).expect("positive");
    let (mut designs, mut compared) = (0, 0);
    for (name, machine) in machines() {
        let bytes = write(&plain(&machine, tolerance).expect("meshed")).expect("plain");
        let again = read(&bytes).expect("readable");
        let [one, other] = [&machine, &again].map(|machine| clearances(machine, tolerance));
        let links = |all: &[(String, Vec<[f64; 2]>)]| -> Vec<String> {
            all.iter().map(|(links, _)| links.clone()).collect()
        };
        assert_eq!(links(&one), links(&other), "{name}");
        for ((links, first), (_, second)) in one.iter().zip(&other) {
            for (a, b) in first.iter().zip(second) {
                let ([minimum, bound], [minimum_again, bound_again]) = (*a, *b);
                let off = (minimum - minimum_again).abs();
                assert!(
                    off < 1e-10 * (1.0 + minimum.abs()),
                    "{name}: {links}: {a:?} {b:?}"
                );
                // Where the search stops depends on rounding.
                let off = (bound - bound_again).abs();
                assert!(off < 1e-3 * tolerance.mm(), "{name}: {links}: {a:?} {b:?}");
                assert!(
                    bound <= minimum && minimum - bound <= tolerance.mm(),
                    "{name}: {links}"
                );
            }
        }
        designs += usize::from(!one.is_empty());
        compared += one.len();
    }
    // The others have no two links that touch at one height: bare linkages, a feeder, a shaft across its slider.
    assert!(
        designs >= 16 && compared > 90,
        "{compared} pairs of {designs} designs"
    );
}

/// Share of its column's maximum value by which a number of the table may be off once laws are in pieces: positions by
/// rounding, each derivative by some hundred times more than the one before it.
fn allowed(column: &str) -> f64 {
    let ends = |ending: &str| column.ends_with(ending);
    if ends("_per_s3") {
        1e-5
    } else if ends("_per_s2") || ends("_slope_per_rad") {
        1e-7
    } else if ends("_per_s") || ends("_per_rad") || column == "ratio" {
        1e-9
    } else {
        1e-12
    }
}

/// Holds two tables against each other, column by column.
fn assert_near(one: &[u8], other: &[u8], name: &str) {
    let rows = |bytes: &[u8]| -> Vec<Vec<f64>> {
        let text = String::from_utf8_lossy(bytes).into_owned();
        let numbers = |line: &str| {
            line.split(',')
                .map(|x| x.parse().expect("a number"))
                .collect()
        };
        text.lines().skip(1).map(numbers).collect()
    };
    let text = String::from_utf8_lossy(one);
    let names = text.lines().next().expect("a header").split(',');
    let (one, other) = (rows(one), rows(other));
    assert_eq!(one.len(), other.len(), "{name}");
    for (column, title) in names.enumerate() {
        let size = one.iter().map(|row| row[column].abs()).fold(1.0, f64::max);
        let off = one
            .iter()
            .zip(&other)
            .map(|(a, b)| (a[column] - b[column]).abs());
        let off = off.fold(0.0, f64::max);
        assert!(
            off <= allowed(title) * size,
            "{name} {title}: {off} of {size}"
        );
    }
}

#[test]
fn a_machine_read_back_from_its_plain_file_stands_and_exports_as_the_first() {
    let tolerance = Tolerance::new(2e-2).expect("positive");
    let options = Options::new(tolerance);
    for (name, machine) in machines() {
        assert_eq!(machine.validate(), Ok(()), "{name}");
        let bytes = write(&plain(&machine, tolerance).expect("meshed")).expect("plain");
        let again = read(&bytes).expect("readable");
        for i in 0..60 {
            let input = machine.input.period * (0.37 + 2.21 * f64::from(i)) / 60.0;
            let poses = machine.pose(input).into_iter().zip(again.pose(input));
            for (link, (one, other)) in poses.enumerate() {
                let off = (one.0[0] - other.0[0]).abs().max();
                let size = one.0[0].abs().max();
                assert!(off <= 1e-12 * size, "{name} link {link} at {input}: {off}");
            }
        }
        let [one, other] = [&machine, &again].map(|machine| picture(machine, tolerance));
        assert_alike(&one, &other, (&name, 0.1 * tolerance.mm()));
        arrangement::assert_alike(&machine, &again, &name, tolerance);
        let (first, second) = (files(&machine, &options), files(&again, &options));
        for ((file, one), (name_again, other)) in first.files().zip(second.files()) {
            assert_eq!(file, name_again, "{name}");
            if file == "motion.csv" {
                assert_near(one, other, &name);
            } else {
                assert!(one == other, "{name}: {file} differs");
            }
        }
        assert_eq!(first.files().count(), second.files().count(), "{name}");
    }
}

#[test]
fn shafts_and_pins_are_assembled_alike_in_the_machine_read_back_from_its_plain_file() {
    let tolerance = Tolerance::new(2e-2).expect("positive");
    let (options, formats) = (Options::new(tolerance), [Format::Step, Format::ThreeMf]);
    let mut mounted = 0;
    for (name, machine) in machines() {
        if machine.links.iter().all(|link| link.mounted.is_empty()) {
            continue;
        }
        // Places by laws in pieces have other last digits than those by exact laws.
        let machine = plain(&machine, tolerance).expect("meshed");
        let again = read(&write(&machine).expect("plain")).expect("readable");
        assert_eq!(machine.links, again.links, "{name}");
        mounted += machine
            .links
            .iter()
            .map(|link| link.mounted.len())
            .sum::<usize>();
        let [one, other] = [&machine, &again].map(|m| in_formats(m, &formats, &options));
        assert_eq!(one.files().count(), 2, "{name}");
        for ((file, one), (_, other)) in one.files().zip(other.files()) {
            assert!(one == other, "{name}: {file} differs");
        }
    }
    assert!(mounted > 100, "{mounted}");
}

#[test]
fn shafts_and_pins_without_a_shape_a_place_or_a_body_are_refused() {
    let mut machines = machines().into_iter();
    let has_pins = |machine: &LinkedMachine| machine.links.iter().any(|l| !l.mounted.is_empty());
    let found = machines.find(|(_, machine)| has_pins(machine));
    let (_, machine) = found.expect("a machine with pins");
    let refused = |change: &dyn Fn(&mut Mounted)| {
        let mut machine = machine.clone();
        let mut mounted = machine.links.iter_mut().flat_map(|link| &mut link.mounted);
        change(mounted.next().expect("a pin"));
        machine.validate().expect_err("refused").to_string()
    };
    assert!(refused(&|body| body.shape = 999).contains("refers to shape 999"));
    assert!(refused(&|body| body.at[1] = f64::NAN).contains("the position of a body"));
    assert!(refused(&|body| body.turn[2] = f64::INFINITY).contains("the rotation of a body"));
    let mut bare = machine;
    for shape in &mut bare.shapes {
        if let Form::Turned(part) = &mut shape.form {
            part.steps.clear();
        }
    }
    let file = write(&bare).expect("plain");
    let error = read(&file).expect_err("no body").to_string();
    assert!(error.contains("not the plain file of a machine"), "{error}");
}

#[test]
fn a_plain_file_of_another_kind_or_cut_short_is_refused() {
    let (_, machine) = machines().swap_remove(0);
    let tolerance = Tolerance::new(2e-2).expect("positive");
    let bytes = write(&plain(&machine, tolerance).expect("meshed")).expect("plain");
    let text = String::from_utf8(bytes).expect("text");
    let refused = |text: &str| read(text.as_bytes()).expect_err("refused").to_string();
    assert!(refused(&text[..text.len() / 2]).contains("not the plain file of a machine"));
    assert!(refused(&text.replace("\"version\":1", "\"version\":9")).contains("version 9"));
    let lost = text.replacen("\"parent\":0", "\"parent\":99", 1);
    assert!(
        refused(&lost).contains("joint 0 refers to link 99"),
        "{}",
        refused(&lost)
    );
    assert!(refused("{\"format\": 1}").contains("not the plain file"));
}

#[test]
fn the_schema_of_the_plain_file_names_what_it_holds() {
    let schema = schema().to_string();
    for word in [
        "joints",
        "closures",
        "meshes",
        "coefficients",
        "inertia",
        "linear",
    ] {
        assert!(schema.contains(word) || word == "linear", "{word}");
    }
}

/// Forces of a machine one after the other, N and N mm: its torque, then joints, closures, contacts and meshes.
fn numbers(forces: &Forces) -> Vec<f64> {
    let joints = forces.joints.iter().flat_map(|joint| {
        let reaction = joint.reaction.map(|reaction| reaction.force);
        let force = reaction.unwrap_or_else(Vector3::zeros);
        [joint.drive, force.x, force.y, force.z]
    });
    let pins = forces.closures.iter().chain(&forces.contacts);
    let pins = pins.flat_map(|force| [force.x, force.y, force.z]);
    let teeth = forces.meshes.iter().filter_map(|mesh| mesh.normal);
    let torque = std::iter::once(forces.input_torque);
    torque.chain(joints).chain(pins).chain(teeth).collect()
}

#[test]
fn a_machine_read_back_from_its_plain_file_has_the_forces_of_the_first() {
    let tolerance = Tolerance::new(2e-2).expect("positive");
    for (name, machine) in machines() {
        let bytes = write(&plain(&machine, tolerance).expect("meshed")).expect("plain");
        let again = read(&bytes).expect("readable");
        let (speed, period) = (machine.input.speed, machine.input.period);
        let [one, other] = [machine, again].map(|machine| Balance::new(machine).expect("forces"));
        let table = |balance: &Balance| -> Vec<Vec<f64>> {
            let at = |i: i32| period * (0.37 + 2.21 * f64::from(i)) / 60.0;
            let forces = (0..30).map(|i| balance.at(at(i), speed).expect("it turns"));
            forces.map(|forces| numbers(&forces)).collect()
        };
        let (one, other) = (table(&one), table(&other));
        for column in 0..one[0].len() {
            let size = one.iter().map(|row| row[column].abs()).fold(1e-6, f64::max);
            let rows = one.iter().zip(&other);
            let off = rows.map(|(a, b)| (a[column] - b[column]).abs());
            let off = off.fold(0.0, f64::max);
            assert!(off <= 1e-6 * size, "{name} {column}: {off} of {size}");
        }
    }
}

/// Kinetic and potential energy of a machine, N mm, from the frames of its links.
fn energy(machine: &LinkedMachine, input: f64) -> f64 {
    let speed = machine.input.speed;
    let pose = machine.pose(input);
    let links = machine.links.iter().zip(&pose);
    let of = links.filter_map(|(link, frame)| {
        let body = link.mass.as_ref()?;
        let center = frame.point(body.center.coords.into());
        let [turn, first, ..] = frame.0.map(|m| m.fixed_view::<3, 3>(0, 0).into_owned());
        // Of the spin R' R^T.
        let spin = first * turn.transpose() * speed;
        let spin = turn.tr_mul(&Vector3::new(spin.m32, spin.m13, spin.m21));
        let way = center.velocity * speed;
        let moving = body.mass * way.norm_squared() + spin.dot(&(body.inertia * spin));
        let height = Vector3::from(machine.gravity).dot(&center.position.coords);
        Some((0.5 * moving - body.mass * height) / 1e3)
    });
    of.sum()
}

/// Work of the links' inertia and weight on their ways by a radian of the input, N mm, from the frames of the links.
fn work(machine: &LinkedMachine, input: f64) -> f64 {
    let square = machine.input.speed.powi(2);
    let pose = machine.pose(input);
    let links = machine.links.iter().zip(&pose);
    let of = links.filter_map(|(link, frame)| {
        let body = link.mass.as_ref()?;
        let center = frame.point(body.center.coords.into());
        let force = (center.acceleration * square - Vector3::from(machine.gravity)) * body.mass;
        let [_, first, second, _] = frame.0.map(|m| m.fixed_view::<3, 3>(0, 0).into_owned());
        let moments = Matrix3::identity() * (0.5 * body.inertia.trace()) - body.inertia;
        let turned = (second * moments).dot(&first) * square;
        Some((force.dot(&center.velocity) + turned) / 1e3)
    });
    of.sum()
}

/// Work of springs, rails and grooves that the input supplies by a radian, N mm.
fn supplied(machine: &LinkedMachine, input: f64, forces: &Forces) -> f64 {
    let rate = |joint: usize| machine.joints[joint].law.at(input).velocity;
    let loads = machine.loads.iter().map(|load| match load {
        Load::Joint { joint, effort } => -machine.value(effort, input) * rate(*joint),
        _ => panic!("no shipped machine has another load"),
    });
    let grooves = machine.guides.iter().map(|guide| {
        let leader = machine.joints[guide.joint].leader.expect("led");
        let (own, lead) = (rate(guide.joint), rate(leader));
        let push = forces.joints[guide.joint].drive;
        let slope = own / lead / guide.radius;
        let friction = guide.friction.atan().copysign(push * own);
        let angle = slope.abs().atan() + friction;
        // Less what the push does itself.
        push * own.signum() * angle.tan() * guide.radius * lead.abs() - push * own
    });
    loads.sum::<f64>() + grooves.sum::<f64>()
}

#[test]
fn the_torque_of_every_machine_is_that_of_virtual_work_and_feeds_its_energy() {
    let mut heavy = 0;
    for (name, machine) in machines() {
        let balance = Balance::new(machine.clone()).expect("forces");
        let (speed, period) = (machine.input.speed, machine.input.period);
        let (mut looks, mut size) = (Vec::new(), 1e-6_f64);
        for i in 0..60 {
            let input = period * (0.37 + 2.21 * f64::from(i)) / 60.0;
            let forces = balance.at(input, speed).expect("it turns");
            let lost = supplied(&machine, input, &forces);
            size = size.max(forces.input_torque.abs());
            let off = forces.input_torque - work(&machine, input) - lost;
            let h = 1e-4;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| energy(&machine, input + k * h));
            let slope = (a - d + 8.0 * (c - b)) / (12.0 * h);
            looks.push((off.abs(), (forces.input_torque - slope - lost).abs()));
        }
        heavy += usize::from(size > 1e-3);
        let worst = looks.iter().map(|(off, _)| *off).fold(0.0, f64::max);
        assert!(worst <= 1e-10 * size, "{name}: {worst} of {size}");
        // Where an acceleration jumps the slope is none; that is at few samples.
        let far = looks.iter().filter(|(_, off)| *off > 1e-6 * size).count();
        assert!(far <= 6, "{name}: {far} of 60 inputs, {size}");
    }
    assert!(heavy >= 10, "{heavy} machines with mass");
}

#[test]
fn the_grooves_forces_are_those_of_the_table() {
    let mut compared = 0;
    for (name, machine) in machines() {
        if machine.guides.is_empty() {
            continue;
        }
        let balance = Balance::new(machine.clone()).expect("forces");
        let column = |name: &str| {
            let named = machine.columns.iter().find(|column| column.name == name);
            &named.expect("in the table").quantity
        };
        for i in 0..40 {
            let input = machine.input.period * (0.37 + 2.21 * f64::from(i)) / 60.0;
            let forces = balance.at(input, machine.input.speed).expect("it turns");
            let found = forces.guides[0];
            for (name_of, found) in [
                ("push_N", found.push),
                ("normal_force_N", found.normal),
                ("transverse_force_N", found.transverse),
                ("shaft_torque_Nmm", found.torque),
            ] {
                let required = machine.value(column(name_of), input);
                let off = (found - required).abs();
                assert!(
                    off <= 1e-9 * (1.0 + required.abs()),
                    "{name} {name_of}: {found} {required}"
                );
            }
            // Where the groove acts is not known: neither are the bearings of what it passes.
            let hidden = forces
                .joints
                .iter()
                .filter(|joint| joint.reaction.is_none());
            let hidden = hidden.count();
            let slides = |kind: &JointKind| matches!(kind, JointKind::Sliding(_));
            let boxed = machine.joints.iter().position(|joint| slides(&joint.kind));
            assert!(hidden == 3 && forces.joints[boxed.expect("a box")].reaction.is_none());
        }
        compared += 1;
    }
    assert_eq!(compared, 2, "a shaft and a box");
}
