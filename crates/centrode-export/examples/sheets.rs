//! Lays out the sheets of a design: `sheets DESIGN DIR`.
use centrode_export::gear_pair::{Format, Options, files};
use centrode_geometry::Tolerance;
use centrode_mechanism::design::DesignFile;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let text = std::fs::read(&args[1]).expect("design");
    let pair = DesignFile::read(&text)
        .expect("design")
        .gear_pair()
        .expect("pair");
    let mut options = Options::new(Tolerance::new(1e-3).expect("positive"));
    options.sheet.size = args.get(3).and_then(|w| {
        centrode_mechanism::design::SheetSize::ALL
            .into_iter()
            .find(|s| s.name() == w)
    });
    if args.get(4).is_some() {
        options.sheet.projection = Some(centrode_mechanism::design::Projection::ThirdAngle);
    }
    let bundle = files(&pair, &[Format::Sheet, Format::Pdf], &options).expect("files");
    bundle
        .write_to(std::path::Path::new(&args[2]))
        .expect("written");
    for subject in centrode_export::gear_pair::Subject::ALL {
        for (i, sheet) in
            centrode_export::gear_pair::sheets(&pair, subject, &options.sheet, options.tolerance)
                .expect("sheets")
                .iter()
                .enumerate()
        {
            eprintln!(
                "{subject:?} {} {}: {:?}",
                i + 1,
                sheet.size.name(),
                centrode_export::sheet::overlaps(sheet)
            );
        }
    }
}
