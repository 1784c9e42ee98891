use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use centrode::FAMILIES;
use centrode::family::{self, Family, Resolved};
use centrode_spec::DesignFile;
use pyo3::PyClass;
use pyo3::prelude::{
    Bound, Py, PyAny, PyAnyMethods, PyClassInitializer, PyModule, PyResult, PyTypeMethods, Python,
    pyfunction,
};
use pyo3::types::PyType;

use crate::array::{Course, Values};
use crate::error::{Answer, Raised};
use crate::feeder::Feeder;
use crate::gear_pair::GearPair;
use crate::machine::Machine;
use crate::shaft::{MovingBox, SpiralShaft};
use crate::three_arm::ThreeArm;
use crate::wait::wait;

/// A design file is read no farther than this, bytes.
pub(crate) const LARGEST: usize = DesignFile::LARGEST + 1;

/// The class of one family's machines.
pub(crate) trait Class: PyClass {
    /// A machine of the family.
    type Machine: Resolved;

    /// The machine as what a new object of the class is made of.
    fn start(machine: Arc<Self::Machine>) -> PyClassInitializer<Self>;

    fn machine(&self) -> &Arc<Self::Machine>;

    /// A number of the machine at each of many inputs.
    fn each(
        &self,
        inputs: Values,
        f: impl Fn(&Self::Machine, f64) -> f64 + Send + Sync + 'static,
    ) -> Course {
        let machine = Arc::clone(self.machine());
        Course::each(inputs, move |input| f(&machine, input))
    }

    /// Numbers of the machine at each of many inputs.
    fn rows<const COUNT: usize>(
        &self,
        inputs: Values,
        f: impl Fn(&Self::Machine, f64) -> [f64; COUNT] + Send + Sync + 'static,
    ) -> Course {
        let machine = Arc::clone(self.machine());
        Course::arrays(inputs, &[COUNT], move |input| f(&machine, input))
    }

    /// The machine of a design as what a new object of the class is made of.
    fn made(
        py: Python<'_>,
        design: <Self::Machine as Resolved>::Design,
    ) -> Answer<PyClassInitializer<Self>> {
        let machine = wait(py, move || <Self::Machine as Resolved>::resolve(&design))??;
        Ok(Self::start(Arc::new(machine)))
    }

    /// The object of a machine.
    fn object(py: Python<'_>, machine: Self::Machine) -> Answer<Py<Self>> {
        Ok(Py::new(py, Self::start(Arc::new(machine)))?)
    }
}

/// A class among others.
struct Kind {
    word: &'static str,
    class: for<'py> fn(Python<'py>) -> Bound<'py, PyType>,
    make: for<'py> fn(Python<'py>, &Arc<dyn family::Mechanism>) -> Option<Made<'py>>,
}

type Made<'py> = PyResult<Bound<'py, PyAny>>;

impl Kind {
    const fn new<C: Class>() -> Self {
        Self {
            word: Family::new::<C::Machine>().design.word,
            class: C::type_object,
            make: |py, machine| {
                let machine = Arc::clone(machine).downcast()?;
                Some(Bound::new(py, C::start(machine)).map(Bound::into_any))
            },
        }
    }
}

/// The classes of all families.
const CLASSES: [Kind; 6] = [
    Kind::new::<GearPair>(),
    Kind::new::<ThreeArm>(),
    Kind::new::<SpiralShaft>(),
    Kind::new::<MovingBox>(),
    Kind::new::<Feeder>(),
    Kind::new::<Machine>(),
];

/// The object of a machine: one of the class of its family.
pub(crate) fn object<'py>(
    py: Python<'py>,
    machine: &Arc<dyn family::Mechanism>,
) -> Answer<Bound<'py, PyAny>> {
    let mut classes = CLASSES.iter();
    let made = classes.find_map(|class| (class.make)(py, machine));
    let word = machine.design().family().word;
    Ok(made.ok_or_else(|| {
        let sentence =
            format!("there is no Python class for family {word:?}: use the command line");
        Raised::sentence("family", sentence)
    })??)
}

/// The object, if it is of the class.
pub(crate) fn of_class<'py>(
    class: &Bound<'py, PyType>,
    object: Bound<'py, PyAny>,
) -> Answer<Bound<'py, PyAny>> {
    if object.is_instance(class)? {
        return Ok(object);
    }
    Err(not_of_class(class)?)
}

/// The exception of a machine that is not of a class.
fn not_of_class(class: &Bound<'_, PyType>) -> PyResult<Raised> {
    for kind in &CLASSES {
        if class.is_subclass(&(kind.class)(class.py()))? {
            let sentence = format!("family must be {:?}", kind.word);
            return Ok(Raised::sentence("family", sentence));
        }
    }
    let sentence = format!("{} is not the class of a family", class.name()?);
    Ok(Raised::sentence("family", sentence))
}

/// The machine of a design file's bytes.
pub(crate) fn read(py: Python<'_>, bytes: &[u8]) -> Answer<Arc<dyn family::Mechanism>> {
    let file = FAMILIES.read(bytes)?;
    Ok(wait(py, move || file.mechanism())??)
}

/// The object of a design file's bytes; the files that it names are in its folder, if it has one.
#[pyfunction]
#[pyo3(signature = (contents, folder=None))]
pub(crate) fn _load<'py>(
    py: Python<'py>,
    contents: &[u8],
    folder: Option<PathBuf>,
) -> Answer<Bound<'py, PyAny>> {
    // Reading bytes that are no text gives the error.
    let (Some(folder), Ok(text)) = (folder, std::str::from_utf8(contents)) else {
        return object(py, &read(py, contents)?);
    };
    let whole = FAMILIES.with_files(text, &|file| {
        bytes(&folder.join(file)).map_err(|error| error.to_string())
    })?;
    object(py, &read(py, whole.as_bytes())?)
}

/// Bytes of a file, up to one more than the limit.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    // A named pipe without a writer would never be read.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(path)?;
    file.take(LARGEST as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The object that the Python part of the package loads from a path: it names the path in its errors.
pub(crate) fn path_loaded(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyAny>> {
    let load = PyModule::import(py, "centrode._design")?.getattr("load")?;
    load.call1((path,))
}

/// A commented design file to start from, which is a valid design.
///
/// >>> import centrode as ct
/// >>> ct.template("gear-pair").splitlines()[0]
/// '# A non-circular gear pair. Lengths in millimetres, angles in degrees.'
#[pyfunction]
#[pyo3(signature = (family="gear-pair"))]
pub(crate) fn template(family: &str) -> Answer<&'static str> {
    Ok(named(family)?.design.template)
}

/// The JSON schema of the design files of a family, or of all families, as text.
#[pyfunction]
#[pyo3(signature = (family=None))]
pub(crate) fn _schema(family: Option<&str>) -> Answer<String> {
    let schema = match family {
        None => FAMILIES.json_schema(),
        Some(word) => named(word)?.design.json_schema(),
    };
    Ok(schema.to_string())
}

/// The family of a word.
pub(crate) fn named(word: &str) -> Answer<&'static Family> {
    let family = FAMILIES.named(word);
    family.ok_or_else(|| Raised::word("family", word, &FAMILIES.words()))
}
