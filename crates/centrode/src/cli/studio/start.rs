use super::StudioState;
use super::document::Document;
use crate::FAMILIES;
use crate::cli::failure::Failure;
use crate::cli::shipped::{shipped, shipped_of};
use crate::formats::{BundleError, write_new_file};
use axum::Router;
use centrode_spec::DesignFile;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;
use std::{fs, io};

/// Maximum number of designs of the folder that are listed.
const MOST: usize = 100;

/// Ending of the files that the start page opens and makes.
const ENDING: &str = "toml";

/// Start page: the designs that can be opened from it, and the design pages that were opened.
pub(crate) struct StartPage {
    /// Folder in which the program was started.
    folder: PathBuf,
    pages: Mutex<Vec<OpenPage>>,
}

struct OpenPage {
    file: PathBuf,
    routes: Router,
}

/// Text with which a new design file begins.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Pattern {
    /// Shipped design of a name.
    Shipped(String),
    /// Template of a family.
    New(String),
    /// Text from a link.
    Text(String),
}

impl Pattern {
    /// The text; `None` if nothing has the name.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::Shipped(name) => shipped(name),
            Self::New(family) => FAMILIES.template(family),
            Self::Text(text) => Some(text),
        }
    }
}

/// Designs and templates that the start page offers.
#[derive(Debug, Serialize)]
pub(crate) struct Offer {
    folder: String,
    /// Designs of the folder, the most recently changed first.
    files: Vec<Found>,
    /// File names of the folder that are taken.
    taken: Vec<String>,
    families: Vec<OfferedFamily>,
    /// Text of a machine without parts, to be composed on the page.
    empty: &'static str,
}

/// A design file of the folder.
#[derive(Debug, Serialize)]
struct Found {
    file: String,
    title: String,
    family: String,
}

#[derive(Debug, Serialize)]
struct OfferedFamily {
    word: &'static str,
    /// One machine of the family, `a gear pair`.
    noun: &'static str,
    about: &'static str,
    shipped: Vec<OfferedDesign>,
}

#[derive(Debug, Serialize)]
struct OfferedDesign {
    name: &'static str,
    title: String,
}

/// Reason why a file is not opened or made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum OpenError {
    #[error("give the path of a file whose name ends with .{ENDING}")]
    Ending,
    #[error("there is no such design or template to start from")]
    Pattern,
    #[error("{name} exists already; choose another name")]
    Taken { name: String },
    #[error("cannot create {name}: {error}")]
    Make { name: String, error: io::Error },
    #[error("{0}")]
    Open(String),
}

impl From<Failure> for OpenError {
    fn from(failure: Failure) -> Self {
        Self::Open(failure.to_string())
    }
}

impl StartPage {
    /// Start page of a program started in a folder.
    pub(crate) fn new(folder: PathBuf) -> Self {
        Self {
            folder,
            pages: Mutex::default(),
        }
    }

    /// Designs and templates that can be opened now.
    pub(crate) fn offer(&self) -> Offer {
        let (files, taken) = self.found();
        let families = FAMILIES.0.iter().map(|family| OfferedFamily {
            word: family.design.word,
            noun: family.noun,
            about: family.design.about,
            shipped: shipped_of(family.design.word)
                .map(|(name, title)| OfferedDesign { name, title })
                .collect(),
        });
        Offer {
            folder: self.folder.display().to_string(),
            files,
            taken,
            families: families.collect(),
            empty: crate::page::EMPTY_MACHINE,
        }
    }

    /// Designs of the folder, and all its file names.
    fn found(&self) -> (Vec<Found>, Vec<String>) {
        let mut taken = Vec::new();
        let mut files: Vec<(SystemTime, String)> = Vec::new();
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            // For a link, the file to which it leads.
            let meta = fs::metadata(entry.path()).ok();
            let meta =
                meta.filter(|meta| meta.is_file() && meta.len() <= DesignFile::LARGEST as u64);
            if let Some(meta) = meta.filter(|_| ends_well(Path::new(&name))) {
                let changed = meta.modified().unwrap_or(SystemTime::UNIX_EPOCH);
                files.push((changed, name.clone()));
            }
            taken.push(name);
        }
        files.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        let designs = files
            .into_iter()
            .filter_map(|(_, name)| design_in(&self.folder, name));
        (designs.take(MOST).collect(), taken)
    }

    /// Opens a design file and returns the number of its page.
    pub(crate) fn open(&self, path: &Path) -> Result<usize, OpenError> {
        let path = self.place(path)?;
        let document = Document::open(&path)?;
        let file = document.path();
        let mut pages = self.pages();
        // A file has only one page: two pages would overwrite each other's autosaves.
        if let Some(number) = pages.iter().position(|page| page.file == file) {
            return Ok(number);
        }
        let routes = super::routes::design_page(StudioState::watched(document, true));
        pages.push(OpenPage { file, routes });
        Ok(pages.len() - 1)
    }

    /// Makes a design file from a pattern, and opens it; an existing file is not changed.
    pub(crate) fn make(&self, pattern: &Pattern, path: &Path) -> Result<usize, OpenError> {
        let text = pattern.text().ok_or(OpenError::Pattern)?;
        let path = self.place(path)?;
        let name = path.file_name().and_then(|name| name.to_str());
        let name = name.ok_or(OpenError::Ending)?.to_owned();
        match write_new_file(&path, text.as_bytes()) {
            Ok(()) => self.open(&path),
            Err(BundleError::Disk { source: error, .. }) => Err(match error.kind() {
                io::ErrorKind::AlreadyExists => OpenError::Taken { name },
                _ => OpenError::Make { name, error },
            }),
            Err(error) => Err(OpenError::Open(error.to_string())),
        }
    }

    /// Routes of a design page by its number.
    pub(crate) fn page(&self, number: usize) -> Option<Router> {
        Some(self.pages().get(number)?.routes.clone())
    }

    /// The path relative to the folder of the program; only design files are accepted.
    fn place(&self, path: &Path) -> Result<PathBuf, OpenError> {
        if ends_well(path) {
            Ok(self.folder.join(path))
        } else {
            Err(OpenError::Ending)
        }
    }

    fn pages(&self) -> MutexGuard<'_, Vec<OpenPage>> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether the path has the ending of a design file.
fn ends_well(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| ending.eq_ignore_ascii_case(ENDING))
}

/// The design file, if it names a family.
fn design_in(folder: &Path, file: String) -> Option<Found> {
    let text = fs::read_to_string(folder.join(&file)).ok()?;
    let table: toml::Table = text.parse().ok()?;
    let word = |key: &str| table.get(key).and_then(toml::Value::as_str);
    let family = FAMILIES.named(word("family")?)?.design.word.to_owned();
    let title = word("title")
        .or(word("name"))
        .unwrap_or_default()
        .to_owned();
    Some(Found {
        file,
        title,
        family,
    })
}
