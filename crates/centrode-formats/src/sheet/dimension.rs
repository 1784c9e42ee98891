//! Dimensions and notes with leaders, ISO 129-1.

use super::{Draft, Pen, draft::ARROW, geometrical::NoteLine, lettering, steady};
use crate::drawing::{Anchor, Dimension, EntityShape, Object};
use centrode_geometry::{Arc, Bounds, Point, Vector};

/// Distance of words from their line, mm.
const LIFT: f64 = 1.3;
/// Length of an extension line beyond the dimension line, mm.
const BEYOND: f64 = 2.0;
/// Step by which a leader is moved to avoid words, mm, and the maximum number of steps.
const CLEARING: f64 = 1.5;
const TRIES: u32 = 40;
/// Gap next to the words of a dimension, mm, and an extra distance that ensures this gap in spite of rounding, mm.
const AIR: f64 = 1.0;
const NUDGE: f64 = 1e-6;
/// Distance of an extension line from its feature, mm.
const CLEAR: f64 = 0.8;

impl Draft {
    /// Draws a dimension between two points, measured along a direction, its line through `at`.
    ///
    /// Words that do not fit between the arrows are put beyond the second point.
    pub fn dimension(&mut self, ends: [Point; 2], along: Vector, at: Point, words: &str) {
        self.dimension_clear_of(ends, along, at, words, &[]);
    }

    /// Draws a dimension whose words avoid lines normal to it; `lines` has their positions along the direction, mm.
    pub fn dimension_clear_of(
        &mut self,
        [a, b]: [Point; 2],
        along: Vector,
        at: Point,
        words: &str,
        lines: &[f64],
    ) {
        let first = self.count();
        let mut along = along.normalize();
        let upwards = along.x.abs() < 1e-9;
        let turned = along.x < -1e-9 || (upwards && along.y < 0.0);
        if turned {
            along = -along;
        }
        let up = Vector::new(-along.y, along.x);
        let foot = |p: Point| at + along * (p - at).dot(&along);
        for p in [a, b] {
            let away = foot(p) - p;
            if away.norm() > CLEAR {
                let out = away.normalize();
                self.line(Pen::Dimension, p + out * CLEAR, foot(p) + out * BEYOND);
            }
        }
        let (start, end) = if (b - a).dot(&along) >= 0.0 {
            (foot(a), foot(b))
        } else {
            (foot(b), foot(a))
        };
        let length = (end - start).norm();
        let width = lettering::width(words, self.letters);
        let rotation = along.y.atan2(along.x);
        let (inside, between, usual) = fitting(length, width);
        let origin = start.coords.dot(&along);
        let sign = if turned { -1.0 } else { 1.0 };
        let lines: Vec<f64> = lines.iter().map(|line| sign * line - origin).collect();
        let middle = clear_middle(length, width, between, usual, &lines);
        let (from, to) = if inside {
            (start, end)
        } else {
            (start - along * (ARROW + 3.0), end + along * (ARROW + 3.0))
        };
        let to = if between {
            to
        } else {
            end + along * (ARROW + 2.0 + width + (middle - usual))
        };
        self.line(Pen::Dimension, from, to);
        let sense = if inside { along } else { -along };
        self.arrow(start, -sense);
        self.arrow(end, sense);
        let at = start + along * middle + up * LIFT;
        self.turned_text(at, self.letters, words, Anchor::Middle, rotation);
        let dimension = Dimension {
            ends: [a, b],
            along,
            line: end,
            middle: at + up * (0.5 * self.letters),
            words: words.to_owned(),
            letters: self.letters,
            scale: self.scale,
        };
        self.gather(first, Pen::Dimension, Object::Dimension(dimension));
    }

    /// Whether the arrows of a dimension of this length (mm) fit between its ends, and its words between the arrows.
    pub fn holds(&self, length: f64, words: &str) -> bool {
        let (inside, between, _) = fitting(length, lettering::width(words, self.letters));
        inside && between
    }

    /// Draws a note with an arrow: a line from `tip` to `elbow`, then level under the words; further lines of words are below.
    pub fn leader(&mut self, tip: Point, elbow: Point, words: &[String]) {
        let lines: Vec<NoteLine> = words.iter().cloned().map(NoteLine::from).collect();
        self.note(tip, elbow, &lines);
    }

    /// Draws a note with an arrow; some of its lines may be tolerance frames.
    pub fn note(&mut self, tip: Point, elbow: Point, words: &[NoteLine]) {
        self.arrow(tip, tip - elbow);
        self.line(Pen::Dimension, tip, elbow);
        let width = words
            .iter()
            .map(|line| line.width(self.letters))
            .fold(0.0, f64::max);
        let side = if elbow.x >= tip.x { 1.0 } else { -1.0 };
        let end = elbow + Vector::new(side * (width + 2.0), 0.0);
        self.line(Pen::Dimension, elbow, end);
        let left = elbow.x.min(end.x) + 1.0;
        for (row, line) in words.iter().enumerate() {
            let y = if row == 0 {
                LIFT
            } else {
                -(self.letters + LIFT + 0.2) - (self.letters + 2.0) * (row as f64 - 1.0)
            };
            let at = Point::new(left, elbow.y + y);
            self.line_of_note(at, line);
        }
    }

    /// Draws notes in two columns left and right of a view, each with a leader to its point, in the order of the points so that
    /// leaders do not cross. The `band` of heights stays free, and leaders avoid existing words.
    pub fn callouts(&mut self, around: Bounds, band: [f64; 2], notes: &[(Point, Vec<String>)]) {
        let lines = |(tip, words): &(Point, Vec<String>)| {
            let lines = words.iter().cloned().map(NoteLine::from);
            (*tip, lines.collect())
        };
        self.call_out(around, band, &notes.iter().map(lines).collect::<Vec<_>>());
    }

    /// Draws notes left and right of a view; some of their lines may be tolerance frames.
    pub fn call_out(&mut self, around: Bounds, band: [f64; 2], notes: &[(Point, Vec<NoteLine>)]) {
        let middle = steady(0.5 * (around.min.x + around.max.x));
        for right in [false, true] {
            let mut column: Vec<&(Point, Vec<NoteLine>)> = notes
                .iter()
                .filter(|(p, _)| (steady(p.x) >= middle) == right)
                .collect();
            column.sort_by(|a, b| steady(a.0.y).total_cmp(&steady(b.0.y)));
            let x = if right {
                around.max.x + 4.0
            } else {
                around.min.x - 4.0
            };
            let halfway = steady(0.5 * (band[0] + band[1]));
            let upper = column.partition_point(|(p, _)| steady(p.y) < halfway);
            // Upwards from the band, then downwards from it.
            let mut floor = band[1];
            for (tip, words) in &column[upper..] {
                let lowest = floor + below(words, self.letters);
                let y = tip.y.max(lowest);
                let y = self.clear(*tip, Point::new(x, y), |y| y >= lowest);
                self.note(*tip, Point::new(x, y), words);
                floor = y + above(self.letters);
            }
            let mut ceiling = band[0];
            for (tip, words) in column[..upper].iter().rev() {
                let highest = ceiling - above(self.letters);
                let y = tip.y.min(highest);
                let y = self.clear(*tip, Point::new(x, y), |y| y <= highest);
                self.note(*tip, Point::new(x, y), words);
                ceiling = y - below(words, self.letters);
            }
        }
    }

    /// The allowed height of an elbow, nearest to its own by steps, at which the leader runs through no words; its own height if
    /// there is none.
    fn clear(&self, tip: Point, elbow: Point, allowed: impl Fn(f64) -> bool) -> f64 {
        let steps = (0..TRIES).map(|i| CLEARING * f64::from(i));
        let mut heights = steps.flat_map(|step| [elbow.y + step, elbow.y - step]);
        let free = |y: &f64| allowed(*y) && !self.strikes([tip, Point::new(elbow.x, *y)]);
        heights.find(free).unwrap_or(elbow.y)
    }

    /// Draws an arc about a centre with an arrow at its end, angles in rad.
    pub fn turning_arrow(&mut self, center: Point, radius: f64, from: f64, to: f64) {
        let at = |angle: f64| center + Vector::new(angle.cos(), angle.sin()) * radius;
        let arc = Arc {
            start: at(from),
            end: at(to),
            bulge: (0.25 * (to - from)).tan(),
        };
        self.draw(Pen::Dimension, EntityShape::Arc(arc));
        let sense = (to - from).signum();
        // The head is a chord: it points a little inwards.
        let lean = to - sense * 0.5 * ARROW / radius;
        let direction = Vector::new(-lean.sin(), lean.cos()) * sense;
        self.arrow(at(to), direction);
    }
}

/// Whether arrows fit inside a dimension, whether its words fit between them, and the distance from its start to the middle of
/// the words, mm.
fn fitting(length: f64, width: f64) -> (bool, bool, f64) {
    let inside = length >= 2.5 * ARROW;
    let between = inside && width + 1.0 <= length;
    let middle = if between {
        0.5 * length
    } else {
        length + ARROW + 1.5 + 0.5 * width
    };
    (inside, between, middle)
}

/// Middle of the words of a dimension, mm from its start: the position nearest to the usual one at which the words touch no line,
/// or the usual one if there is none. Words between the arrows stay between them, others move outwards.
fn clear_middle(length: f64, width: f64, between: bool, usual: f64, lines: &[f64]) -> f64 {
    let half = 0.5 * width + AIR;
    let free = |middle: &f64| lines.iter().all(|line| (line - middle).abs() > half);
    let allowed = |middle: &f64| {
        let [low, high] = match between {
            true => [half, length - half],
            false => [usual, f64::INFINITY],
        };
        (low..=high).contains(middle)
    };
    // Just next to one of the lines.
    let beside = lines.iter().flat_map(|line| [line - half, line + half]);
    let beside = beside.flat_map(|middle| [middle - NUDGE, middle + NUDGE]);
    let mut middles: Vec<f64> = beside.filter(allowed).collect();
    middles.push(usual);
    middles.retain(free);
    let away = |middle: &f64| steady((middle - usual).abs());
    middles.sort_by(|a, b| away(a).total_cmp(&away(b)).then(b.total_cmp(a)));
    middles.first().copied().unwrap_or(usual)
}

/// Range of the dimension line that its words take, with gaps, mm.
pub fn dimension_words([a, b]: [f64; 2], words: &str, letters: f64) -> [f64; 2] {
    let width = lettering::width(words, letters);
    let (_, _, middle) = fitting((b - a).abs(), width);
    let middle = a.min(b) + middle;
    [-1.0, 1.0].map(|side| middle + side * (0.5 * width + AIR))
}

/// Room above the line of a note, mm.
fn above(letters: f64) -> f64 {
    letters + LIFT + 1.2
}

/// Room below the line of a note, mm.
fn below(words: &[NoteLine], letters: f64) -> f64 {
    1.0 + (letters + 2.0) * (words.len() as f64 - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Entity, EntityShape};

    #[test]
    fn words_of_a_dimension_leave_the_lines_of_others_free() {
        let ends = [Point::new(10.0, 0.0), Point::new(110.0, 0.0)];
        let middle = |ends: [Point; 2], along: Vector, lines: &[f64]| {
            let mut draft = Draft::default();
            draft.dimension_clear_of(ends, along, Point::new(0.0, -20.0), "100", lines);
            let drawn = draft.into_entities();
            let mut plain = drawn.iter().flat_map(Entity::plain);
            let found = plain.find_map(|e| match &e.shape {
                EntityShape::Text(text) => Some(text.at.x),
                _ => None,
            });
            found.expect("words")
        };
        let half = 0.5 * lettering::width("100", 3.5) + AIR;
        let x = Vector::x();
        assert!((middle(ends, x, &[]) - 60.0).abs() < 1e-9);
        assert!((middle(ends, x, &[40.0, 90.0]) - 60.0).abs() < 1e-9);
        assert!((middle(ends, x, &[59.0]) - 59.0 - half).abs() < 1e-5);
        assert!((middle(ends, x, &[61.0]) - 61.0 + half).abs() < 1e-5);
        // Both nearest gaps are too narrow.
        let found = middle(ends, x, &[58.0, 62.0, 62.0 + 1.5 * half]);
        assert!((found - 58.0 + half).abs() < 1e-5, "{found}");
        assert!((middle(ends, -x, &[-61.0]) - 61.0 + half).abs() < 1e-5);
        // Words next to their arrows move outwards.
        let short = [Point::new(0.0, 0.0), Point::new(2.0, 0.0)];
        let line = middle(short, x, &[]);
        assert!((middle(short, x, &[line]) - line - half).abs() < 1e-5);
    }

    #[test]
    fn notes_keep_their_order_their_distance_and_the_free_band() {
        let around = Bounds {
            min: Point::new(-20.0, -30.0),
            max: Point::new(20.0, 30.0),
        };
        let heights = [-2.0, -1.0, 0.5, 1.0, 1.5];
        let notes = heights.map(|y| (Point::new(15.0, y), vec![format!("{y}"), "of two".into()]));
        let mut draft = Draft::default();
        draft.callouts(around, [-5.0, 5.0], &notes);
        let mut found: Vec<(f64, String)> = Vec::new();
        for entity in draft.into_entities() {
            if let EntityShape::Text(text) = entity.shape
                && text.words != "of two"
            {
                found.push((text.at.y, text.words));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let order: Vec<&str> = found.iter().map(|f| &*f.1).collect();
        assert_eq!(order, ["-2", "-1", "0.5", "1", "1.5"]);
        assert!(found.windows(2).all(|w| w[1].0 - w[0].0 > 7.0));
        assert!(found.iter().all(|f| f.0 > 5.0 || f.0 + 3.5 < -5.0));
    }
}
