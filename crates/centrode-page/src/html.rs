use super::{bundle, policy};

/// A file of the page.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Asset {
    /// File name.
    pub name: &'static str,
    /// Media type.
    pub media_type: &'static str,
    /// Content.
    pub text: &'static str,
}

/// A vendored module of the page, packed by gzip: every browser accepts it in this form.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Packed {
    /// File name.
    pub name: &'static str,
    /// Media type of the unpacked content.
    pub media_type: &'static str,
    /// The content, packed by gzip.
    pub gzip: &'static [u8],
}

macro_rules! packed {
    ($folder:literal: $($name:literal),+ $(,)?) => {
        [$(Packed {
            name: $name,
            media_type: "text/javascript; charset=utf-8",
            gzip: include_bytes!(concat!("vendor/", $folder, "/", $name, ".gz")),
        }),+]
    };
}

/// three.js, which draws in three dimensions; the page loads it when the view in space is requested.
const PACKED: [Packed; 2] = packed!("three-0.184.0": "three.module.min.js", "three.core.min.js");

/// The packed module of the page with a name.
#[must_use]
pub fn packed(name: &str) -> Option<&'static Packed> {
    PACKED.iter().find(|packed| packed.name == name)
}

/// The page itself, empty.
pub const INDEX: &str = include_str!("site/index.html");

/// The page to start from: designs to open.
pub const START: &str = include_str!("site/start.html");

/// The page on which a machine is made from a path.
pub const PATH: &str = include_str!("site/path.html");

macro_rules! assets {
    ($media_type:literal: $($name:literal $(= $text:expr)?),+ $(,)?) => {
        [$(Asset { name: $name, media_type: $media_type, text: assets!(@text $name $($text)?) }),+]
    };
    (@text $name:literal) => { include_str!(concat!("site/", $name)) };
    (@text $name:literal $text:expr) => { $text };
}

/// uPlot, which draws the charts, as it is published minified; its last line here makes it a module. A report holds
/// it as text, so it is not packed by gzip.
const UPLOT: &str = concat!(
    include_str!("vendor/uplot-1.6.32/uPlot.iife.min.js"),
    "export { uPlot as default };\n"
);

const STYLES: [Asset; 4] = assets!(
    "text/css; charset=utf-8":
    "uplot.css" = include_str!("vendor/uplot-1.6.32/uPlot.min.css"),
    "page.css",
    "picture.css",
    "windows.css",
);

/// The scripts; `main.js` is the first to run.
const SCRIPTS: [Asset; 48] = assets!(
    "text/javascript; charset=utf-8":
    "uplot.js" = UPLOT,
    "axes.js",
    "chart-files.js",
    "charts.js",
    "compare.js",
    "compose.js",
    "compose-panel.js",
    "dialogs.js",
    "elements.js",
    "essentials.js",
    "figures.js",
    "find.js",
    "file.js",
    "form.js",
    "gif.js",
    "handles.js",
    "help.js",
    "hints.js",
    "history.js",
    "layout.js",
    "link.js",
    "look.js",
    "main.js",
    "mesh.js",
    "motion.js",
    "numbers.js",
    "painter.js",
    "overlays.js",
    "picking.js",
    "picture-files.js",
    "points.js",
    "reach.js",
    "response.js",
    "search.js",
    "server.js",
    "sight.js",
    "solving.js",
    "source.js",
    "space.js",
    "space-view.js",
    "stage.js",
    "state.js",
    "theme.js",
    "tools.js",
    "transport.js",
    "verdict.js",
    "ways.js",
    "work.js",
);

/// The scripts of the start page and of the page of a path, which no report needs.
const START_SCRIPTS: [Asset; 11] = assets!(
    "text/javascript; charset=utf-8":
    "new-file.js",
    "path.js",
    "path-design.js",
    "path-field.js",
    "path-file.js",
    "path-form.js",
    "path-make.js",
    "path-shapes.js",
    "path-solving.js",
    "path-told.js",
    "start.js",
);

/// The style of the page of a path.
const PATH_STYLES: [Asset; 1] = assets!("text/css; charset=utf-8": "path.css");

/// The file of the page with a name.
#[must_use]
pub fn asset(name: &str) -> Option<&'static Asset> {
    STYLES
        .iter()
        .chain(&SCRIPTS)
        .chain(&START_SCRIPTS)
        .chain(&PATH_STYLES)
        .find(|asset| asset.name == name)
}

/// Policy of a report: only content of the file is allowed. The report makes no requests, and its script and styles are named by
/// their hashes.
fn allowed(script: &str) -> String {
    let styles: Vec<String> = STYLES
        .iter()
        .map(|a| policy::source(&inline(a.text)))
        .collect();
    format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data: blob:",
        policy::source(script),
        styles.join(" ")
    )
}

/// Content of the element of a style.
fn inline(style: &str) -> String {
    format!("\n{style}")
}

/// The page with a snapshot in it, as one file that needs nothing else.
///
/// `title` is plain text, `snapshot` JSON.
#[must_use]
pub fn report(title: &str, snapshot: &str) -> String {
    let styles: String = STYLES
        .iter()
        .map(|a| format!("<style>{}</style>\n", inline(a.text)))
        .collect();
    let script = bundle::script("main.js", &SCRIPTS);
    let policy = allowed(&script);
    let script = format!(
        "<script type=\"application/json\" id=\"snapshot\">{}</script>\n\
         <script type=\"module\">{script}</script>\n",
        snapshot.replace('<', "\\u003c"),
    );
    let policy = format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n");
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let page = between(INDEX, "<title>", "</title>", &title);
    let page = between(&page, "<!-- policy -->", "<!-- /policy -->", &policy);
    let page = between(&page, "<!-- styles -->", "<!-- /styles -->", &styles);
    between(&page, "<!-- scripts -->", "<!-- /scripts -->", &script)
}

/// The text with the part between two marks replaced; unchanged if a mark is missing.
fn between(text: &str, open: &str, close: &str, new: &str) -> String {
    let Some((before, rest)) = text.split_once(open) else {
        return text.to_owned();
    };
    let Some((_, after)) = rest.split_once(close) else {
        return text.to_owned();
    };
    format!("{before}{open}{new}{close}{after}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_asks_for_nothing_outside_itself() {
        let html = report("a < b", r#"{"title":"</script><script>"}"#);
        assert!(html.contains("<title>a &lt; b</title>"));
        assert!(
            !html.contains("</script><script>"),
            "a snapshot cannot leave its element"
        );
        for outside in ["src=\"", "rel=\"", "from \"./"] {
            assert!(!html.contains(outside), "{outside}");
        }
        for script in SCRIPTS {
            assert!(
                html.contains(&format!("\nmodules[\"{}\"] = ", script.name)),
                "{}",
                script.name
            );
        }
    }

    #[test]
    fn a_report_runs_one_script_and_loads_none() {
        let html = report("pair", r#"{"title":"a"}"#);
        let between = |open: &str, close: &str| {
            let (_, rest) = html.split_once(open).expect(open);
            rest.split_once(close).expect(close).0
        };
        let policy = between("http-equiv=\"Content-Security-Policy\" content=\"", "\"");
        let rule = |name: &str| policy.split("; ").find(|rule| rule.starts_with(name));
        let script = between("<script type=\"module\">", "</script>");
        assert_eq!(
            rule("script-src"),
            Some(&*format!("script-src {}", policy::source(script)))
        );
        assert_eq!(rule("default-src"), Some("default-src 'none'"));
        assert!(
            !script.contains("<!--"),
            "it would hide the end of the script"
        );
        for line in script.lines() {
            assert!(!line.starts_with("import "), "{line}");
        }
    }

    #[test]
    fn every_import_is_an_asset() {
        for script in SCRIPTS.iter().chain(&START_SCRIPTS) {
            for import in script.text.split("from \"./").skip(1) {
                let name = import.split('"').next().expect("a name");
                assert!(asset(name).is_some(), "{} imports {name}", script.name);
            }
        }
        for name in ["../Cargo.toml", "", "index.html", "main.js/", "/main.js"] {
            assert!(asset(name).is_none(), "{name}");
        }
    }
}
