use centrode_geometry::Cancel;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_machines::three_arm::{Parameter, Sweep, SweepError, UnknownParameter};
use rayon::prelude::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// Evaluates many variants of one three-arm design: the figures of its goals 2 to 4 and 6 to 8, in about twenty microseconds
/// per variant.
///
/// The pitch curves must be those that a [`Sweep`] accepts; its documentation states how closely the figures agree with those
/// of a check. Only a check shows the effect of a variant on arms, seedlings and teeth.
#[derive(Clone, Debug)]
pub struct Variants {
    start: ThreeArmDesign,
    parameters: Vec<Parameter>,
    sweep: Sweep,
}

/// Reason why a design has no such variants.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VariantsError {
    /// A word names no parameter.
    #[error(transparent)]
    Unknown(#[from] UnknownParameter),
    /// The pitch curve has no such control point.
    #[error("the pitch curve has {points} control points, so there is no `{parameter}`")]
    NoSuchPoint {
        /// Name of the parameter.
        parameter: String,
        /// Points of the pitch curve.
        points: usize,
    },
    /// A parameter is requested twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// A sweep does not accept the pitch curve.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}

impl Variants {
    /// Names of the figures of each variant: the goals' figures, and two lengths; angles in rad, lengths in mm.
    pub const FIGURES: [&'static str; 8] = [
        "pick-angle",
        "push-angle",
        "angle-difference",
        "gearbox-clearance",
        "trajectory-height",
        "module",
        "center_distance",
        "pitch_length",
    ];

    /// Makes variants of a design in the parameters `names`. The tip's path is sampled at `inputs` inputs per turn before its
    /// extremes are refined.
    ///
    /// # Errors
    /// [`VariantsError`] if a name is unknown or given twice, or if a sweep does not accept the pitch curve.
    pub fn new(
        design: &ThreeArmDesign,
        names: &[impl AsRef<str>],
        inputs: usize,
    ) -> Result<Self, VariantsError> {
        let sweep = Sweep::like(design, inputs)?;
        let mut parameters = Vec::new();
        for name in names {
            let parameter: Parameter = name.as_ref().parse()?;
            if let Parameter::Radius(_) | Parameter::Angle(_) = parameter
                && parameter.of(design).is_none()
            {
                let points = sweep.control_points();
                let parameter = parameter.to_string();
                return Err(VariantsError::NoSuchPoint { parameter, points });
            }
            if parameters.contains(&parameter) {
                return Err(VariantsError::Twice(parameter.to_string()));
            }
            parameters.push(parameter);
        }
        Ok(Self {
            start: design.clone(),
            parameters,
            sweep,
        })
    }

    /// The [figures](Self::FIGURES) of `count` variants, computed on all cores. `values` writes the parameters of a variant in
    /// the units of the design file. All figures are NaN if a variant is not a mechanism; the module is NaN if the gears have
    /// no tooth count.
    pub fn figures(
        &self,
        count: usize,
        values: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Vec<[f64; Self::FIGURES.len()]> {
        let cancel = Cancel::current();
        let start = || {
            let values = vec![0.0; self.parameters.len()];
            (self.sweep.clone(), self.start.clone(), values)
        };
        let variant = |(sweep, design, row): &mut (Sweep, ThreeArmDesign, Vec<f64>), i: usize| {
            let _scope = cancel.enter();
            values(i, row);
            for (parameter, &value) in self.parameters.iter().zip(&*row) {
                let angle = parameter.is_angle();
                parameter.set(design, if angle { value.to_radians() } else { value });
            }
            look(sweep, design).unwrap_or([f64::NAN; Self::FIGURES.len()])
        };
        let all = (0..count).into_par_iter().with_min_len(64).panic_fuse();
        all.map_init(start, variant).collect()
    }
}

fn look(sweep: &mut Sweep, design: &ThreeArmDesign) -> Option<[f64; Variants::FIGURES.len()]> {
    design.validate().ok()?;
    let figures = sweep.figures(design).ok()?;
    Some([
        figures.pick_angle,
        figures.push_angle,
        figures.angle_difference,
        figures.gearbox_clearance,
        figures.trajectory_height,
        figures.module.unwrap_or(f64::NAN),
        sweep.center_distance(),
        sweep.pitch_length(),
    ])
}
