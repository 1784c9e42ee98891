//! The files of a gear pair.

mod format;
mod links;
mod outline;
mod part;
mod picture;
mod pins;
mod sheet;
mod sheet_set;
mod sheets;
mod solid;

use crate::{
    Bundle, BundleError,
    csv::{self, TableError},
    drawing::Drawing,
    dxf::{self, DxfError},
    machine::MachineFilesError,
    pdf::PdfError,
    sheet::SheetError,
    step::StepError,
    svg,
    threemf::PackageError,
};
use centrode_geometry::{SolidError, Tolerance};
use centrode_mechanism::gear::{GearPair, Member};
pub use format::{Format, UnknownFormat};
pub use links::machine;
pub(crate) use links::{gear, teeth};
pub(crate) use part::add_part;
pub(crate) use picture::drawn_gear;
pub use picture::{curves, picture};
use sheet::Contours;
pub use sheet_set::SheetSet;
pub use sheets::{Label, Meshing, SheetOptions, Subject, sheets};
pub use solid::{mesh, solid, step_file, stl_file, threemf_file};
use thiserror::Error;

/// How the files are written.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Greatest distance of every arc, point sequence and mesh from the exact curve.
    pub tolerance: Tolerance,
    /// Which DXF.
    pub dxf_version: dxf::Version,
    /// Arcs or splines in the DXF.
    pub dxf_curves: dxf::Curves,
    /// How the drawing sheets are laid out.
    pub sheet: SheetOptions,
    /// What drawings, sheets, solids and tables are of; models and motion are of the pair.
    pub subjects: Vec<Subject>,
}

impl Options {
    /// DXF R2010 with arcs, of everything.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            dxf_version: dxf::Version::default(),
            dxf_curves: dxf::Curves::default(),
            sheet: SheetOptions::default(),
            subjects: Subject::ALL.to_vec(),
        }
    }
}

impl Options {
    /// The gears asked for.
    fn members(&self) -> impl Iterator<Item = Member> + '_ {
        [Member::Driver, Member::Driven]
            .into_iter()
            .filter(|&member| self.subjects.contains(&member.into()))
    }
}

/// Why a gear pair's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GearPairFilesError {
    /// A gear is no solid at this tolerance.
    #[error("the {} gear is no solid: {source}", .member.name())]
    Solid {
        /// Which gear.
        member: Member,
        /// Why.
        source: SolidError,
    },
    /// The tolerance is so coarse that no tooth would be left.
    #[error(
        "a tolerance of {tolerance} mm is too coarse: at most a tenth of the module, {largest:.4} mm"
    )]
    Tolerance {
        /// The tolerance, mm.
        tolerance: f64,
        /// The coarsest one possible, mm.
        largest: f64,
    },
    /// The drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// The drawing sheets cannot be laid out.
    #[error("{} drawing: {source}", .subject.name())]
    Sheet {
        /// What the sheets are of.
        subject: Subject,
        /// Why.
        source: SheetError,
    },
    /// The drawing sheets could not be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// A gear cannot be written as STEP.
    #[error("the {} gear cannot be written as STEP: {source}", .member.name())]
    Step {
        /// Which gear.
        member: Member,
        /// Why.
        source: StepError,
    },
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its motion or a simulator model could not be written.
    #[error(transparent)]
    Machine(#[from] MachineFilesError),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// The files of a pair in the formats asked for, not yet on disk. URDF and MJCF bring the STL files they
/// name (URDF a folder of them to touch with), the law of motion and a script that plays them.
///
/// # Errors
/// [`GearPairFilesError`], for instance if the tolerance is too coarse for the bore to clear the teeth.
pub fn files(
    pair: &GearPair,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, GearPairFilesError> {
    let largest = 0.1 * pair.module();
    if options.tolerance.mm() > largest {
        return Err(GearPairFilesError::Tolerance {
            tolerance: options.tolerance.mm(),
            largest,
        });
    }
    let wanted = |format: Format| formats.contains(&format);
    let simulated = wanted(Format::Urdf) || wanted(Format::Mjcf);
    let mut bundle = Bundle::default();
    if wanted(Format::Dxf) || wanted(Format::Svg) {
        draw(pair, &wanted, options, &mut bundle)?;
    }
    if wanted(Format::Sheet) || wanted(Format::Pdf) {
        for &subject in &options.subjects {
            let set = SheetSet::new(pair, subject, options)?;
            set.add(&wanted, options, &mut bundle)?;
        }
    }
    solid::add(pair, &wanted, options, &mut bundle)?;
    if wanted(Format::Csv) {
        for member in options.members() {
            let table = outline::columns(pair.gear(member), options.tolerance);
            bundle.add(&format!("{}.csv", member.name()), csv::write(&table)?)?;
            let table = pins::columns(pair, member);
            bundle.add(&format!("{}-pins.csv", member.name()), csv::write(&table)?)?;
        }
    }
    if wanted(Format::Csv) || simulated {
        let models = [Format::Urdf, Format::Mjcf].map(wanted);
        crate::machine::add(&machine(pair)?, models, options.tolerance, &mut bundle)?;
    }
    Ok(bundle)
}

fn draw(
    pair: &GearPair,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), GearPairFilesError> {
    let tolerance = options.tolerance;
    let exact = contours(pair, tolerance);
    // Arcs are fitted once: fitting what is arcs already leaves it as it is.
    let fitted = exact.clone().map(|c| c.with_arcs(tolerance));
    if wanted(Format::Dxf) {
        let source = match options.dxf_curves {
            dxf::Curves::Arcs => &fitted,
            dxf::Curves::Splines => &exact,
        };
        for (name, drawing) in drawings(pair, source, options) {
            let bytes = dxf::write(&drawing, options.dxf_version, options.dxf_curves, tolerance)?;
            bundle.add(&format!("{name}.dxf"), bytes)?;
        }
    }
    if wanted(Format::Svg) {
        for (name, drawing) in drawings(pair, &fitted, options) {
            let picture = svg::write(&drawing, tolerance);
            bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
        }
    }
    Ok(())
}

fn contours(pair: &GearPair, tolerance: Tolerance) -> [Contours; 2] {
    [Member::Driver, Member::Driven].map(|member| Contours::new(pair, member, tolerance))
}

fn drawings(
    pair: &GearPair,
    [driver, driven]: &[Contours; 2],
    options: &Options,
) -> Vec<(&'static str, Drawing)> {
    let draw = |&subject: &Subject| {
        let drawing = match subject {
            Subject::Driver => sheet::gear(driver),
            Subject::Driven => sheet::gear(driven),
            Subject::Assembly => sheet::assembly(pair, [driver, driven]),
        };
        (subject.name(), drawing)
    };
    options.subjects.iter().map(draw).collect()
}

/// The drawing of one gear, with exact contours.
#[must_use]
pub fn gear_drawing(pair: &GearPair, member: Member, tolerance: Tolerance) -> Drawing {
    sheet::gear(&Contours::new(pair, member, tolerance))
}

/// The drawing of both gears in place at phi = 0, with exact contours.
#[must_use]
pub fn assembly_drawing(pair: &GearPair, tolerance: Tolerance) -> Drawing {
    let [driver, driven] = &contours(pair, tolerance);
    sheet::assembly(pair, [driver, driven])
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::{Outline, Point, Vector};
    use centrode_mechanism::gear::{
        Gear,
        design::{GearPairDesign, Keyway},
        pitch::{Circle, Ellipse, PitchSpec, Polar},
    };
    use std::f64::consts::TAU;

    fn pair(pitch: PitchSpec) -> GearPair {
        let mut design = GearPairDesign::new(pitch);
        design.driver.bore = 12.0;
        design.driver.keyway = Some(Keyway {
            width: 4.0,
            depth: 1.8,
        });
        design.driven.bore = 10.0;
        GearPair::resolve(&design).expect("a sound pair")
    }

    fn elliptic() -> GearPair {
        pair(PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.2679,
            module: Some(2.25),
            tooth_count: Some(23),
            ..Ellipse::default()
        }))
    }

    fn circular() -> GearPair {
        pair(PitchSpec::Circle(Circle {
            module: Some(2.0),
            tooth_count: Some(20),
            ..Circle::default()
        }))
    }

    /// A driver with a waist, whose tooth flanks there are hollow.
    fn pair_of_lobes() -> GearPair {
        pair(PitchSpec::Polar(Polar {
            expression: Some("1 + 0.35*cos(2*phi)".into()),
            module: Some(1.5),
            tooth_count: Some(40),
            ..Polar::default()
        }))
    }

    fn options() -> Options {
        Options::new(Tolerance::new(1e-3).expect("positive"))
    }

    fn text(bundle: &Bundle, name: &str) -> String {
        let (_, bytes) = bundle
            .files()
            .find(|(n, _)| *n == name)
            .expect("in the bundle");
        String::from_utf8(bytes.to_vec()).expect("text")
    }

    /// Names of the files but those of the convex bodies.
    fn beside(bundle: &Bundle) -> Vec<&str> {
        let names = bundle.files().map(|(name, _)| name);
        names
            .filter(|name| !name.starts_with("collision/"))
            .collect()
    }

    #[test]
    fn every_format_is_there_and_the_same_twice() {
        let pair = elliptic();
        let bundle = files(&pair, &Format::ALL, &options()).expect("made");
        let names = beside(&bundle);
        let expected = [
            "driver.dxf",
            "driven.dxf",
            "assembly.dxf",
            "driver.svg",
            "driven.svg",
            "assembly.svg",
            "driver-sheet-1.dxf",
            "driver-sheet-1.svg",
            "driver-sheet-2.dxf",
            "driver-sheet-2.svg",
            "driver.pdf",
            "driven-sheet-1.dxf",
            "driven-sheet-1.svg",
            "driven-sheet-2.dxf",
            "driven-sheet-2.svg",
            "driven.pdf",
            "assembly-sheet.dxf",
            "assembly-sheet.svg",
            "assembly.pdf",
            "driver.step",
            "driver.stl",
            "driver.3mf",
            "driven.step",
            "driven.stl",
            "driven.3mf",
            "driver.csv",
            "driver-pins.csv",
            "driven.csv",
            "driven-pins.csv",
            "motion.csv",
            "motion.json",
            "machine.urdf",
            "play_pybullet.py",
            "machine.xml",
            "play_mujoco.py",
        ];
        assert_eq!(names, expected);
        assert_eq!(
            bundle,
            files(&elliptic(), &Format::ALL, &options()).expect("made again")
        );
        let model = files(&pair, &[Format::Urdf], &options()).expect("made");
        assert_eq!(
            beside(&model),
            [
                "motion.csv",
                "motion.json",
                "driver.stl",
                "driven.stl",
                "machine.urdf",
                "play_pybullet.py",
            ]
        );
    }

    #[test]
    fn a_tolerance_that_leaves_no_teeth_is_refused() {
        let coarse = Options::new(Tolerance::new(1.0).expect("positive"));
        let error = files(&elliptic(), &[Format::Dxf], &coarse).expect_err("too coarse");
        assert!(error.to_string().contains("0.2250 mm"), "{error}");
    }

    #[test]
    fn profiles_are_one_contour_of_at_most_400_arcs() {
        let pair = elliptic();
        for member in [Member::Driver, Member::Driven] {
            let arcs: Outline = pair.gear(member).outline().arcs(options().tolerance);
            assert_eq!(arcs.crossing(), None);
            assert!(
                arcs.segments().len() <= 400,
                "{} arcs",
                arcs.segments().len()
            );
        }
    }

    #[test]
    fn only_a_linear_law_is_written_as_a_mimic_joint() {
        let curved = text(
            &files(&elliptic(), &[Format::Urdf], &options()).expect("made"),
            "machine.urdf",
        );
        assert!(
            !curved.contains("<mimic") && curved.contains("no mimic joint"),
            "{curved}"
        );
        let linear = text(
            &files(&circular(), &[Format::Urdf], &options()).expect("made"),
            "machine.urdf",
        );
        assert!(
            linear.contains("<mimic") && linear.contains("multiplier=\"-1\""),
            "{linear}"
        );
    }

    /// How far a point lies outside a gear, mm, judged by circles round it: whether any reaches inside.
    fn outside(gear: &Gear, point: Point) -> f64 {
        let reaches = |radius: f64| {
            (0..32).any(|k| {
                let (sin, cos) = (TAU * f64::from(k) / 32.0).sin_cos();
                gear.outline()
                    .contains(point + Vector::new(cos, sin) * radius)
            })
        };
        let radii = [0.0, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3];
        radii
            .into_iter()
            .find(|&r| reaches(r))
            .unwrap_or(f64::INFINITY)
    }

    #[test]
    fn teeth_are_one_convex_body_each_or_several_where_they_are_hollow() {
        let (plain, hollow) = (elliptic(), pair_of_lobes());
        for pair in [&plain, &hollow] {
            let machine = machine(pair).expect("linked");
            let simulated = crate::machine::simulated(&machine, options().tolerance);
            let model = simulated.expect("made").model;
            assert!(model.note.contains("by at most"), "{}", model.note);
            for (link, gear) in model.links[1..].iter().zip([pair.driver(), pair.driven()]) {
                let width = gear.body().width;
                let (hub, teeth): (Vec<_>, Vec<_>) = link
                    .collision
                    .iter()
                    .partition(|body| body.name.contains("hub"));
                assert!(!hub.is_empty());
                let volume: f64 = teeth.iter().map(|body| body.mesh.volume()).sum();
                let share = volume / (gear.outline().area() * width);
                assert!((0.05..0.5).contains(&share), "{share}");
                let count = gear.tooth_count() as usize;
                if std::ptr::eq(pair, &raw const plain) {
                    assert_eq!((teeth.len(), hub.len()), (count, 1));
                } else {
                    assert!(
                        (count..16 * count).contains(&teeth.len()),
                        "{}",
                        teeth.len()
                    );
                }
                for body in &link.collision {
                    assert!(
                        body.mesh.is_watertight() && body.mesh.volume() > 0.0,
                        "{}",
                        body.name
                    );
                    let vertices = &body.mesh.vertices;
                    let (low, high) = vertices.split_at(vertices.len() / 2);
                    assert!(low.iter().all(|v| v[2] == 0.0) && high.iter().all(|v| v[2] == width));
                    // The hull's edges, which bridge hollows, in their middles.
                    for (a, b) in low.iter().zip(low.iter().cycle().skip(1)) {
                        let middle = Point::new(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
                        let out = outside(gear, middle);
                        assert!(out <= 1e-3, "{} at {middle}: {out}", body.name);
                    }
                }
            }
        }
    }

    #[test]
    fn the_motion_is_dense_enough_to_draw_straight_lines_between() {
        let pair = elliptic();
        let table = text(
            &files(&pair, &[Format::Csv], &options()).expect("made"),
            "motion.csv",
        );
        let rows: Vec<Vec<f64>> = table
            .lines()
            .skip(1)
            .map(|line| {
                line.split(',')
                    .map(|cell| cell.parse().expect("a number"))
                    .collect()
            })
            .collect();
        assert!(rows.len() >= 721);
        for w in rows.windows(2) {
            let middle = 0.5 * (w[0][0] + w[1][0]);
            let error = (pair.driven_angle(middle) - 0.5 * (w[0][1] + w[1][1])).abs();
            assert!(error * pair.center_distance() < 1e-3);
        }
        let last = rows.last().expect("rows");
        assert!((last[0] - pair.cycle()).abs() < 1e-12 && (last[1] - pair.cycle()).abs() < 1e-9);
    }

    #[test]
    fn outline_points_carry_role_and_outward_normal() {
        let pair = elliptic();
        let table = text(
            &files(&pair, &[Format::Csv], &options()).expect("made"),
            "driven.csv",
        );
        let mut lines = table.lines();
        assert_eq!(
            lines.next(),
            Some("x_mm,y_mm,normal_x,normal_y,curvature_per_mm,role,tooth")
        );
        let mut roles = std::collections::BTreeSet::new();
        let outline = pair.driven().outline();
        for line in lines.step_by(7) {
            let cells: Vec<&str> = line.split(',').collect();
            let x: Vec<f64> = cells[..4]
                .iter()
                .map(|c| c.parse().expect("a number"))
                .collect();
            let at = |d: f64| centrode_geometry::Point::new(x[0] + d * x[2], x[1] + d * x[3]);
            if cells[5] == "tip" || cells[5] == "root" {
                assert!(
                    outline.contains(at(-1e-4)) && !outline.contains(at(1e-4)),
                    "{line}"
                );
            }
            roles.insert(cells[5].to_owned());
        }
        assert_eq!(
            roles.into_iter().collect::<Vec<_>>(),
            ["fillet", "flank", "root", "tip"]
        );
    }

    #[test]
    fn solids_have_the_area_of_the_outline_less_the_bore() {
        let pair = elliptic();
        for member in [Member::Driver, Member::Driven] {
            let gear = pair.gear(member);
            let bore = gear.bore().expect("a bore").area();
            let volume = (gear.outline().area() - bore) * gear.body().width;
            let mesh = mesh(&pair, member, options().tolerance).expect("a solid");
            assert!(mesh.is_watertight());
            assert!((mesh.volume() / volume - 1.0).abs() < 1e-3);
            let exact = solid(&pair, member).expect("a solid").volume();
            assert!((exact - volume).abs() < 1e-6);
        }
    }
}
