use std::path::Path;

use crate::analysis::Unit;
use crate::geometry::Point;
use crate::mechanism::design::{DesignFamily, DesignFile};
use crate::mechanism::gear::design::SpecError;
use crate::mechanism::reverse::{
    Aim, DrawnPath, PathDesign, PathError, SplitKind, WantedPath, WantedPoints,
};

use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;

/// Distance within which a path lies of a drawing where none is given, mm.
pub(crate) const WITHIN: f64 = 0.01;

/// A path and what is wanted of its machine, on the command line and in files.
pub(super) struct Asked {
    /// The wishes; their points are those below.
    pub(super) design: PathDesign,
    pub(super) points: Vec<Point>,
    /// File of the points.
    pub(super) source: Source,
    /// Words on a drawing.
    pub(super) drawing: Option<String>,
}

impl Asked {
    pub(super) fn read(command: &Reverse) -> Result<Self, Failure> {
        let source = super::source(command)?;
        let (mut design, file) = match path_design(&source)? {
            Some((design, file)) => (design, Some(file)),
            None => (PathDesign::default(), None),
        };
        let points = design.path.points.iter().map(|&p| p.into()).collect();
        let mut asked = match (&file, &design.path.file) {
            (None, _) => Self::of_points(PathDesign::default(), source, command)?,
            (Some(file), Some(name)) => {
                let folder = command.path.as_deref().and_then(Path::parent);
                let path = folder.unwrap_or(Path::new("")).join(name);
                let points = Source::open_up_to(&path, WantedPath::LARGEST)?;
                let wishes = design.wishes.clone();
                let design = std::mem::take(&mut design);
                let asked = Self::of_points(design, points, command)?;
                // A number of a point stands in the design, and not in the file that holds too few of them.
                let count = asked.points.len();
                let is_closed = count > 1 && asked.points.first() == asked.points.last();
                let checked = wishes.validate(count - usize::from(is_closed));
                checked.map_err(|error| {
                    let key = format!("wishes.{}", error.key);
                    let error = SpecError { key, ..error };
                    source.blame(file.blame(error.into()))
                })?;
                asked
            }
            (Some(_), None) => Self {
                design,
                points,
                source,
                drawing: None,
            },
        };
        asked.take(command)?;
        if asked.design.path.control {
            asked.points = WantedPath::knots(&asked.points);
        }
        Ok(asked)
    }

    /// Wishes about a machine that takes key poses.
    pub(super) fn of_poses(source: Source, command: &Reverse) -> Result<Self, Failure> {
        let mut asked = Self {
            design: PathDesign::default(),
            points: Vec::new(),
            source,
            drawing: None,
        };
        asked.take(command)?;
        Ok(asked)
    }

    /// Points of a CSV or SVG file.
    fn of_points(
        mut design: PathDesign,
        source: Source,
        command: &Reverse,
    ) -> Result<Self, Failure> {
        let drawn = drawn(source.bytes(), command.within.unwrap_or(WITHIN));
        if let Some(drawn) = drawn.map_err(|error| source.refused(&error))? {
            let off = Unit::Millimetre.tell(drawn.deviation.value);
            let points = drawn.points.len();
            return Ok(Self {
                design,
                points: drawn.points,
                source,
                drawing: Some(format!(
                    "through {points} points, within {off} of the drawing"
                )),
            });
        }
        let wanted = WantedPoints::from_csv(source.bytes());
        let wanted = wanted.map_err(|error| source.refused(&error))?;
        if let Some(tolerances) = wanted.tolerances {
            if command.band.is_some() || design.path.band.is_some() {
                let words = "the file has a tolerance for each point: leave out --band";
                return Err(Failure::Usage(words.into()));
            }
            design.path.tolerance = tolerances;
        }
        design.wishes.directions.extend(wanted.directions);
        Ok(Self {
            design,
            points: wanted.points,
            source,
            drawing: None,
        })
    }

    /// Takes what the command line says, before what the file does.
    fn take(&mut self, command: &Reverse) -> Result<(), Failure> {
        let design = &mut self.design;
        if command.axis.is_some() || command.axis_box.is_some() {
            (design.axis, design.axis_box) = (command.axis, command.axis_box);
        }
        if let Some(bend) = command.bend {
            design.bend = bend.to_radians();
        }
        if let Some(kind) = named(&SplitKind::NAMES, command.split.as_deref()) {
            design.split = kind;
        }
        design.arms = command.arms.unwrap_or(design.arms);
        design.steps = command.steps.or(design.steps);
        design.aim = named(&Aim::NAMES, command.aim.as_deref()).or(design.aim);
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
            let words = "--module eases a path: say by how much with --band, or by a column headed tolerance in the file";
            return Err(Failure::Usage(words.into()));
        }
        Ok(())
    }

    /// Angle from the carrier's first leg to its second, degrees, as it was given.
    pub(super) fn bend_deg(&self, command: &Reverse) -> f64 {
        let degrees = self.design.bend.to_degrees();
        command.bend.unwrap_or((degrees * 1e9).round() / 1e9)
    }
}

/// Value of a word.
fn named<T: Copy>(names: &[(&str, T)], word: Option<&str>) -> Option<T> {
    let word = word?;
    let found = names.iter().find(|(name, _)| *name == word);
    found.map(|(_, value)| *value)
}

/// Design of a path, if a file is one.
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

/// Points along the path of an SVG file; none where the file is another.
pub(crate) fn drawn(bytes: &[u8], within: f64) -> Result<Option<DrawnPath>, PathError> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_drawing = text.trim_ascii_start().starts_with(b"<");
    is_drawing
        .then(|| DrawnPath::from_svg(bytes, within))
        .transpose()
}
