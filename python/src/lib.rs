//! Python face of centrode: moves values across, no arithmetic.

use pyo3::prelude::pymodule;

mod array;
mod body;
mod cam;
mod count;
mod design;
mod drawing;
mod error;
mod feeder;
mod files;
mod gear;
mod gear_pair;
mod made;
mod mechanism;
mod moving_box;
mod pitch;
mod place;
mod record;
mod search;
mod sheet;
mod six_bar;
mod spiral_shaft;
mod table;
mod three_arm;
mod tool;
mod variants;
mod wait;
mod word;

/// Native part of the `centrode` package.
#[pymodule]
mod _centrode {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::body::{Body, Keyway};
    #[pymodule_export]
    use crate::cam::{
        DiscCam, Follower, Fork, Law, Segment, dwell, law, law_of_polynomial, return_, rise,
        swinging_flat, swinging_roller, transition, translating_flat, translating_roller,
    };
    #[pymodule_export]
    use crate::design::{_load, _schema, template};
    #[pymodule_export]
    use crate::drawing::DrawingSpec;
    #[pymodule_export]
    use crate::feeder::Feeder;
    #[pymodule_export]
    use crate::files::_write;
    #[pymodule_export]
    use crate::gear::Gear;
    #[pymodule_export]
    use crate::gear_pair::GearPair;
    #[pymodule_export]
    use crate::mechanism::Mechanism;
    #[pymodule_export]
    use crate::moving_box::MovingBox;
    #[pymodule_export]
    use crate::pitch::kinds::{
        bezier, bspline, circle, conjugate, eccentric_circle, ellipse, from_ratio,
        from_transmission, limacon, lobed_ellipse, polar,
    };
    #[pymodule_export]
    use crate::pitch::{_pitch_from_toml, Pitch};
    #[pymodule_export]
    use crate::six_bar::SixBar;
    #[pymodule_export]
    use crate::spiral_shaft::SpiralShaft;
    #[pymodule_export]
    use crate::three_arm::ThreeArm;
    #[pymodule_export]
    use crate::tool::{Rack, Shaper};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("_LARGEST_DESIGN", crate::design::LARGEST)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
