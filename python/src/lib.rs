//! Python face of centrode: moves values across, no arithmetic.

use pyo3::prelude::pymodule;

mod array;
mod body;
mod cam;
mod command;
mod count;
mod design;
mod drawing;
mod error;
mod feeder;
mod files;
mod forces;
mod gear;
mod gear_pair;
mod keywords;
mod machine;
mod made;
mod mechanism;
mod pitch;
mod record;
mod reverse;
mod search;
mod shaft;
mod sheet;
mod six_bar;
mod solid;
mod sweep;
mod table;
mod three_arm;
mod tool;
mod wait;
mod word;

/// Native part of the `centrode` package.
#[pymodule]
mod _centrode {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::{
        body::{Body, Keyway},
        cam::{
            DiscCam, Follower, Fork, Law, Segment, dwell, law, law_of_polynomial, return_, rise,
            swinging_flat, swinging_roller, transition, translating_flat, translating_roller,
        },
        command::_run,
        design::{_load, _schema, template},
        drawing::DrawingSpec,
        feeder::Feeder,
        files::_write,
        gear::Gear,
        gear_pair::GearPair,
        machine::Machine,
        machine::drive::{GearDrive, gear_drive},
        mechanism::Mechanism,
        pitch::kinds::{
            bezier, bspline, circle, conjugate, eccentric_circle, ellipse, from_ratio,
            from_transmission, limacon, lobed_ellipse, polar,
        },
        pitch::{_pitch_from_toml, Pitch},
        reverse::{_drawn_path, Reversed, reverse, reverse_poses},
        shaft::BoxDrive,
        shaft::MovingBox,
        shaft::SpiralShaft,
        six_bar::SixBar,
        sweep::_sweep,
        three_arm::ThreeArm,
        tool::{Rack, Shaper},
        wait::_panic,
    };

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("_LARGEST_DESIGN", crate::design::LARGEST)?;
        module.add("_LARGEST_PATH", crate::reverse::LARGEST)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
