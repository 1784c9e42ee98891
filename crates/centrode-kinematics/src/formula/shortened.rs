use super::{Function, Step};

/// A program in which steps of a Fourier sum are combined: multiples of the variable, their sines and cosines, and products with
/// a number. Its values are those of the original program, bit by bit.
pub(super) fn shortened(program: Vec<Step>) -> Vec<Step> {
    let mut short = Vec::with_capacity(program.len());
    for step in program {
        let (taken, mut steps) = replaced(&short, step);
        short.truncate(short.len() - taken);
        short.append(&mut steps);
    }
    short
}

/// Number of last steps that combine with the next one, and the steps that replace them all.
fn replaced(before: &[Step], next: Step) -> (usize, Vec<Step>) {
    use Step::{Apply, Constant, Multiple, Multiply, Scale, Variable, Wave};
    let is_sine = matches!(next, Apply(Function::Sin));
    match (next, before) {
        (Multiply, [.., Constant(c), Variable] | [.., Variable, Constant(c)]) => {
            (2, vec![Multiple(*c)])
        }
        (Multiply, [.., Constant(c), of @ (Multiple(_) | Wave { .. })]) => {
            (2, vec![*of, Scale(*c)])
        }
        (Multiply, [.., Constant(c)]) => (1, vec![Scale(*c)]),
        (Apply(Function::Sin | Function::Cos), [.., Variable]) => {
            let slope = 1.0;
            (1, vec![Wave { slope, is_sine }])
        }
        (Apply(Function::Sin | Function::Cos), [.., Multiple(slope)]) => {
            let slope = *slope;
            (1, vec![Wave { slope, is_sine }])
        }
        _ => (0, vec![next]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Formula, parser};

    #[test]
    fn a_shortened_program_has_the_same_values_bit_by_bit() {
        for (text, count) in [
            ("phi - 0.45*cos(phi) + 0.09*sin(phi) + 6e-4*cos(2*phi)", 10),
            ("30 + sin(phi*3)*2 - cos(3*phi)/7", 8),
            ("2*(phi + 1)*sin(phi)^2 - 3*exp(cos(2*phi))", 13),
            ("sin(2*phi + 1) + phi*phi", 8),
            ("(2 - phi)*3*phi", 6),
        ] {
            let program = parser::read(text).expect("a formula");
            let whole = Formula { program };
            let short = Formula::read(text).expect("a formula");
            assert!(short.program.len() <= whole.program.len());
            assert_eq!(short.program.len(), count, "{text}: {:?}", short.program);
            for i in -40..90 {
                let phi = 0.173 * f64::from(i);
                assert_eq!(short.at(phi).0, whole.at(phi).0, "{text} at {phi}");
            }
        }
    }
}
