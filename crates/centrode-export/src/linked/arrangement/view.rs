use centrode_formats::drawing::{Anchor, EntityShape};
use centrode_formats::sheet::{
    Draft, Pen, Scale, dimension_words, lettering, steady, view_letters,
};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_kinematics::machine::{Axis as Along, Place};
use centrode_spec::SheetSize;

use super::axes::Axis;
use super::measure::Measured;
use super::scene::{Drawn, Scene};

/// Room between the view and its first dimension line, mm, and from one line to the next.
const FIRST: f64 = 12.0;
const NEXT: f64 = 9.0;
/// Half the length of the lines of a centre mark, mm.
const CROSS: f64 = 3.0;
/// Mean length of a contour's segments on paper below which its lines are thin, mm.
const FINE: f64 = 1.0;
/// Number of directions in which room for words is searched, and the distances tried, mm.
const DIRECTIONS: u32 = 16;
const ROOM: [f64; 6] = [1.2, 2.5, 4.0, 6.0, 8.5, 12.0];
/// Minimum advance over a period at which a shaft counts as rotating, rad.
const ROUND: f64 = 0.1;
/// Angle of an arrow of rotation, rad, and the room it needs on either side, mm.
const ARROW: f64 = 1.2;
const BESIDE: f64 = 0.9;
/// Radii of such an arrow in the order tried, mm.
const RADII: [f64; 10] = [14.0, 11.0, 17.0, 20.0, 8.0, 24.0, 28.0, 6.0, 33.0, 40.0];
/// Height of the lowest words above a view, mm, and the sideways reach of their leaders: the minimum (mm), the step (mm) and the
/// number of tries for a leader that runs through no words.
const ABOVE: f64 = 12.0;
const LEAN: f64 = 6.0;
const MORE: f64 = 1.5;
const LEANS: u32 = 24;
/// Distance on a sheet below which two points count as one, mm.
const ONE_PLACE: f64 = 0.1;
/// Maximum number of dimensions for which all orders are tried.
const ORDERED: usize = 6;

/// Lines of words and the point they are about.
type Note = (Point, Vec<String>);

/// The machine as drafted at any scale.
pub(super) struct View<'a> {
    pub(super) scene: Scene<'a>,
    pub(super) axes: Vec<Axis>,
    pub(super) dimensions: Vec<Measured>,
    /// Item numbers of the parts list with their positions.
    pub(super) balloons: Vec<(Place, String)>,
}

impl View<'_> {
    pub(super) fn draft(&self, scale: Scale, size: SheetSize) -> Draft {
        let k = scale.factor();
        let letters = view_letters(size);
        let mut draft = Draft::lettered(letters).at_scale(k);
        for (pen, line) in &self.scene.lines {
            match line {
                Drawn::Closed(outline, mean) => {
                    let fine = *pen == Pen::Outline && mean * k < FINE;
                    let pen = if fine { Pen::Thin } else { *pen };
                    draft.draw(pen, EntityShape::Contour(outline.scaled(k)));
                }
                Drawn::Open(points) => {
                    let points = points.iter().map(|p| p * k).collect();
                    draft.draw(*pen, EntityShape::Polyline(points));
                }
            }
        }
        let whole = Bounds {
            min: self.scene.whole.min * k,
            max: self.scene.whole.max * k,
        };
        let mut centers: Vec<Point> = Vec::new();
        let axes = self.axes.iter().map(|axis| axis.at);
        for at in axes.chain(self.scene.centers()) {
            let at = at * k;
            if centers.iter().all(|known| (at - known).norm() > 1e-6) {
                centers.push(at);
                for way in [Vector::x(), Vector::y()] {
                    draft.line(Pen::Axis, at - way * CROSS, at + way * CROSS);
                }
            }
        }
        self.measure(&mut draft, k, whole);
        let stated = self.scene.machine.arrangement.callouts.iter();
        let stated: Vec<Note> = stated
            .map(|note| (self.scene.at(&note.place) * k, note.words.clone()))
            .collect();
        let balloons = self.balloons.iter();
        let balloons: Vec<Note> = balloons
            .map(|(place, items)| (self.scene.at(place) * k, vec![items.clone()]))
            .collect();
        let (above, beside): (Vec<Note>, Vec<Note>) =
            stated.into_iter().partition(|(at, _)| is_upper(*at, whole));
        note_above(&mut draft, above);
        self.turn(&mut draft, k, whole);
        note_next_to(&mut draft, &[beside, balloons].concat());
        // Names have more room to choose from than leaders: they come last.
        let left = self.name(&mut draft, k);
        note_next_to(&mut draft, &left);
        draft
    }

    /// Draws the dimensions below and on the right.
    fn measure(&self, draft: &mut Draft, k: f64, whole: Bounds) {
        for along in [Along::X, Along::Y] {
            let own = self.dimensions.iter().filter(|d| d.along == along);
            let rows = ordered(own.collect(), k, draft.lettering());
            for (row, dimension) in rows.iter().enumerate() {
                let far = FIRST + NEXT * row as f64;
                let at = match along {
                    Along::X => Point::new(0.0, whole.min.y - far),
                    Along::Y => Point::new(whole.max.x + far, 0.0),
                };
                let ends = dimension.ends.map(|end| end * k);
                let along = dimension.direction();
                let lines = rows[row + 1..].iter().flat_map(|later| later.ends);
                let lines: Vec<f64> = lines.map(|end| end.coords.dot(&along) * k).collect();
                draft.dimension_clear_of(ends, along, at, &dimension.words(), &lines);
            }
        }
    }

    /// Names marks and fixed shafts where there is room; returns the names without room.
    fn name(&self, draft: &mut Draft, k: f64) -> Vec<Note> {
        let machine = self.scene.machine;
        let marks = machine.marks.iter().map(|mark| {
            let place = Place {
                figure: mark.figure,
                at: mark.at,
            };
            (self.scene.at(&place), mark.name.clone())
        });
        let shafts = self
            .axes
            .iter()
            .filter(|axis| axis.stands() && !axis.marked);
        let shafts = shafts.map(|axis| (axis.at, axis.name.clone()));
        let mut left = Vec::new();
        let mut named: Vec<(Point, String)> = Vec::new();
        for (at, name) in marks.chain(shafts) {
            // Coincident points of two bodies with the same name are named once.
            let is_known = |(known, word): &(Point, String)| {
                *word == name && ((known - at) * k).norm() < ONE_PLACE
            };
            if named.iter().any(is_known) {
                continue;
            }
            named.push((at, name.clone()));
            if !label(draft, at * k, &name) {
                left.push((at * k, vec![name]));
            }
        }
        left
    }

    /// Draws the sense of rotation of the fixed shafts that rotate, where there is room for the arrow.
    fn turn(&self, draft: &mut Draft, k: f64, whole: Bounds) {
        let machine = self.scene.machine;
        for axis in self.axes.iter().filter(|axis| axis.stands()) {
            let Some(joint) = axis.joint.map(|joint| &machine.joints[joint]) else {
                continue;
            };
            let upwards =
                (self.scene.places[joint.child].rotation * nalgebra::Vector3::from(joint.axis)).z;
            let turned = joint.law.advance() * upwards;
            if turned.abs() < ROUND {
                continue;
            }
            let center = axis.at * k;
            let sweep = ARROW * turned.signum();
            let free = |radius: f64, from: f64| {
                // Squares along the arrow, without gaps between them.
                let count = (radius * ARROW / BESIDE).ceil() as u32;
                let square = |i: u32| {
                    let angle = from + sweep * f64::from(i) / f64::from(count);
                    let at = center + Vector::new(angle.cos(), angle.sin()) * radius;
                    let half = Vector::repeat(BESIDE);
                    Bounds {
                        min: at - half,
                        max: at + half,
                    }
                };
                (0..=count).all(|i| whole.meets(&square(i)) && !draft.touches(square(i)))
            };
            let starts = |i: u32| {
                std::f64::consts::FRAC_PI_2 - 0.5 * sweep
                    + f64::from(i) * std::f64::consts::FRAC_PI_4
            };
            let mut places = RADII
                .into_iter()
                .flat_map(|radius| (0..8).map(move |i| (radius, starts(i))));
            if let Some((radius, from)) = places.find(|(radius, from)| free(*radius, *from)) {
                draft.turning_arrow(center, radius, from, from + sweep);
            }
        }
    }
}

/// Whether the upper edge of a view is nearer to a point than its sides.
fn is_upper(at: Point, Bounds { min, max }: Bounds) -> bool {
    steady(max.y - at.y) < steady((at.x - min.x).min(max.x - at.x))
}

/// Writes notes above a view. Leaders of the left half lean to the left, those of the right half to the right; notes nearer to
/// the middle are higher.
fn note_above(draft: &mut Draft, mut notes: Vec<Note>) {
    notes.sort_by(|(a, _), (b, _)| steady(a.x).total_cmp(&steady(b.x)));
    let right = notes.split_off(notes.len() / 2);
    let row = draft.lettering() + 2.0;
    let lowest = draft.bounds().max.y + ABOVE;
    for (side, notes) in [(-1.0, notes), (1.0, right.into_iter().rev().collect())] {
        let mut height = lowest;
        for (tip, words) in notes {
            let elbow = |i: u32| Point::new(tip.x + side * (LEAN + MORE * f64::from(i)), height);
            let mut elbows = (0..LEANS).map(elbow);
            let free = elbows.find(|elbow| !draft.strikes([tip, *elbow]));
            draft.leader(tip, free.unwrap_or(elbow(0)), &words);
            height += row * (words.len() as f64 + 1.0);
        }
    }
}

/// Writes notes left and right of all that is drawn.
fn note_next_to(draft: &mut Draft, notes: &[Note]) {
    draft.callouts(draft.bounds(), [f64::NEG_INFINITY; 2], notes);
}

/// Writes words next to a point where they touch nothing; returns whether there is room.
fn label(draft: &mut Draft, at: Point, words: &str) -> bool {
    let letters = draft.lettering();
    let width = lettering::width(words, letters);
    // Some letters hang below the line.
    let below = lettering::ink(words, letters).min.y.min(0.0);
    for room in ROOM {
        for i in 0..DIRECTIONS {
            let angle = (f64::from(i) + 1.0) * std::f64::consts::TAU / f64::from(DIRECTIONS);
            let (sin, cos) = angle.sin_cos();
            // The nearest corner or side of the words lies in this direction.
            let left = at.x + room * cos - 0.5 * width * (1.0 - cos.signum() * cos.abs().sqrt());
            let low = at.y + room * sin - 0.5 * letters * (1.0 - sin.signum() * sin.abs().sqrt());
            let corner = Point::new(left, low);
            let around = Bounds {
                min: corner + Vector::new(-0.5, below - 0.5),
                max: corner + Vector::new(width + 0.5, letters + 0.5),
            };
            if !draft.touches(around) {
                draft.text(corner, letters, words, Anchor::Left);
                return true;
            }
        }
    }
    false
}

/// Dimensions from the nearest line outwards: ordered by length, or in the first order in which the fewest extension lines run
/// through words.
fn ordered(mut all: Vec<&Measured>, k: f64, letters: f64) -> Vec<&Measured> {
    all.sort_by(|a, b| a.length().total_cmp(&b.length()));
    let crossings = |order: &[&Measured]| {
        let run = |i: usize| {
            let along = order[i].direction();
            order[i].ends.map(|end| end.coords.dot(&along) * k)
        };
        let through = |i: usize| {
            let [low, high] = dimension_words(run(i), &order[i].words(), letters);
            let later = (i + 1..order.len()).flat_map(run);
            later.filter(|at| low < *at && *at < high).count()
        };
        (0..order.len()).map(through).sum::<usize>()
    };
    if all.len() > ORDERED || crossings(&all) == 0 {
        return all;
    }
    let mut best = (crossings(&all), all.clone());
    permute(&mut all, 0, &mut |order| {
        let found = crossings(order);
        if found < best.0 {
            best = (found, order.to_vec());
        }
    });
    best.1
}

/// Calls a function with every order of some items.
fn permute<T>(items: &mut [T], fixed: usize, call: &mut impl FnMut(&[T])) {
    if fixed == items.len() {
        return call(items);
    }
    for i in fixed..items.len() {
        items.swap(fixed, i);
        permute(items, fixed + 1, call);
        items.swap(fixed, i);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leaves_lines_below_its_hanging_letters_free() {
        let mut draft = Draft::lettered(3.5);
        let below = |y: f64| [Point::new(-30.0, y), Point::new(30.0, y)];
        // Between two lines there is room for a name on its line, not for letters that hang below it.
        for [from, to] in [below(-3.0), below(2.0)] {
            draft.line(Pen::Outline, from, to);
        }
        assert!(label(&mut draft, Point::new(0.0, -0.5), "pin"));
        let entities = draft.into_entities();
        let placed = entities.iter().find_map(|entity| match &entity.shape {
            EntityShape::Text(text) => Some(text.at.y),
            _ => None,
        });
        let y = placed.expect("a name");
        let ink = lettering::ink("pin", 3.5);
        for line in [-3.0, 2.0] {
            assert!(!(y + ink.min.y..y + ink.max.y).contains(&line), "{y}");
        }
    }

    #[test]
    fn extension_lines_run_through_no_words_of_dimensions_nearer_to_the_view() {
        let measured = |from: f64, to: f64| Measured {
            ends: [Point::new(from, 0.0), Point::new(to, 0.0)],
            along: Along::X,
        };
        // The longer one ends in the middle of the shorter.
        let [short, long] = [measured(0.0, 60.0), measured(30.0, 200.0)];
        let found = ordered(vec![&short, &long], 1.0, 3.5);
        assert_eq!(found, [&long, &short]);
        let apart = measured(-150.0, 60.0);
        assert_eq!(ordered(vec![&apart, &short], 1.0, 3.5), [&short, &apart]);
    }
}
