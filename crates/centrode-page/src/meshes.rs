use centrode_export::linked;
use centrode_families::FAMILIES;
use centrode_geometry::Tolerance;

/// Meshes of a design, and their poses at the picture's inputs, as the page reads them.
///
/// # Errors
/// The reason in words if there is no machine, or one of its bodies is not a solid.
pub fn meshes(text: &str, tolerance: Tolerance) -> Result<Vec<u8>, String> {
    let read = FAMILIES.read(text.as_bytes());
    let mechanism = read.and_then(|file| file.mechanism());
    let mechanism = mechanism.map_err(|error| error.message())?;
    let input = mechanism.picture().motion.input;
    let made = mechanism.machine();
    let made = made.and_then(|made| linked::spatial(&made, &input, tolerance));
    made.map_err(|error| error.to_string())
}
