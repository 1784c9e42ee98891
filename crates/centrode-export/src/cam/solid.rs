use centrode_gear::cam::Cam;
use centrode_geometry::{Mesh, Solid, SolidError, Tolerance};

/// A cam as a solid: contour less the bore, from z = 0 to its width.
///
/// # Errors
/// [`SolidError::NoHeight`] if the width is not positive.
pub fn solid(cam: &Cam) -> Result<Solid, SolidError> {
    let holes = cam.bore().into_iter().collect();
    Solid::new(
        cam.profile().outline().clone(),
        holes,
        0.0,
        cam.body().width,
    )
}

/// A cam as a closed triangle mesh.
///
/// # Errors
/// [`SolidError`] if the flattened contour and bore meet.
pub fn mesh(cam: &Cam, tolerance: Tolerance) -> Result<Mesh, SolidError> {
    solid(cam)?.mesh(tolerance)
}
