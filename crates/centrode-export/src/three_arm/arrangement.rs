//! The general arrangement: the whole machine on a sheet, with its main dimensions and a list of its parts.

use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};
use centrode_mechanism::design::SheetSize;
use centrode_mechanism::gear::Member;
use centrode_mechanism::three_arm::Link;

use super::machine::Machine;
use super::{Part, assembly};
use crate::SheetOptions;
use crate::drawing::{Anchor, Shape};
use crate::sheet::{Draft, Pen, Piece, Scale, Sheet, SheetError, Table, TitleBlock, compose};

/// Sheet of a machine half a metre high.
const USUAL: SheetSize = SheetSize::A2;
/// Room between the view and its first dimension line, mm, and from one line to the next.
const FIRST: f64 = 12.0;
const NEXT: f64 = 9.0;
/// Room on either side of the middle of a dimension line, mm: half its words, and for leaders that slant.
const CLEAR: f64 = 15.0;

/// The sheets of the machine as its first arm picks.
pub(super) fn sheets(
    machine: &Machine<'_>,
    supplement: &str,
    options: &SheetOptions,
    tolerance: Tolerance,
) -> Result<Vec<Sheet>, SheetError> {
    let spec = &machine.mechanism.design().drawing;
    let mut block = TitleBlock::new(spec, Part::Assembly.name(), options);
    block.title = Part::Assembly.title().into();
    block.supplement = supplement.into();
    block.document = "General arrangement".into();
    let view = View::of(machine, tolerance);
    let (parts, figures) = (parts_list(machine), figures(machine));
    let lines = [
        "Shown as arm I picks; arms II and III follow it.".to_owned(),
        "Gears seen through the front plate of the carrier.".to_owned(),
        "Dash-dotted: pitch curves, path of the tips.".to_owned(),
        "Spring, bearings, shafts, screws: bought, not listed.".to_owned(),
    ];
    let pieces = |scale: Scale, size: SheetSize| {
        vec![
            Piece::table("parts list", &parts),
            Piece::table("figures", &figures),
            Piece::notes(&lines),
            Piece::view("machine", view.draft(scale, size)),
        ]
    };
    let extent = (view.whole.max - view.whole.min).amax();
    let size = options.size.or(spec.sheet).unwrap_or(USUAL);
    compose(Some(size), &block, extent, &pieces, &[])
}

/// The machine from the front, at full size.
struct View<'a> {
    machine: &'a Machine<'a>,
    contours: Vec<(Pen, Outline)>,
    path: Vec<Point>,
    /// Feet of the planted seedlings, the newest first.
    planted: Vec<Point>,
    whole: Bounds,
}

impl<'a> View<'a> {
    fn of(machine: &'a Machine<'a>, tolerance: Tolerance) -> Self {
        let mechanism = machine.mechanism;
        let mut contours: Vec<(Pen, Outline)> = assembly::contours(machine, tolerance)
            .into_iter()
            .map(|(layer, outline)| (pen(layer), outline))
            .collect();
        let path = assembly::path(mechanism);
        let reach = path.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let tray = mechanism.tray_body();
        // Of a long tray what is within reach of the arms, and a little more.
        let near = |outline: &Outline| outline.bounds().max.y.abs() < reach;
        let stems = tray.stems.iter().map(|stem| tray.placed(stem)).filter(near);
        let still = stems.chain(assembly::planted_stems(mechanism, reach));
        contours.extend(still.map(|outline| (Pen::Adjacent, outline)));
        let bounds = contours.iter().map(|(_, outline)| outline.bounds());
        let whole = bounds.fold(Bounds::EMPTY, Bounds::union);
        let whole = path.iter().fold(whole, |b, p| b.with(*p));
        Self {
            machine,
            contours,
            path,
            planted: assembly::planted(mechanism, reach),
            whole,
        }
    }

    fn draft(&self, scale: Scale, size: SheetSize) -> Draft {
        let k = scale.factor();
        let letters = match size {
            SheetSize::A4 => 2.5,
            _ => 3.5,
        };
        let mut draft = Draft::lettered(letters);
        for (pen, outline) in &self.contours {
            draft.draw(*pen, Shape::Contour(outline.scaled(k)));
        }
        let path = self.path.iter().map(|p| p * k).collect();
        draft.draw(Pen::Axis, Shape::Polyline(path));
        let whole = Bounds {
            min: self.whole.min * k,
            max: self.whole.max * k,
        };
        self.surroundings(&mut draft, k, letters);
        let words = self.dimensions(&mut draft, k, whole);
        let items: Vec<(Point, Vec<String>)> = self
            .items()
            .into_iter()
            .map(|(items, at)| (at * k, vec![items]))
            .collect();
        // Numbers stand beyond the dimension lines, and their leaders pass clear of the words there.
        let around = Bounds {
            min: whole.min,
            max: whole.max + Vector::new(FIRST + 2.0 * NEXT, 0.0),
        };
        draft.callouts(around, words, &items);
        draft
    }

    /// The tray's surface, the ground, and the axes.
    fn surroundings(&self, draft: &mut Draft, k: f64, letters: f64) {
        let mechanism = self.machine.mechanism;
        let tray = mechanism.tray_body();
        let span = 0.5 * (self.whole.max.y - self.whole.min.y);
        let end = |side: f64| tray.place * Point::new(0.0, side * span) * k;
        draft.line(Pen::Outline, end(-1.0), end(1.0));
        let ground = mechanism.ground() * k;
        let [left, right] = [self.whole.min.x, self.whole.max.x].map(|x| x * k);
        let (from, to) = (Point::new(left, ground), Point::new(right, ground));
        draft.line(Pen::Outline, from, to);
        let over = to + Vector::new(0.0, 1.5);
        draft.text(over, letters, "ground", Anchor::Right);
        let top = end(1.0);
        let behind = top + Vector::new(2.0, -letters);
        draft.text(behind, letters, "surface of the tray", Anchor::Left);
        let cross = 6.0;
        for at in self.axes() {
            let at = at * k;
            for way in [Vector::x(), Vector::y()] {
                draft.line(Pen::Axis, at - way * cross, at + way * cross);
            }
        }
    }

    /// Axes of sun, intermediate gears and planets.
    fn axes(&self) -> Vec<Point> {
        let arms = 0..self.machine.mechanism.arms();
        let turning = arms.flat_map(|k| [Link::Intermediate(k), Link::Planet(k)]);
        [Link::Sun]
            .into_iter()
            .chain(turning)
            .map(|l| self.at(l))
            .collect()
    }

    /// Where a link's frame stands.
    fn at(&self, link: Link) -> Point {
        let mechanism = self.machine.mechanism;
        mechanism.link(link, mechanism.picking(0)).origin.position
    }

    /// Tray, ground, trajectory and plants; gives the heights between which the words of the upright ones stand.
    fn dimensions(&self, draft: &mut Draft, k: f64, whole: Bounds) -> [f64; 2] {
        let mechanism = self.machine.mechanism;
        let origin = Point::origin();
        let tip = mechanism.tip(mechanism.picking(0), 0).position;
        let trajectory = mechanism.trajectory();
        let below = |row: f64| Point::new(0.0, whole.min.y - FIRST - row * NEXT);
        draft.dimension([origin, tip * k], Vector::x(), below(0.0), &number(tip.x));
        if let [newest, before, ..] = self.planted[..] {
            let apart = number(mechanism.design().work.plant_spacing);
            draft.dimension([newest * k, before * k], Vector::x(), below(1.0), &apart);
        }
        let beside = |row: f64| Point::new(whole.max.x + FIRST + row * NEXT, 0.0);
        let ground = Point::new(0.0, mechanism.ground());
        let [low, high] = [trajectory.lowest, trajectory.highest]
            .map(|extreme| mechanism.tip(extreme.input, 0).position);
        let middles = [
            ([origin, ground], -ground.y),
            ([low, high], trajectory.height()),
        ]
        .into_iter()
        .zip([0.0, 1.0])
        .map(|(([a, b], length), row)| {
            let ends = [a * k, b * k];
            draft.dimension(ends, Vector::y(), beside(row), &number(length));
            0.5 * (ends[0].y + ends[1].y)
        });
        let middles: Vec<f64> = middles.collect();
        let least = middles.iter().copied().fold(f64::INFINITY, f64::min);
        let most = middles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [least - CLEAR, most + CLEAR]
    }

    /// A point of each part, by its number in the list of parts, on different arms so that they spread; the covers of
    /// a housing share its contour.
    fn items(&self) -> Vec<(String, Point)> {
        let mechanism = self.machine.mechanism;
        let arms = mechanism.arms();
        let input = mechanism.picking(0);
        let on_arm =
            |k: u32, p: Point| mechanism.link(Link::Arm(k % arms), input).point(p).position;
        let (spec, pusher) = (&mechanism.design().arm, &self.machine.pusher);
        let reach = (spec.tip_distance.powi(2) - spec.pusher_offset.powi(2)).sqrt();
        let back = |k: u32| {
            pusher
                .retraction(mechanism.own_input(input, k % arms))
                .position
        };
        let sizes = mechanism.arm_sizes();
        let offset = spec.pusher_offset;
        let radius = |member| 0.5 * mechanism.rolling().radii(member).0;
        let beside = |link: Link, far: f64| self.at(link) + Vector::new(0.7, 0.7) * far;
        let carrier = mechanism.link(Link::Carrier, input);
        let rim = self
            .machine
            .gearbox
            .outline
            .segments()
            .first()
            .map(|s| s.start());
        let points = [
            (Part::Sun, Some(beside(Link::Sun, -radius(Member::Driver)))),
            (
                Part::Intermediate,
                Some(beside(Link::Intermediate(1 % arms), radius(Member::Driven))),
            ),
            (
                Part::Planet,
                Some(beside(Link::Planet(2 % arms), -radius(Member::Driver))),
            ),
            (
                Part::Cam,
                Some(beside(Link::Planet(1 % arms), 0.6 * pusher.cam().radii().0)),
            ),
            (Part::Fork, Some(on_arm(2, pusher.pivot()))),
            (Part::Roller, Some(on_arm(0, pusher.roller(back(0))))),
            (Part::Carrier, rim.map(|p| carrier.point(p).position)),
            (
                Part::Housing,
                Some(on_arm(
                    1,
                    Point::new(-sizes.housing.drum_radius * 0.98, 0.0),
                )),
            ),
            (
                Part::Clamp,
                Some(on_arm(
                    2,
                    Point::new(reach - 0.5 * spec.clamp_length, -offset),
                )),
            ),
            (
                Part::PushRod,
                Some(on_arm(
                    0,
                    Point::new(reach - spec.clamp_length - back(0), -offset),
                )),
            ),
        ];
        let numbered = |(part, at): (Part, Option<Point>)| {
            let parts: &[Part] = match part {
                Part::Housing => &[part, Part::CoverRear, Part::CoverFront],
                _ => &[part],
            };
            let items: Vec<String> = parts.iter().map(|part| item(*part)).collect();
            Some((items.join(", "), at?))
        };
        points.into_iter().filter_map(numbered).collect()
    }
}

/// How the layers of the drawing look on a sheet.
fn pen(layer: &str) -> Pen {
    match layer {
        "ARMS" => Pen::Outline,
        "CARRIER" => Pen::Adjacent,
        "PITCH_CURVE" => Pen::Axis,
        _ => Pen::Thin,
    }
}

/// Number of a part in the list, from one.
fn item(part: Part) -> String {
    let before = Part::ALL.iter().take_while(|known| **known != part).count();
    (before + 1).to_string()
}

fn parts_list(machine: &Machine<'_>) -> Table {
    let arms = machine.mechanism.arms();
    let listed = Part::ALL.into_iter().filter(|part| *part != Part::Assembly);
    let row = |part: Part| {
        let material = match (machine.gear(part), machine.plate_of(part)) {
            (Some((pair, member)), _) => pair.gear(member).body().material.clone(),
            (None, Some(plate)) => plate.material,
            (None, None) => String::new(),
        };
        vec![
            item(part),
            part.title().to_owned(),
            part.quantity(arms).to_string(),
            material,
            part.name().to_owned(),
        ]
    };
    Table {
        title: "Parts".into(),
        headings: ["item", "part", "quantity", "material", "files"]
            .map(String::from)
            .into(),
        columns: vec![
            Anchor::Right,
            Anchor::Left,
            Anchor::Right,
            Anchor::Left,
            Anchor::Left,
        ],
        rows: listed.map(row).collect(),
        notes: Vec::new(),
    }
}

fn figures(machine: &Machine<'_>) -> Table {
    let mechanism = machine.mechanism;
    let design = mechanism.design();
    let degrees = |angle: f64| format!("{}°", number(angle.to_degrees()));
    let rows = [
        ("centre distance a", number(mechanism.center_distance())),
        (
            "teeth of every gear",
            machine.pairs[0].driver().tooth_count().to_string(),
        ),
        ("module", number(machine.pairs[0].module())),
        ("bend γ0", degrees(design.bend)),
        (
            "arm's mounting angle β0",
            degrees(design.arm.mounting_angle),
        ),
        (
            "tip from the planet's axis S",
            number(design.arm.tip_distance),
        ),
        ("pusher's axis from it H1", number(design.arm.pusher_offset)),
        (
            "gearbox sweeps a radius of",
            number(mechanism.gearbox_radius()),
        ),
        (
            "arms pick at a carrier turn of",
            degrees(mechanism.picking(0)),
        ),
        ("and plant at", degrees(mechanism.planting(0))),
        ("seedlings a minute", number(design.work.rate_per_minute)),
        ("plants apart", number(design.work.plant_spacing)),
        ("holes of the tray apart", number(design.tray.hole_spacing)),
    ];
    Table {
        title: "Mechanism".into(),
        headings: Vec::new(),
        columns: vec![Anchor::Left, Anchor::Right],
        rows: rows.map(|(name, value)| vec![name.into(), value]).into(),
        notes: Vec::new(),
    }
}

/// A number to two places, without trailing zeros.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}
