/// Table of a standard from its file: a line with the source, one with the names of the columns, then `N` numbers per line.
#[derive(Debug)]
pub struct StandardTable<const N: usize> {
    columns: Vec<&'static str>,
    /// The numbers, in the order of the file; most tables ascend by their first column.
    pub rows: Vec<[f64; N]>,
}

impl<const N: usize> StandardTable<N> {
    /// Reads the text of a file.
    #[must_use]
    pub fn read(text: &'static str) -> Self {
        let mut lines = text.lines().skip(1);
        let columns = lines.next().unwrap_or_default().split(',').collect();
        let numbers = |line: &str| {
            let numbers: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
            numbers.ok()?.try_into().ok()
        };
        let rows = lines.filter_map(numbers).collect();
        Self { columns, rows }
    }

    /// Index of the column of a name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|known| *known == name)
    }

    /// Row of the range that a size lies in, for a table whose first column has the upper ends of its ranges.
    #[must_use]
    pub fn up_to(&self, size: f64) -> Option<&[f64; N]> {
        self.rows.iter().find(|row| size <= row[0])
    }

    /// Row that begins with a number.
    #[must_use]
    pub fn of(&self, number: f64) -> Option<[f64; N]> {
        self.rows.iter().copied().find(|row| row[0] == number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a table's file, with the number of its lines of numbers.
    macro_rules! table {
        ($name:literal, $columns:literal) => {{
            let text = include_str!(concat!("../../../data/", $name));
            let table = StandardTable::<$columns>::read(text);
            assert_eq!(table.columns.len(), $columns, $name);
            // No line of the file is lost, and the first column ascends.
            assert_eq!(table.rows.len(), text.lines().count() - 2, $name);
            assert!(table.rows.windows(2).all(|w| w[0][0] < w[1][0]), $name);
            table.rows.len()
        }};
    }

    #[test]
    fn every_line_of_every_table_is_read() {
        assert_eq!(table!("iso-286-grades.csv", 10), 13);
        assert_eq!(table!("iso-286-deviations.csv", 10), 13);
        assert_eq!(table!("iso-286-r.csv", 2), 22);
        assert_eq!(table!("iso-2768-1.csv", 5), 8);
        assert_eq!(table!("iso-4762.csv", 6), 10);
        assert_eq!(table!("din-471.csv", 6), 28);
        assert_eq!(table!("din-6885-keys.csv", 5), 15);
        assert_eq!(table!("din-6885-hubs.csv", 3), 15);
    }
}
