use std::sync::LazyLock;

use super::super::{TurnedPart, TurnedStep};
use super::StandardTable;

/// Socket head cap screw, ISO 4762, of strength class 8.8, with the holes that belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Nominal diameter of its coarse thread, mm: 6 of M6.
    pub diameter: f64,
    /// Length below the head, mm.
    pub length: f64,
}

/// Nominal diameter, diameter of the head, clearance hole, tapping drill, minimum and maximum length, mm.
///
/// Source: ISO 4762:2004 (head and lengths), ISO 273:1979, medium series (clearance holes), ISO 2306:1972 (drills for the coarse
/// threads of ISO 261).
static SCREWS: LazyLock<StandardTable<6>> =
    LazyLock::new(|| StandardTable::read(include_str!("../../../data/iso-4762.csv")));

/// Lengths, mm; ISO 4762:2004.
const LENGTHS: [f64; 27] = [
    2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0,
    60.0, 65.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0, 130.0, 140.0,
];

impl Screw {
    /// Tolerance class of clearance holes of the medium series, ISO 273.
    pub const HOLE: &'static str = "H13";
    /// Tolerance class of the threads they are screwed into, ISO 965-1.
    pub const THREAD: &'static str = "6H";

    /// Nominal diameters, mm, ascending.
    pub fn sizes() -> impl DoubleEndedIterator<Item = f64> {
        SCREWS.rows.iter().map(|row| row[0])
    }

    /// The longest screw of a nominal diameter that is no longer than `room`, mm; `None` if there is no such screw.
    #[must_use]
    pub fn for_diameter(diameter: f64, room: f64) -> Option<Self> {
        let [.., minimum, most] = SCREWS.of(diameter)?;
        // A sum of layers differs from a standard length by rounding.
        let fits =
            |length: &f64| (minimum..=most).contains(length) && *length <= room * (1.0 + 1e-9);
        let length = LENGTHS.into_iter().rev().find(fits)?;
        Some(Self { diameter, length })
    }

    fn row(self) -> [f64; 6] {
        SCREWS.of(self.diameter).unwrap_or([self.diameter; 6])
    }

    /// Diameter of its head, mm.
    #[must_use]
    pub fn head(self) -> f64 {
        self.row()[1]
    }

    /// Height of its head, mm: equal to the thread's diameter.
    #[must_use]
    pub fn head_height(self) -> f64 {
        self.diameter
    }

    /// Diameter of the hole that it goes through, mm; ISO 273, medium series.
    #[must_use]
    pub fn clearance_hole(self) -> f64 {
        self.row()[2]
    }

    /// Diameter of the hole that its thread is cut in, mm.
    #[must_use]
    pub fn drill(self) -> f64 {
        self.row()[3]
    }

    /// Name of its thread: "M6".
    #[must_use]
    pub fn thread(self) -> String {
        format!("M{}", self.diameter)
    }

    /// Designation: "Screw ISO 4762 - M6 x 12".
    #[must_use]
    pub fn name(self) -> String {
        format!("Screw ISO 4762 - {} x {}", self.thread(), self.length)
    }

    /// Its body, the head upwards: shank and head without thread and socket.
    #[must_use]
    pub fn body(self) -> TurnedPart {
        let name = format!("screw-m{}x{}", self.diameter, self.length);
        TurnedPart {
            name,
            title: self.name(),
            steps: vec![
                TurnedStep::plain(self.diameter, self.length, ""),
                TurnedStep::plain(self.head(), self.head_height(), ""),
            ],
            keyway: None,
            held: Vec::new(),
            chamfer: 0.0,
            material: "steel 8.8".into(),
            density: 7850.0,
            heat_treatment: String::new(),
            notes: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_screw_of_a_size_is_named_by_its_standard() {
        let name = |diameter, room| Screw::for_diameter(diameter, room).map(Screw::name);
        let named = |diameter, room| name(diameter, room).unwrap_or_default();
        assert_eq!(named(6.0, 13.0), "Screw ISO 4762 - M6 x 12");
        assert_eq!(named(2.5, 8.0), "Screw ISO 4762 - M2.5 x 8");
        assert_eq!(named(3.0, 500.0), "Screw ISO 4762 - M3 x 30");
        assert_eq!(
            (name(6.0, 9.9), name(7.0, 50.0), name(6.0, f64::NAN)),
            (None, None, None)
        );
    }

    #[test]
    fn holes_leave_play_and_threads_their_depth() {
        // Pitches of the coarse series, ISO 261.
        let pitches = [0.35, 0.4, 0.45, 0.5, 0.7, 0.8, 1.0, 1.25, 1.5, 1.75];
        for ([diameter, head, hole, drill, minimum, most], pitch) in
            SCREWS.rows.iter().copied().zip(pitches)
        {
            // The core of a nut's thread is 1.0825 pitches below the nominal diameter, its widest limit a fifth of a pitch more.
            let core = diameter - 1.0825 * pitch;
            assert!(
                drill > core - 0.03 && drill < core + 0.31 * pitch,
                "M{diameter}"
            );
            assert!(((diameter - pitch) - drill).abs() < 0.051, "M{diameter}");
            assert!(hole > diameter && hole < 1.21 * diameter, "M{diameter}");
            assert!(
                head >= 1.5 * diameter && head <= 1.9 * diameter,
                "M{diameter}"
            );
            assert!(head > hole && minimum < most, "M{diameter}");
            assert!(
                LENGTHS.contains(&minimum) && LENGTHS.contains(&most),
                "M{diameter}"
            );
            let screw = Screw::for_diameter(diameter, most).expect("a screw");
            assert_eq!(screw.length, most);
            let body = screw.body().solid().expect("a body").moments().volume;
            let quarter = std::f64::consts::FRAC_PI_4;
            let sum = quarter * (diameter * diameter * most + head * head * diameter);
            assert!((body / sum - 1.0).abs() < 1e-12, "M{diameter}");
        }
    }
}
