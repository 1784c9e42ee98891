use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Point, Segment, SegmentJet, Vector};
use centrode_mechanism::gear::{Gear, Role};

/// Change of direction at a joint above which it is a corner, rad: far above the rounding of a fitted
/// joint, far below a tip edge.
const CORNER: f64 = 1e-4;

/// Directions of the outward normals of a part: the middle one and how far the rest turn from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) direction: Vector,
    half: f64,
    sin: f64,
    cos: f64,
}

impl Cone {
    fn new(middle: f64, half: f64) -> Self {
        let (sin, cos) = half.sin_cos();
        Self {
            direction: Vector::new(middle.cos(), middle.sin()),
            half,
            sin,
            cos,
        }
    }

    /// The same cone with its body turned.
    pub(super) fn turned(&self, direction: Vector) -> Self {
        Self { direction, ..*self }
    }

    /// Whether some direction of one opposes some direction of the other.
    pub(super) fn opposes(&self, other: &Self) -> bool {
        self.half + other.half >= PI
            || self.direction.dot(&other.direction) <= self.sin * other.sin - self.cos * other.cos
    }

    /// How much longer than along the middle a length along any direction of the cone can be.
    pub(super) fn slant(&self) -> f64 {
        1.0 / self.cos.max(0.4)
    }
}

/// A smooth part of an outline with what tells quickly whether it can touch another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    pub(super) segment: &'a Segment,
    pub(super) role: Role,
    pub(super) owner: u32,
    pub(super) center: Point,
    pub(super) radius: f64,
    pub(super) normals: Cone,
    pub(super) start: Point,
    pub(super) end: Point,
    /// Greatest distance from the chord.
    pub(super) sagitta: f64,
    /// Bound of the curvature from above, positive where the gear is convex.
    pub(super) bend: f64,
}

/// A corner of an outline: an edge of the gear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) point: Point,
    pub(super) owner: u32,
    /// Whether a flank ends here.
    pub(super) on_flank: bool,
    pub(super) normals: Cone,
}

/// A finished gear as the contact analysis sees it: nothing but its outline.
#[derive(Debug)]
pub(super) struct Body<'a> {
    pub(super) parts: Vec<Part<'a>>,
    pub(super) corners: Vec<Corner>,
    /// Greatest distance from the axis.
    pub(super) reach: f64,
    /// The same, sector by sector of the body's own polar angle.
    sectors: Vec<f64>,
}

/// Sectors in which a body's reach is kept.
const SECTORS: usize = 72;

impl<'a> Body<'a> {
    pub(super) fn of(gear: &'a Gear) -> Self {
        let outline: &Outline = gear.outline();
        let parts: Vec<Part<'a>> = outline
            .segments()
            .iter()
            .zip(gear.roles().iter().zip(gear.owners()))
            .map(|(segment, (&role, &owner))| part(segment, role, owner))
            .collect();
        let mut corners = Vec::new();
        let count = parts.len();
        for i in 0..count {
            let (before, after) = (&parts[i], &parts[(i + 1) % count]);
            let (end, start) = (before.segment.at(1.0), after.segment.at(-1.0));
            let turn = angle(end.first.perp(&start.first), end.first.dot(&start.first));
            // A re-entrant corner can touch nothing that its neighbours do not touch first.
            if turn > CORNER {
                let from = direction(&end);
                corners.push(Corner {
                    point: start.point,
                    owner: before.owner,
                    on_flank: before.role == Role::Flank || after.role == Role::Flank,
                    normals: Cone::new(from + 0.5 * turn, 0.5 * turn),
                });
            }
        }
        let reach = parts
            .iter()
            .map(|p| p.center.coords.norm() + p.radius)
            .fold(0.0, f64::max);
        let sectors = sectors(&parts);
        Self {
            parts,
            corners,
            reach,
            sectors,
        }
    }

    /// Greatest distance from the axis near a direction in the body's own frame.
    pub(super) fn reach_towards(&self, direction: &Vector) -> f64 {
        self.sectors[sector(angle(direction.y, direction.x)) % SECTORS]
    }
}

fn sector(angle: f64) -> usize {
    let share = angle.rem_euclid(TAU) / TAU;
    (share * SECTORS as f64) as usize
}

/// Reach by sector, each with its neighbours': what is near a direction may lie just beside it.
fn sectors(parts: &[Part<'_>]) -> Vec<f64> {
    let mut own = vec![0.0_f64; SECTORS];
    for part in parts {
        let away = part.center.coords.norm();
        let far = away + part.radius;
        let middle = angle(part.center.y, part.center.x);
        // A part about the axis itself, or reaching it, is in every sector.
        let spread = if part.radius < away {
            (part.radius / away).asin()
        } else {
            PI
        };
        let width = TAU / SECTORS as f64;
        let count = (2.0 * spread / width).ceil() as usize + 1;
        for k in 0..=count.min(SECTORS) {
            let at = sector(middle - spread + k as f64 * width) % SECTORS;
            own[at] = own[at].max(far);
        }
    }
    (0..SECTORS)
        .map(|k| {
            own[k]
                .max(own[(k + 1) % SECTORS])
                .max(own[(k + SECTORS - 1) % SECTORS])
        })
        .collect()
}

fn angle(y: f64, x: f64) -> f64 {
    y.atan2(x)
}

/// Direction of the outward normal: the contour is counter-clockwise.
fn direction(jet: &SegmentJet) -> f64 {
    angle(-jet.first.x, jet.first.y)
}

fn part(segment: &Segment, role: Role, owner: u32) -> Part<'_> {
    const SAMPLES: usize = 6;
    let jets: [SegmentJet; SAMPLES + 1] =
        std::array::from_fn(|i| segment.at(-1.0 + 2.0 * i as f64 / SAMPLES as f64));
    let center = nalgebra::center(&jets[0].point, &jets[SAMPLES].point);
    let radius = jets
        .iter()
        .map(|j| (j.point - center).norm())
        .fold(0.0, f64::max);
    let chord = (jets[SAMPLES].point - jets[0].point).normalize();
    let sagitta = jets
        .iter()
        .map(|j| chord.perp(&(j.point - jets[0].point)).abs())
        .fold(0.0, f64::max);
    let mut direction_now = direction(&jets[0]);
    let (mut low, mut high) = (direction_now, direction_now);
    for pair in jets.windows(2) {
        let (a, b): (Vector, Vector) = (pair[0].first, pair[1].first);
        direction_now += angle(a.perp(&b), a.dot(&b));
        low = low.min(direction_now);
        high = high.max(direction_now);
    }
    // Between samples a smooth part turns little more than between their ends.
    let half = 0.5 * (high - low);
    Part {
        segment,
        role,
        owner,
        center,
        radius: radius * 1.02,
        normals: Cone::new(0.5 * (low + high), half * 1.05 + 1e-3),
        start: jets[0].point,
        end: jets[SAMPLES].point,
        sagitta: 1.1 * sagitta,
        bend: bend(&jets),
    }
}

/// Greatest curvature among samples, raised by half its spread.
fn bend(jets: &[SegmentJet]) -> f64 {
    let curvature = |j: &SegmentJet| j.first.perp(&j.second) / j.first.norm().powi(3);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for jet in jets {
        let k = curvature(jet);
        low = low.min(k);
        high = high.max(k);
    }
    high + 0.5 * (high - low)
}
