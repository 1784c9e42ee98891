use centrode::export::feeder;
use centrode::export::page::Picture;
use centrode::geometry::Tolerance;
use centrode::mechanism::feeder::Feeder;

/// Tolerance of the picture, as a share of the frame.
const DRAWN: f64 = 1e-4;

/// The six-bar as it moves, with the path of its tip.
pub(super) fn picture(machine: &Feeder) -> Picture {
    let frame = machine.six_bar().four_bar().lengths()[3];
    let tolerance = Tolerance::new(DRAWN * frame);
    tolerance.map_or_else(|_| Picture::default(), |t| feeder::picture(machine, t))
}
