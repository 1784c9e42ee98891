use centrode_formats::model::Convex;
use centrode_geometry::{ConvexPieces, Mesh, Point, Tolerance, Vector, convex_pieces};
use centrode_kinematics::machine::Surface;
use std::collections::BTreeMap;

/// Convex bodies that replace a surface.
pub(super) struct ContactBodies {
    /// For a gear: the teeth in order, each of one body or several, then the hub.
    pub(super) bodies: Vec<Convex>,
    /// Maximum distance by which a body exceeds the surface, mm.
    pub(super) excess: f64,
}

/// A surface as convex bodies between its heights. They deviate from it by at most the tolerance times its `coarseness`.
pub(super) fn all(surface: &Surface, tolerance: Tolerance) -> ContactBodies {
    let tolerance = tolerance.scaled(surface.coarseness);
    if surface.teeth.is_empty() {
        plate(surface, tolerance)
    } else {
        gear(surface, tolerance)
    }
}

/// A plate as numbered convex pieces.
fn plate(surface: &Surface, tolerance: Tolerance) -> ContactBodies {
    let half = tolerance.scaled(0.5);
    let [bottom, top] = surface.span;
    let cut = convex_pieces(&surface.outline.flatten(half), half);
    let pieces = cut.pieces.iter().enumerate();
    ContactBodies {
        bodies: pieces
            .map(|(i, piece)| Convex {
                name: format!("{}_{i}", surface.name),
                mesh: Mesh::prism(piece, bottom, top),
            })
            .collect(),
        excess: cut.excess + half.mm(),
    }
}

/// The teeth of a gear as convex bodies over its width: flanks and tip of each tooth down to where the flanks end, cut into
/// enough pieces to exceed the tooth by no more than the tolerance. Below the teeth is the hub, from the bottom of one space to
/// that of the next, with its bore filled.
///
/// Fillets are omitted: mates do not touch there, and each would take a dozen bodies.
fn gear(surface: &Surface, tolerance: Tolerance) -> ContactBodies {
    // Half of the tolerance is for the chords of a concave flank, half for the pieces that bridge them.
    let half = tolerance.scaled(0.5);
    let samples = surface.outline.samples(half);
    let contour: Vec<Point> = samples.iter().map(|sample| sample.point).collect();
    let owners = samples
        .iter()
        .map(|sample| surface.teeth.get(sample.segment).copied().flatten());
    let Sections { teeth, hub, excess } =
        Sections::new(&contour, &owners.collect::<Vec<_>>(), half);
    let mut found = ContactBodies {
        bodies: Vec::new(),
        excess,
    };
    let (prefix, span) = (&surface.name, surface.span);
    for (tooth, contours) in teeth {
        let name = format!("{prefix}_tooth_{tooth}");
        let cut = contours.iter().map(|contour| convex_pieces(contour, half));
        found.add(&name, cut.collect(), span);
    }
    let hub = convex_pieces(&hub, half);
    found.add(&format!("{prefix}_hub"), vec![hub], span);
    found.excess += half.mm();
    found
}

impl ContactBodies {
    /// Adds the pieces of a part over the width, numbered where there are several.
    fn add(&mut self, name: &str, cut: Vec<ConvexPieces>, [bottom, top]: [f64; 2]) {
        self.excess = cut.iter().map(|c| c.excess).fold(self.excess, f64::max);
        let pieces: Vec<Vec<Point>> = cut.into_iter().flat_map(|c| c.pieces).collect();
        let several = pieces.len() > 1;
        for (i, piece) in pieces.into_iter().enumerate() {
            self.bodies.push(Convex {
                name: if several {
                    format!("{name}_{i}")
                } else {
                    name.to_owned()
                },
                mesh: Mesh::prism(&piece, bottom, top),
            });
        }
    }
}

/// A gear's section, split into teeth and hub.
struct Sections {
    /// Contours of the teeth, by their numbers.
    teeth: BTreeMap<u32, Vec<Vec<Point>>>,
    /// Corners of the hub, which carries the teeth.
    hub: Vec<Point>,
    /// Maximum distance by which the hub exceeds the contour, mm.
    excess: f64,
}

impl Sections {
    /// Splits a contour into teeth and spaces. `owners` has, for each point, the number of the tooth whose part begins there; `None`
    /// if a space begins.
    fn new(contour: &[Point], owners: &[Option<u32>], tolerance: Tolerance) -> Self {
        let n = contour.len();
        // Begin with a whole space, not in the middle of one.
        let begins = |i: &usize| owners[*i].is_none() && owners[(i + n - 1) % n].is_some();
        let start = (0..n).find(begins).unwrap_or(0);
        let order: Vec<usize> = (0..n).map(|i| (start + i) % n).collect();
        let mut teeth = BTreeMap::<u32, Vec<Vec<Point>>>::new();
        let mut bottoms = Vec::new();
        for run in order.chunk_by(|&i, &j| owners[i] == owners[j]) {
            let [first, .., last] = [&run[..1], run].concat()[..] else {
                continue;
            };
            // The next point ends the last segment of the run, whether a tooth or a space begins there.
            let points = stretch(contour, first, last + 1);
            match owners[first] {
                Some(tooth) => teeth.entry(tooth).or_default().push(points),
                None => {
                    let over = [points[0], points[points.len() - 1]];
                    let lowest = depths(over, &points).max_by(|a, b| a.1.total_cmp(&b.1));
                    bottoms.extend(lowest.map(|(k, _)| (first + k) % n));
                }
            }
        }
        let stretches: Vec<Vec<Point>> = bottoms
            .iter()
            .zip(bottoms.iter().cycle().skip(1))
            .map(|(&from, &to)| stretch(contour, from, to))
            .collect();
        let (hub, excess) = hub(&stretches, tolerance);
        Self { teeth, hub, excess }
    }
}

/// A polygon under stretches of contour, with one corner per stretch: its start, or a deeper point, so that no point lies below
/// the polygon by more than the tolerance. Also the maximum remaining depth below the polygon, mm.
fn hub(stretches: &[Vec<Point>], tolerance: Tolerance) -> (Vec<Point>, f64) {
    let n = stretches.len();
    let mut corners: Vec<Point> = stretches.iter().map(|s| s[0]).collect();
    let mut excess = 0.0;
    for _ in 0..10 {
        let depths: Vec<f64> = (0..n)
            .map(|k| {
                let line = [corners[k], corners[(k + 1) % n]];
                depths(line, &stretches[k]).fold(0.0, |a, (_, b)| f64::max(a, b))
            })
            .collect();
        excess = depths.iter().copied().fold(0.0, f64::max);
        if excess <= tolerance.mm() {
            break;
        }
        let lowered = (0..n).map(|k| {
            let (before, after) = ((k + n - 1) % n, (k + 1) % n);
            let along = (corners[after] - corners[before]).try_normalize(0.0);
            let inwards = along.map_or(Vector::zeros(), |a| Vector::new(-a.y, a.x));
            corners[k] + inwards * depths[before].max(depths[k])
        });
        corners = lowered.collect();
    }
    (corners, excess)
}

/// The points of a closed contour from one index to another, both included.
fn stretch(contour: &[Point], from: usize, to: usize) -> Vec<Point> {
    let n = contour.len();
    let count = (to + n - from - 1) % n + 1;
    (0..=count).map(|k| contour[(from + k) % n]).collect()
}

/// Distance of each point to the left of a line, that is, its depth inside the contour; with the point's index.
fn depths([from, to]: [Point; 2], points: &[Point]) -> impl Iterator<Item = (usize, f64)> {
    let along = (to - from).try_normalize(0.0).unwrap_or_default();
    let depth = points.iter().map(move |p| along.perp(&(p - from)));
    depth.enumerate()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// A square with a tooth in the middle of each side and a dip between them.
    fn square_gear() -> (Vec<Point>, Vec<Option<u32>>) {
        let side = [
            (Point::new(1.2, -1.2), None),
            (Point::new(1.6, -0.9), None),
            (Point::new(2.2, -0.5), Some(())),
            (Point::new(3.0, -0.2), Some(())),
            (Point::new(3.0, 0.2), Some(())),
            (Point::new(2.2, 0.5), None),
        ];
        let mut contour = Vec::new();
        let mut owners = Vec::new();
        for tooth in 0..4_u32 {
            let turn = nalgebra::Rotation2::new(FRAC_PI_2 * f64::from(tooth));
            contour.extend(side.iter().map(|(p, _)| turn * p));
            owners.extend(side.iter().map(|(_, owner)| owner.map(|()| tooth)));
        }
        (contour, owners)
    }

    #[test]
    fn a_section_is_teeth_and_a_hub() {
        let (mut contour, mut owners) = square_gear();
        for _ in 0..contour.len() {
            contour.rotate_left(1);
            owners.rotate_left(1);
            let tolerance = Tolerance::new(1e-6).expect("positive");
            let Sections { teeth, hub, excess } = Sections::new(&contour, &owners, tolerance);
            assert!(teeth.keys().copied().eq(0..4));
            assert!(teeth.values().all(|contours| contours.len() == 1));
            let contour = &teeth[&0][0];
            assert_eq!((contour.len(), contour[0]), (4, Point::new(2.2, -0.5)));
            assert_eq!(contour[3], Point::new(2.2, 0.5));
            assert_eq!((hub.len(), excess), (4, 0.0));
            assert!(
                hub.iter()
                    .all(|p| (p.x.abs() - 1.2).abs() + (p.y.abs() - 1.2).abs() < 1e-12)
            );
        }
    }

    #[test]
    fn a_hub_goes_as_deep_as_every_point_over_it() {
        // A ring of six corners with the middle of each side dented by a tenth.
        let corner = |k: u32, r: f64| {
            let (sin, cos) = (FRAC_PI_2 / 3.0 * 2.0 * f64::from(k)).sin_cos();
            Point::new(r * cos, r * sin)
        };
        let stretches: Vec<Vec<Point>> = (0..6)
            .map(|k| {
                let (a, b) = (corner(k, 5.0), corner(k + 1, 5.0));
                let middle = nalgebra::center(&a, &b);
                vec![a, middle - middle.coords.normalize() * 0.1, b]
            })
            .collect();
        let (hub, excess) = hub(&stretches, Tolerance::new(1e-6).expect("positive"));
        assert!(excess <= 1e-6);
        let apothem = 5.0 * (FRAC_PI_2 / 3.0).cos() - 0.1;
        for (a, b) in hub.iter().zip(hub.iter().cycle().skip(1)) {
            let off = nalgebra::center(a, b).coords.norm() - apothem;
            assert!((-0.03..=1e-6).contains(&off), "{off}");
        }
    }
}
