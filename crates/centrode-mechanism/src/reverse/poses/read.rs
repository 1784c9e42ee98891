use super::{KeyPose, KeyPoses, PoseError};
use crate::reverse::path::rows;

impl KeyPoses {
    /// Reads key poses from a CSV file and finds the chain: x and y in mm and the clamp's direction in degrees, a pose a line, in
    /// order.
    ///
    /// # Errors
    /// [`PoseError`] with the line, and as [`new`](Self::new).
    pub fn from_csv(bytes: &[u8]) -> Result<Self, PoseError> {
        let rows = rows::<3>(bytes)?;
        let poses = rows.iter().map(|&[x, y, direction]| KeyPose {
            point: [x, y].into(),
            direction: direction.to_radians(),
        });
        Self::new(&poses.collect::<Vec<_>>())
    }
}
