//! Time-stamped tables of numbers as CSV: `t_ns` first, then columns of floating-point numbers.

use super::atomic::write_atomically;
use crate::dataset::error::DatasetError;
use nalgebra::{Quaternion, UnitQuaternion};
use std::path::Path;

/// One row: a time stamp in ns and the other columns.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedRow {
    /// Time in ns.
    pub t_ns: i64,
    /// The other columns, in the header's order and units.
    pub values: Vec<f64>,
}

/// A table with its header, time stamps strictly increasing, every value finite.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedTable {
    /// Column names without the first (time) column.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<TimedRow>,
    /// Line of each row in the file, from 1.
    lines: Vec<u64>,
}

impl TimedTable {
    /// Rotation from the four columns `qw,qx,qy,qz` that start at `column` of a row.
    pub(in crate::dataset) fn rotation(
        &self,
        path: &Path,
        row: usize,
        column: usize,
    ) -> Result<UnitQuaternion<f64>, DatasetError> {
        let v = &self.rows[row].values[column..column + 4];
        let q = Quaternion::new(v[0], v[1], v[2], v[3]);
        if (q.norm() - 1.0).abs() > 1e-2 {
            let problem = format!("the quaternion's length is {}, 1 expected", q.norm());
            return Err(DatasetError::Malformed { path: path.into(), line: self.lines[row], problem });
        }
        Ok(UnitQuaternion::from_quaternion(q))
    }
}

/// Reads a table of `columns` numbers beside the time; a header line may start with `#` and is optional.
///
/// # Errors
/// Names the file and line of a wrong column count, a value that is not a finite number, or time stamps that are
/// unordered or doubled; a table without rows is an error too.
pub fn read_timed_table(path: &Path, columns: usize) -> Result<TimedTable, DatasetError> {
    let text = read_text(path)?;
    let mut table = TimedTable { columns: Vec::new(), rows: Vec::new(), lines: Vec::new() };
    for (index, line) in text.lines().enumerate() {
        let line_number = index as u64 + 1;
        let malformed = |problem: String| DatasetError::Malformed { path: path.into(), line: line_number, problem };
        let fields: Vec<&str> = line.trim().split(',').map(str::trim).collect();
        let is_header = line.trim_start().starts_with('#') || (index == 0 && fields[0].parse::<f64>().is_err());
        if line.trim().is_empty() {
            continue;
        }
        if is_header {
            table.columns = fields.iter().skip(1).map(|s| s.to_string()).collect();
            continue;
        }
        if fields.len() != columns + 1 {
            return Err(malformed(format!("{} columns found, {} expected", fields.len(), columns + 1)));
        }
        let t_ns = fields[0]
            .parse::<i64>()
            .map_err(|_| malformed(format!("'{}' is not a time stamp in whole nanoseconds", fields[0])))?;
        if table.rows.last().is_some_and(|last| last.t_ns >= t_ns) {
            return Err(malformed(format!(
                "time stamp {t_ns} ns does not come after the one before it: sort the rows and remove doubles"
            )));
        }
        let values = fields[1..].iter().map(|f| parse_finite(f).map_err(&malformed)).collect::<Result<_, _>>()?;
        table.rows.push(TimedRow { t_ns, values });
        table.lines.push(line_number);
    }
    if table.rows.is_empty() {
        return Err(DatasetError::Unusable { path: path.into(), problem: "it has no rows of data".into() });
    }
    Ok(table)
}

/// Writes a table with the given full header (time column included); numbers keep every digit.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_timed_table<'a>(
    path: &Path,
    header: &str,
    rows: impl IntoIterator<Item = (i64, &'a [f64])>,
) -> Result<(), DatasetError> {
    write_atomically(path, |w| {
        writeln!(w, "{header}")?;
        for (t_ns, values) in rows {
            write!(w, "{t_ns}")?;
            for value in values {
                write!(w, ",{value}")?;
            }
            writeln!(w)?;
        }
        Ok(())
    })
}

pub fn read_text(path: &Path) -> Result<String, DatasetError> {
    if !path.exists() {
        return Err(DatasetError::Missing { path: path.into(), cure: "check the folder's path and layout".into() });
    }
    std::fs::read_to_string(path).map_err(DatasetError::io("read", path))
}

pub fn parse_finite(field: &str) -> Result<f64, String> {
    match field.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("'{field}' is not a finite number: remove the row or repair the value")),
        Err(_) => Err(format!("'{field}' is not a number")),
    }
}

/// Seconds as text to whole nanoseconds, digit by digit, so that nothing is lost to floating point.
pub fn seconds_to_ns(text: &str) -> Option<i64> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let plain = fraction.bytes().all(|b| b.is_ascii_digit()) && whole.parse::<i64>().is_ok();
    if !plain {
        let ns = text.parse::<f64>().ok()? * 1e9;
        return (ns.abs() < i64::MAX as f64).then(|| ns.round() as i64);
    }
    let digits: String = fraction.chars().chain(std::iter::repeat('0')).take(9).collect();
    let ns: i64 = digits.parse().ok()?;
    let seconds: i64 = whole.parse().ok()?;
    let sign = if whole.starts_with('-') { -1 } else { 1 };
    seconds.checked_mul(1_000_000_000)?.checked_add(sign * ns)
}
