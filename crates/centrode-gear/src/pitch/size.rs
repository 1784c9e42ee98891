use super::PitchError;
use super::error::positive;

/// Inch, mm.
const INCH: f64 = 25.4;

/// Size of a curve as given in its description.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub(crate) module: Option<f64>,
    pub(crate) diametral_pitch: Option<f64>,
    pub(crate) tooth_count: Option<u32>,
    /// Source of the lengths of the shape.
    pub(crate) own: OwnSize,
}

/// Size of a shape as written, before module and tooth count.
#[derive(Clone, Copy, Debug)]
pub(crate) enum OwnSize {
    /// The shape has no size; the key is the one that could set it.
    Missing(&'static str),
    /// The key fixes it: a module next to it would contradict.
    Fixed(&'static str),
    /// Lengths as written, unless module and tooth count scale it.
    Written,
}

impl OwnSize {
    /// Size of a shape whose length, mm, a key gives, if it is written.
    pub(crate) fn of(key: &'static str, length: Option<f64>) -> Result<Self, PitchError> {
        match length {
            Some(length) => positive(key, length).map(|_| Self::Fixed(key)),
            None => Ok(Self::Missing(key)),
        }
    }
}

impl Size {
    pub(crate) fn new(
        module: Option<f64>,
        diametral_pitch: Option<f64>,
        tooth_count: Option<u32>,
        own: OwnSize,
    ) -> Self {
        Self {
            module,
            diametral_pitch,
            tooth_count,
            own,
        }
    }

    /// Module, mm, as written or by the diametral pitch.
    pub(crate) fn module(&self) -> Option<f64> {
        let by_pitch = || Some(INCH / self.diametral_pitch?);
        self.module.or_else(by_pitch)
    }

    /// Key that gives the module.
    pub(crate) fn module_key(&self) -> &'static str {
        match self.diametral_pitch {
            Some(_) => "diametral_pitch",
            None => "module",
        }
    }

    /// Refuses a size that is impossible, absent or given twice.
    pub(crate) fn check(&self) -> Result<(), PitchError> {
        if let Some(module) = self.module {
            positive("module", module)?;
        }
        if let Some(pitch) = self.diametral_pitch {
            positive("diametral_pitch", pitch)?;
            if self.module.is_some() {
                let key = "diametral_pitch";
                let rule = "cannot be given together with module: give one of them";
                return Err(PitchError::Key { key, rule });
            }
        }
        if let Some(z) = self.tooth_count {
            if z < 3 {
                return Err(PitchError::ToothCount(z));
            }
            if z > 10_000 {
                return Err(PitchError::OutOfRange {
                    key: "tooth_count",
                    value: z.into(),
                    minimum: 3,
                    maximum: 10_000,
                });
            }
        }
        match (self.module(), self.tooth_count, self.own) {
            (Some(_), None, _) => Err(PitchError::SizeIncomplete {
                given: self.module_key(),
                missing: "tooth_count",
            }),
            (None, Some(_), OwnSize::Missing(_)) => Err(PitchError::SizeIncomplete {
                given: "tooth_count",
                missing: "module",
            }),
            (None, None, OwnSize::Missing(key)) => Err(PitchError::NoSize(key)),
            (Some(_), Some(_), OwnSize::Fixed(key)) => {
                Err(PitchError::SizeTwice(key, self.module_key()))
            }
            _ => Ok(()),
        }
    }
}
