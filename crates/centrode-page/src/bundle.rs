//! The modules of the page as one script: one hash in the page's policy then covers all code that runs.
//!
//! A module becomes a function that is called once, after those whose names it imports; its result holds the names it exports.

use super::Asset;

/// One script of the module `main` and of all that it imports.
///
/// Imports and exports must be in one line each; modules must not import each other in a circle.
pub(super) fn script(main: &'static str, modules: &[Asset]) -> String {
    let mut text = String::from("const modules = {};\n");
    add(main, modules, &mut Vec::new(), &mut text);
    text
}

fn add(name: &'static str, modules: &[Asset], done: &mut Vec<&'static str>, text: &mut String) {
    let Some(module) = modules.iter().find(|m| m.name == name) else {
        return;
    };
    if done.contains(&name) {
        return;
    }
    done.push(name);
    let (mut body, mut exported) = (String::new(), Vec::new());
    let mut is_comment = false;
    for line in module.text.lines() {
        is_comment |= line.starts_with("/*");
        if is_comment {
            is_comment = !line.contains("*/");
            body.push_str(line);
            body.push('\n');
        } else if let Some((names, from)) = import(line) {
            add(from, modules, done, text);
            body.push_str(&format!("const {names} = modules[\"{from}\"];\n"));
        } else if let Some(names) = line.strip_prefix("export {") {
            exported.push(renamed(names.trim_end_matches([';', ' ', '}']), true));
        } else if let Some(declaration) = line.strip_prefix("export ") {
            exported.push(declared(declaration).to_owned());
            body.push_str(declaration);
            body.push('\n');
        } else {
            body.push_str(line);
            body.push('\n');
        }
    }
    let exported = exported.join(", ");
    text.push_str(&format!(
        "modules[\"{name}\"] = (() => {{\n{body}return {{ {exported} }};\n}})();\n"
    ));
}

/// Pattern of the names that a line imports, and the module they are from.
fn import(line: &'static str) -> Option<(String, &'static str)> {
    let (names, from) = line.strip_prefix("import ")?.split_once(" from \"./")?;
    let (from, _) = from.split_once('"')?;
    let names = match (names.strip_prefix("* as "), names.starts_with('{')) {
        (Some(all), _) => all.to_owned(),
        (None, true) => renamed(names, false),
        (None, false) => format!("{{ default: {names} }}"),
    };
    Some((names, from))
}

/// Names of an import or, if `is_export`, of an export, written as those of an object: `a as b` becomes `a: b` or `b: a`.
fn renamed(names: &str, is_export: bool) -> String {
    let one = |name: &str| match name.split_once(" as ") {
        Some((inside, outside)) if is_export => format!("{}: {}", outside.trim(), inside.trim()),
        Some((outside, inside)) => format!("{}: {}", outside, inside),
        None => name.to_owned(),
    };
    let names: Vec<String> = names.split(',').map(one).collect();
    names.join(",")
}

/// The name that a declaration declares.
fn declared(declaration: &str) -> &str {
    let name = declaration
        .split([' ', '(', '*'])
        .find(|word| !["async", "class", "const", "function", ""].contains(word));
    name.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn module(name: &'static str, text: &'static str) -> Asset {
        let media_type = "";
        Asset {
            name,
            media_type,
            text,
        }
    }

    #[test]
    fn every_kind_of_import_and_export_becomes_plain_script() {
        for (line, name) in [
            ("class Charts {", "Charts"),
            ("class Away extends Error {", "Away"),
            ("function labels(x) {", "labels"),
            ("async function take(a) {", "take"),
            ("function* steps(n) {", "steps"),
            ("function *steps(n) {", "steps"),
            ("const FAINT = 0.35;", "FAINT"),
            ("const files = async () => {", "files"),
            ("const LOOK = { ink: 1 };", "LOOK"),
            ("const WHOLE = Array.from({ length: 3 });", "WHOLE"),
        ] {
            assert_eq!(declared(line), name, "{line}");
        }
        for (line, names, from) in [
            ("import { a } from \"./x.js\";", "{ a }", "x.js"),
            ("import { a, b } from \"./x.js\";", "{ a, b }", "x.js"),
            ("import { a as b } from \"./x.js\";", "{ a: b }", "x.js"),
            (
                "import { a, b as c, d } from \"./x.js\";",
                "{ a, b: c, d }",
                "x.js",
            ),
            ("import * as x from \"./x-y.js\";", "x", "x-y.js"),
            ("import x from \"./x.js\";", "{ default: x }", "x.js"),
        ] {
            assert_eq!(import(line), Some((names.into(), from)), "{line}");
        }
        for line in [
            "const a = 1;",
            "  import { a } from \"./x.js\";",
            "importance()",
        ] {
            assert_eq!(import(line), None, "{line}");
        }
        assert_eq!(renamed(" u as default", true), "default: u");
        assert_eq!(renamed(" a, b as c", true), " a,c: b");
    }

    #[test]
    fn modules_come_once_and_after_those_they_import() {
        let modules = [
            module(
                "main.js",
                "/* old:\nexport const c = 1;\n*/\nimport { a } from \"./a.js\";\nimport b from \"./b.js\";\na(b);",
            ),
            module("a.js", "import b from \"./b.js\";\nexport const a = b;"),
            module("b.js", "const b = 1;\nexport { b as default };"),
            module("other.js", "export const never = 1;"),
        ];
        assert_eq!(
            script("main.js", &modules),
            "const modules = {};\n\
             modules[\"b.js\"] = (() => {\nconst b = 1;\nreturn { default: b };\n})();\n\
             modules[\"a.js\"] = (() => {\nconst { default: b } = modules[\"b.js\"];\nconst a = b;\nreturn { a };\n})();\n\
             modules[\"main.js\"] = (() => {\n/* old:\nexport const c = 1;\n*/\nconst { a } = modules[\"a.js\"];\nconst { default: b } = modules[\"b.js\"];\na(b);\nreturn {  };\n})();\n"
        );
    }
}
