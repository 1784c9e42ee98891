use centrode_formats::drawing::{Anchor, EntityShape};
use centrode_formats::sheet::geometrical::{Characteristic, NoteLine};
use centrode_formats::sheet::{
    Draft, Pen, Scale, Sheet, SheetBlock, SheetError, Table, TitleBlock, compose, lettering,
    number, steady, view_letters,
};
use centrode_geometry::{Arc, Bounds, COMPUTED, Outline, Point, Segment, Tolerance, Vector};
use centrode_spec::{DrawingSpec, Projection, SheetSize};

use super::{Exactness, Hole, HoleKind, Plate, ScrewHole};
use crate::SheetOptions;
use crate::{number::fixed, treatment::treatment_note};

/// Maximum number of holes with their size and position next to the view; more have a table.
const CALLED_OUT: usize = 6;
/// Maximum number of sides of the contour in a sheet's table; contours with more are only in the cutting file.
const SIDES: usize = 40;
/// Radius of a timing mark on a sheet, mm.
const MARK: f64 = 0.6;
/// Extra distances between a hole and its label in the order tried, mm.
const FARTHER: [f64; 4] = [0.0, 2.0, 5.0, 9.0];
/// Decimals of lengths.
const PLACES: usize = 3;

impl Plate {
    /// The drawing sheets: face, edge, dimensions, notes.
    pub(crate) fn sheets(
        &self,
        spec: &DrawingSpec,
        supplement: &str,
        options: &SheetOptions,
        tolerance: Tolerance,
    ) -> Result<Vec<Sheet>, SheetError> {
        let (name, title, projection) = (&self.name, &self.title, options.projection);
        let mut block = TitleBlock::of_part(spec, name, title, supplement, projection);
        block.material.clone_from(&self.material);
        block.mass = self.weight();
        let plain = Plate {
            outline: self.outline.arcs(tolerance),
            ..self.clone()
        };
        let projection = block.projection;
        let mut lines = self.lines();
        let fits = self.holes.iter().filter(|hole| hole.screw.is_none());
        let fits = fits.map(|hole| &*hole.fit);
        let contour = match self.exactness {
            Some(Exactness::Profile) => "the contour",
            Some(Exactness::Teeth(_)) => "the flanks",
            Some(Exactness::Rim) | None => "",
        };
        let classes = self.classes.iter().map(|class| &**class);
        lines.extend(block.fitted(fits.chain(classes), contour));
        let pieces = |scale: Scale, size: SheetSize| {
            vec![
                SheetBlock::notes(&lines),
                SheetBlock::view("face and edge", plain.views(scale, size, projection)),
            ]
        };
        let bounds = plain.outline.bounds();
        let extent = (bounds.max - bounds.min).amax();
        let mut tables = self.tables.clone();
        tables.extend(self.hole_table());
        tables.extend(self.contour_table());
        compose(
            options.size.or(spec.sheet),
            &block,
            extent,
            &pieces,
            &tables,
        )
    }

    fn lines(&self) -> Vec<String> {
        let name = &self.name;
        let mut lines = vec![format!("{} for each machine.", self.quantity)];
        lines.push(match self.is_stated() {
            true => format!("Cutting file: {name}.dxf."),
            false => format!("Contour: {name}.dxf."),
        });
        lines.push(match self.shows_axes() {
            true => {
                "Positions x, y from the crossing of the long centre lines, x to the right.".into()
            }
            false => "Positions x, y from an origin next to the part, x to the right.".into(),
        });
        let frames = self.frames();
        if frames
            .iter()
            .flatten()
            .any(|frame| frame.characteristic == Characteristic::Position)
        {
            lines.push("Positions of holes with a position tolerance are exact (TED).".into());
        }
        lines.extend(self.notes.iter().cloned());
        lines.extend(self.heat_treatment.as_deref().map(treatment_note));
        lines
    }

    /// Whether the axes of all positions cross on the part.
    fn shows_axes(&self) -> bool {
        let Bounds { min, max } = self.outline.bounds();
        min.x < 0.0 && max.x > 0.0 && min.y < 0.0 && max.y > 0.0
    }

    /// Face, and edge seen from the left.
    fn views(&self, scale: Scale, size: SheetSize, projection: Projection) -> Draft {
        let k = scale.factor();
        let mut draft = Draft::lettered(view_letters(size)).at_scale(k);
        draft.draw(Pen::Outline, EntityShape::Contour(self.outline.scaled(k)));
        for hole in &self.holes {
            draft.draw(Pen::Outline, EntityShape::Contour(hole.outline.scaled(k)));
            hole.cross(&mut draft, k);
            hole.thread(&mut draft, k);
        }
        let Bounds { min, max } = self.outline.bounds();
        let (low, high) = (min * k, max * k);
        let p = Point::new;
        if self.shows_axes() {
            draft.line(Pen::Axis, p(low.x - 3.0, 0.0), p(high.x + 3.0, 0.0));
            draft.line(Pen::Axis, p(0.0, low.y - 3.0), p(0.0, high.y + 3.0));
        }
        // The width is below everything, and left of the notes. A round plate has its diameter at the view of its edge.
        if self.round().is_none() && self.blank().is_none() {
            draft.dimension(
                [p(low.x, low.y), p(high.x, low.y)],
                Vector::x(),
                p(low.x, low.y - 12.0),
                &number(max.x - min.x, PLACES),
            );
        }
        let around = Bounds {
            min: low - Vector::repeat(4.0),
            max: high + Vector::repeat(4.0),
        };
        if self.holes.len() > CALLED_OUT {
            self.letter(&mut draft, k);
        } else {
            draft.call_out(around, [f64::NEG_INFINITY; 2], &self.callouts(k));
        }
        for mark in &self.marks {
            let center = *mark * k;
            draft.draw(
                Pen::Outline,
                EntityShape::Circle {
                    center,
                    radius: MARK,
                },
            );
        }
        if let Some((frame, words)) = self.contour_frame() {
            let corners = self.outline.segments().iter().map(|side| side.start());
            // A circle has no corner at its top.
            let top = self
                .outline
                .as_circle()
                .map(|(at, radius)| at + Vector::new(0.0, radius));
            let highest = corners.max_by(|a, b| steady(a.y).total_cmp(&steady(b.y)));
            if let Some(top) = top.or(highest) {
                let at = top * k + Vector::new(5.0, 9.0);
                draft.pointed_frame(top * k, at, &frame, words);
            }
        }
        self.edge(&mut draft, k, projection);
        self.front(&mut draft, k, projection);
        draft
    }

    /// Label of a hole: its own, or a letter or number if there are many holes.
    pub(super) fn label(&self, index: usize) -> String {
        let own = &self.holes[index].label;
        if !own.is_empty() || self.holes.len() <= CALLED_OUT {
            return own.clone();
        }
        let named = self.holes.iter().any(|hole| !hole.label.is_empty());
        match u8::try_from(index) {
            Ok(index @ 0..26) if !named => char::from(b'A' + index).to_string(),
            _ => (index + 1).to_string(),
        }
    }

    /// Writes the label of every hole next to it.
    fn letter(&self, draft: &mut Draft, k: f64) {
        for (index, hole) in self.holes.iter().enumerate() {
            let (at, reach) = match hole.kind() {
                HoleKind::Round(at, radius) | HoleKind::Slot([at, _], radius) => (at, radius),
                HoleKind::Free => continue,
            };
            let (letters, label) = (draft.lettering(), self.label(index));
            let size = Vector::new(lettering::width(&label, letters), letters);
            let beside = 0.72 * reach * k + 0.8;
            // Above and to the right of the hole, or the nearest position where the label touches nothing.
            let corner = |([x, y], farther): ([f64; 2], f64)| {
                let middle = Vector::repeat(beside + farther) + 0.5 * size;
                at * k + Vector::new(x * middle.x, y * middle.y) - 0.5 * size
            };
            let ways = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
            let places = FARTHER.into_iter().flat_map(|mm| ways.map(|way| (way, mm)));
            let free = places.map(corner).find(|low| {
                let air = Vector::repeat(0.5);
                let (min, max) = (low - air, low + size + air);
                !draft.touches(Bounds { min, max })
            });
            let at = free.unwrap_or(corner((ways[0], 0.0)));
            draft.text(at, letters, &label, Anchor::Left);
        }
    }

    /// Notes of the holes with their size and position.
    fn callouts(&self, k: f64) -> Vec<(Point, Vec<NoteLine>)> {
        let frames = self.frames();
        let holes = self.holes.iter().enumerate();
        let Bounds { min, max } = self.outline.bounds();
        let middle = 0.5 * (min.x + max.x);
        let note = |(index, hole): (usize, &Hole)| {
            let ([one, other], radius) = match hole.kind() {
                HoleKind::Round(center, radius) => ([center; 2], radius),
                HoleKind::Slot(ends, radius) => (ends, radius),
                HoleKind::Free => {
                    let Bounds { min, max } = hole.outline.bounds();
                    ([min + 0.5 * (max - min); 2], 0.5 * (max - min).amin())
                }
            };
            // Towards the column of words that contains the note.
            let outwards = if 0.5 * (one.x + other.x) < middle {
                -1.0
            } else {
                1.0
            };
            let way = Vector::new(outwards * 0.8, 0.6);
            // The round end of a slot that is farthest in that direction.
            let center = if (one - other).dot(&way) > 0.0 {
                one
            } else {
                other
            };
            let side = way * radius;
            let lines = [hole.size()].into_iter().chain(hole.place());
            let lines = lines.chain(hole.notes.iter().cloned());
            let mut words: Vec<String> = lines.filter(|line| !line.is_empty()).collect();
            let label = self.label(index);
            if let Some(first) = words.first_mut().filter(|_| !label.is_empty()) {
                *first = format!("{label}: {first}");
            }
            let frames = frames[index].iter().cloned().map(NoteLine::from);
            let words = words.into_iter().map(NoteLine::from);
            let lines: Vec<NoteLine> = words.chain(frames).collect();
            (!lines.is_empty()).then_some(((center + side) * k, lines))
        };
        holes.filter_map(note).collect()
    }

    /// Table of the holes with size and position, if there are many.
    fn hole_table(&self) -> Option<Table> {
        if self.holes.len() <= CALLED_OUT {
            return None;
        }
        let frames = self.frames();
        let holes = self.holes.iter().enumerate();
        let row = |(index, hole): (usize, &Hole)| {
            let mut cells = vec![self.label(index), hole.size()];
            let lines = hole.place().into_iter().chain(hole.notes.iter().cloned());
            let words = lines.chain(frames[index].iter().map(ToString::to_string));
            cells.push(words.collect::<Vec<_>>().join(", "));
            cells
        };
        let named = holes.filter(|(_, hole)| !hole.is_by_contour());
        Some(Table {
            title: "Holes".into(),
            headings: ["", "size", "place"].map(String::from).to_vec(),
            columns: vec![Anchor::Left; 3],
            rows: named.map(row).collect(),
            notes: Vec::new(),
        })
    }

    /// Contours that a sheet shows by their corners: the outline, and holes that are neither round nor slots.
    fn stated(&self) -> impl Iterator<Item = &Outline> {
        let holes = self.holes.iter().filter(|hole| hole.is_by_contour());
        std::iter::once(&self.outline).chain(holes.map(|hole| &hole.outline))
    }

    /// Whether the sheet shows all of the contour.
    fn is_stated(&self) -> bool {
        self.outline.segments().len() <= SIDES
            && self.stated().all(|contour| {
                let mut sides = contour.segments().iter();
                !sides.any(|side| matches!(side, Segment::Poly(_)))
            })
    }

    /// Table of the contour's corners and roundings; `None` if the sheet does not show all of the contour.
    fn contour_table(&self) -> Option<Table> {
        if !self.is_stated() {
            return None;
        }
        let mut rows = Vec::new();
        let alone = self.stated().count() == 1;
        for (index, contour) in self.stated().enumerate() {
            for segment in contour.segments() {
                let start = segment.start();
                let [round, about] = match segment {
                    Segment::Arc(arc) => [
                        rounding(arc, contour.is_counter_clockwise()),
                        written(arc.center()),
                    ],
                    _ => ["line".into(), String::new()],
                };
                let name = match (index, alone) {
                    (_, true) => "",
                    (0, false) => "outside",
                    _ => "opening",
                };
                let [x, y] = [start.x, start.y].map(|x| fixed(x, PLACES));
                rows.push(vec![name.to_owned(), x, y, round, about]);
            }
        }
        let table = Table {
            title: "Contour".into(),
            headings: ["", "x", "y", "radius to the next", "about"]
                .map(String::from)
                .to_vec(),
            columns: vec![
                Anchor::Left,
                Anchor::Right,
                Anchor::Right,
                Anchor::Right,
                Anchor::Left,
            ],
            rows,
            notes: Vec::new(),
        };
        Some(table.filled())
    }
}

/// Radius of an arc of a contour in words; "concave" if the arc bends into the contour.
fn rounding(arc: &Arc, counter_clockwise: bool) -> String {
    let bulges = (arc.bulge > 0.0) == counter_clockwise;
    let [concave, long] = [
        (!bulges, ", concave"),
        (arc.bulge.abs() > 1.0 + COMPUTED, ", over 180°"),
    ]
    .map(|(is, words)| if is { words } else { "" });
    format!("{}{concave}{long}", number(arc.radius(), PLACES))
}

/// Coordinates of a point, mm, with one decimal more than lengths.
fn written(at: Point) -> String {
    let [x, y] = [at.x, at.y].map(|x| number(x, PLACES + 1));
    format!("{x}, {y}")
}

impl Hole {
    /// Centre lines.
    fn cross(&self, draft: &mut Draft, k: f64) {
        let (centers, radius) = match self.kind() {
            HoleKind::Round(center, radius) => (vec![center], radius),
            HoleKind::Slot(ends, radius) => (ends.to_vec(), radius),
            HoleKind::Free => return,
        };
        let arm = radius * k + 2.0;
        for center in centers {
            let at = center * k;
            let (x, y) = (Vector::new(arm, 0.0), Vector::new(0.0, arm));
            draft.line(Pen::Axis, at - x, at + x);
            draft.line(Pen::Axis, at - y, at + y);
        }
    }

    /// Three quarters of a thin circle of the thread's diameter, ISO 6410-1.
    fn thread(&self, draft: &mut Draft, k: f64) {
        if let (Some(ScrewHole::Thread(screw, _)), HoleKind::Round(at, _)) =
            (self.screw, self.kind())
        {
            let (middle, radius) = (at * k, 0.5 * screw.diameter * k);
            let arc = Arc {
                start: middle + Vector::new(0.0, radius),
                end: middle + Vector::new(radius, 0.0),
                bulge: (0.375 * std::f64::consts::PI).tan(),
            };
            draft.draw(Pen::Thin, EntityShape::Arc(arc));
        }
    }

    /// Position in the plate's axes, in words.
    fn place(&self) -> Vec<String> {
        match self.kind() {
            HoleKind::Round(center, _) => vec![format!("at {}", written(center))],
            HoleKind::Slot([from, to], radius) => vec![format!(
                "R{} about {} and {}",
                number(radius, PLACES + 1),
                written(from),
                written(to)
            )],
            HoleKind::Free => Vec::new(),
        }
    }
}
