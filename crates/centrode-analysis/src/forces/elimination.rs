/// Maximum pivot of the scaled rows that counts as rounding: a force is then not determined. A larger limit refuses
/// machines near a dead centre, a smaller one returns rounding as forces.
const DEAD: f64 = 1e-13;

/// Solution of linear equations, one per row with its right side last; `None` if the equations are singular within rounding.
///
/// Source: Gaussian elimination with scaled rows and partial pivoting. Most systems have one or two unknowns.
pub(super) fn eliminated(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = rows.len();
    for row in &mut rows {
        // Rows of forces and rows of moments differ in size.
        let size = row[..count]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()));
        row.iter_mut().for_each(|x| *x /= size);
    }
    for at in 0..count {
        let size = |row: &usize| rows[*row][at].abs();
        let pivot = (at..count).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if size(&pivot) <= DEAD || size(&pivot).is_nan() {
            return None;
        }
        rows.swap(at, pivot);
        let (above, below) = rows.split_at_mut(at + 1);
        let pivot = &above[at];
        for row in below {
            let share = row[at] / pivot[at];
            for (x, over) in row.iter_mut().zip(pivot).skip(at) {
                *x -= share * over;
            }
        }
    }
    let mut found = vec![0.0; count];
    for at in (0..count).rev() {
        let row = &rows[at];
        let known = row[at + 1..count].iter().zip(&found[at + 1..]);
        let known: f64 = known.map(|(x, value)| x * value).sum();
        found[at] = (row[count] - known) / row[at];
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_solved_and_dependent_ones_refused() {
        let rows = vec![
            vec![0.0, 2e6, 1e6, 8e6],
            vec![1.0, 1.0, 0.0, 3.0],
            vec![3.0, 0.0, -1.0, -1.0],
        ];
        let found = eliminated(rows).expect("independent");
        for (found, required) in found.iter().zip([1.0, 2.0, 4.0]) {
            assert!((found - required).abs() < 1e-14, "{found}");
        }
        let twice = vec![vec![1.0, 0.3, 1.0], vec![3.0, 0.9, 2.0]];
        assert_eq!(eliminated(twice), None);
        assert_eq!(eliminated(vec![vec![0.0, 1.0]]), None);
    }
}
