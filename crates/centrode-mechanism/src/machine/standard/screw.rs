/// Hexagon socket head cap screw with a metric thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapScrew {
    /// Diameter of the thread, mm.
    pub thread: f64,
    /// Length under the head, mm.
    pub length: f64,
}

/// Thread, pitch, diameter and height of the head, mm, ISO 4762:2004; clearance hole, medium, mm, ISO 273:1979.
#[rustfmt::skip]
const SCREWS: [[f64; 5]; 8] = [
    [3.0, 0.5, 5.5, 3.0, 3.4], [4.0, 0.7, 7.0, 4.0, 4.5], [5.0, 0.8, 8.5, 5.0, 5.5],
    [6.0, 1.0, 10.0, 6.0, 6.6], [8.0, 1.25, 13.0, 8.0, 9.0], [10.0, 1.5, 16.0, 10.0, 11.0],
    [12.0, 1.75, 18.0, 12.0, 13.5], [16.0, 2.0, 24.0, 16.0, 17.5],
];
/// Lengths, mm; ISO 4762:2004.
const LENGTHS: [f64; 22] = [
    5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0,
    70.0, 80.0, 90.0, 100.0, 110.0, 120.0,
];

impl CapScrew {
    /// The longest screw of a thread that is no longer than a room, mm, from one and a half of its diameter on; `None` where there
    /// is none.
    #[must_use]
    pub fn of(thread: f64, room: f64) -> Option<Self> {
        let least = 1.5 * thread;
        let mut fitting = LENGTHS.into_iter().rev();
        let length = fitting.find(|&length| length <= room && length >= least)?;
        let known = SCREWS.iter().any(|row| row[0] == thread);
        known.then_some(Self { thread, length })
    }

    fn row(self) -> [f64; 5] {
        let mut rows = SCREWS.into_iter();
        // Only sizes of the table are made.
        rows.find(|row| row[0] == self.thread)
            .unwrap_or([f64::NAN; 5])
    }

    /// Pitch of the thread, mm.
    #[must_use]
    pub fn pitch(self) -> f64 {
        self.row()[1]
    }

    /// Diameter and height of the head, mm.
    #[must_use]
    pub fn head(self) -> [f64; 2] {
        let [_, _, diameter, height, _] = self.row();
        [diameter, height]
    }

    /// Diameter of the hole that it passes through, series medium, mm.
    #[must_use]
    pub fn clearance_hole(self) -> f64 {
        self.row()[4]
    }

    /// Designation: "Screw ISO 4762 - M6 x 20 - 8.8".
    #[must_use]
    pub fn name(self) -> String {
        format!("Screw ISO 4762 - M{} x {} - 8.8", self.thread, self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screws_are_those_of_the_standard() {
        let name = |thread: f64, room: f64| CapScrew::of(thread, room).map(CapScrew::name);
        assert_eq!(
            name(6.0, 23.0).as_deref(),
            Some("Screw ISO 4762 - M6 x 20 - 8.8")
        );
        assert_eq!((name(6.0, 8.9), name(7.0, 30.0)), (None, None));
        for [thread, pitch, diameter, height, hole] in SCREWS {
            let screw = CapScrew::of(thread, 60.0).expect("a screw");
            assert_eq!((screw.pitch(), screw.head()), (pitch, [diameter, height]));
            assert_eq!(screw.clearance_hole(), hole);
            // A head is as high as its thread, and covers its hole.
            assert!(
                height == thread && diameter > hole && hole > thread,
                "{thread}"
            );
        }
    }
}
