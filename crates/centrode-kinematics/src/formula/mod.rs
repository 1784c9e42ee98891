//! Formulas in one variable, parsed once and evaluated with exact derivatives.

mod lanes;
mod number;
mod pace;
mod parser;
mod shortened;
mod taylor;

pub(crate) use lanes::{LANES, Lanes, groups};
pub use number::Number;
pub use pace::Steep;
pub use parser::FormulaError;
pub use taylor::Taylor;

/// Depth of the stack: maximum number of intermediate values of a formula.
const DEEPEST: usize = 32;

/// A formula in the variable `phi`, as a program for a stack machine.
///
/// Evaluation is forward differentiation in Taylor arithmetic: exact derivatives at a cost linear in
/// the length of the formula, whatever the formula is.
#[derive(Clone, Debug)]
pub struct Formula {
    program: Vec<Step>,
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(f64),
    Variable,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    PowerConstant(f64),
    Negate,
    Apply(Function),
    /// The variable times a number.
    Multiple(f64),
    /// Product of the value on top of the stack with a number.
    Scale(f64),
    /// Sine, or else cosine, of the variable times a number.
    Wave {
        slope: f64,
        is_sine: bool,
    },
}

/// A function a formula may use: analytic wherever it has a value.
#[derive(Clone, Copy, Debug)]
enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
}

impl Formula {
    /// Reads a formula: numbers, `phi`, `pi`, `+ - * / ^`, parentheses and the analytic functions.
    ///
    /// # Errors
    /// [`FormulaError`] with the reason and the character.
    pub fn read(text: &str) -> Result<Self, FormulaError> {
        let program = parser::read(text)?;
        Ok(Self {
            program: shortened::shortened(program),
        })
    }

    /// Taylor coefficients of the formula around `phi`; not finite where it has no value.
    #[must_use]
    pub fn at(&self, phi: f64) -> Taylor {
        self.run(phi, |_, _, _| ())
    }

    /// Evaluates the formula. For each function, product, quotient and power, passes to `seen` its index in the program, the
    /// argument of a quick function, and the value.
    #[inline]
    fn run(&self, phi: f64, mut seen: impl FnMut(usize, Option<&Taylor>, &Taylor)) -> Taylor {
        let mut stack = [Taylor::constant(0.0); DEEPEST];
        let mut top = 0;
        // Terms of a Fourier sum come in pairs: the last sine and cosine are stored.
        let mut wave = (f64::NAN, stack[0], stack[0]);
        for (place, step) in self.program.iter().enumerate() {
            match step {
                Step::Constant(c) => {
                    stack[top] = Taylor::constant(*c);
                    top += 1;
                }
                Step::Variable => {
                    stack[top] = Taylor::variable(phi);
                    top += 1;
                }
                Step::Multiple(slope) => {
                    stack[top] = Taylor::variable(phi) * *slope;
                    top += 1;
                }
                Step::Wave { slope, is_sine } => {
                    if wave.0 != *slope {
                        let (sin, cos) = Taylor::wave(*slope, (slope * phi).sin_cos());
                        wave = (*slope, sin, cos);
                    }
                    stack[top] = if *is_sine { wave.1 } else { wave.2 };
                    top += 1;
                }
                Step::Scale(c) => stack[top - 1] = stack[top - 1] * *c,
                Step::Negate => stack[top - 1] = -stack[top - 1],
                Step::PowerConstant(p) => {
                    stack[top - 1] = stack[top - 1].power(*p);
                    seen(place, None, &stack[top - 1]);
                }
                Step::Apply(f) => {
                    let of = stack[top - 1];
                    stack[top - 1] = f.of(of);
                    seen(place, f.is_quick().then_some(&of), &stack[top - 1]);
                }
                Step::Add | Step::Subtract | Step::Multiply | Step::Divide | Step::Power => {
                    top -= 1;
                    stack[top - 1] = step.combine(stack[top - 1], stack[top]);
                    if !matches!(step, Step::Add | Step::Subtract) {
                        seen(place, None, &stack[top - 1]);
                    }
                }
            }
        }
        stack[0]
    }
}

impl Step {
    fn combine(self, a: Taylor, b: Taylor) -> Taylor {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            // A moderate value divided by one near the maximum float is zero, with all its derivatives.
            Self::Divide if b.0[0].abs() > 1e200 && a.0.iter().all(|c| c.abs() < 1e100) => {
                Taylor::constant(0.0)
            }
            Self::Divide => a / b,
            _ => (a.ln() * b).exp(),
        }
    }
}

impl Function {
    /// Whether the function may change within a small step of its argument without a sign of it nearby, as at the foot of a bump.
    /// A change at a root or a pole is visible from afar.
    fn is_quick(self) -> bool {
        !matches!(self, Self::Ln | Self::Sqrt | Self::Asin | Self::Acos)
    }

    fn of(self, a: Taylor) -> Taylor {
        match self {
            Self::Sin => a.sin_cos().0,
            Self::Cos => a.sin_cos().1,
            Self::Tan => {
                let (sin, cos) = a.sin_cos();
                sin / cos
            }
            Self::Asin => a.asin(),
            Self::Acos => Taylor::constant(std::f64::consts::FRAC_PI_2) - a.asin(),
            Self::Atan => a.atan(),
            Self::Sinh => a.sinh_cosh().0,
            Self::Cosh => a.sinh_cosh().1,
            Self::Tanh => a.tanh(),
            Self::Exp => a.exp(),
            Self::Ln => a.ln(),
            Self::Sqrt => a.sqrt(),
        }
    }
}

#[cfg(test)]
mod tests;
