//! Boundary of an extrusion with an opening through a wall.

use super::{
    StepError,
    brep::ExtrusionWriter,
    part21::{Data, Id, List},
};
use centrode_geometry::{Opening, Point, Segment, Solid};

/// Edges of a wall: the upright ones over the start of its side, from below, and those along the side at each of its levels.
struct Side {
    uprights: Vec<Id>,
    levels: Vec<Id>,
    /// Points and vertices at its start, from below.
    corners: Vec<(Id, Id)>,
    segment: Segment,
    opens: bool,
}

/// Writes the closed boundary of a solid with an opening, its contours with the material on their left, and returns its
/// `MANIFOLD_SOLID_BREP`.
pub(super) fn manifold(
    data: &mut Data,
    name: &str,
    solid: &Solid,
    opening: &Opening,
    contours: &[Vec<Segment>],
) -> Result<Id, StepError> {
    let mut shape = ExtrusionWriter::new(data, solid.bottom(), solid.top());
    let heights = [
        solid.bottom(),
        opening.span[0],
        opening.span[1],
        solid.top(),
    ];
    let mut faces = Vec::new();
    let (mut below, mut above) = (Vec::new(), Vec::new());
    // The two sides that the opening cuts, in the outline and in the hole: the edges at the start and at the end of each.
    let mut opened: Vec<[Edges; 2]> = Vec::new();
    for (index, sides) in contours.iter().enumerate() {
        let ring = ring(&mut shape, sides, opening, heights);
        let mut walls = Vec::new();
        for (side, next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let (surface, outward) = shape.surface(&side.segment);
            let mut wall = |shape: &mut ExtrusionWriter<'_>, edges: &[(Id, bool)]| {
                let bound = bound(shape, "FACE_OUTER_BOUND", edges);
                walls.push(shape.face(&[bound], surface, outward));
            };
            let forward = |edges: &[Id]| edges.iter().map(|&e| (e, true)).collect::<Vec<_>>();
            let back = |edges: &[Id]| edges.iter().rev().map(|&e| (e, false)).collect::<Vec<_>>();
            if side.opens {
                for (low, layer) in [(0, 0), (2, 2)] {
                    wall(
                        &mut shape,
                        &[
                            (side.levels[low], true),
                            (next.uprights[layer], true),
                            (side.levels[low + 1], false),
                            (side.uprights[layer], false),
                        ],
                    );
                }
                opened.push([Edges::new(side), Edges::new(next)]);
            } else {
                let around = [
                    vec![(side.levels[0], true)],
                    forward(&next.uprights),
                    vec![(side.levels[1], false)],
                    back(&side.uprights),
                ];
                wall(&mut shape, &around.concat());
            }
        }
        faces.extend(walls);
        let kind = if index == 0 {
            "FACE_OUTER_BOUND"
        } else {
            "FACE_BOUND"
        };
        let backward: Vec<(Id, bool)> = ring
            .iter()
            .rev()
            .map(|side| (side.levels[0], false))
            .collect();
        let forward: Vec<(Id, bool)> = ring
            .iter()
            .filter_map(|side| Some((*side.levels.last()?, true)))
            .collect();
        below.push(bound(&mut shape, kind, &backward));
        above.push(bound(&mut shape, kind, &forward));
    }
    faces.push(shape.cap(solid.bottom(), -1.0, &below));
    faces.push(shape.cap(solid.top(), 1.0, &above));
    let [outer, inner] = &opened[..] else {
        // The sides of the opening were shorter than a kernel's accuracy and were removed.
        return Err(StepError::NoRegion { contour: 0 });
    };
    faces.extend(inside(&mut shape, outer, inner, heights));
    let shell = shape
        .data
        .add(format_args!("CLOSED_SHELL('',{})", List(&faces)));
    Ok(shape
        .data
        .add(format_args!("MANIFOLD_SOLID_BREP({name},{shell})")))
}

/// Edges of the opening at one of its corners, and of the side that begins there.
#[derive(Clone)]
struct Edges {
    at: Point,
    corners: Vec<(Id, Id)>,
    uprights: Vec<Id>,
    levels: Vec<Id>,
}

impl Edges {
    fn new(side: &Side) -> Self {
        Self {
            at: side.segment.start(),
            corners: side.corners.clone(),
            uprights: side.uprights.clone(),
            levels: side.levels.clone(),
        }
    }
}

/// Side walls, floor and ceiling of the opening: `first` and `second` are at the outline's corners, `third` and `fourth` at those
/// of the hole, which runs in the opposite direction.
fn inside(
    shape: &mut ExtrusionWriter<'_>,
    [first, second]: &[Edges; 2],
    [third, fourth]: &[Edges; 2],
    heights: [f64; 4],
) -> Vec<Id> {
    let mut faces = Vec::new();
    let mut lines = Vec::new();
    for [from, to] in [[first, fourth], [third, second]] {
        let along = Segment::Line(from.at, to.at);
        let [low, high] = [1, 2].map(|level| {
            let (point, start) = from.corners[level];
            let curve = shape.curve(&along, point, heights[level]);
            shape.edge(start, to.corners[level].1, curve)
        });
        let (surface, outward) = shape.surface(&along);
        let around = [
            (low, true),
            (to.uprights[1], true),
            (high, false),
            (from.uprights[1], false),
        ];
        let bound = bound(shape, "FACE_OUTER_BOUND", &around);
        faces.push(shape.face(&[bound], surface, outward));
        lines.push([low, high]);
    }
    let floor = [
        (first.levels[1], true),
        (lines[1][0], false),
        (third.levels[1], true),
        (lines[0][0], false),
    ];
    let ceiling = [
        (lines[0][1], true),
        (third.levels[2], false),
        (lines[1][1], true),
        (first.levels[2], false),
    ];
    for (edges, z, way) in [(floor, heights[1], 1.0), (ceiling, heights[2], -1.0)] {
        let bound = bound(shape, "FACE_OUTER_BOUND", &edges);
        faces.push(shape.cap(z, way, &[bound]));
    }
    faces
}

fn bound(shape: &mut ExtrusionWriter<'_>, kind: &str, edges: &[(Id, bool)]) -> Id {
    let edges: Vec<Id> = edges
        .iter()
        .map(|&(edge, forward)| shape.oriented(edge, forward))
        .collect();
    shape.closed(kind, &edges)
}

/// Writes the edges over a contour; the corners and sides of the opening also have edges at the opening's heights.
fn ring(
    shape: &mut ExtrusionWriter<'_>,
    sides: &[Segment],
    opening: &Opening,
    heights: [f64; 4],
) -> Vec<Side> {
    let corners = [opening.outer, opening.inner].concat();
    let over: Vec<Vec<(Id, Id)>> = sides
        .iter()
        .map(|side| {
            let all = corners.contains(&side.start());
            let mut at = |z: f64| shape.corner(side.start(), z);
            if all {
                heights.iter().map(|&z| at(z)).collect()
            } else {
                vec![at(heights[0]), at(heights[3])]
            }
        })
        .collect();
    let count = sides.len();
    let is_opened = |side: &Segment| {
        let ends = [side.start(), side.end()];
        ends == opening.outer || ends == [opening.inner[1], opening.inner[0]]
    };
    (0..count)
        .map(|i| {
            let (side, here, next) = (&sides[i], &over[i], &over[(i + 1) % count]);
            let opens = is_opened(side);
            let ends = |level: usize, z: f64| {
                let pick = |corner: &[(Id, Id)]| match (level, corner.len()) {
                    (0, _) => corner[0],
                    (3, n) => corner[n - 1],
                    _ => corner[level],
                };
                (pick(here), pick(next), z)
            };
            let levels = (0..4).filter(|level| opens || [0, 3].contains(level));
            let levels = levels
                .map(|level| {
                    let ((point, from), (_, to), z) = ends(level, heights[level]);
                    let curve = shape.curve(side, point, z);
                    shape.edge(from, to, curve)
                })
                .collect();
            let uprights = here
                .windows(2)
                .map(|pair| {
                    let line = shape.line(pair[0].0, shape.up);
                    shape.edge(pair[0].1, pair[1].1, line)
                })
                .collect();
            Side {
                uprights,
                levels,
                corners: here.clone(),
                segment: *side,
                opens,
            }
        })
        .collect()
}
