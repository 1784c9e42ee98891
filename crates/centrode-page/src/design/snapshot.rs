use super::detail::{LeftOut, Made};
use super::field::{Table, tables};
use super::machine::compose::Composition;
use crate::words::{self, FindingWords, GoalWords, Section};
use centrode_analysis::Report;
use centrode_export::picture::{Curve, CurveList, Picture};
use centrode_families::{FAMILIES, Limit, Mechanism};
use centrode_geometry::run_both;
use centrode_spec::{DesignError, visible};
use serde::Serialize;
use std::sync::{Arc, OnceLock};

/// Snapshot of one design state for the page.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Snapshot {
    /// Text of the design file.
    text: String,
    name: String,
    title: String,
    /// Definition of the mechanism, in a line.
    definition: String,
    /// Reason why there is no mechanism.
    error: Option<Fault>,
    /// Error of a detail of a body: picture, curves and checks are those of the design without the detail.
    detail: Option<Fault>,
    #[serde(skip)]
    left_out: Option<Arc<LeftOut>>,
    #[serde(skip)]
    picture: Option<Picture>,
    /// Whether the picture lacks details that take longer to make.
    coarse: bool,
    /// Whether its goals are reported before the rest of the checks.
    goals_first: bool,
    #[serde(skip)]
    beside: Adjacent,
    /// Speed of the input, rad/s, if the design has one.
    speed: Option<f64>,
    /// Parts of a composed machine; `None` for any other design.
    compose: Option<Composition>,
    verdict: Option<Verdict>,
}

/// Numbers and curves, which the page shows after the picture.
#[derive(Clone, Debug, Default)]
struct Adjacent {
    /// The numbers of the design, table by table.
    tables: Vec<Table>,
    curves: Vec<Curve>,
}

/// An error with its key, in the words of the command line.
#[derive(Clone, Debug, Serialize)]
pub struct Fault {
    key: String,
    /// Line from one; zero if the error has no position in the file.
    line: usize,
    column: usize,
    message: String,
    /// The message without the key: it is shown next to its field.
    rule: String,
}

/// Results of the checks.
#[derive(Clone, Debug, Serialize)]
struct Verdict {
    ok: bool,
    summary: String,
    findings: Vec<FindingWords>,
    #[serde(flatten)]
    goals: Goals,
    figures: Vec<Section>,
}

/// Goals, and what is required of the figures drawn along the cycle.
#[derive(Clone, Debug, Serialize)]
pub struct Goals {
    goals: Vec<GoalWords>,
    limits: Vec<Limit>,
}

impl From<&DesignError> for Fault {
    fn from(error: &DesignError) -> Self {
        Self {
            key: error.key.clone(),
            line: error.line,
            column: error.column,
            message: error.message(),
            rule: visible(&error.fault.to_string()),
        }
    }
}

impl Verdict {
    fn new(mechanism: &dyn Mechanism, found: &Report) -> Self {
        Self {
            ok: found.ok(),
            summary: words::summary(found),
            findings: found.findings.iter().map(words::finding_words).collect(),
            goals: Goals::new(mechanism, found),
            figures: words::sections(found),
        }
    }
}

impl Goals {
    fn new(mechanism: &dyn Mechanism, found: &Report) -> Self {
        Self {
            goals: found.goals.iter().map(words::goal_words).collect(),
            limits: mechanism.limits(found),
        }
    }
}

/// Picture of a design alone, as JSON, as its page shows it before the details are made.
///
/// # Errors
/// The reason in words if there is no mechanism.
pub fn drawn(text: &str) -> Result<String, String> {
    let mechanism = resolved(text).map_err(|error| error.message())?;
    serde_json::to_string(&mechanism.picture()).map_err(|error| error.to_string())
}

/// Mechanism of a design file.
pub(super) fn resolved(text: &str) -> Result<Arc<dyn Mechanism>, DesignError> {
    FAMILIES.read(text.as_bytes())?.mechanism()
}

/// Design that has become a mechanism.
#[derive(Debug)]
pub struct Subject {
    snapshot: Snapshot,
    /// Text of the design with the samples of its files.
    whole: String,
    mechanism: Arc<dyn Mechanism>,
    beside: OnceLock<Adjacent>,
    /// Picture in detail, once it has been requested.
    detailed: OnceLock<Option<Picture>>,
}

impl Snapshot {
    /// Snapshot of the design alone: its text and numbers.
    fn of(text: String) -> Self {
        let tables = tables(&text);
        let curves = Vec::new();
        Self {
            compose: Composition::empty(&text),
            text,
            beside: Adjacent { tables, curves },
            ..Self::default()
        }
    }

    /// Snapshot with the reason why there is no mechanism.
    fn with_error(text: String, error: &DesignError) -> Self {
        Self {
            error: Some(error.into()),
            ..Self::of(text)
        }
    }

    /// Snapshot of a design whose solving was cancelled: its numbers, so that they can be changed.
    pub fn cancelled(text: String) -> Self {
        Self {
            error: Some(Fault {
                key: String::new(),
                line: 0,
                column: 0,
                message: "cancelled; the next change starts a new calculation".into(),
                rule: String::new(),
            }),
            ..Self::of(text)
        }
    }

    /// Title, or the name if there is no title.
    pub fn heading(&self) -> &str {
        if self.title.is_empty() {
            &self.name
        } else {
            &self.title
        }
    }

    /// Whether there is a mechanism without a finding of severity error.
    pub fn ok(&self) -> bool {
        self.verdict.as_ref().is_some_and(|verdict| verdict.ok)
    }

    /// Snapshot as JSON; numbers that are not finite are null.
    ///
    /// # Errors
    /// The error of the JSON writer.
    pub fn json(&self) -> serde_json::Result<String> {
        // Two threads write the two long parts.
        let (head, beside) = run_both(|| self.head(), || self.beside.json());
        Ok(head? + &beside?)
    }

    /// The beginning of the snapshot's JSON; the JSON of numbers and curves follows it.
    fn head(&self) -> serde_json::Result<String> {
        let picture = serde_json::to_string(&self.picture)?;
        let rest = serde_json::to_string(self)?;
        // The outer braces belong to the whole JSON value.
        let rest = &rest[1..rest.len() - 1];
        Ok(format!("{{\"picture\":{picture},{rest}"))
    }
}

impl Adjacent {
    fn json(&self) -> serde_json::Result<String> {
        let tables = serde_json::to_string(&self.tables)?;
        let curves = serde_json::to_string(&CurveList(&self.curves))?;
        Ok(format!(",\"tables\":{tables},\"curves\":{curves}}}"))
    }
}

impl Subject {
    /// Resolves a design file and draws it. If there is no mechanism, the snapshot has the reason.
    ///
    /// # Errors
    /// The snapshot with the reason.
    pub fn from_text(text: String) -> Result<Self, Box<Snapshot>> {
        match resolved(&text) {
            Ok(mechanism) => Ok(Self::new(text.clone(), text, mechanism)),
            Err(error) => Err(Box::new(Snapshot::with_error(text, &error))),
        }
    }

    /// Resolves and draws a design that is being edited: an impossible detail of a body becomes a finding, and the rest is drawn
    /// without it. `whole` is its text with the samples of its files, or the reason why there are none.
    ///
    /// # Errors
    /// The snapshot with the reason.
    pub fn without_faulty_details(
        text: String,
        whole: Result<String, DesignError>,
    ) -> Result<Self, Box<Snapshot>> {
        let made = whole.and_then(|whole| Ok((Made::new(&whole)?, whole)));
        match made {
            Ok((made, whole)) => {
                let mut subject = Self::new(text, whole, made.mechanism);
                subject.snapshot.detail = made.left_out.as_ref().map(|left_out| Fault {
                    message: left_out.message(),
                    ..Fault::from(&left_out.error)
                });
                subject.snapshot.left_out = made.left_out.map(Arc::new);
                Ok(subject)
            }
            Err(error) => Err(Box::new(Snapshot::with_error(text, &error))),
        }
    }

    fn new(text: String, whole: String, mechanism: Arc<dyn Mechanism>) -> Self {
        let snapshot = Snapshot {
            compose: Composition::of(&*mechanism, &text),
            text,
            name: mechanism.design().name().into(),
            title: mechanism.design().title().into(),
            definition: mechanism.definition(),
            picture: Some(mechanism.picture()),
            coarse: mechanism.is_coarse(),
            goals_first: mechanism.goals_come_first(),
            speed: mechanism.input_speed(),
            ..Snapshot::default()
        };
        Self {
            snapshot,
            whole,
            mechanism,
            beside: OnceLock::new(),
            detailed: OnceLock::new(),
        }
    }

    /// Whether this is the mechanism of a text, which with the samples of its files is `whole`.
    pub fn is_of(&self, text: &str, whole: &str) -> bool {
        self.snapshot.text == text && self.whole == whole
    }

    /// Snapshot with the picture but without the results of the checks, as JSON in two parts: the picture is in the first.
    ///
    /// # Errors
    /// The error of the JSON writer.
    pub fn drawn(&self, send: &dyn Fn(String)) -> serde_json::Result<()> {
        send(self.snapshot.head()? + "\n");
        send(self.beside().json()?);
        Ok(())
    }

    fn beside(&self) -> &Adjacent {
        // One thread is enough: the browser draws the picture meanwhile.
        self.beside.get_or_init(|| Adjacent {
            tables: tables(&self.snapshot.text),
            curves: self.mechanism.curves(),
        })
    }

    /// Snapshot with the picture in detail.
    pub fn detailed(&self) -> Snapshot {
        let mut snapshot = self.snapshot.clone();
        snapshot.coarse = false;
        snapshot.beside = self.beside().clone();
        let detailed = self.detailed.get_or_init(|| self.mechanism.detailed());
        if let Some(picture) = detailed {
            snapshot.picture = Some(picture.clone());
        }
        snapshot
    }

    /// Goals, checked as far as the motion shows.
    pub fn goals(&self) -> Goals {
        Goals::new(&*self.mechanism, &self.mechanism.check_goals())
    }

    /// Snapshot with the results of the checks.
    pub fn checked(&self) -> Snapshot {
        let mut snapshot = self.detailed();
        let (mut found, curves) = self.mechanism.check_with_curves();
        if let Some(left_out) = &snapshot.left_out {
            left_out.report(&mut found);
        }
        snapshot.beside.curves.extend(curves);
        snapshot.verdict = Some(Verdict::new(&*self.mechanism, &found));
        snapshot
    }
}
