use centrode_formats::drawing::EntityShape;
use centrode_formats::sheet::geometrical::{Frame, NoteLine};
use centrode_formats::sheet::{
    Corner, Draft, Pen, Scale, Sheet, SheetBlock, SheetError, TitleBlock, compose, number, steady,
    view_letters,
};
use centrode_geometry::{Arc, Point, Tolerance, Vector};
use centrode_kinematics::machine::HeldLength;
use centrode_spec::{DrawingSpec, SheetSize};

use super::{Drawn, across, centre, centre_mark, cutting_plane};
use crate::SheetOptions;
use crate::{fit, grade, number::mass, treatment::treatment_note};

/// Letter of the section; datums have the first two.
const SECTION: char = 'C';
/// Tolerance class of the width of a ring's groove, ISO 286.
const GROOVE: &str = "H13";
/// Decimals of lengths.
const PLACES: usize = 3;
/// Distance below which two axial positions count as one, mm: rounding.
const ROUNDING: f64 = 1e-6;
/// Length, in diameters, above which a part is turned between centres.
const SLENDER: f64 = 3.0;
/// Distance of dimension lines, mm, beyond the height of their letters.
const ROW: f64 = 4.5;
/// Maximum number of notes of diameters that are all on the right.
const LADDER: usize = 4;

impl Drawn<'_> {
    /// The drawing sheets: the part from the side, a section across its keyway.
    pub(super) fn sheets(
        &self,
        spec: &DrawingSpec,
        supplement: &str,
        quantity: usize,
        options: &SheetOptions,
        tolerance: Tolerance,
    ) -> Result<Vec<Sheet>, SheetError> {
        let (name, title, projection) = (&self.name, &self.title, options.projection);
        let mut block = TitleBlock::of_part(spec, name, title, supplement, projection);
        block.material.clone_from(&self.material);
        block.mass = self.mass().map(|kg| mass(kg * 1e3)).unwrap_or_default();
        let mut lines = vec![format!("{quantity} for each machine.")];
        lines.push(format!("Turned; contour: {}.dxf.", self.name));
        if let Some(centre) = self.centre() {
            lines.push(format!("Centre holes at both ends: {centre}."));
        }
        lines.extend(self.notes.iter().cloned());
        let classes = self.steps.iter().map(|step| &*step.class);
        lines.extend(block.fitted(classes, ""));
        lines.push(treatment_note(&self.heat_treatment));
        let keyed = self
            .steps
            .iter()
            .find(|step| step.is_keyed && step.ring.is_none());
        let section = keyed.map(|step| {
            let (size, class, key) = (step.diameter, fit::SHAFT_KEYWAY, self.keyway);
            let words = [NoteLine::from(fit::bore(size, &step.class))];
            let is_datum = self.datum().is_some();
            across(size, key, class, is_datum, SECTION, &words, tolerance)
        });
        let pieces = |scale: Scale, size: SheetSize| {
            let mut pieces = vec![
                SheetBlock::notes(&lines),
                SheetBlock::view("side view", self.side(scale, size)),
            ];
            let section = section.iter().cloned();
            pieces.extend(
                section.map(|draft| SheetBlock::detail("section", draft, Corner::LowerLeft)),
            );
            pieces
        };
        compose(
            options.size.or(spec.sheet),
            &block,
            self.length(),
            &pieces,
            &[],
        )
    }

    /// Centre holes of a long part.
    fn centre(&self) -> Option<String> {
        let end = self.diameter() - 2.0 * self.chamfer;
        let is_long = self.length() > SLENDER * self.diameter();
        centre(end).filter(|_| is_long)
    }

    /// The part from the side, its keyway towards the viewer.
    fn side(&self, scale: Scale, size: SheetSize) -> Draft {
        let k = scale.factor();
        let mut draft = Draft::lettered(view_letters(size)).at_scale(k);
        let p = |x: f64, y: f64| Point::new(k * x, k * y);
        draft.draw(
            Pen::Outline,
            EntityShape::Contour(self.silhouette().scaled(k)),
        );
        for corner in self.half().windows(2) {
            // An edge round the part wherever its contour bends.
            let [from, to] = [corner[0], corner[1]];
            for at in [from, to] {
                let is_end = at.x == 0.0 || at.x == self.length();
                if !is_end && from.y != to.y {
                    draft.line(Pen::Outline, p(at.x, -at.y), p(at.x, at.y));
                }
            }
        }
        // A thin line where only the class changes, not the diameter.
        for (pair, [_, end]) in self.steps.windows(2).zip(self.ends()) {
            let [one, other] = [&pair[0], &pair[1]];
            if one.diameter == other.diameter && one.class != other.class {
                let radius = 0.5 * one.diameter;
                draft.line(Pen::Thin, p(end, -radius), p(end, radius));
            }
        }
        let whole = self.length();
        draft.line(
            Pen::Axis,
            Point::new(-4.0, 0.0),
            Point::new(k * whole + 4.0, 0.0),
        );
        self.draw_keyways(&mut draft, k);
        self.lengths(&mut draft, k);
        self.diameters(&mut draft, k);
        self.draw_plane(&mut draft, k);
        if self.centre().is_some() {
            for (end, way) in [(0.0, -1.0), (whole, 1.0)] {
                centre_mark(&mut draft, p(end, 0.0), way);
            }
        }
        draft
    }

    /// Start and end of each step along the axis, mm.
    fn ends(&self) -> Vec<[f64; 2]> {
        let mut at = 0.0;
        let steps = self.steps.iter().map(|step| {
            let from = at;
            at += step.length;
            [from, at]
        });
        steps.collect()
    }

    fn draw_keyways(&self, draft: &mut Draft, k: f64) {
        let Some(key) = self.keyway else {
            return;
        };
        let half = 0.5 * key.width * k;
        for ([from, to], round) in self.keyways() {
            // The walls end where the round ends begin.
            let inset = round.map(|is_round| if is_round { half } else { 0.0 });
            let ends = [k * from + inset[0], k * to - inset[1]];
            for y in [-half, half] {
                let [start, end] = ends.map(|x| Point::new(x, y));
                draft.line(Pen::Outline, start, end);
            }
            for (end, is_round) in round.into_iter().enumerate() {
                let [low, high] = [-half, half].map(|y| Point::new(ends[end], y));
                // Counter-clockwise about its middle.
                let (start, end) = if end == 0 { (high, low) } else { (low, high) };
                draft.draw(
                    Pen::Outline,
                    match is_round {
                        true => EntityShape::Arc(Arc {
                            start,
                            end,
                            bulge: 1.0,
                        }),
                        false => EntityShape::Line(start, end),
                    },
                );
            }
        }
    }

    /// The plane of the section across the first keyway.
    fn draw_plane(&self, draft: &mut Draft, k: f64) {
        let Some(&([from, to], _)) = self.keyways().first() else {
            return;
        };
        let height = 0.5 * k * self.diameter() + 2.0;
        cutting_plane(draft, [k * from, k * to], height, SECTION);
    }

    /// Lengths with a dimension, and their words: every step except grooves and the last step, and the length over all. If
    /// deviations hold for several steps together, the dimension of their sum replaces that of the last of them.
    fn dimensioned(&self) -> Vec<([f64; 2], String)> {
        let last = self.steps.len() - 1;
        let inside = |held: &&HeldLength, [from, to]: [f64; 2]| {
            held.span[0] <= from + ROUNDING && held.span[1] >= to - ROUNDING
        };
        let steps = self.steps.iter().zip(self.ends()).enumerate();
        let plain = steps.filter(|(index, (step, _))| step.ring.is_none() && *index < last);
        let mut all: Vec<([f64; 2], String)> = plain
            .map(|(_, (_, ends))| {
                let held = self.held.iter().find(|held| inside(held, ends));
                match held.filter(|held| ends[1] >= held.span[1] - ROUNDING) {
                    Some(held) => {
                        let long = held.span[1] - held.span[0];
                        (held.span, fit::length(long, held.deviations))
                    }
                    None => (ends, number(ends[1] - ends[0], PLACES)),
                }
            })
            .collect();
        all.push(([0.0, self.length()], number(self.length(), PLACES)));
        all
    }

    /// Lengths below the view.
    fn lengths(&self, draft: &mut Draft, k: f64) {
        let radius = 0.5 * k * self.diameter();
        let row = draft.lettering() + ROW;
        let keyed = if self.keyway.is_some() { 9.0 } else { 0.0 };
        let p = |x: f64| Point::new(k * x, -radius);
        let mut lower = radius + keyed;
        // Extension lines of lower dimensions may run through the words of upper ones.
        let crossing: Vec<f64> = self.ends().into_iter().flatten().map(|x| k * x).collect();
        // End of the last dimension line, if its words fit between its arrows, so that the next dimension fits in its row.
        let mut free = f64::INFINITY;
        for ([from, to], words) in self.dimensioned() {
            let is_held = draft.holds(k * (to - from), &words);
            if !is_held || from < free - ROUNDING {
                lower += row;
            }
            free = if is_held { to } else { f64::INFINITY };
            let at = Point::new(0.0, -lower);
            draft.dimension_clear_of([p(from), p(to)], Vector::x(), at, &words, &crossing);
        }
    }

    /// The longest step with a class, the datum for the runout of all others; `None` for a part of one step.
    fn datum(&self) -> Option<usize> {
        let steps = self.steps.iter().enumerate();
        let fitted = steps.filter(|(_, step)| step.ring.is_none() && !step.class.is_empty());
        let longest = fitted.max_by(|(_, a), (_, b)| steady(a.length).total_cmp(&steady(b.length)));
        longest
            .map(|(index, _)| index)
            .filter(|_| self.steps.len() > 1)
    }

    /// Notes of the diameters and chamfers above the view; on each side they are lower towards the end of the part.
    fn diameters(&self, draft: &mut Draft, k: f64) {
        let datum = self.datum();
        let notes = self.steps.iter().zip(self.ends()).enumerate();
        let mut notes: Vec<(Point, Vec<NoteLine>)> = notes
            .map(|(index, (step, [from, to]))| {
                let tip = Point::new(0.5 * k * (from + to), 0.5 * k * step.diameter);
                let size = fit::bore(step.diameter, &step.class);
                let mut lines = vec![NoteLine::from(size)];
                if let Some(ring) = step.ring {
                    let width = fit::keyway(ring.width, GROOVE);
                    lines.push(format!("groove {width}").into());
                    lines.push(format!("for {}", ring.name()).into());
                }
                if step.is_keyed {
                    lines.push("with keyway".to_owned().into());
                }
                if Some(index) == datum {
                    lines.push(Frame::datum('A').into());
                } else if datum.is_some() && step.ring.is_none() && !step.class.is_empty() {
                    lines.extend(grade::runout(step.diameter, "A").map(NoteLine::from));
                }
                (tip, lines)
            })
            .collect();
        if self.chamfer > 0.0 {
            let end = k * (self.length() - 0.5 * self.chamfer);
            let last = &self.steps[self.steps.len() - 1];
            let radius = 0.5 * k * (last.diameter - self.chamfer);
            let words = format!("{} x 45°, both ends", number(self.chamfer, PLACES));
            notes.push((Point::new(end, radius), vec![words.into()]));
        }
        let row = draft.lettering() + 2.0;
        let keyed = if self.keyway.is_some() { 9.0 } else { 0.0 };
        let lowest = 0.5 * k * self.diameter() + keyed + 6.0;
        // If there are many notes, they are on both sides, so that leaders from farther in pass no words.
        let left = if notes.len() > LADDER {
            notes.len() / 2
        } else {
            0
        };
        let mut heights = vec![lowest; notes.len()];
        let mut climb = |all: &mut dyn Iterator<Item = usize>| {
            let mut height = lowest;
            for index in all {
                height += row * (notes[index].1.len() as f64 - 1.0).max(0.0);
                heights[index] = height;
                height += row + 2.0;
            }
        };
        climb(&mut (0..left));
        climb(&mut (left..notes.len()).rev());
        for (index, (tip, lines)) in notes.iter().enumerate().rev() {
            let aside = if index < left { -4.0 } else { 4.0 };
            draft.note(*tip, Point::new(tip.x + aside, heights[index]), lines);
        }
    }
}
