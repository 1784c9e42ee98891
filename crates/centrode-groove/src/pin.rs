use std::f64::consts::FRAC_PI_2;

use super::SpiralShaft;
use centrode_kinematics::machine::{Bar, Fit, Stock, TurnedPiece, TurnedPieces};
use centrode_spec::digits::thousandths;

/// Length of the slider's pin inside the box, in pin diameters.
const IN_BOX: f64 = 2.0;

impl SpiralShaft {
    /// The slider's pin, from the slider's foot into the box. In the box's frame it lies along x; `link` is the box's name.
    #[must_use]
    pub fn pin(&self, link: &str) -> TurnedPieces {
        let slider = self.slider();
        let length = slider.reach + IN_BOX * slider.pin_diameter;
        let classes = [&*slider.hole_fit, &slider.pin_fit];
        let fit = Fit::new("slider on its pin", slider.pin_diameter, classes);
        let stock = Stock::new(&slider.material, slider.density);
        let bar = Bar::new(fit, [0.0, length]);
        let mut pin = bar.turned("pin", "Pin of the slider", stock, "");
        let inside = thousandths(slider.reach);
        pin.part.notes = vec![format!("{inside} mm of its length is in the slider.")];
        pin.pieces = vec![TurnedPiece {
            link: link.into(),
            at: [self.groove().radius() - slider.reach, 0.0, 0.0],
            turn: [0.0, FRAC_PI_2, 0.0],
            // The moved mass that the design states includes the pin.
            is_counted: true,
        }];
        pin
    }
}
