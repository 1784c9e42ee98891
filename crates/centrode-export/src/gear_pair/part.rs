use super::{Format, GearPairFilesError, Label, Options, SheetSet, outline, pins};
use crate::{Bundle, csv, dxf, step, stl, svg, threemf};
use centrode_mechanism::gear::{GearPair, Member};

/// Adds the files of one gear as a part of a larger machine, under its label.
pub(crate) fn add_part(
    pair: &GearPair,
    member: Member,
    label: Label,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), GearPairFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    let (name, tolerance) = (label.name, options.tolerance);
    if wanted(Format::Dxf) || wanted(Format::Svg) {
        let drawing = super::gear_drawing(pair, member, tolerance);
        if wanted(Format::Dxf) {
            let (version, curves) = (options.dxf_version, options.dxf_curves);
            let bytes = dxf::write(&drawing, version, curves, tolerance)?;
            bundle.add(&format!("{name}.dxf"), bytes)?;
        }
        if wanted(Format::Svg) {
            let picture = svg::write(&drawing, tolerance);
            bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
        }
    }
    if wanted(Format::Sheet) || wanted(Format::Pdf) {
        let mut labelled = options.clone();
        labelled.sheet.label = Some(label);
        let set = SheetSet::new(pair, member.into(), &labelled)?;
        set.add(&wanted, options, bundle)?;
    }
    let design = match pair.title() {
        "" => pair.name(),
        title => title,
    };
    let title = format!("{design}: {name}");
    let solid = super::solid(pair, member)?;
    if wanted(Format::Step) {
        let bytes = step::write(&solid, name, &title)
            .map_err(|source| GearPairFilesError::Step { member, source })?;
        bundle.add(&format!("{name}.step"), bytes)?;
    }
    if wanted(Format::Stl) || wanted(Format::ThreeMf) {
        let mesh = solid
            .mesh(tolerance)
            .map_err(|source| GearPairFilesError::Solid { member, source })?;
        if wanted(Format::Stl) {
            bundle.add(&format!("{name}.stl"), stl::write(&mesh))?;
        }
        if wanted(Format::ThreeMf) {
            let bytes = threemf::write(&mesh, name, &title)?;
            bundle.add(&format!("{name}.3mf"), bytes)?;
        }
    }
    if wanted(Format::Csv) {
        let table = outline::columns(pair.gear(member), tolerance);
        bundle.add(&format!("{name}.csv"), csv::write(&table)?)?;
        let table = pins::columns(pair, member);
        bundle.add(&format!("{name}-pins.csv"), csv::write(&table)?)?;
    }
    Ok(())
}
