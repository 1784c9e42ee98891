//! The grooved shaft as a solid.

mod blank;
mod boundary;
mod ends;
mod moments;
mod plan;
mod rings;
mod surface;

use centrode_geometry::{MassProperties, Mesh, Point, Shell, Tolerance};

pub use blank::ShaftBody;

use super::{Groove, ShaftError};
use plan::Plan;
use rings::Rings;

/// The shaft with its groove: a cylinder, the groove's radial walls and its floor, journals and a keyway.
///
/// The walls lie on the exact offset of the centre line on the shaft's surface and run straight towards
/// the axis, as a mill slightly thinner than the groove leaves them when it follows both walls.
/// [`Groove::wall_deviation`] gives the difference for the walls of a mill as wide as the groove.
#[derive(Clone, Debug)]
pub struct ShaftSolid<'a> {
    groove: &'a Groove,
    body: &'a ShaftBody,
    /// Lower and upper end of the thick part, mm.
    ends: [f64; 2],
}

impl<'a> ShaftSolid<'a> {
    /// Makes the solid of a groove in a body.
    ///
    /// # Errors
    /// [`ShaftError`] where body and groove do not fit together.
    pub fn new(groove: &'a Groove, body: &'a ShaftBody) -> Result<Self, ShaftError> {
        body.validate(groove)?;
        let (near, far) = groove.traverse().reach();
        let beyond = 0.5 * groove.width() + body.margin;
        Ok(Self {
            groove,
            body,
            ends: [near - beyond, far + beyond],
        })
    }

    /// Lower and upper end of the thick part along the axis, mm.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Lower and upper end of the whole shaft along the axis, mm.
    #[must_use]
    pub fn whole(&self) -> [f64; 2] {
        let [low, high] = self.ends;
        // The journals begin beyond the chamfers.
        let beyond = self.body.chamfer + self.body.journal_length;
        [low - beyond, high + beyond]
    }

    /// Mass, center of mass and inertia, integrated over the exact surfaces, fillet and keyway included.
    #[must_use]
    pub fn mass_properties(&self) -> MassProperties {
        moments::moments(self.groove, self.body, self.ends).mass_properties(self.body.density)
    }

    /// A closed triangle mesh with outward normals, every triangle within the tolerance of the surface.
    ///
    /// Walls twist and fillets bend, so the number of triangles grows as the inverse of the tolerance.
    #[must_use]
    pub fn mesh(&self, tolerance: Tolerance) -> Mesh {
        let plan = Plan::new(self.groove, self.body.fillet, tolerance);
        let mut surface = surface::Surface::new(&plan, self.groove.radius(), self.ends);
        surface.fill();
        let (mut mesh, lower, upper) = surface.finish();
        Rings::new(self.body, self.groove.radius(), tolerance).close(&mut mesh, &lower, &upper);
        mesh
    }

    /// The boundary on exact surfaces: cylinders, cones, planes and the walls, ruled between polynomial edges
    /// within 1e-7 mm of the exact ones. The fillet along the floor is omitted.
    ///
    /// # Errors
    /// [`ShaftError::Boundary`] where smooth pieces cannot follow the edges.
    pub fn shell(&self) -> Result<Shell, ShaftError> {
        let shell = boundary::shell(self.groove, self.body, self.ends);
        shell.ok_or(ShaftError::Boundary(boundary::MAX_LINES))
    }

    /// Upper edges of the groove's walls as far as they remain, on the development, mm: `(R phi, z)`, the angle `phi`
    /// from 0 to one turn, each broken where it starts anew.
    #[must_use]
    pub fn wall_edges(&self, tolerance: Tolerance) -> Vec<Vec<Point>> {
        let plan = Plan::new(self.groove, 0.0, tolerance);
        let mut surface = surface::Surface::new(&plan, self.groove.radius(), self.ends);
        surface.fill();
        surface.wall_edges()
    }
}

#[cfg(test)]
mod tests;
