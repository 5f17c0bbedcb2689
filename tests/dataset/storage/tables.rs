//! Tables of times and numbers.

use crate::dataset::{complaint, folder, put};
use opnav::dataset::*;

#[test]
fn timed_tables_return_every_digit() {
    let (dir, values) = (folder(), [1.0 / 3.0, -0.0, f64::MIN_POSITIVE, 1e300, 5e-324]);
    let path = dir.path().join("deep/down/table.csv");
    write_timed_table(&path, "t_ns,a,b,c,d,e", [(-5, values.as_slice()), (i64::MAX, values.as_slice())])
        .expect("write");
    let table = read_timed_table(&path, 5).expect("read");
    assert_eq!(table.columns, ["a", "b", "c", "d", "e"]);
    assert_eq!((table.rows[0].t_ns, table.rows[1].t_ns), (-5, i64::MAX));
    assert_eq!(table.rows[1].values, values);
}

#[test]
fn bad_tables_are_refused_with_file_and_line() {
    let dir = folder();
    let cases: [(&str, &str, Option<u64>, &str); 10] = [
        ("t_ns,a\n1,2\n2\n", "truncated", Some(3), "1 columns found, 2 expected"),
        ("t_ns,a\n1,2,3\n", "too wide", Some(2), "3 columns found, 2 expected"),
        ("t_ns,a\n1,NaN\n", "not a number", Some(2), "not a finite number"),
        ("t_ns,a\n1,inf\n", "infinite", Some(2), "not a finite number"),
        ("t_ns,a\n1,two\n", "a word", Some(2), "'two' is not a number"),
        ("#t_ns,a\n1,1\n\n1,2\n", "doubled time", Some(4), "time stamp 1 ns does not come after"),
        ("5,1\n4,2\n", "unordered, no header", Some(2), "sort the rows"),
        ("t_ns,a\n1.5,2\n", "fraction of a ns", Some(2), "whole nanoseconds"),
        ("t_ns,a\n", "header alone", None, "no rows"),
        ("", "empty", None, "no rows"),
    ];
    for (text, name, line, word) in cases {
        let path = put(dir.path(), &format!("{name}.csv"), text);
        complaint(read_timed_table(&path, 1), &path, line, &[word]);
    }
    let path = dir.path().join("nowhere.csv");
    complaint(read_timed_table(&path, 1), &path, None, &["missing", "check"]);
    let path = put(dir.path(), "binary.csv", [0xff, 0xfe, 0x00]);
    complaint(read_timed_table(&path, 1), &path, None, &["could not read"]);
}

#[test]
fn tables_with_windows_line_ends_and_spaces_are_read() {
    let dir = folder();
    let path = put(dir.path(), "a.csv", "#timestamp [ns], a\r\n 1 , 2.5 \r\n2,3\r\n");
    let table = read_timed_table(&path, 1).expect("read");
    assert_eq!(table.rows.iter().map(|r| r.values[0]).collect::<Vec<_>>(), [2.5, 3.0]);
}
