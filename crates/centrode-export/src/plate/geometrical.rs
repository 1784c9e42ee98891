//! Datums of a plate and the geometrical tolerances that refer to them.

use centrode_formats::sheet::geometrical::Frame;
use centrode_geometry::Point;

use super::{Exactness, Hole, Plate};
use crate::grade;

impl Plate {
    /// Tolerance frames of each hole. The first datum is the seat of a shaft, or else the first hole with a class; the second is
    /// the hole with a class that lies farthest from it. All other holes and slots with a class have a position tolerance to
    /// both; a keyway has a symmetry tolerance to the first. Holes of screws are datums only if no other hole has a class.
    pub(super) fn frames(&self) -> Vec<Vec<Frame>> {
        let mut frames = vec![Vec::new(); self.holes.len()];
        let Some((first, origin)) = self.first_datum() else {
            return frames;
        };
        let [one, two] = self.letters();
        let fitted = self.holes.iter().enumerate().filter_map(|(index, hole)| {
            let at = hole.axis().filter(|_| !hole.fit.is_empty())?;
            Some((index, (at - origin).norm()))
        });
        let others: Vec<(usize, f64)> = fitted.filter(|(index, _)| *index != first).collect();
        // Holes of screws, which have clearance, are datums only of each other.
        let of_screws = self.holes[first].screw.is_some();
        let seats = others.iter();
        let seats = seats.filter(|(index, _)| of_screws || self.holes[*index].screw.is_none());
        let second = seats.max_by(|a, b| a.1.total_cmp(&b.1));
        let second = second.map(|(index, _)| *index);
        for &(index, distance) in &others {
            let datums = match second {
                Some(other) if other != index => format!("{one} {two}"),
                _ => one.to_string(),
            };
            let Hole { off, apart, .. } = self.holes[index];
            let position = grade::position(distance, off, apart, &datums);
            frames[index].extend(position);
        }
        for (index, hole) in self.holes.iter().enumerate() {
            let datums = match second {
                Some(_) => format!("{one} {two}"),
                None => one.to_string(),
            };
            let distance = hole.fitted_slot().map(|at| (at - origin).norm());
            let position = distance.and_then(|mm| grade::position_of_slot(mm, &datums));
            frames[index].extend(position);
        }
        // A datum that no frame refers to is omitted.
        let is_used = (0..frames.len())
            .any(|index| index != first && Some(index) != second && !frames[index].is_empty());
        if let Some(second) = second.filter(|_| is_used) {
            frames[second].push(Frame::datum(two));
        }
        let keyed = self.holes[first].keyed;
        let keyway = grade::symmetry(keyed, &one.to_string());
        let is_used = self.face_runout().is_some()
            || self.contour_frame().is_some()
            || keyway.is_some()
            || (0..frames.len()).any(|index| index != first && !frames[index].is_empty());
        // The datum comes below the frame of the keyway.
        frames[first].extend(keyway);
        if is_used {
            frames[first].push(Frame::datum(one));
        }
        frames
    }

    /// Runout tolerance of the faces of a body seated on a shaft; it depends on the diameter of the circle around the body.
    pub(super) fn face_runout(&self) -> Option<Frame> {
        let (first, origin) = self.first_datum()?;
        if !self.holes[first].is_seat {
            return None;
        }
        let [one, _] = self.letters();
        grade::runout(2.0 * self.reach(origin), &one.to_string())
    }

    /// Tolerance frame of the contour relative to the datum of the bore, and the words after it.
    pub(super) fn contour_frame(&self) -> Option<(Frame, &'static str)> {
        let exactness = self.exactness?;
        let (first, origin) = self.first_datum()?;
        if !self.holes[first].is_seat {
            return None;
        }
        let [one, _] = self.letters().map(String::from);
        match exactness {
            Exactness::Profile => Some((grade::profile(self.reach(origin), &one)?, "")),
            Exactness::Rim => Some((grade::runout(2.0 * self.reach(origin), &one)?, "rim")),
            Exactness::Teeth(width) => {
                Some((grade::runout_within(width, &one), "teeth, over pins"))
            }
        }
    }

    /// Distance of the contour's farthest corner from a point, mm.
    pub(super) fn reach(&self, from: Point) -> f64 {
        let corners = self.outline.segments().iter().map(|side| side.start());
        corners.map(|p| (p - from).norm()).fold(0.0, f64::max)
    }

    pub(super) fn first_datum(&self) -> Option<(usize, Point)> {
        let with_class = |hole: &&Hole| !hole.fit.is_empty() && hole.axis().is_some();
        let seat = self
            .holes
            .iter()
            .position(|hole| hole.is_seat && with_class(&hole));
        let mut holes = self.holes.iter();
        let fitted = || holes.position(|hole| with_class(&hole) && hole.screw.is_none());
        let first = seat.or_else(fitted);
        let first = first.or_else(|| self.holes.iter().position(|hole| with_class(&hole)))?;
        Some((first, self.holes[first].axis()?))
    }

    /// Letters of both datums: not those that name holes.
    fn letters(&self) -> [char; 2] {
        let names: Vec<String> = (0..self.holes.len())
            .map(|index| self.label(index))
            .collect();
        let is_free = |letter: &char| !names.contains(&letter.to_string());
        let named = names.iter().any(|name| name.chars().count() == 1);
        // I and O are read as digits.
        let letters = if named {
            "PQRSTUVWXYZABCDEFGHJKLMN"
        } else {
            "AB"
        };
        let mut free = letters.chars().filter(is_free);
        ['A', 'B'].map(|other| free.next().unwrap_or(other))
    }
}

#[cfg(test)]
mod tests {
    use centrode_gear::design::BodySpec;
    use centrode_geometry::Outline;
    use centrode_kinematics::machine::Keyway;
    use centrode_machines::PinHole;

    use super::*;

    fn hole(label: &str, at: [f64; 2], radius: f64) -> Hole {
        Hole {
            fit: "H8".into(),
            label: label.into(),
            ..Hole::from(Outline::circle(Point::from(at), radius))
        }
    }

    fn plate(holes: Vec<Hole>) -> Plate {
        let corners = [[-20.0, -20.0], [90.0, -20.0], [90.0, 60.0], [-20.0, 60.0]];
        let outline = Outline::polygon(&corners.map(Point::from));
        let body = BodySpec::default();
        Plate {
            holes,
            ..Plate::of_body("plate", "Plate", outline, None, &body)
        }
    }

    fn stated(plate: &Plate) -> Vec<Vec<String>> {
        let frames = plate.frames().into_iter();
        frames
            .map(|all| all.iter().map(ToString::to_string).collect())
            .collect()
    }

    #[test]
    fn datums_have_letters_that_no_hole_has() {
        let at = [[0.0, 0.0], [60.0, 0.0], [30.0, 40.0]];
        let with = |names: [&str; 3]| {
            let holes = names.into_iter().zip(at);
            stated(&plate(
                holes.map(|(name, at)| hole(name, at, 3.0)).collect(),
            ))
        };
        // IT8 of 50 to 80 and 30 to 50 mm.
        let plain = with(["", "", ""]);
        assert_eq!(plain[0], ["datum A"]);
        assert_eq!(plain[1], ["position Ø0.046 A", "datum B"]);
        assert_eq!(plain[2], ["position Ø0.039 A B"]);
        assert_eq!(with(["O", "P", "S"])[2], ["position Ø0.039 Q R"]);
        assert_eq!(with(["pivot", "roller", "pin"])[2], ["position Ø0.039 A B"]);
    }

    #[test]
    fn a_keyway_is_symmetrical_to_its_bore_and_a_slot_in_position_to_the_holes() {
        let hub = BodySpec {
            bore: 16.0,
            keyway: Some(Keyway {
                width: 5.0,
                depth: 2.3,
            }),
            ..BodySpec::default()
        };
        let bore = PinHole {
            name: String::new(),
            at: Point::origin(),
            hub: hub.clone(),
        };
        let ends = [(Point::new(55.0, 0.0), 4.0), (Point::new(65.0, 0.0), 4.0)];
        let slot = Hole {
            fit: "H9".into(),
            ..Hole::from(Outline::hull(&ends).expect("a slot"))
        };
        let part = plate(vec![Hole::bore(bore.outline(), &hub), slot.clone()]);
        // IT9 of 3 to 6 mm, IT8 of 50 to 80 mm.
        assert_eq!(stated(&part)[0], ["symmetry 0.03 A", "datum A"]);
        assert_eq!(stated(&part)[1], ["position 0.046 A"]);
        let free = Hole {
            fit: String::new(),
            ..slot
        };
        let part = plate(vec![hole("", [0.0, 0.0], 3.0), free]);
        assert_eq!(stated(&part), [Vec::<String>::new(), Vec::new()]);
    }
}
