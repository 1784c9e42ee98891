//! The cam as a part: its contour, its bore, its body.

use centrode_geometry::{Outline, Tolerance};

use super::design::CamSpec;
use super::disc::{CamError, DiscCam};
use super::profile::Profile;
use crate::design::BodySpec;

/// Maximum distance of the contour from the exact envelope, as a share of the base radius. A coarser one makes the
/// figures of the cam less exact, a finer one gives more segments.
const ACCURACY: f64 = 1e-11;

/// Finished disc cam: the part that is cut and drawn.
#[derive(Clone, Debug)]
pub struct Cam {
    name: String,
    title: String,
    disc: DiscCam,
    profile: Profile,
    body: BodySpec,
}

impl Cam {
    /// The finished cam of a description.
    ///
    /// # Errors
    /// [`CamError`] naming the rule broken.
    pub fn resolve(spec: &CamSpec) -> Result<Self, CamError> {
        let disc = DiscCam::resolve(spec)?;
        let mut cam = Self::new(disc, &spec.name, spec.body.clone())?;
        cam.title.clone_from(&spec.title);
        Ok(cam)
    }

    /// Makes a cam with a body.
    ///
    /// # Errors
    /// [`CamError::Looped`] and [`CamError::AxisOutside`] where there is no contour,
    /// [`CamError::Bore`] where the bore cuts into it.
    pub fn new(disc: DiscCam, name: &str, body: BodySpec) -> Result<Self, CamError> {
        body.validate().map_err(|e| e.inside("body"))?;
        // The base radius is known to be a positive finite length.
        let tolerance = Tolerance::new(ACCURACY * disc.base_radius())
            .map_err(|_| CamError::NotFinite { degrees: 0.0 })?;
        let profile = disc.profile(tolerance)?;
        let (reach, (minimum, _)) = (body.bore_reach(), profile.radii());
        if reach >= minimum {
            return Err(CamError::Bore { reach, minimum });
        }
        Ok(Self {
            name: name.to_owned(),
            title: String::new(),
            disc,
            profile,
            body,
        })
    }

    /// This cam under another name.
    pub fn renamed(&self, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..self.clone()
        }
    }

    /// Short name, used for file names.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// One line for drawings and reports; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The exact cam.
    #[must_use]
    pub fn disc(&self) -> &DiscCam {
        &self.disc
    }

    /// The contour, within 1e-11 of the base radius of the exact envelope.
    #[must_use]
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Minimum and maximum distance of the contour from the axis, mm.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        self.profile.radii()
    }

    /// Width, bore and material.
    #[must_use]
    pub fn body(&self) -> &BodySpec {
        &self.body
    }

    /// The bore with its keyway, counter-clockwise; `None` for a cam without one.
    #[must_use]
    pub fn bore(&self) -> Option<Outline> {
        self.body.bore_outline()
    }
}
