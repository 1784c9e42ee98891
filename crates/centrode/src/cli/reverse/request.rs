use crate::analysis::Unit;
use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::geometry::Point;
use crate::page::reverse::{WITHIN, drawn};
use centrode_spec::{DesignFamily, DesignFile, MechanismError, SpecError};
use centrode_synthesis::reverse::{Aim, PathDesign, RequiredPath, RequiredPoints, SplitKind};
use std::path::Path;

/// A path and what is required of its machine, on the command line and in files.
pub(super) struct Request {
    /// The wishes; the field `points` has their points.
    pub(super) design: PathDesign,
    pub(super) points: Vec<Point>,
    /// File of the points.
    pub(super) source: Source,
    /// Line on a drawing that was read.
    pub(super) drawing: Option<String>,
    /// The design file, if there is one.
    file: Option<(Source, DesignFile)>,
}

/// Words of an error.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Sentence(&'static str);

impl Request {
    pub(super) fn read(command: &Reverse) -> Result<Self, Failure> {
        let source = super::source(command)?;
        let (design, file) = match path_design(&source)? {
            Some((design, file)) => (design, Some((source.clone(), file))),
            None => (PathDesign::default(), None),
        };
        let name = design.path.file.clone();
        let mut requested = Self {
            points: design.path.points.iter().map(|&p| p.into()).collect(),
            design,
            source,
            drawing: None,
            file,
        };
        match (requested.file.is_some(), name) {
            (false, _) => requested.take_points(command)?,
            (true, Some(name)) => {
                let folder = command.path.as_deref().and_then(Path::parent);
                let path = folder.unwrap_or(Path::new("")).join(name);
                requested.source = Source::open_up_to(&path, RequiredPath::LARGEST)?;
                let wishes = requested.design.wishes.clone();
                requested.take_points(command)?;
                // The number of a point is in the design; the file of the points is not at fault.
                let count = requested.points.len();
                let is_closed = count > 1 && requested.points.first() == requested.points.last();
                let checked = wishes.validate(count - usize::from(is_closed));
                checked.map_err(|error| {
                    let key = format!("wishes.{}", error.key);
                    requested.refused(SpecError { key, ..error }.into())
                })?;
            }
            (true, None) => {}
        }
        requested.take(command)?;
        if requested.design.path.control {
            requested.points = RequiredPath::knots(&requested.points);
        }
        Ok(requested)
    }

    /// Wishes about a machine that takes key poses.
    pub(super) fn of_poses(source: Source, command: &Reverse) -> Result<Self, Failure> {
        let mut requested = Self {
            design: PathDesign::default(),
            points: Vec::new(),
            source,
            drawing: None,
            file: None,
        };
        requested.take(command)?;
        Ok(requested)
    }

    /// Takes the points of a CSV or SVG file.
    fn take_points(&mut self, command: &Reverse) -> Result<(), Failure> {
        let bytes = self.source.bytes();
        let drawn = drawn(bytes, command.within.unwrap_or(WITHIN));
        if let Some(drawn) = drawn.map_err(|error| self.source.refused(&error))? {
            let off = Unit::Millimetre.with_unit(drawn.deviation.value);
            let points = drawn.points.len();
            self.points = drawn.points;
            self.drawing = Some(format!(
                "through {points} points, within {off} of the drawing"
            ));
            return Ok(());
        }
        let required = RequiredPoints::from_csv(bytes);
        let required = required.map_err(|error| self.source.refused(&error))?;
        if let Some(tolerances) = required.tolerances {
            if command.band.is_some() || self.design.path.band.is_some() {
                let words = "the file has a tolerance for each point: omit this value";
                let is_option = command.band.is_some();
                return Err(self.blame(is_option, "--band", "path.band", Sentence(words)));
            }
            self.design.path.tolerance = tolerances;
        }
        self.design.wishes.directions.extend(required.directions);
        self.points = required.points;
        Ok(())
    }

    /// The option or, if there is a design file, the key.
    pub(super) fn spelled<'a>(&self, option: &'a str, key: &'a str) -> &'a str {
        if self.file.is_some() { key } else { option }
    }

    /// Failure of a value that is an option of the command line or, if the option is not given, a key of the design file.
    pub(super) fn blame(
        &self,
        is_option: bool,
        option: &'static str,
        key: &'static str,
        error: impl std::error::Error + Send + Sync + 'static,
    ) -> Failure {
        let key = match is_option {
            true => option,
            false => self.spelled(option, key),
        };
        self.refused(MechanismError::new(key.into(), error))
    }

    /// Failure of an error, at the line of the design file with its key, unless the key is an option.
    fn refused(&self, error: MechanismError) -> Failure {
        match &self.file {
            Some((source, file)) if !error.key.starts_with("--") => source.blame(file.blame(error)),
            _ => Failure::Usage(error.message()),
        }
    }

    /// Takes the options of the command line; they replace keys of the file.
    fn take(&mut self, command: &Reverse) -> Result<(), Failure> {
        let design = &mut self.design;
        let is_axis_option = command.axis.is_some() || command.axis_box.is_some();
        if is_axis_option {
            (design.axis, design.axis_box) = (command.axis, command.axis_box);
        }
        if let Some(bend) = command.bend {
            design.bend = bend.to_radians();
        }
        if let Some(kind) = command.split.as_deref().and_then(SplitKind::named) {
            design.split = kind;
        }
        design.arms = command.arms.unwrap_or(design.arms);
        design.steps = command.steps.or(design.steps);
        let aim = command.aim.as_deref().and_then(Aim::named);
        design.aim = aim.or(design.aim);
        if let Some(band) = command.band {
            design.path.tolerance.clear();
            design.path.band = Some(band);
        }
        design.path.open |= command.open;
        design.path.control |= command.control;
        design.path.crossing |= command.crossing;
        design.path.module = command.module.or(design.path.module);
        let path = &design.path;
        let is_eased = path.band.is_some() || !path.tolerance.is_empty() || path.open;
        if path.module.is_some() && !is_eased {
            let is_option = command.module.is_some() || self.file.is_none();
            let words = Sentence(match is_option {
                true => {
                    "it limits how far a path is eased: give --band, or a column headed tolerance in the file"
                }
                false => {
                    "it limits how far a path is eased: give path.band, path.tolerance or a column headed tolerance"
                }
            });
            return Err(self.blame(is_option, "--module", "path.module", words));
        }
        let checked = self.design.check_axes(&self.points);
        checked.map_err(|error| {
            let key = match is_axis_option {
                true => format!("--{}", error.key.replace('_', "-")),
                false => error.key,
            };
            self.refused(SpecError { key, ..error }.into())
        })
    }

    /// Angle from the carrier's first leg to its second, degrees, as it was given.
    pub(super) fn bend_deg(&self, command: &Reverse) -> f64 {
        let degrees = self.design.bend.to_degrees();
        command.bend.unwrap_or((degrees * 1e9).round() / 1e9)
    }
}

/// Design of a path, if the source is a design file.
fn path_design(source: &Source) -> Result<Option<(PathDesign, DesignFile)>, Failure> {
    let text = std::str::from_utf8(source.bytes()).unwrap_or_default();
    let has_key = |line: &str| line.trim_start().starts_with("family") && line.contains('=');
    if !(source.name().ends_with(".toml") || text.lines().any(has_key)) {
        return Ok(None);
    }
    let family = [DesignFamily::new::<PathDesign>()];
    let (file, _) =
        DesignFile::read(source.bytes(), &family).map_err(|error| source.blame(error))?;
    let design = file.design().downcast_ref::<PathDesign>().cloned();
    Ok(design.map(|design| (design, file)))
}
