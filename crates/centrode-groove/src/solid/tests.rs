use std::f64::consts::{PI, TAU};

use centrode_geometry::Tolerance;

use super::{ShaftBody, ShaftSolid};
use crate::{Groove, Reversal, Sine, SpeedLaw, Traverse, Wall};
use centrode_kinematics::transmission::Transmission;

fn groove(holes: u32, offset: f64, phase: f64, width: f64) -> Groove {
    let law = SpeedLaw::Sine(Sine {
        amplitude: 1.283_333,
        harmonic: 1,
        phase,
    });
    let law = law.resolve(20.0, 15.0).expect("runs one way");
    let traverse = Traverse::new(law, holes, &Reversal::default(), offset).expect("closes");
    Groove::new(traverse, 15.0, width, 4.0).expect("fits")
}

fn tolerance(mm: f64) -> Tolerance {
    Tolerance::new(mm).expect("positive")
}

fn sharp() -> ShaftBody {
    ShaftBody {
        fillet: 0.0,
        chamfer: 0.0,
        keyway: None,
        ..ShaftBody::default()
    }
}

/// Area of the groove on the development, by a fine midpoint rule over the angle: at each, the union of
/// the heights within half the width of the centre line, found on a dense polyline of it.
fn developed_area(groove: &Groove) -> f64 {
    let (r, half) = (groove.radius(), 0.5 * groove.width());
    let traverse = groove.traverse();
    let turns = traverse.turns();
    let (columns, steps) = (600_u32, 400_i32);
    let dx = TAU * r / f64::from(columns);
    let mut area = 0.0;
    for column in 0..columns {
        let phi = TAU * (f64::from(column) + 0.5) / f64::from(columns);
        let mut spans: Vec<[f64; 2]> = (0..turns)
            .map(|turn| {
                let middle = phi + TAU * f64::from(turn);
                let mut span = [f64::INFINITY, f64::NEG_INFINITY];
                // A disc of half the width rolls along: its chord over this angle.
                for i in -steps..=steps {
                    let x = half * f64::from(i) / f64::from(steps);
                    let height = (half * half - x * x).sqrt();
                    let z = traverse.at(middle + x / r).position;
                    span = [span[0].min(z - height), span[1].max(z + height)];
                }
                span
            })
            .collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut end = f64::NEG_INFINITY;
        for [low, high] in spans {
            area += (high - low.max(end)).max(0.0) * dx;
            end = end.max(high);
        }
    }
    area
}

#[test]
fn the_volume_is_that_of_the_developed_area() {
    let groove = groove(5, 0.0, 0.0, 8.0);
    let body = sharp();
    let solid = ShaftSolid::new(&groove, &body).expect("fits");
    let [low, high] = solid.ends();
    let (r, floor, journal) = (15.0, 11.0, 0.5 * body.journal_diameter);
    let removed = developed_area(&groove) * (r * r - floor * floor) / (2.0 * r);
    let exact = PI * r * r * (high - low) + TAU * journal * journal * body.journal_length - removed;
    let mut before = f64::INFINITY;
    for tol in [0.1, 0.01, 0.001] {
        let mesh = solid.mesh(tolerance(tol));
        assert!(mesh.is_watertight(), "at {tol}");
        let error = (mesh.volume() / exact - 1.0).abs();
        assert!(error < 0.5 * before, "{error} after {before}");
        before = error;
    }
    assert!(before < 1e-4, "{before}");
}

#[test]
fn every_kind_of_shaft_is_watertight() {
    let keyed = ShaftBody::default();
    // No room for a half round end beyond the chamfer.
    let short = ShaftBody {
        keyway_length: 3.0,
        ..ShaftBody::default()
    };
    assert_eq!([&keyed, &short].map(ShaftBody::keyway_rounding), [2.5, 0.0]);
    for (holes, offset, phase, width) in [
        (2, 0.0, 0.0, 10.0),
        (3, 0.0, 0.0, 3.0),
        (4, 0.7, 0.0, 8.0),
        (3, 0.0, 0.4, 10.0),
        (6, 9.9, 1.0, 12.0),
        (14, 0.0, 0.0, 10.0),
    ] {
        let groove = groove(holes, offset, phase, width);
        for body in [sharp(), keyed.clone(), short.clone()] {
            for tol in [0.2, 0.02] {
                let solid = ShaftSolid::new(&groove, &body).expect("fits");
                let mesh = solid.mesh(tolerance(tol));
                assert!(
                    mesh.is_watertight(),
                    "{holes} {offset} {phase} {width} {tol}"
                );
                assert!(mesh.volume() > 0.0);
            }
        }
    }
}

#[test]
fn vertices_of_the_walls_lie_half_the_width_from_the_centre_line() {
    let groove = groove(4, 0.0, 0.0, 8.0);
    let body = sharp();
    let solid = ShaftSolid::new(&groove, &body).expect("fits");
    let mesh = solid.mesh(tolerance(0.02));
    let [low, high] = solid.ends();
    let samples: Vec<_> = (0..groove.traverse().turns() * 1600)
        .map(|i| groove.center(TAU * f64::from(i) / 1600.0))
        .collect();
    let mut counted = 0;
    for [x, y, z] in mesh.vertices {
        let on_surface = (x.hypot(y) - 15.0).abs() < 1e-9;
        if !on_surface || z <= low + 1e-9 || z >= high - 1e-9 {
            continue;
        }
        counted += 1;
        let phi = y.atan2(x).rem_euclid(TAU);
        let nearest = samples
            .iter()
            .map(|p| {
                let round = 15.0 * TAU;
                let mut dx = (p.x - 15.0 * phi).rem_euclid(round);
                dx = dx.min(round - dx);
                dx.hypot(p.y - z)
            })
            .fold(f64::INFINITY, f64::min);
        assert!((nearest - 4.0).abs() < 2e-4, "{nearest}");
    }
    assert!(counted > 300);
}

#[test]
fn the_wall_is_an_exact_offset_and_unwraps_unchanged() {
    let groove = groove(4, 0.3, 0.2, 8.0);
    for i in 0..500 {
        let theta = f64::from(i) * 0.1;
        for wall in Wall::BOTH {
            let point = groove.wall(theta, wall);
            let gap = point - groove.center(theta);
            assert!((gap.norm() - 4.0).abs() < 1e-12);
            let slope = groove.traverse().at(theta).velocity;
            assert!((gap.x * 15.0 + gap.y * slope).abs() < 1e-10);
            let back = groove.unwrapped(groove.wrapped(point, 15.0), point.x);
            assert!((back - point).norm() < 1e-12 * (1.0 + point.x.abs()));
            // The mill's wall has its own development at its own height.
            let [x, y, z] = groove.cut_wall(theta, wall, 15.0);
            let (sin, cos) = theta.sin_cos();
            let across = y * cos - x * sin;
            let along = z - groove.traverse().at(theta).position;
            assert!((across.hypot(along) - 4.0).abs() < 1e-12);
        }
    }
    assert!(groove.wall_deviation() > 0.01 && groove.wall_deviation() < 0.2);
}

fn bezier(points: &[[f64; 3]], x: f64) -> [f64; 3] {
    let mut row = points.to_vec();
    while row.len() > 1 {
        row = row
            .windows(2)
            .map(|w| [0, 1, 2].map(|i| w[0][i] + (w[1][i] - w[0][i]) * x))
            .collect();
    }
    row[0]
}

/// Flux of (x, y, 0) / 2 through a surface of straight lines between two curves, by small flat cells: none through the groove's
/// walls, which point to the axis.
fn through(points: &[Vec<[f64; 3]>; 2]) -> f64 {
    let (along, across) = (64, 4);
    let at = |i: u32, j: u32| {
        let (x, y) = (
            f64::from(i) / f64::from(along),
            f64::from(j) / f64::from(across),
        );
        let [a, b] = points.each_ref().map(|curve| bezier(curve, x));
        nalgebra::Vector3::from([0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * y))
    };
    let cells = (0..along).flat_map(|i| (0..across).map(move |j| (i, j)));
    cells
        .map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            let normal = (b + d - a - c).cross(&(c + d - a - b)) * 0.25;
            let middle = (a + b + c + d) * 0.25;
            0.5 * (middle.x * normal.x + middle.y * normal.y)
        })
        .sum()
}

/// Enclosed volume of a shell, mm³, by Gauss points over fine pieces of every surface: the flux of (0, 0, z)
/// through walls and planes, and through cylinders and cones none.
fn enclosed(shell: &centrode_geometry::Shell) -> f64 {
    use centrode_geometry::{ShellCurve, ShellSide, ShellSurface};
    // The flux of (x, y, 0) / 2 through each face: round the bounds by Green where the surface has a radius.
    let mut volume = 0.0;
    let sample = |edge: usize, x: f64| -> [f64; 3] {
        let edge = &shell.edges[edge];
        let [a, b] = edge.ends.map(|end| shell.vertices[end]);
        match &edge.curve {
            ShellCurve::Line => [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * x),
            ShellCurve::Circle { radius } => {
                let from = a[1].atan2(a[0]);
                let span = (b[1].atan2(b[0]) - from).rem_euclid(TAU);
                let angle = from + span * x;
                [radius * angle.cos(), radius * angle.sin(), a[2]]
            }
            ShellCurve::Bezier(points) => bezier(points, x),
        }
    };
    for face in &shell.faces {
        if let ShellSurface::Ruled { points, outward } = &face.surface {
            let way = if *outward { 1.0 } else { -1.0 };
            volume += way * through(points);
            continue;
        }
        let mut rings: Vec<Vec<[f64; 3]>> = Vec::new();
        for bound in &face.bounds {
            let mut ring = Vec::new();
            for &ShellSide { edge, forward } in bound {
                for k in 0..40 {
                    let x = f64::from(k) / 40.0;
                    ring.push(sample(edge, if forward { x } else { 1.0 - x }));
                }
            }
            rings.push(ring);
        }
        for ring in rings {
            let next = ring.iter().cycle().skip(1);
            for (p, q) in ring.iter().zip(next) {
                let middle = [0, 1, 2].map(|i| 0.5 * (p[i] + q[i]));
                match face.surface {
                    // Half of r over r dphi dz, the face left of its bound: minus z dphi.
                    ShellSurface::Cylinder { radius } => {
                        let turn = (q[1] * p[0] - q[0] * p[1]).atan2(q[0] * p[0] + q[1] * p[1]);
                        volume -= 0.5 * radius * radius * turn * middle[2];
                    }
                    // With the radius at each height.
                    ShellSurface::Cone {
                        height,
                        radius,
                        widens,
                    } => {
                        let turn = (q[1] * p[0] - q[0] * p[1]).atan2(q[0] * p[0] + q[1] * p[1]);
                        let way = if widens { 1.0 } else { -1.0 };
                        let r = radius + way * (middle[2] - height);
                        volume -= turn * way * r * r * r / 6.0;
                    }
                    // Planes square to x: x / 2 over dy dz. Those square to y and z: likewise with y, none.
                    ShellSurface::Plane { point, normal } => {
                        let along = normal[0] * point[0] * (middle[1] * (q[2] - p[2]));
                        let across = normal[1] * point[1] * (middle[2] * (q[0] - p[0]));
                        volume += 0.5 * (normal[0] * along + normal[1] * across);
                    }
                    ShellSurface::Ruled { .. } => unreachable!("told before"),
                }
            }
        }
    }
    volume
}

#[test]
fn the_exact_boundary_is_closed_and_encloses_what_the_mesh_does() {
    let groove = groove(4, 0.0, 0.0, 10.0);
    for body in [
        sharp(),
        ShaftBody {
            fillet: 0.0,
            ..ShaftBody::default()
        },
    ] {
        let solid = ShaftSolid::new(&groove, &body).expect("fits");
        let shell = solid.shell().expect("smooth");
        assert!(shell.is_closed());
        let (fine, exact) = (solid.mesh(tolerance(1e-4)).volume(), enclosed(&shell));
        assert!((exact / fine - 1.0).abs() < 1e-4, "{exact} {fine}");
        let mut torn = shell.clone();
        torn.faces.pop();
        assert!(!torn.is_closed());
    }
}

/// Distance of a point from the centre line on the development, mm, the shaft's turns taken together.
fn near_line(groove: &Groove, samples: &[(f64, f64)], phi: f64, z: f64) -> f64 {
    let r = groove.radius();
    let round = |x: f64| x - TAU * r * (x / (TAU * r)).round();
    let off = |theta: f64| {
        let p = groove.center(theta);
        round(p.x - r * phi).hypot(p.y - z)
    };
    let mut near: Vec<(f64, f64)> = samples
        .iter()
        .map(|&(theta, height)| (round(r * (theta - phi)).hypot(height - z), theta))
        .collect();
    let step = samples[1].0 - samples[0].0;
    let minimum = near.iter().map(|n| n.0).fold(f64::INFINITY, f64::min);
    // Samples lie closer together than this.
    near.retain(|n| n.0 < minimum + 0.5);
    let mut best = minimum;
    for (_, theta) in near {
        let (_, value) = centrode_geometry::bracketed_minimum(off, theta - step, theta + step);
        best = best.min(value);
    }
    best
}

/// Distance of a point from the grooved length's exact surface, mm, hardly too great.
fn off_surface(groove: &Groove, fillet: f64, samples: &[(f64, f64)], [x, y, z]: [f64; 3]) -> f64 {
    let (radius, half) = (groove.radius(), 0.5 * groove.width());
    let floor = radius - groove.depth();
    let r = x.hypot(y);
    let d = near_line(groove, samples, y.atan2(x), z);
    let foot = floor + fillet;
    let land = (radius - r).hypot((half - d).max(0.0));
    let bottom = (r - floor).hypot((d - half + fillet).max(0.0));
    let wall = (d - half).hypot((foot - r).max(r - radius).max(0.0));
    let round = if d >= half - fillet && r <= foot {
        ((d - half + fillet).hypot(foot - r) - fillet).abs()
    } else {
        f64::INFINITY
    };
    land.min(bottom).min(wall).min(round)
}

/// Maximum distance of corners, middles of edges and middles of triangles of the grooved length from its exact surface,
/// over some 400 triangles.
fn maximum_deviation(groove: &Groove, body: &ShaftBody, tol: f64) -> f64 {
    let solid = ShaftSolid::new(groove, body).expect("fits");
    let samples: Vec<(f64, f64)> = (0..groove.traverse().turns() * 200)
        .map(|i| TAU * f64::from(i) / 200.0)
        .map(|theta| (theta, groove.center(theta).y))
        .collect();
    let mesh = solid.mesh(tolerance(tol));
    let [low, high] = solid.ends();
    let of_groove = |corners: &[[f64; 3]; 3]| {
        let within = |p: &[f64; 3]| p[2] > low - 1e-9 && p[2] < high + 1e-9;
        let outside = |p: &[f64; 3]| p[0].hypot(p[1]) > groove.radius() - groove.depth() - 1e-9;
        let flat = corners.iter().all(|p| p[2] == corners[0][2]);
        corners.iter().all(|p| within(p) && outside(p)) && !flat
    };
    let mut worst = 0.0_f64;
    for face in mesh.faces.iter().step_by(mesh.faces.len() / 400 + 1) {
        let corners = mesh.triangle(face);
        if !of_groove(&corners) {
            continue;
        }
        for weights in [
            [1.0, 0.0, 0.0],
            [0.5, 0.5, 0.0],
            [0.0, 0.5, 0.5],
            [0.5, 0.0, 0.5],
            [1.0 / 3.0; 3],
        ] {
            let point = [0, 1, 2].map(|k| (0..3).map(|i| weights[i] * corners[i][k]).sum());
            worst = worst.max(off_surface(groove, body.fillet, &samples, point));
        }
    }
    worst
}

#[test]
fn every_triangle_is_within_the_tolerance_of_walls_fillets_and_floor() {
    for (holes, offset, phase, width, fillet) in [
        (4, 0.0, 0.0, 8.0, 0.0),
        (3, 0.0, 0.0, 3.0, 0.5),
        (6, 9.9, 1.0, 12.0, 0.5),
    ] {
        let groove = groove(holes, offset, phase, width);
        let body = ShaftBody { fillet, ..sharp() };
        for tol in [0.1, 0.01, 0.001] {
            let off = maximum_deviation(&groove, &body, tol);
            assert!(off <= tol, "{holes} {width} {fillet}: {off} at {tol}");
            assert!(off > 0.3 * tol, "finer than asked for: {off} at {tol}");
        }
    }
}

/// Volume, centre and second moments about the origin of the body inside a mesh, a tetrahedron over the origin each.
fn moments_of(mesh: &centrode_geometry::Mesh) -> (f64, [f64; 3], [f64; 6]) {
    const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
    let (mut volume, mut first, mut second) = (0.0, [0.0; 3], [0.0; 6]);
    for face in &mesh.faces {
        let [a, b, c] = mesh.triangle(face);
        let cross = [
            b[1] * c[2] - b[2] * c[1],
            b[2] * c[0] - b[0] * c[2],
            b[0] * c[1] - b[1] * c[0],
        ];
        let part = (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0;
        let sum = [0, 1, 2].map(|k| a[k] + b[k] + c[k]);
        volume += part;
        for k in 0..3 {
            first[k] += 0.25 * part * sum[k];
        }
        for (m, [i, j]) in PAIRS.into_iter().enumerate() {
            let squares = sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
            second[m] += 0.05 * part * squares;
        }
    }
    (volume, first.map(|f| f / volume), second)
}

#[test]
fn mass_and_inertia_are_those_of_ever_finer_meshes() {
    for (holes, offset, phase, width, body) in [
        (4, 0.0, 0.0, 8.0, sharp()),
        (3, 0.7, 0.4, 10.0, ShaftBody::default()),
    ] {
        let groove = groove(holes, offset, phase, width);
        let solid = ShaftSolid::new(&groove, &body).expect("fits");
        let exact = solid.mass_properties();
        let density = body.density * 1e-9;
        let mut before = f64::INFINITY;
        for tol in [0.02, 0.005, 0.00125] {
            let (volume, center, second) = moments_of(&solid.mesh(tolerance(tol)));
            let off = (volume * density / exact.mass - 1.0).abs();
            assert!(off < 0.3 * before && off < 0.2 * tol, "{off} at {tol}");
            before = off;
            let apart = (0..3).map(|k| (center[k] - exact.center[k]).abs());
            assert!(apart.fold(0.0, f64::max) < tol, "{center:?} {exact:?}");
            let [xx, yy, zz, xy, xz, yz] = second.map(|s| s * density);
            let m = volume * density;
            let [x, y, z] = center;
            let own = [
                (yy + zz - m * (y * y + z * z), (0, 0)),
                (xx + zz - m * (x * x + z * z), (1, 1)),
                (xx + yy - m * (x * x + y * y), (2, 2)),
                (m * x * y - xy, (0, 1)),
                (m * x * z - xz, (0, 2)),
                (m * y * z - yz, (1, 2)),
            ];
            for (found, at) in own {
                let [own, other] = [(at.0, at.0), (at.1, at.1)].map(|k| exact.inertia[k]);
                let off = (found - exact.inertia[at]).abs() / (own * other).sqrt();
                assert!(off < 0.5 * tol, "{at:?} {found} {exact:?} at {tol}");
            }
        }
    }
}

#[test]
fn the_keyway_ends_half_round() {
    let groove = groove(3, 0.0, 0.0, 8.0);
    let keyed = ShaftBody::default();
    let plain = ShaftBody {
        keyway: None,
        ..keyed.clone()
    };
    let bodies = [&plain, &keyed].map(|body| ShaftSolid::new(&groove, body).expect("fits"));
    let [whole, cut] = bodies.each_ref().map(|solid| {
        let exact = solid.mass_properties().mass * 1e9 / keyed.density;
        [exact, solid.mesh(tolerance(1e-3)).volume()]
    });
    let [exact, meshed] = [0, 1].map(|i| whole[i] - cut[i]);
    assert!((exact - meshed).abs() < 1.0, "{exact} {meshed}");
    // 5 wide, 3 deep in the middle and 18 long to the crest; less at the sides, at the chamfer and by the corners of its end.
    let corners = (25.0 / 2.0 - 25.0 * PI / 8.0) * 3.0;
    let square = 5.0 * 3.0 * 18.0;
    assert!(exact < square - corners, "{exact}");
    assert!(exact > square - corners - 0.5 * 18.0 * 5.0, "{exact}");
}
