use super::{KeyPose, PoseError};
use crate::reverse::csv;

impl KeyPose {
    /// Reads key poses from a CSV file: x and y in mm and the clamp's direction in degrees, one pose per line, in order.
    ///
    /// A line of headings names the columns, `x`, `y` and `direction_deg`, in any order.
    ///
    /// # Errors
    /// [`PoseError::Path`] with the line.
    pub fn from_csv(bytes: &[u8]) -> Result<Vec<Self>, PoseError> {
        let rows = csv::poses(bytes)?;
        let poses = rows.iter().map(|&[x, y, direction]| Self {
            point: [x, y].into(),
            direction: direction.to_radians(),
        });
        Ok(poses.collect())
    }
}
