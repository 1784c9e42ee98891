//! One tooth, enlarged.

use super::part::{SheetGear, degrees};
use centrode_formats::{
    drawing::{Anchor, EntityShape},
    sheet::{Draft, Pen, Scale, lettering, number},
};
use centrode_gear::Role;
use centrode_geometry::{Point, Tolerance, Vector};
use nalgebra::Rotation2;

/// Height of the letters, mm.
const LETTERS: f64 = 2.5;
/// Length that words of four figures take beyond the arrows of a dimension, mm.
const WORDS: f64 = 18.0;
/// Length of the detail on paper, mm.
const SHOWN: f64 = 72.0;

/// The teeth at the maximum and the minimum curvature of the pitch curve; one tooth if the pitch curve is a circle.
pub(super) fn extremes(part: &SheetGear<'_>) -> Vec<(u32, &'static str)> {
    let teeth = part.gear.teeth();
    let sound: Vec<(u32, f64)> = (0_u32..)
        .zip(teeth)
        .filter(|(_, tooth)| !tooth.cut_through)
        .map(|(k, _)| (k, part.middle(k, 0.0).curvature))
        .collect();
    let by = |a: &&(u32, f64), b: &&(u32, f64)| a.1.total_cmp(&b.1);
    let (Some(minimum), Some(most)) = (sound.iter().min_by(by), sound.iter().max_by(by)) else {
        return Vec::new();
    };
    if most.1 - minimum.1 < 1e-9 / part.pair.module() {
        return vec![(0, "every tooth equal")];
    }
    let gentlest = if minimum.1 < 0.0 {
        "nearest to where the curve is most concave"
    } else {
        "nearest to where the curve is straightest"
    };
    vec![
        (most.0, "nearest to where the curve bends most"),
        (minimum.0, gentlest),
    ]
}

/// A tooth upright, with half a space on both sides.
pub(super) fn detail(part: &SheetGear<'_>, letter: char, tooth: u32, place: &str) -> Draft {
    let pitch = part.pitch();
    let scale = Scale::largest(1.8 * pitch, SHOWN);
    let k = scale.factor();
    let frame = part.middle(tooth, 0.0);
    let turn = Rotation2::new(std::f64::consts::FRAC_PI_2 - frame.normal.y.atan2(frame.normal.x));
    let upright = |p: Point| Point::from(turn * (p - frame.point) * k);
    let fine = Tolerance::new(0.01 / k).unwrap_or(part.tolerance);
    let reach = 0.9 * pitch * k;
    let mut draft = Draft::lettered(LETTERS).at_scale(k);
    let profile = near(&part.gear.outline().flatten(fine), &upright, reach);
    let curve = near(
        &part.gear.pitch_curve().flatten(fine),
        &upright,
        reach + 4.0,
    );
    let heights = |points: &[Point], pick: fn(f64, f64) -> f64, start: f64| {
        points.iter().map(|p| p.y).fold(start, pick)
    };
    let low = heights(&profile, f64::min, 0.0);
    let central = |p: &&Point| p.x.abs() < 0.3 * pitch * k;
    let crown: Vec<Point> = profile.iter().filter(central).copied().collect();
    let high = heights(&crown, f64::max, 0.0);
    let base = low - 7.0;
    let p = Point::new;
    if let (Some(&first), Some(&last)) = (profile.first(), profile.last()) {
        draft.line(Pen::Thin, first, p(first.x, base));
        draft.line(Pen::Thin, last, p(last.x, base));
        let wave = (0..=48).map(|i| {
            let x = first.x + (last.x - first.x) * f64::from(i) / 48.0;
            p(
                x,
                base + 0.8 * (0.9 * f64::from(i)).sin() * (1.0 - (f64::from(i) / 24.0 - 1.0).abs()),
            )
        });
        draft.draw(Pen::Thin, EntityShape::Polyline(wave.collect()));
    }
    draft.draw(Pen::Outline, EntityShape::Polyline(profile.clone()));
    draft.draw(Pen::Axis, EntityShape::Polyline(curve));
    draft.line(Pen::Axis, p(0.0, low - 3.0), p(0.0, high + 3.0));
    let side = &part.gear.teeth()[tooth as usize];
    let foot = [side.leading, side.trailing].map(|s| upright(part.frame(s.crossing).point));
    let thick = (foot[1] - foot[0]).norm() / k;
    let above = p(0.0, heights(&profile, f64::max, high) + 9.0);
    let words = format!("{thick:.3}");
    // The text of the thickness may be next to its arrows: the heights are placed clear of it.
    let beyond = foot[0].x.max(foot[1].x) + lettering::width(&words, LETTERS) + 13.0;
    draft.dimension(foot, foot[1] - foot[0], above, &words);
    let right = (reach + 9.0).max(beyond);
    if let Some(height) = part.height(&frame, 1.0) {
        let words = format!("{height:.3}");
        let ends = [p(0.0, 0.0), p(0.0, height * k)];
        draft.dimension(ends, Vector::y(), p(right, 0.0), &words);
    }
    // On a bent pitch curve the spaces are inclined to the tooth: their depth is measured along their own normal.
    let spaces = [-0.5, 0.5].map(|half| part.middle(tooth, half));
    let space = spaces.iter().find(|frame| upright(frame.point).x < 0.0);
    let depth = space.and_then(|frame| Some((frame, part.height(frame, -1.0)?)));
    if let Some((frame, depth)) = depth {
        let ends = [frame.point, frame.point - frame.normal * depth].map(upright);
        let outwards = turn * frame.tangent;
        let outwards = -outwards * outwards.x.signum();
        // The dimension is beyond the drawn profile; the more the normal is inclined, the more room its text needs.
        let lean = WORDS * outwards.y.abs();
        let far = (reach + 9.0 + lean + ends[0].x) / outwards.x.abs().max(0.5);
        let at = ends[0] + outwards * far;
        draft.dimension(ends, ends[1] - ends[0], at, &format!("{depth:.3}"));
    }
    let fillet = side.leading.fillet_radius.min(side.trailing.fillet_radius);
    let (segments, roles) = (part.gear.outline().segments(), part.gear.roles());
    let owned = segments.iter().zip(roles).zip(part.gear.owners());
    let own = owned.filter(|((_, role), owner)| **owner == tooth && **role == Role::Fillet);
    let mut own: Vec<Point> = own
        .map(|((segment, _), _)| upright(segment.at(0.0).point))
        .filter(|q| q.x > 0.0 && q.x < reach)
        .collect();
    own.sort_by(|a, b| a.y.total_cmp(&b.y));
    let at = own.get(own.len() / 2);
    if let (Some(&at), true) = (at, fillet.is_finite() && fillet > 0.0) {
        let elbow = p(reach + 5.0, low - 5.0);
        let words = format!("fillet R ≥ {}", number(fillet, 3));
        draft.leader(at, elbow, &[words]);
    }
    let radius = 1.0 / frame.curvature;
    let bend = if frame.curvature.abs() * part.gear.pitch_length() < 1e-6 {
        "straight here".to_owned()
    } else {
        format!("radius here {}", number(radius, 3))
    };
    let lines = [
        format!(
            "tooth {tooth} at {:.2}°, pitch radius {:.3}",
            degrees(frame.point),
            frame.point.coords.norm()
        ),
        format!("{place}: {bend}"),
    ];
    let bounds = draft.bounds();
    let center = 0.5 * (bounds.min.x + bounds.max.x);
    for (row, line) in lines.iter().enumerate() {
        let at = p(center, bounds.max.y + 9.0 - 4.6 * row as f64);
        draft.text(at, 2.5, line, Anchor::Middle);
    }
    let title = p(center, bounds.max.y + 15.0);
    draft.text(title, 5.0, &format!("{letter} ({scale})"), Anchor::Middle);
    draft
}

/// The run of a closed polyline, after mapping, from its point nearest to the origin out to a distance on both sides.
fn near(points: &[Point], map: &impl Fn(Point) -> Point, reach: f64) -> Vec<Point> {
    let mapped: Vec<Point> = points.iter().map(|p| map(*p)).collect();
    let count = mapped.len();
    let far = |p: &Point| p.x.abs().max(0.85 * p.coords.norm());
    let nearest = (0..count).min_by(|&a, &b| {
        let off = |i: usize| mapped[i].coords.norm();
        off(a).total_cmp(&off(b))
    });
    let Some(start) = nearest else {
        return Vec::new();
    };
    let walk = |step: usize| {
        let mut run = vec![mapped[start]];
        for i in 1..count {
            let q = mapped[(start + i * step) % count];
            let before = run[run.len() - 1];
            if far(&q) > reach {
                let t = (reach - far(&before)) / (far(&q) - far(&before));
                run.push(before + (q - before) * t.clamp(0.0, 1.0));
                break;
            }
            run.push(q);
        }
        run
    };
    let mut back = walk(count - 1);
    back.reverse();
    back.pop();
    back.extend(walk(1));
    if back.first().map(|p| p.x) > back.last().map(|p| p.x) {
        back.reverse();
    }
    back
}
