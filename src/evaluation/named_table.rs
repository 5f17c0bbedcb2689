//! Result tables, whose columns are found by name so that their order is free.

use super::error::EvaluationError;
use crate::dataset::DatasetError;
use std::path::{Path, PathBuf};

/// A CSV file with a header.
#[derive(Debug, Clone)]
pub struct NamedTable {
    path: PathBuf,
    columns: Vec<String>,
    rows: Vec<csv::StringRecord>,
}

impl NamedTable {
    /// Reads a table.
    ///
    /// # Errors
    /// Names the file if it is missing, and the line if it has not as many columns as the header.
    pub fn read(path: &Path) -> Result<Self, EvaluationError> {
        if !path.is_file() {
            let cure = "the result is incomplete: make it again".into();
            return Err(DatasetError::Missing { path: path.into(), cure }.into());
        }
        let unusable = |e: csv::Error| DatasetError::Unusable { path: path.into(), problem: e.to_string() };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(unusable)?;
        let header = reader.headers().map_err(unusable)?;
        let columns = header.iter().map(|name| name.trim_start_matches(['#', ' ']).to_string()).collect();
        let rows = reader.records().collect::<Result<_, _>>().map_err(unusable)?;
        Ok(NamedTable { path: path.into(), columns, rows })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Place of a column.
    ///
    /// # Errors
    /// [`EvaluationError::MissingColumn`].
    pub fn column(&self, name: &str) -> Result<usize, EvaluationError> {
        self.columns.iter().position(|column| column == name).ok_or_else(|| EvaluationError::MissingColumn {
            path: self.path.clone(),
            column: name.into(),
            found: self.columns.join(", "),
        })
    }

    /// Places of several columns.
    ///
    /// # Errors
    /// [`EvaluationError::MissingColumn`].
    pub fn places<const N: usize>(&self, names: [&str; N]) -> Result<[usize; N], EvaluationError> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            *place = self.column(name)?;
        }
        Ok(places)
    }

    /// The text of a cell.
    pub fn text(&self, row: usize, column: usize) -> &str {
        &self.rows[row][column]
    }

    /// A finite number.
    ///
    /// # Errors
    /// Names the file, line and column.
    pub fn number(&self, row: usize, column: usize) -> Result<f64, EvaluationError> {
        let found = self.text(row, column).parse::<f64>().ok().filter(|v| v.is_finite());
        found.ok_or_else(|| self.malformed(row, column, "is not a finite number"))
    }

    /// Finite numbers of several columns.
    ///
    /// # Errors
    /// As [`NamedTable::number`].
    pub fn numbers<const N: usize>(&self, row: usize, columns: &[usize; N]) -> Result<[f64; N], EvaluationError> {
        let mut numbers = [0.0; N];
        for (number, column) in numbers.iter_mut().zip(columns) {
            *number = self.number(row, *column)?;
        }
        Ok(numbers)
    }

    /// A number, or nothing where the cell is empty or not a number ("not determined").
    pub fn optional(&self, row: usize, column: usize) -> Option<f64> {
        self.text(row, column).parse::<f64>().ok().filter(|v| v.is_finite())
    }

    /// A whole number.
    ///
    /// # Errors
    /// Names the file, line and column.
    pub fn integer(&self, row: usize, column: usize) -> Result<i64, EvaluationError> {
        self.text(row, column).parse().map_err(|_| self.malformed(row, column, "is not a whole number"))
    }

    /// Time stamps of a column, which have to rise strictly.
    ///
    /// # Errors
    /// Names the file and line.
    pub fn times(&self, name: &str) -> Result<Vec<i64>, EvaluationError> {
        let column = self.column(name)?;
        let mut times: Vec<i64> = Vec::with_capacity(self.len());
        for row in 0..self.len() {
            let t_ns = self.integer(row, column)?;
            if times.last().is_some_and(|last| *last >= t_ns) {
                return Err(self.malformed(row, column, "does not come after the time before it"));
            }
            times.push(t_ns);
        }
        Ok(times)
    }

    /// The error of one cell.
    pub fn malformed(&self, row: usize, column: usize, problem: &str) -> EvaluationError {
        let line = self.rows[row].position().map_or(0, csv::Position::line);
        let problem = format!("{} '{}' {problem}", self.columns[column], self.text(row, column));
        DatasetError::Malformed { path: self.path.clone(), line, problem }.into()
    }
}
