use super::*;

fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(directory)
        .expect("readable")
        .map(|entry| {
            entry
                .expect("entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn files_are_written_whole_into_a_new_directory_and_over_old_ones() {
    let root = tempfile::tempdir().expect("a place to write");
    let directory = root.path().join("a").join("b");
    let mut bundle = Bundle::default();
    bundle.add("one.txt", b"first".to_vec()).expect("plain");
    bundle.add("two.txt", vec![7; 100_000]).expect("plain");
    let paths = bundle.write_to(&directory).expect("written");
    assert_eq!(paths.len(), 2);
    assert_eq!(names(&directory), ["one.txt", "two.txt"]);
    let mut second = Bundle::default();
    second.add("one.txt", b"second".to_vec()).expect("plain");
    second.write_to(&directory).expect("written over");
    assert_eq!(
        fs::read(directory.join("one.txt")).expect("there"),
        b"second"
    );
    assert_eq!(names(&directory), ["one.txt", "two.txt"]);
}

#[test]
fn a_failure_leaves_old_files_and_no_temporaries() {
    let root = tempfile::tempdir().expect("a place to write");
    fs::write(root.path().join("one.txt"), b"old").expect("written");
    fs::create_dir(root.path().join("two.txt")).expect("a directory in the way");
    let mut bundle = Bundle::default();
    bundle.add("one.txt", b"new".to_vec()).expect("plain");
    bundle.add("two.txt", b"new".to_vec()).expect("plain");
    let error = bundle.write_to(root.path()).expect_err("in the way");
    assert!(error.to_string().contains("two.txt"), "{error}");
    assert_eq!(
        fs::read(root.path().join("one.txt")).expect("there"),
        b"old"
    );
    assert_eq!(names(root.path()), ["one.txt", "two.txt"]);
    let file = root.path().join("one.txt");
    let error = bundle.write_to(&file).expect_err("a file, not a directory");
    assert!(matches!(error, BundleError::Disk { .. }) && error.to_string().contains("one.txt"));
}

#[test]
fn folders_of_a_bundle_are_made() {
    let root = tempfile::tempdir().expect("a place to write");
    let mut bundle = Bundle::default();
    bundle.add("top.txt", b"top".to_vec()).expect("plain");
    bundle.add("a/b/low.txt", b"low".to_vec()).expect("plain");
    bundle.write_to(root.path()).expect("written");
    assert_eq!(names(root.path()), ["a", "top.txt"]);
    let low = root.path().join("a").join("b");
    assert_eq!(names(&low), ["low.txt"]);
    assert_eq!(fs::read(low.join("low.txt")).expect("there"), b"low");
}

#[test]
fn one_file_is_written_over_the_old_one_or_not_at_all() {
    let root = tempfile::tempdir().expect("a place to write");
    let path = root.path().join("new").join("gear.step");
    write_file(&path, b"first".to_vec()).expect("written");
    write_file(&path, b"second".to_vec()).expect("written over");
    assert_eq!(fs::read(&path).expect("there"), b"second");
    for bad in ["..", "/", "new/gear.step/below", "new/.hidden"] {
        assert!(write_file(&root.path().join(bad), vec![]).is_err(), "{bad}");
    }
    assert_eq!(names(path.parent().expect("a folder")), ["gear.step"]);
}

#[test]
fn many_threads_write_the_same_files_into_one_folder() {
    let root = tempfile::tempdir().expect("a place to write");
    let bundle = |letter: u8| {
        let mut bundle = Bundle::default();
        for name in ["one.txt", "two.txt", "deep/three.txt"] {
            bundle.add(name, vec![letter; 20_000]).expect("plain");
        }
        bundle
    };
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let (root, bundle) = (root.path(), bundle(b'a' + thread));
            scope.spawn(move || {
                for _ in 0..12 {
                    bundle.write_to(root).expect("written");
                    let read = fs::read(root.join("deep/three.txt")).expect("there");
                    assert_eq!(read, vec![read[0]; 20_000]);
                }
            });
        }
    });
    assert_eq!(names(root.path()), ["deep", "one.txt", "two.txt"]);
    assert_eq!(names(&root.path().join("deep")), ["three.txt"]);
}

#[test]
fn a_cancelled_write_leaves_what_was_there() {
    let root = tempfile::tempdir().expect("a place to write");
    fs::write(root.path().join("one.txt"), b"old").expect("written");
    let mut bundle = Bundle::default();
    bundle.add("one.txt", b"new".to_vec()).expect("plain");
    let cancel = centrode_geometry::Cancel::default();
    cancel.cancel();
    assert!(cancel.run(|| bundle.write_to(root.path())).is_err());
    assert_eq!(names(root.path()), ["one.txt"]);
    assert_eq!(
        fs::read(root.path().join("one.txt")).expect("there"),
        b"old"
    );
}

#[test]
fn an_archive_holds_every_file() {
    let mut bundle = Bundle::default();
    bundle.add("one.txt", b"first".to_vec()).expect("plain");
    bundle.add("two.bin", vec![7; 100_000]).expect("plain");
    let bytes = bundle.zip().expect("small");
    assert_eq!(bytes, bundle.zip().expect("small"));
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).expect("a zip");
    assert_eq!(archive.len(), 2);
    for (name, content) in bundle.files() {
        let mut file = archive.by_name(name).expect("there");
        let mut read = Vec::new();
        io::Read::read_to_end(&mut file, &mut read).expect("readable");
        assert_eq!(read, content);
    }
}

#[cfg(unix)]
#[test]
fn a_private_file_stays_private() {
    use std::os::unix::fs::PermissionsExt as _;
    let root = tempfile::tempdir().expect("a place to write");
    let path = root.path().join("one.txt");
    fs::write(&path, b"old").expect("written");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("set");
    let mut bundle = Bundle::default();
    bundle.add("one.txt", b"new".to_vec()).expect("plain");
    bundle.write_to(root.path()).expect("written");
    let mode = fs::metadata(&path).expect("there").permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    assert_eq!(fs::read(&path).expect("there"), b"new");
}

#[cfg(unix)]
#[test]
fn links_are_written_through_and_what_is_no_file_is_refused() {
    use std::os::unix::{fs::symlink, net::UnixListener};
    let root = tempfile::tempdir().expect("a place to write");
    let [deep, link, socket] = ["deep", "link", "socket"].map(|name| root.path().join(name));
    fs::create_dir(&deep).expect("made");
    symlink("deep/between", &link).expect("linked");
    symlink("one.txt", deep.join("between")).expect("linked");
    for text in [b"first", b"other"] {
        // First made, then written over.
        write_file(&link, text.to_vec()).expect("written");
        assert_eq!(fs::read(deep.join("one.txt")).expect("there"), text);
        assert!(link.is_symlink() && deep.join("between").is_symlink());
    }
    assert_eq!(names(&deep), ["between", "one.txt"]);
    symlink("loop", root.path().join("loop")).expect("linked");
    assert!(write_file(&root.path().join("loop"), vec![]).is_err());
    let _listener = UnixListener::bind(&socket).expect("bound");
    symlink("socket", root.path().join("to-socket")).expect("linked");
    for name in ["socket", "to-socket"] {
        let error = write_file(&root.path().join(name), vec![]).expect_err("a socket");
        assert!(error.to_string().contains("not a regular file"), "{error}");
    }
    assert!(!socket.is_file() && root.path().join("to-socket").is_symlink());
    let all = ["deep", "link", "loop", "socket", "to-socket"];
    assert_eq!(names(root.path()), all);
}

#[test]
fn names_that_lead_elsewhere_or_repeat_are_refused() {
    let mut bundle = Bundle::default();
    for name in [
        "", "..", ".hidden", "a//b", "a\\b", "c:d", "/etc", "a\nb", "../x", "a/../b", "a/", "a/.b",
    ] {
        assert!(
            matches!(bundle.add(name, vec![]), Err(BundleError::Name { .. })),
            "{name}"
        );
    }
    bundle.add("a.dxf", vec![]).expect("plain");
    assert!(matches!(
        bundle.add("A.DXF", vec![]),
        Err(BundleError::Twice { .. })
    ));
}

#[test]
fn a_new_file_is_there_whole_and_none_is_replaced() {
    let root = tempfile::tempdir().expect("a place to write");
    let names = || fs::read_dir(root.path()).expect("readable").count();
    for (number, bytes) in [&b""[..], b"a", &[0; 70_000], "\u{3c0}".as_bytes()]
        .into_iter()
        .enumerate()
    {
        let path = root.path().join(format!("{number}.toml"));
        write_new_file(&path, bytes).expect("written");
        assert_eq!(fs::read(&path).expect("there"), bytes);
        let error = write_new_file(&path, b"other").expect_err("taken");
        let BundleError::Disk { source, .. } = error else {
            panic!("{error}");
        };
        assert_eq!(source.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&path).expect("there"), bytes);
        assert_eq!(names(), number + 1, "nothing is left behind");
    }
    fs::create_dir(root.path().join("folder")).expect("a folder");
    let bad = [
        "folder",
        "",
        ".hidden",
        "..",
        "no/such/a.toml",
        "0.toml/a.toml",
    ];
    for name in bad {
        assert!(
            write_new_file(&root.path().join(name), b"a").is_err(),
            "{name}"
        );
    }
    #[cfg(unix)]
    for (name, target) in [("dead", "nowhere"), ("alive", "0.toml"), ("self", "self")] {
        std::os::unix::fs::symlink(target, root.path().join(name)).expect("linked");
        assert!(
            write_new_file(&root.path().join(name), b"a").is_err(),
            "{name}"
        );
    }
    assert!(!root.path().join("nowhere").exists());
}

#[cfg(unix)]
#[test]
fn a_read_only_file_and_all_others_of_its_set_stay_as_they_were() {
    use std::os::unix::fs::PermissionsExt as _;

    let root = tempfile::tempdir().expect("a place to write");
    let [old, new] = ["old", "new"].map(|text| {
        let mut bundle = Bundle::default();
        for name in ["a.txt", "b.txt", "sub/c.txt"] {
            bundle.add(name, text.into()).expect("a name");
        }
        bundle
    });
    old.write_to(root.path()).expect("written");
    let path = |name: &str| root.path().join(name);
    let read = |name: &str| fs::read_to_string(path(name)).expect("there");
    let set = |name: &str, mode: u32| {
        fs::set_permissions(path(name), fs::Permissions::from_mode(mode)).expect("set");
    };
    std::os::unix::fs::symlink("b.txt", path("link.txt")).expect("linked");
    let mut linked = Bundle::default();
    linked.add("link.txt", b"new".to_vec()).expect("a name");
    for mode in [0o444, 0o400, 0o555, 0o440, 0o404] {
        for name in ["a.txt", "b.txt", "sub/c.txt"] {
            set(name, mode);
            let error = new
                .write_to(root.path())
                .expect_err("read-only")
                .to_string();
            assert!(
                error.contains(name) && error.contains("read-only"),
                "{error}"
            );
            assert_eq!(linked.write_to(root.path()).is_err(), name == "b.txt");
            assert_eq!(["a.txt", "sub/c.txt"].map(read), ["old"; 2]);
            set(name, 0o644);
            old.write_to(root.path()).expect("written");
        }
    }
    for mode in [0o644, 0o600, 0o755, 0o200, 0o660] {
        set("a.txt", mode);
        new.write_to(root.path()).expect("written");
        let kept = fs::metadata(path("a.txt"))
            .expect("there")
            .permissions()
            .mode();
        assert_eq!(kept & 0o777, mode);
    }
}

fn bundle_of(files: &[(&str, &str)]) -> Bundle {
    let mut bundle = Bundle::default();
    for (name, text) in files {
        bundle.add(name, text.as_bytes().to_vec()).expect("plain");
    }
    bundle
}

/// Each step changes a file by hand, or exports files, which works or is refused with the names of some.
#[test]
fn an_export_replaces_only_files_that_exports_wrote() {
    enum Step {
        Edit(&'static str, &'static str),
        Export(&'static [(&'static str, &'static str)]),
        Refused(&'static [(&'static str, &'static str)], &'static str),
        Force(&'static [(&'static str, &'static str)]),
    }
    use Step::{Edit, Export, Force, Refused};
    let cases: [&[Step]; 10] = [
        // A file of somebody else.
        &[Edit("a.dxf", "mine"), Refused(&[("a.dxf", "1")], "a.dxf")],
        // The same with equal contents loses nothing.
        &[
            Edit("a.dxf", "1"),
            Export(&[("a.dxf", "1")]),
            Export(&[("a.dxf", "2")]),
        ],
        // Own files are replaced again and again.
        &[
            Export(&[("a.dxf", "1")]),
            Export(&[("a.dxf", "2")]),
            Export(&[("a.dxf", "1")]),
        ],
        // A file changed by hand since.
        &[
            Export(&[("a.dxf", "1")]),
            Edit("a.dxf", "1 and a hole"),
            Refused(&[("a.dxf", "2")], "a.dxf"),
        ],
        // Exports of other parts into one folder know each other.
        &[
            Export(&[("a.dxf", "1")]),
            Export(&[("b.dxf", "1")]),
            Export(&[("a.dxf", "2"), ("b.dxf", "2")]),
        ],
        // Files in folders of the folder.
        &[
            Edit("collision/hub.stl", "mine"),
            Refused(&[("collision/hub.stl", "1")], "collision/hub.stl"),
        ],
        &[Export(&[("c/h.stl", "1")]), Export(&[("c/h.stl", "2")])],
        // Other files stay, and are no hindrance.
        &[
            Edit("notes.txt", "mine"),
            Export(&[("a.dxf", "1")]),
            Export(&[("a.dxf", "2")]),
        ],
        // All are named, and none is written.
        &[
            Edit("a.dxf", "mine"),
            Export(&[("b.dxf", "1")]),
            Edit("c.dxf", "mine"),
            Refused(
                &[("a.dxf", "1"), ("b.dxf", "2"), ("c.dxf", "1")],
                "a.dxf, c.dxf;",
            ),
        ],
        // Force replaces, and what it wrote is known.
        &[
            Edit("a.dxf", "mine"),
            Force(&[("a.dxf", "1")]),
            Export(&[("a.dxf", "2")]),
        ],
    ];
    for (number, steps) in cases.into_iter().enumerate() {
        let root = tempfile::tempdir().expect("a place to write");
        let text = |name: &str| fs::read_to_string(root.path().join(name)).ok();
        for step in steps {
            let (files, force) = match step {
                Edit(name, text) => {
                    let path = root.path().join(name);
                    fs::create_dir_all(path.parent().expect("a folder")).expect("made");
                    fs::write(path, text).expect("written");
                    continue;
                }
                Export(files) | Refused(files, _) => (files, false),
                Force(files) => (files, true),
            };
            let before: Vec<_> = files.iter().map(|(name, _)| text(name)).collect();
            let found = bundle_of(files).export_to(root.path(), force);
            match step {
                Refused(files, names) => {
                    let error = found.expect_err("refused").to_string();
                    assert!(error.contains(names), "{number}: {error}");
                    let after: Vec<_> = files.iter().map(|(name, _)| text(name)).collect();
                    assert_eq!(after, before, "{number}");
                }
                _ => {
                    let written = found.unwrap_or_else(|error| panic!("{number}: {error}"));
                    let expected = files.iter().map(|(name, _)| root.path().join(name));
                    assert_eq!(written, expected.collect::<Vec<_>>(), "{number}");
                    for (name, new) in *files {
                        assert_eq!(text(name).as_deref(), Some(*new), "{number}");
                    }
                }
            }
        }
    }
}

#[test]
fn an_export_continues_after_a_kill_between_two_names() {
    let [old, new] = ["old", "new"].map(|text| bundle_of(&[("a.dxf", text), ("b.dxf", text)]));
    let root = tempfile::tempdir().expect("a place to write");
    old.export_to(root.path(), false).expect("written");
    // The manifest is the first name, then a.dxf.
    let manifest = new.manifest(root.path(), false).expect("no other files");
    fs::write(root.path().join(MANIFEST), manifest).expect("written");
    fs::write(root.path().join("a.dxf"), "new").expect("written");
    for bundle in [new, old] {
        bundle.export_to(root.path(), false).expect("written");
    }
    let lines = fs::read_to_string(root.path().join(MANIFEST)).expect("there");
    assert!(lines.lines().count() <= 4, "{lines}");
}
