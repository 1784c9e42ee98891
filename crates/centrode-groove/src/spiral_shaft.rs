use centrode_geometry::{
    MassProperties, Mesh, Outline, Point, Shell, Solid, SolidError, Tolerance,
};

use super::{
    Groove, Load, Schedule, ShaftBody, ShaftError, ShaftLaw, ShaftSolid, SliderSpec, SpeedLaw,
    SpiralShaftDesign, Traverse,
};
use centrode_kinematics::machine::GuideForce;
use centrode_kinematics::transmission::Transmission;
use centrode_spec::DrawingSpec;

/// A spiral shaft: law, groove, slider and body, resolved.
#[derive(Clone, Debug)]
pub struct SpiralShaft {
    design: SpiralShaftDesign,
    law: SpeedLaw,
    groove: Groove,
}

impl SpiralShaft {
    /// Resolves a design.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn resolve(design: &SpiralShaftDesign) -> Result<Self, ShaftError> {
        design.validate()?;
        let law = design.solved_law()?;
        let traverse = Traverse::starting_at(
            design.pick,
            law.resolve(design.lead, design.radius)?,
            design.holes,
            &design.reversal,
            design.return_offset,
        )?;
        let groove = Groove::new(
            traverse,
            design.radius,
            design.groove.width,
            design.groove.depth,
        )?;
        design.body.validate(&groove)?;
        Ok(Self {
            design: design.clone(),
            law,
            groove,
        })
    }

    /// The design as written.
    #[must_use]
    pub fn design(&self) -> &SpiralShaftDesign {
        &self.design
    }

    /// Law with its amplitude.
    #[must_use]
    pub fn speed_law(&self) -> &SpeedLaw {
        &self.law
    }

    /// Amplitude of a sine, mm; `None` for other laws.
    #[must_use]
    pub fn amplitude(&self) -> Option<f64> {
        match &self.law {
            SpeedLaw::Sine(law) => Some(law.amplitude),
            SpeedLaw::RotatedSine(law) => Some(law.amplitude),
            _ => None,
        }
    }

    /// The law of the strokes.
    #[must_use]
    pub fn law(&self) -> &ShaftLaw {
        self.traverse().law()
    }

    /// The slider's motion over the whole cycle out and back.
    #[must_use]
    pub fn traverse(&self) -> &Traverse {
        self.groove.traverse()
    }

    /// The groove.
    #[must_use]
    pub fn groove(&self) -> &Groove {
        &self.groove
    }

    /// The slider.
    #[must_use]
    pub fn slider(&self) -> &SliderSpec {
        &self.design.slider
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &ShaftBody {
        &self.design.body
    }

    /// Load that is moved, and its speed.
    #[must_use]
    pub fn load(&self) -> &Load {
        &self.design.load
    }

    /// Entries and layout of the drawing sheets, as in the design.
    #[must_use]
    pub fn drawing(&self) -> &DrawingSpec {
        &self.design.drawing
    }

    /// Hole picked at each pick.
    #[must_use]
    pub fn schedule(&self) -> Schedule {
        Schedule::new(self.traverse(), self.design.pick, self.design.window)
    }

    /// Distance the box moves while the first seedling is picked, as in full stroke, mm.
    #[must_use]
    pub fn moved_in_window(&self) -> f64 {
        let (pick, half) = (self.design.pick, 0.5 * self.design.window);
        self.law().moved(pick - half, pick + half)
    }

    /// Forces on the slider at an angle of the shaft.
    #[must_use]
    pub fn force(&self, theta: f64, load: &Load) -> GuideForce {
        self.groove.force(theta, load)
    }

    /// The shaft as a closed triangle mesh within the tolerance.
    ///
    /// # Errors
    /// [`ShaftError`] where body and groove do not fit together.
    pub fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, ShaftError> {
        Ok(ShaftSolid::new(&self.groove, self.body())?.mesh(tolerance))
    }

    /// Mass, center of mass and inertia of the shaft, integrated over its exact surfaces.
    ///
    /// # Errors
    /// [`ShaftError`] where body and groove do not fit together.
    pub fn mass_properties(&self) -> Result<MassProperties, ShaftError> {
        Ok(ShaftSolid::new(&self.groove, self.body())?.mass_properties())
    }

    /// The shaft's boundary on exact surfaces; the fillet along the groove's floor is omitted.
    ///
    /// # Errors
    /// [`ShaftError`] where body and groove do not fit together, or smooth surfaces cannot follow the law.
    pub fn shell(&self) -> Result<Shell, ShaftError> {
        ShaftSolid::new(&self.groove, self.body())?.shell()
    }

    /// The slider as an extrusion along its pin, its foot at z = 0, with the bore for the pin.
    ///
    /// # Errors
    /// [`SolidError`] where it has no height.
    pub fn slider_solid(&self) -> Result<Solid, SolidError> {
        let slider = self.slider();
        let bore = Outline::circle(Point::origin(), 0.5 * slider.pin_diameter);
        let outline = slider.outline(self.groove.width());
        Solid::new(outline, vec![bore], 0.0, slider.reach)
    }

    /// Upper edges of the groove's walls as far as they remain, on the development, mm; each broken where the angle
    /// round the shaft starts anew.
    ///
    /// # Errors
    /// [`ShaftError`] where body and groove do not fit together.
    pub fn wall_edges(&self, tolerance: Tolerance) -> Result<Vec<Vec<Point>>, ShaftError> {
        Ok(ShaftSolid::new(&self.groove, self.body())?.wall_edges(tolerance))
    }

    /// Minimum and maximum speed of the strokes over their mean.
    #[must_use]
    pub fn speed_ratio(&self) -> (f64, f64) {
        let law = self.law();
        let mean = law.mean_speed();
        (law.slowest().value / mean, law.fastest().value / mean)
    }

    /// Shaft turn of the whole cycle, rad.
    #[must_use]
    pub fn cycle(&self) -> f64 {
        self.traverse().period()
    }
}
