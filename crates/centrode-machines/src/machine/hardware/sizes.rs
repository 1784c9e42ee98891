//! Sizes of plates and pins: as given, or by default from the distances of holes.

use std::ops::Deref;

use centrode_geometry::Point;

use crate::machine::hardware::plates::PIN;
use crate::machine::hardware::slots::Slot;
use crate::machine::{Machine, MachineDesign, MachinePlatesSpec};
use centrode_kinematics::machine::{JointKind, preferred_size_below};
use centrode_spec::SpecError;
use centrode_spec::rule::in_range;

/// Default thickness, gap, width and pin diameter, mm, if holes are at least [`ROOM`] apart.
const SIZES: [f64; 4] = [5.0, 1.0, 8.0, 3.0];
/// Distance of two holes, mm, below which the default sizes shrink with it: a plate of the default width then still passes the
/// pin at the other end of a bar.
const ROOM: f64 = 8.0;
/// Ratio of the distance between a hole and the path of a block in the same plate to the equivalent distance of two holes.
/// In widths it is half the block, the round end of its slot, the gap, the wall and half the pin.
const SLOT: f64 = 2.2;
/// Distance of two holes, as a share of the longest distance, below which they count as one hole.
const ONE: f64 = 1e-4;

/// Sizes of the plates and pins of a machine, with the other values of the design's table `plates`.
#[derive(Clone, Debug, PartialEq)]
pub struct Plates {
    /// Thickness of a plate, mm.
    pub thickness: f64,
    /// Distance of neighbouring plates, mm.
    pub gap: f64,
    /// Width of a plate, mm.
    pub width: f64,
    /// Diameter of the pins, mm.
    pub pin_diameter: f64,
    spec: MachinePlatesSpec,
}

/// Gives access to tolerance classes, materials and density as the design gives them.
impl Deref for Plates {
    type Target = MachinePlatesSpec;

    fn deref(&self) -> &MachinePlatesSpec {
        &self.spec
    }
}

impl Plates {
    /// Sizes as given. The others follow from the shortest distance of two holes, `room`, mm; pins fit into the narrowest
    /// plate.
    fn new(design: &MachineDesign, room: f64) -> Self {
        let spec = design.plates.clone();
        let share = room / ROOM;
        let [thickness, gap, width, pin] = SIZES.map(|size| match share < 1.0 {
            true => preferred_size_below(share * size),
            false => size,
        });
        // A given pin needs a plate that is wide enough; the factor allows for rounding.
        let held = spec
            .pin_diameter
            .map_or(0.0, |pin| pin / PIN * (1.0 + 1e-9));
        let width = spec.width.unwrap_or(width.max(held));
        let own = design.bodies.values().filter_map(|body| body.width);
        let narrowest = own.fold(width, f64::min);
        let pin = match pin > PIN * narrowest {
            true => preferred_size_below(SIZES[3] / SIZES[2] * narrowest),
            false => pin,
        };
        Self {
            thickness: spec.thickness.unwrap_or(thickness),
            gap: spec.gap.unwrap_or(gap),
            width,
            pin_diameter: spec.pin_diameter.unwrap_or(pin),
            spec,
        }
    }

    /// Height of the lower face of a layer along the shafts, mm.
    pub(in crate::machine) fn height_of(&self, layer: f64) -> f64 {
        layer * (self.thickness + self.gap)
    }
}

/// A design with its copies written out, and the sizes of its plates, which replace those of the design.
#[derive(Clone, Debug)]
pub(in crate::machine) struct Sized {
    design: MachineDesign,
    pub(in crate::machine) plates: Plates,
}

impl From<MachineDesign> for Sized {
    fn from(design: MachineDesign) -> Self {
        Self {
            plates: Plates::new(&design, f64::INFINITY),
            design,
        }
    }
}

impl Deref for Sized {
    type Target = MachineDesign;

    fn deref(&self) -> &MachineDesign {
        &self.design
    }
}

impl Sized {
    /// Sets the layer of a body.
    pub(super) fn set_layer(&mut self, body: &str, layer: i32) {
        let spec = self.design.bodies.entry(body.to_owned()).or_default();
        spec.layer = Some(layer);
    }
}

impl Machine {
    /// Sizes of the machine's plates and pins.
    ///
    /// A size that `plates` does not give is 5 mm (thickness), 1 mm (gap), 8 mm (width) or 3 mm (pin diameter). It is smaller in
    /// proportion if two holes of a plate are closer than 8 mm, rounded down to a preferred size, ISO 497 R"20. The distance
    /// between a hole and the path of a block in one plate counts divided by 2.2.
    #[must_use]
    pub fn plates(&self) -> &Plates {
        &self.design.plates
    }

    /// The machine with sizes for its plates and pins.
    pub(in crate::machine) fn sized(mut self) -> Self {
        self.design.plates = Plates::new(&self.design, self.room());
        self
    }

    /// Shortest distance of two holes in a plate, mm; infinite if no plate has two.
    fn room(&self) -> f64 {
        let mut all = Vec::new();
        for body in 0..self.bodies.len() {
            let holes = self.hole_places(body).unwrap_or_default();
            for (k, (_, at)) in holes.iter().enumerate() {
                all.extend(holes[..k].iter().map(|(_, other)| (other - at).norm()));
            }
            for block in (0..self.bodies.len()).filter(|&block| self.slotted(block) == Some(body)) {
                let path = self.path_in(block);
                let distances = holes.iter().map(|(_, at)| path.distance(*at) / SLOT);
                all.extend(distances);
            }
        }
        let smallest = ONE * all.iter().copied().fold(0.0, f64::max);
        let apart = all.into_iter().filter(|apart| *apart > smallest);
        apart.fold(f64::INFINITY, f64::min)
    }

    /// Path of the middle of a block, in the axes of the plate with the block's slot.
    fn path_in(&self, block: usize) -> Slot {
        let mount = self.bodies[block].mount.as_ref();
        let ends = mount.map_or([Point::origin(); 2], |mount| match mount.kind {
            JointKind::Sliding(range) => range.map(|along| mount.along(along)),
            _ => [mount.at; 2],
        });
        Slot {
            block,
            ends,
            width: 0.0,
        }
    }

    /// Checks the pins against the plates that hold them.
    pub(in crate::machine) fn check_sizes(&self) -> Result<(), SpecError> {
        let plates = &self.design.plates;
        let largest = PIN * plates.width;
        in_range(
            "plates.pin_diameter",
            plates.pin_diameter,
            [0.0, largest],
            " mm",
        )?;
        let narrowest = plates.pin_diameter / PIN;
        let widths = self.written.bodies.iter();
        let mut widths = widths.filter_map(|(name, body)| Some((name, body.width?)));
        widths.try_for_each(|(name, width)| {
            in_range(
                &format!("bodies.{name}.width"),
                width,
                [narrowest, 1e9],
                " mm",
            )
        })
    }
}
