use centrode::analysis::Report;
use centrode::export::page::{Curve, Picture};
use centrode::mechanism::design::{DesignError, DesignFile};
use serde::Serialize;

use super::field::{Table, tables};
use super::gear_pair;
use crate::report;

/// What the page shows of one design state.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Snapshot {
    /// The design file.
    text: String,
    name: String,
    title: String,
    /// What it is, in a line.
    definition: String,
    /// The numbers of the design, table by table.
    tables: Vec<Table>,
    /// Why there is no mechanism.
    error: Option<Fault>,
    picture: Option<Picture>,
    curves: Vec<Curve>,
    verdict: Option<Verdict>,
}

/// An error at its key, in the words of the command line.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Fault {
    key: String,
    line: usize,
    column: usize,
    message: String,
}

/// What the checks say.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Verdict {
    ok: bool,
    summary: String,
    findings: Vec<report::Words>,
    figures: Vec<report::Group>,
}

impl From<&DesignError> for Fault {
    fn from(error: &DesignError) -> Self {
        Self {
            key: error.key.clone(),
            line: error.line,
            column: error.column,
            message: error.message(),
        }
    }
}

impl Verdict {
    fn of(found: &Report) -> Self {
        Self {
            ok: found.ok(),
            summary: report::summary(found),
            findings: found.findings.iter().map(report::words).collect(),
            figures: report::groups(found),
        }
    }
}

/// A design that has become a mechanism.
pub(crate) struct Subject {
    snapshot: Snapshot,
    pair: Box<centrode::mechanism::gear::GearPair>,
}

impl Snapshot {
    /// The design alone: its text and numbers.
    pub(crate) fn of_text(text: String) -> Self {
        Self {
            tables: tables(&text),
            text,
            ..Self::default()
        }
    }

    /// The same with the reason why there is no mechanism.
    pub(crate) fn with_error(mut self, error: &DesignError) -> Self {
        self.error = Some(error.into());
        self
    }

    /// Title, or name where there is none.
    pub(crate) fn heading(&self) -> &str {
        if self.title.is_empty() {
            &self.name
        } else {
            &self.title
        }
    }

    /// Whether there is a mechanism without a finding of severity error.
    pub(crate) fn ok(&self) -> bool {
        self.verdict.as_ref().is_some_and(|verdict| verdict.ok)
    }

    /// As JSON; what is not finite is null.
    pub(crate) fn json(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

impl Subject {
    /// Resolves a design file and draws it; without a mechanism, the snapshot says why.
    pub(crate) fn of(text: String) -> Result<Self, Box<Snapshot>> {
        let mut snapshot = Snapshot::of_text(text);
        let resolved = DesignFile::read(snapshot.text.as_bytes())
            .and_then(|file| file.gear_pair().map(|pair| (file, pair)));
        let (file, pair) = match resolved {
            Ok(both) => both,
            Err(error) => return Err(Box::new(snapshot.with_error(&error))),
        };
        snapshot.name = pair.name().into();
        snapshot.title = pair.title().into();
        snapshot.definition = gear_pair::definition(&pair);
        snapshot.picture = Some(gear_pair::picture(file.design(), &pair));
        snapshot.curves = centrode::export::gear_pair::curves(&pair);
        Ok(Self {
            snapshot,
            pair: Box::new(pair),
        })
    }

    /// Whether this is the mechanism of a text.
    pub(crate) fn is_of(&self, text: &str) -> bool {
        self.snapshot.text == text
    }

    /// The picture without what the checks say.
    pub(crate) fn drawn(&self) -> Snapshot {
        self.snapshot.clone()
    }

    /// The picture with what the checks say.
    pub(crate) fn checked(&self) -> Snapshot {
        let mut snapshot = self.snapshot.clone();
        let contact = centrode::analysis::Contact::of(&self.pair);
        let found = centrode::analysis::check_contact(&self.pair, &contact);
        snapshot.curves.extend(gear_pair::contact_curves(&contact));
        snapshot.verdict = Some(Verdict::of(&found));
        snapshot
    }
}
