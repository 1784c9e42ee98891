use std::f64::consts::TAU;

/// An angle round the shaft that gets a line.
#[derive(Debug)]
pub(super) struct Event {
    pub(super) phi: f64,
    /// Edges that meet there.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Heights of all edges there, if already computed.
    pub(super) heights: Option<Vec<f64>>,
}

impl Event {
    pub(super) fn new(phi: f64) -> Self {
        Self {
            phi,
            pairs: Vec::new(),
            heights: None,
        }
    }
}

/// Equally spaced lines round the shaft.
pub(super) fn even(count: u32) -> impl Iterator<Item = Event> {
    (0..count).map(move |i| Event::new(TAU * f64::from(i) / f64::from(count)))
}
