use centrode_export::picture::{Handle, HandlePlane};
use centrode_gear::pitch::{PitchSpec, Plane};
use std::f64::consts::{PI, TAU};

/// Maximum number of points of a pitch curve for which handles are drawn: more handles would hide the curve.
const MAX_HANDLES: usize = 60;

/// Handles at the points of a pitch curve on a link; `length` is the length of the curve in the picture, mm.
pub(super) fn handles(pitch: &PitchSpec, length: f64, link: usize) -> Vec<Handle> {
    let (plane, first, second): (_, &[f64], &[f64]) = match pitch {
        PitchSpec::Bspline(s) if s.plane == Plane::Polar => {
            (HandlePlane::Polar, &s.radius, &s.angle)
        }
        PitchSpec::Bspline(s) => (HandlePlane::Cartesian, &s.x, &s.y),
        PitchSpec::Bezier(s) if s.plane == Plane::Polar => {
            (HandlePlane::Polar, &s.radius, &s.angle)
        }
        PitchSpec::Bezier(s) => (HandlePlane::Cartesian, &s.x, &s.y),
        // A smoothed curve does not go through its radii.
        PitchSpec::Polar(s) if s.smooth.is_none() => (HandlePlane::Polar, &s.radius, &s.angle),
        _ => return Vec::new(),
    };
    if first.len() > MAX_HANDLES {
        return Vec::new();
    }
    let scale = scale(pitch, length);
    let turn = TAU / first.len() as f64;
    let handle = |(i, &a): (usize, &f64)| {
        let (keys, b) = match plane {
            HandlePlane::Cartesian => (["x", "y"], second.get(i).copied()),
            // A table without angles has points at equal angular steps.
            HandlePlane::Polar if second.is_empty() => (["radius", ""], Some(turn * i as f64)),
            HandlePlane::Polar => (["radius", "angle_deg"], second.get(i).copied()),
        };
        let b = match plane {
            HandlePlane::Cartesian => b?,
            HandlePlane::Polar => degrees(b?),
        };
        Some(Handle {
            name: format!("point {} of the pitch curve", i + 1),
            link,
            plane,
            keys: keys.map(|key| {
                if key.is_empty() {
                    String::new()
                } else {
                    format!("pitch.{key}[{i}]")
                }
            }),
            values: [a, b],
            scale,
            origin: [0.0; 2],
            chained: true,
        })
    };
    first.iter().enumerate().filter_map(handle).collect()
}

/// The angle in degrees, without the rounding error of the conversion from radians.
pub(super) fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e10).round() / 1e10
}

/// Factor by which module and tooth count scale the curve of the design file.
fn scale(pitch: &PitchSpec, length: f64) -> f64 {
    let mut unscaled = pitch.clone();
    let (module, tooth_count) = match &mut unscaled {
        PitchSpec::Bspline(s) => (s.module.take(), s.tooth_count),
        PitchSpec::Bezier(s) => (s.module.take(), s.tooth_count),
        PitchSpec::Polar(s) => (s.module.take(), s.tooth_count),
        _ => (None, None),
    };
    let (Some(_), Some(teeth)) = (module, tooth_count) else {
        return 1.0;
    };
    let own = unscaled.resolve().ok().and_then(|pitch| pitch.module);
    own.map_or(1.0, |own| length / (PI * own * f64::from(teeth)))
}
