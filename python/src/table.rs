//! Tables of a design as keyword classes.

use centrode_kinematics::machine::Keyway as KeywaySpec;
use pyo3::prelude::IntoPyObject;

use crate::body::Keyway;
use crate::keywords::Field;
use crate::word::Word;

/// A value of a table, as Python gives and sees it.
pub(crate) trait Value: Field {
    /// The value as seen.
    type Shown: for<'py> IntoPyObject<'py>;

    fn shown(&self) -> Self::Shown;
}

/// Values that are seen as they are given.
macro_rules! plain {
    ($($value:ty),*) => {
        $(impl Value for $value {
            type Shown = Self;

            fn shown(&self) -> Self {
                self.clone()
            }
        })*
    };
}

plain!(f64, u32, String);

impl Value for KeywaySpec {
    type Shown = Keyway;

    fn shown(&self) -> Keyway {
        Keyway(*self)
    }
}

impl<W: Word> Value for W {
    type Shown = &'static str;

    fn shown(&self) -> &'static str {
        self.word()
    }
}

impl<T: Value> Value for Option<T> {
    type Shown = Option<T::Shown>;

    fn shown(&self) -> Self::Shown {
        self.as_ref().map(Value::shown)
    }
}

/// A class whose keywords and attributes are the keys of a table: those that must be given, and those that are as usual
/// where they are omitted.
macro_rules! table {
    (
        $(#[$($about:tt)*])*
        $module:literal $name:ident($spec:ty) from $usual:expr, keys $place:literal, rules $rules:expr;
        needed { $($(#[$($needed_about:tt)*])* $needed:ident: $needed_type:ty,)* }
        usual { $($(#[$($given_about:tt)*])* $given:ident: $given_type:ty,)* }
    ) => {
        $(#[$($about)*])*
        #[pyo3::pyclass(frozen, eq, from_py_object, module = $module)]
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) struct $name(pub(crate) $spec);

        #[pyo3::pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = (*, $($needed,)* $($given = None),*))]
            #[allow(clippy::too_many_arguments, reason = "the keys of the table")]
            fn new(
                $($needed: pyo3::Bound<'_, pyo3::PyAny>,)*
                $($given: Option<pyo3::Bound<'_, pyo3::PyAny>>,)*
            ) -> $crate::error::Answer<Self> {
                let mut table: $spec = $usual;
                $(if let Some($given) = $given {
                    table.$given = $crate::keywords::read(stringify!($given), concat!($place, stringify!($given)), &$given)?;
                })*
                $(table.$needed =
                    $crate::keywords::read(stringify!($needed), concat!($place, stringify!($needed)), &$needed)?;)*
                let rules: fn(&$spec) -> Result<(), centrode_spec::SpecError> = $rules;
                rules(&table)?;
                Ok(Self(table))
            }

            $(
                $(#[$($needed_about)*])*
                #[getter]
                fn $needed(&self) -> <$needed_type as $crate::table::Value>::Shown {
                    $crate::table::Value::shown(&self.0.$needed)
                }
            )*

            $(
                $(#[$($given_about)*])*
                #[getter]
                fn $given(&self) -> <$given_type as $crate::table::Value>::Shown {
                    $crate::table::Value::shown(&self.0.$given)
                }
            )*

            fn __repr__(&self, py: pyo3::Python<'_>) -> pyo3::PyResult<String> {
                self.keywords(py)?.call(stringify!($name))
            }

            fn __reduce__<'py>(&self, py: pyo3::Python<'py>) -> pyo3::PyResult<$crate::made::Reduced<'py>> {
                $crate::made::by(stringify!($name), self.keywords(py)?)
            }
        }

        impl $name {
            /// The keywords that make this one.
            fn keywords<'py>(&self, py: pyo3::Python<'py>) -> pyo3::PyResult<$crate::record::Keywords<'py>> {
                let keywords = $crate::record::Keywords::new(py);
                $(let keywords = keywords.with(stringify!($needed), self.$needed())?;)*
                $(let keywords = keywords.with(stringify!($given), self.$given())?;)*
                Ok(keywords)
            }
        }
    };
}

pub(crate) use table;
