//! Sections along shafts, pins and screws, with the parts on them and around them.

use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::{Draft, Pen, Scale};
use centrode_geometry::{Bounds, Outline, Point, Solid, Tolerance, Vector};
use centrode_kinematics::machine::{Blank, Form, LinkedMachine, Part, Shape, Supply, TurnedPart};
use nalgebra::{Isometry3, Point3, Vector3};

/// Maximum height of a section on paper, mm.
const HIGH: f64 = 90.0;
/// Largest scale of a section.
const LARGEST: f64 = 5.0;
/// Half the width of a section in diameters of the turned part, and the distance on paper from the section to its numbers, mm.
const WIDE: f64 = 1.25;
const BESIDE: f64 = 6.0;
/// Minimum width of a cut body relative to half the width of the section; thinner ones are omitted unless they are about the
/// axis.
const MINIMUM: f64 = 0.1;
/// Distance below which two axes count as one, mm.
const ONE: f64 = 1e-6;
/// Maximum difference between the diameters of a drawn contour and of its listed blank, mm.
const DRAWN: f64 = 0.01;
/// Height of the letters of headings and numbers, mm.
const LETTERS: f64 = 2.5;

/// A section in a plane through the axis of a turned part.
pub(super) struct Stack {
    /// Name of the turned part.
    name: String,
    /// Rectangles in the plane, across the axis and along it, mm.
    cuts: Vec<Cut>,
    /// Half of the width, mm.
    half: f64,
    /// Item in the parts list and a position on it.
    items: Vec<(usize, Point)>,
}

struct Cut {
    bounds: Bounds,
    /// Whether it is hatched: shafts, pins and bought parts are not.
    hatched: bool,
}

/// An upright plane through an axis of the machine.
#[derive(Clone, Copy)]
struct Plane {
    axis: Point,
    /// Horizontal direction in it.
    across: Vector,
}

/// A body in the position that it has at the arrangement's input.
struct Placed<'a> {
    link: usize,
    shape: &'a Shape,
    place: Isometry3<f64>,
}

impl Stack {
    /// The sections of a machine: one through every kind of upright turned part, except those whose parts are all in another
    /// section.
    pub(super) fn all(
        machine: &LinkedMachine,
        places: &[Isometry3<f64>],
        tolerance: Tolerance,
    ) -> Vec<Self> {
        let bodies: Vec<Placed<'_>> = (0..machine.links.len())
            .flat_map(|link| {
                let own = machine.links[link].bodies();
                own.map(move |(shape, at)| Placed {
                    link,
                    shape: &machine.shapes[shape],
                    place: places[link] * at,
                })
            })
            .collect();
        let mut found: Vec<Self> = Vec::new();
        let mut known: Vec<&str> = Vec::new();
        for body in &bodies {
            let Form::Turned(turned) = &body.shape.form else {
                continue;
            };
            let up = body.place.rotation * Vector3::z();
            if up.z.abs() < 1.0 - 1e-9 || known.contains(&&*body.shape.name) {
                continue;
            }
            known.push(&body.shape.name);
            found.extend(Self::through(body, turned, machine, &bodies, tolerance));
        }
        let items = |stack: &Self| -> Vec<usize> { stack.items.iter().map(|(i, _)| *i).collect() };
        let all: Vec<Vec<usize>> = found.iter().map(items).collect();
        let within = |a: &[usize], b: &[usize]| a.iter().all(|item| b.contains(item));
        let mut index = 0..found.len();
        found.retain(|_| {
            let own = index.next().unwrap_or_default();
            !all.iter().enumerate().any(|(other, items)| {
                let same = items.len() == all[own].len();
                other != own && within(&all[own], items) && (!same || other < own)
            })
        });
        found
    }

    fn through(
        body: &Placed<'_>,
        turned: &TurnedPart,
        machine: &LinkedMachine,
        bodies: &[Placed<'_>],
        tolerance: Tolerance,
    ) -> Option<Self> {
        let across = (body.place.rotation * Vector3::x()).xy();
        let plane = Plane {
            axis: Point::from(body.place.translation.vector.xy()),
            across: across.try_normalize(0.0)?,
        };
        let wide = WIDE * turned.diameter();
        let mut stack = Self {
            name: turned.title.clone(),
            cuts: Vec::new(),
            half: wide,
            items: Vec::new(),
        };
        // Bodies along the turned part, and heads and rings at its ends.
        let ends = [0.0, turned.length()].map(|z| (body.place * Point3::new(0.0, 0.0, z)).z);
        let span = [ends[0].min(ends[1]) - ONE, ends[0].max(ends[1]) + ONE];
        for other in bodies {
            let cuts = other.cuts(plane, wide, span, tolerance);
            for (cut, size) in cuts {
                let item = other.item(machine, size);
                let hatched = !matches!(other.shape.form, Form::Turned(_))
                    && item.is_some_and(|item| machine.parts[item].supply == Supply::Made);
                if let Some(item) = item
                    && stack.items.iter().all(|(known, _)| *known != item)
                {
                    let Bounds { min, max } = cut;
                    stack.items.push((item, min + 0.5 * (max - min)));
                }
                stack.cuts.push(Cut {
                    bounds: cut,
                    hatched,
                });
            }
        }
        (stack.items.len() > 1).then_some(stack)
    }

    /// Draws the section, with a heading and the item numbers of the parts list.
    pub(super) fn draft(&self, tolerance: Tolerance) -> Draft {
        let cuts = self.cuts.iter().map(|cut| cut.bounds);
        let whole = cuts.fold(Bounds::EMPTY, Bounds::union);
        let height = whole.max.y - whole.min.y;
        let scale = Scale::RECOMMENDED
            .into_iter()
            .find(|scale| scale.factor() <= LARGEST && scale.factor() * height <= HIGH);
        let scale = scale.unwrap_or(Scale::RECOMMENDED[Scale::RECOMMENDED.len() - 1]);
        let k = scale.factor();
        let mut draft = Draft::lettered(LETTERS).at_scale(k);
        for Cut { bounds, hatched } in &self.cuts {
            let (low, high) = (bounds.min * k, bounds.max * k);
            let corners = [
                low,
                Point::new(high.x, low.y),
                high,
                Point::new(low.x, high.y),
            ];
            let broken = |x: f64| (x.abs() - self.half).abs() < ONE;
            for i in 0..4 {
                let (a, b) = (corners[i], corners[(i + 1) % 4]);
                let pen = match a.x == b.x && broken(a.x / k) {
                    true => Pen::Thin,
                    false => Pen::Outline,
                };
                draft.line(pen, a, b);
            }
            if *hatched {
                draft.hatch(&[Outline::polygon(&corners)], tolerance);
            }
        }
        let Bounds { min, max } = Bounds {
            min: whole.min * k,
            max: whole.max * k,
        };
        let p = Point::new;
        draft.line(Pen::Axis, p(0.0, min.y - 3.0), p(0.0, max.y + 3.0));
        let notes: Vec<(Point, Vec<String>)> = self
            .items
            .iter()
            .map(|(item, at)| (at * k, vec![(item + 1).to_string()]))
            .collect();
        let around = Bounds {
            min: min - Vector::new(BESIDE, 0.0),
            max: max + Vector::new(BESIDE, 0.0),
        };
        draft.callouts(around, [f64::NEG_INFINITY; 2], &notes);
        let top = draft.bounds().max.y + 4.0;
        let words = format!("Along: {} ({scale})", self.name);
        draft.text(p(0.0, top), 3.5, &words, Anchor::Middle);
        draft
    }
}

impl Placed<'_> {
    /// Index of the body in the parts list: by the name of its files, by the designation of a bought part, or by its link and its
    /// thickness (mm). If several parts fit, its diameter about the axis (mm) decides.
    fn item(&self, machine: &LinkedMachine, [thickness, diameter]: [f64; 2]) -> Option<usize> {
        let find = |is: &dyn Fn(&Part) -> bool| machine.parts.iter().position(is);
        let shape = self.shape;
        if !shape.part.is_empty() {
            return find(&|part| part.file == shape.part);
        }
        if let Some(word) = shape.name.strip_prefix("bought/") {
            return find(&|part| part.word() == word);
        }
        let on_link = |part: &Part| part.links.contains(&self.link);
        if let Form::Turned(turned) = &shape.form {
            let mass = turned.mass_properties().map(|own| own.mass);
            let is = |part: &Part| part.name == turned.title;
            let bought = |part: &Part| on_link(part) && part.mass == mass;
            return find(&is).or_else(|| find(&bought));
        }
        let of = |blank: &Blank| match blank {
            Blank::Plate { thickness, .. } => [*thickness, 0.0],
            Blank::Round { length, diameter } => [*length, *diameter],
        };
        let alike = |part: &Part| {
            let own = part.blank.as_ref().map(of).filter(|_| on_link(part));
            own.filter(|own| (own[0] - thickness).abs() < ONE)
        };
        let round = |part: &Part| alike(part).is_some_and(|own| (own[1] - diameter).abs() < DRAWN);
        let flat = |part: &Part| alike(part).is_some_and(|own| own[1] == 0.0);
        let any = |part: &Part| alike(part).is_some();
        find(&round).or_else(|| find(&flat)).or_else(|| find(&any))
    }

    /// Rectangles in which a plane cuts the body, up to the distance `half` from the axis, each with the thickness of the body
    /// and its diameter about the axis, mm.
    fn cuts(
        &self,
        plane @ Plane { axis, across }: Plane,
        half: f64,
        span: [f64; 2],
        tolerance: Tolerance,
    ) -> Vec<(Bounds, [f64; 2])> {
        let upright = (self.place.rotation * Vector3::z()).z.abs() > 1.0 - 1e-9;
        let z = self.place.translation.vector.z;
        let up = (self.place.rotation * Vector3::z()).z;
        match &self.shape.form {
            Form::Turned(turned) if upright => {
                let off = Point::from(self.place.translation.vector.xy()) - axis;
                let (along, beside) = (off.dot(&across), off.perp(&across));
                let mut low = 0.0;
                let steps = turned.steps.iter().filter_map(|step| {
                    let ends = [low, low + step.length].map(|at| z + up * at);
                    low += step.length;
                    let radius = 0.5 * step.diameter;
                    // Only turned parts that the plane cuts through their middle.
                    (beside.abs() < ONE && along.abs() + radius <= half + ONE).then(|| {
                        let (bottom, top) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                        let bounds = Bounds {
                            min: Point::new(along - radius, bottom),
                            max: Point::new(along + radius, top),
                        };
                        (bounds, [turned.length(), 0.0])
                    })
                });
                let steps: Vec<(Bounds, [f64; 2])> = steps.collect();
                let meets = |(bounds, _): &(Bounds, [f64; 2])| {
                    bounds.min.y <= span[1] && bounds.max.y >= span[0]
                };
                if steps.iter().any(meets) {
                    steps
                } else {
                    Vec::new()
                }
            }
            Form::Solids(solids) if upright => solids
                .iter()
                .flat_map(|solid| {
                    let ends = [solid.bottom(), solid.top()].map(|at| z + up * at);
                    let (bottom, top) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                    if bottom > span[1] || top < span[0] {
                        return Vec::new();
                    }
                    let about = self.place.inverse() * Point3::new(axis.x, axis.y, z);
                    let about = solid
                        .outline()
                        .maximum_distance(Point::new(about.x, about.y));
                    let spans = self.spans(solid, plane, half, tolerance);
                    let spans = spans.into_iter().map(|[left, right]| {
                        let bounds = Bounds {
                            min: Point::new(left, bottom),
                            max: Point::new(right, top),
                        };
                        (bounds, [top - bottom, 2.0 * about])
                    });
                    spans.collect()
                })
                .collect(),
            // A key lies along the plane.
            Form::Solids(solids) => {
                let mut bounds = Bounds::EMPTY;
                let mut sides = [f64::INFINITY, f64::NEG_INFINITY];
                for solid in solids {
                    let Bounds { min, max } = solid.outline().bounds();
                    let heights = [solid.bottom(), solid.top()];
                    let corners = [min, max, Point::new(min.x, max.y), Point::new(max.x, min.y)];
                    for (corner, height) in corners
                        .iter()
                        .flat_map(|corner| heights.map(|height| (corner, height)))
                    {
                        let at = self.place * Point3::new(corner.x, corner.y, height);
                        let off = Point::from(at.coords.xy()) - axis;
                        bounds = bounds.with(Point::new(off.dot(&across), at.z));
                        let beside = off.perp(&across);
                        sides = [sides[0].min(beside), sides[1].max(beside)];
                    }
                }
                let within = sides[0] < 0.0
                    && sides[1] > 0.0
                    && bounds.min.x.abs().max(bounds.max.x.abs()) <= half
                    && bounds.min.y <= span[1]
                    && bounds.max.y >= span[0];
                if within {
                    vec![(bounds, [0.0; 2])]
                } else {
                    Vec::new()
                }
            }
            _ => Vec::new(),
        }
    }

    /// Stretches of a line across the axis that lie in an upright extrusion.
    fn spans(
        &self,
        solid: &Solid,
        Plane { axis, across }: Plane,
        half: f64,
        tolerance: Tolerance,
    ) -> Vec<[f64; 2]> {
        // In the body's own frame.
        let inside = self.place.inverse();
        let at = inside * Point3::new(axis.x, axis.y, self.place.translation.vector.z);
        let way = inside.rotation * Vector3::new(across.x, across.y, 0.0);
        let (at, way) = (Point::new(at.x, at.y), Vector::new(way.x, way.y));
        let reach = Vector::repeat(half);
        let around = Bounds {
            min: at - reach,
            max: at + reach,
        };
        let bounds = solid.outline().bounds();
        // Sleeves and rollers on another axis nearby have a section of their own.
        let small = (bounds.max - bounds.min).amax() < 2.0 * half;
        if !bounds.meets(&around) || (small && !bounds.meets(&Bounds { min: at, max: at })) {
            return Vec::new();
        }
        let mut crossings: Vec<f64> = Vec::new();
        for contour in std::iter::once(solid.outline()).chain(solid.holes()) {
            let points = contour.flatten(tolerance);
            let next = points.iter().cycle().skip(1);
            for (a, b) in points.iter().zip(next) {
                let [u, v] = [a, b].map(|p| way.perp(&(p - at)));
                if (u > 0.0) != (v > 0.0) {
                    let crossing = a + (b - a) * (u / (u - v));
                    crossings.push((crossing - at).dot(&way));
                }
            }
        }
        crossings.sort_by(f64::total_cmp);
        let pairs = crossings.chunks_exact(2);
        let cut = pairs.map(|pair| [pair[0].max(-half), pair[1].min(half)]);
        // Parts about the axis are shown even if they are thin.
        let about = solid.holes().iter().any(|hole| hole.contains(at));
        let whole = |[left, right]: &[f64; 2]| -half < *left && *right < half;
        cut.filter(|span| span[1] - span[0] > MINIMUM * half || (about && whole(span)))
            .collect()
    }
}
