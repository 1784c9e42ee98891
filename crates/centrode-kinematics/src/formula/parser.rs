use thiserror::Error;

use super::{DEEPEST, Formula, Function, Step};

/// Maximum length of a formula, in characters.
const LONGEST: usize = 2000;
/// Maximum nesting of parentheses, signs and powers.
const DEEPEST_NESTING: usize = 64;

const FUNCTIONS: [(&str, Function); 12] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sqrt", Function::Sqrt),
];

/// Names of functions and variables in other notations, each with its name here.
const ELSEWHERE: [(&str, &str); 6] = [
    ("log", "ln"),
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("theta", "phi"),
    ("t", "phi"),
];

/// Reason why a formula cannot be read.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{reason} at character {column}")]
pub struct FormulaError {
    /// Rule of the notation that is broken.
    pub reason: String,
    /// Position in the formula, from one.
    pub column: usize,
}

pub(super) fn read(text: &str) -> Result<Vec<Step>, FormulaError> {
    let characters: Vec<char> = text.chars().take(LONGEST + 1).collect();
    let mut parser = Parser {
        text: &characters,
        position: 0,
        nesting: 0,
        program: Vec::new(),
    };
    if characters.len() > LONGEST {
        return parser.fail(format!("a formula of more than {LONGEST} characters"));
    }
    parser.sum()?;
    match parser.peek() {
        Some(')') => return parser.fail("a ')' without its '('"),
        Some(c) => return parser.fail(format!("an operator is missing before {c:?}")),
        None => {}
    }
    parser.fits_the_stack()?;
    Ok(parser.program)
}

struct Parser<'a> {
    text: &'a [char],
    position: usize,
    nesting: usize,
    program: Vec<Step>,
}

impl Parser<'_> {
    fn fail<T>(&self, reason: impl Into<String>) -> Result<T, FormulaError> {
        Err(FormulaError {
            reason: reason.into(),
            column: self.position + 1,
        })
    }

    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        while self
            .text
            .get(self.position)
            .is_some_and(|c| c.is_whitespace())
        {
            self.position += 1;
        }
        self.text.get(self.position).copied()
    }

    fn take(&mut self, required: char) -> bool {
        let found = self.peek() == Some(required);
        if found {
            self.position += 1;
        }
        found
    }

    fn sum(&mut self) -> Result<(), FormulaError> {
        self.product()?;
        loop {
            let step = match self.peek() {
                Some('+') => Step::Add,
                Some('-') => Step::Subtract,
                _ => return Ok(()),
            };
            self.position += 1;
            self.product()?;
            self.emit(step);
        }
    }

    fn product(&mut self) -> Result<(), FormulaError> {
        self.signed()?;
        loop {
            let step = match self.peek() {
                Some('*') => Step::Multiply,
                Some('/') => Step::Divide,
                _ => return Ok(()),
            };
            self.position += 1;
            self.signed()?;
            self.emit(step);
        }
    }

    /// Parses a sign, which binds less strongly than a power: `-phi^2` is `-(phi^2)`.
    fn signed(&mut self) -> Result<(), FormulaError> {
        self.nesting += 1;
        if self.nesting > DEEPEST_NESTING {
            return self.fail(format!("nested more than {DEEPEST_NESTING} levels deep"));
        }
        if self.take('-') {
            self.signed()?;
            self.emit(Step::Negate);
        } else if self.take('+') {
            self.signed()?;
        } else {
            self.operand()?;
            if self.power_sign() {
                self.signed()?;
                self.emit(Step::Power);
            }
        }
        self.nesting -= 1;
        Ok(())
    }

    fn power_sign(&mut self) -> bool {
        if self.take('^') {
            return true;
        }
        let double = self.peek() == Some('*') && self.text.get(self.position + 1) == Some(&'*');
        if double {
            self.position += 2;
        }
        double
    }

    fn operand(&mut self) -> Result<(), FormulaError> {
        match self.peek() {
            Some('(') => self.parenthesis(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(),
            Some(c) => self.fail(format!("a number, phi or '(' is missing before {c:?}")),
            None if self.text.is_empty() => self.fail("an empty formula"),
            None => self.fail("the formula ends too early"),
        }
    }

    fn parenthesis(&mut self) -> Result<(), FormulaError> {
        self.position += 1;
        self.sum()?;
        if self.take(')') {
            Ok(())
        } else {
            self.fail("a ')' is missing")
        }
    }

    fn number(&mut self) -> Result<(), FormulaError> {
        let start = self.position;
        let mut end = start;
        let digit = |i: usize| self.text.get(i).is_some_and(char::is_ascii_digit);
        while digit(end) || self.text.get(end) == Some(&'.') {
            end += 1;
        }
        if matches!(self.text.get(end), Some('e' | 'E')) {
            let signed = matches!(self.text.get(end + 1), Some('+' | '-'));
            let mut after = end + 1 + usize::from(signed);
            if digit(after) {
                while digit(after) {
                    after += 1;
                }
                end = after;
            }
        }
        let number: String = self.text[start..end].iter().collect();
        match number.parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.position = end;
                self.emit(Step::Constant(value));
                Ok(())
            }
            _ => self.fail(format!("{number:?} is not a number")),
        }
    }

    fn name(&mut self) -> Result<(), FormulaError> {
        let start = self.position;
        let rest = self.text[start..].iter();
        let name: String = rest
            .take_while(|c| c.is_alphanumeric() || **c == '_')
            .collect();
        let length = name.chars().count();
        if name == "phi" || name == "pi" {
            self.position += length;
            self.emit(if name == "phi" {
                Step::Variable
            } else {
                Step::Constant(std::f64::consts::PI)
            });
            return Ok(());
        }
        let Some((_, function)) = FUNCTIONS.iter().find(|(n, _)| *n == name) else {
            return self.fail(unknown(&name));
        };
        self.position += length;
        if self.peek() != Some('(') {
            return self.fail(format!("'(' is missing after {name}"));
        }
        self.parenthesis()?;
        self.emit(Step::Apply(*function));
        Ok(())
    }

    /// Appends a step; a step whose operands are all constants is evaluated at once.
    fn emit(&mut self, step: Step) {
        let constant = |back: usize| match self.program.iter().rev().nth(back) {
            Some(Step::Constant(c)) => Some(*c),
            _ => None,
        };
        let (last, before) = (constant(0), constant(1));
        let operands = match (step, last, before) {
            (Step::Constant(_) | Step::Variable, ..) => 0,
            (Step::Negate | Step::PowerConstant(_) | Step::Apply(_), Some(_), _) => 1,
            (Step::Negate | Step::PowerConstant(_) | Step::Apply(_), None, _) => 0,
            (_, Some(_), Some(_)) => 2,
            (Step::Power, Some(p), None) => {
                self.program.pop();
                self.program.push(Step::PowerConstant(p));
                return;
            }
            _ => 0,
        };
        if operands == 0 {
            self.program.push(step);
            return;
        }
        let start = self.program.len() - operands;
        let mut program = self.program.split_off(start);
        if let (Step::Power, Some(p)) = (step, last) {
            program.pop();
            program.push(Step::PowerConstant(p));
        } else {
            program.push(step);
        }
        let value = Formula { program }.at(0.0).0[0];
        self.program.push(Step::Constant(value));
    }

    fn fits_the_stack(&self) -> Result<(), FormulaError> {
        let mut depth = 0_usize;
        for step in &self.program {
            match step {
                Step::Constant(_) | Step::Variable => depth += 1,
                Step::Negate | Step::PowerConstant(_) | Step::Apply(_) => {}
                _ => depth -= 1,
            }
            if depth > DEEPEST {
                let reason = format!(
                    "use fewer nested parentheses: more than {DEEPEST} intermediate values at once in the formula that begins"
                );
                return Err(FormulaError { reason, column: 1 });
            }
        }
        Ok(())
    }
}

fn unknown(name: &str) -> String {
    let known = FUNCTIONS.iter().map(|(n, _)| *n).chain(["phi", "pi"]);
    let shown: String = name.chars().take(40).collect();
    let elsewhere = ELSEWHERE.iter().find(|(other, _)| *other == shown);
    let near = known
        .clone()
        .map(|n| (strsim::damerau_levenshtein(&shown, n), n))
        .min()
        .filter(|(distance, n)| *distance <= 2 && *distance < n.len());
    match elsewhere.map(|(_, n)| *n).or(near.map(|(_, n)| n)) {
        Some(n) => format!("unknown name {shown:?}, did you mean {n:?}?"),
        None => format!(
            "unknown name {shown:?}; known are {}",
            known.collect::<Vec<_>>().join(", ")
        ),
    }
}
