//! Lines of a picture that do not depend on the motion.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use centrode_geometry::{Outline, Point, Recent, Tolerance};
use centrode_kinematics::machine::{Line, LinePath, LinkedMachine};

use crate::picture::Path;

/// Number of cached contours, and maximum segments of one: a machine has some dozens of contours, and a change alters a few of
/// them.
const CACHED: usize = 64;
const LONGEST: usize = 2000;

/// Cache of contours fitted recently.
static FITTED: Recent<(Outline, Tolerance), Path, CACHED> = Recent::new();

/// Contours of a machine, equal ones once, to be fitted by several threads.
pub(super) struct Still<'a> {
    tolerance: Tolerance,
    contours: Vec<Contour<'a>>,
    /// Number of contours that threads have started to fit.
    taken: AtomicUsize,
}

struct Contour<'a> {
    outline: &'a Outline,
    line: &'a Line,
    fitted: OnceLock<Path>,
}

impl<'a> Still<'a> {
    pub(super) fn new(machine: &'a LinkedMachine, tolerance: Tolerance) -> Self {
        let mut contours: Vec<Contour<'a>> = Vec::new();
        for line in machine.sketches.iter().flat_map(|sketch| &sketch.lines) {
            let LinePath::Contour(outline) = &line.path else {
                continue;
            };
            if !contours.iter().any(|known| known.outline == outline) {
                contours.push(Contour {
                    outline,
                    line,
                    fitted: OnceLock::new(),
                });
            }
        }
        Self {
            tolerance,
            contours,
            taken: AtomicUsize::new(0),
        }
    }

    /// Fits contours until threads have started all of them.
    pub(super) fn fit(&self) {
        while let Some(contour) = self
            .contours
            .get(self.taken.fetch_add(1, Ordering::Relaxed))
        {
            contour.path(self.tolerance);
        }
    }

    /// A line as a path; `None` for the path of a point.
    pub(super) fn path(&self, line: &Line) -> Option<Path> {
        let role = line.role;
        match &line.path {
            LinePath::Contour(outline) => {
                let known = self
                    .contours
                    .iter()
                    .find(|known| known.outline == outline)?;
                let path = known.path(self.tolerance).clone();
                Some(Path { role, ..path })
            }
            LinePath::Chain(corners) => {
                let corners: Vec<Point> = corners.iter().copied().map(Point::from).collect();
                Some(Path::open(role, &corners))
            }
            LinePath::Trace(_) => None,
        }
    }
}

impl Contour<'_> {
    fn path(&self, tolerance: Tolerance) -> &Path {
        let new = || Path::closed(self.line.role, self.outline, tolerance);
        self.fitted.get_or_init(|| {
            if self.outline.segments().len() > LONGEST {
                return new();
            }
            FITTED.get(&(self.outline.clone(), tolerance), new)
        })
    }
}
