//! Which images a folder holds, in which order, and when they were taken.

use super::frame::Frame;
use super::image_file::EXTENSIONS;
use crate::dataset::error::DatasetError;
use crate::dataset::storage::{read_text, seconds_to_ns};
use std::path::{Path, PathBuf};

/// Where the time stamps of images come from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum FrameTimes {
    /// `data.csv` beside the images; else their names, where those are whole nanoseconds or seconds with a decimal
    /// point; else the camera file's rate; else 1 s apart.
    #[default]
    Folder,
    /// A list of time and file name, a line an image.
    List(PathBuf),
    /// Images in the order of their names, taken this many times a second.
    RateHz(f64),
}

/// Images in order, and their times where the folder or the list tells them.
#[derive(Debug)]
pub(super) struct FrameList {
    paths: Vec<PathBuf>,
    times_ns: Option<Vec<i64>>,
}

impl FrameList {
    /// Lists the images of a folder, or of its `data/`.
    ///
    /// # Errors
    /// No images; a malformed list; times that do not increase.
    pub(super) fn read(folder: &Path, times: &FrameTimes) -> Result<Self, DatasetError> {
        let beside = folder.join("data.csv");
        let list = match times {
            FrameTimes::List(path) => listed(path, folder)?,
            FrameTimes::Folder if beside.is_file() => listed(&beside, folder)?,
            FrameTimes::Folder => timed_by_names(found(folder)?)?,
            FrameTimes::RateHz(_) => FrameList { paths: found(folder)?, times_ns: None },
        };
        if list.paths.is_empty() {
            let problem = format!("no pictures found ({}): {}", EXTENSIONS.join(", "), where_else(folder));
            return Err(DatasetError::Unusable { path: folder.into(), problem });
        }
        Ok(list)
    }

    /// The images' files.
    pub(super) fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Whether the times are known.
    pub(super) fn is_timed(&self) -> bool {
        self.times_ns.is_some()
    }

    /// The frames; those without a time are `rate_hz` a second.
    pub(super) fn into_frames(self, rate_hz: f64) -> Vec<Frame> {
        let times_ns = self.times_ns;
        let spaced = |index: usize| (index as f64 * 1e9 / rate_hz).round() as i64;
        let t_ns = |index: usize| times_ns.as_ref().map_or_else(|| spaced(index), |times| times[index]);
        let frame = |(index, path)| Frame { index, t_ns: t_ns(index), path };
        self.paths.into_iter().enumerate().map(frame).collect()
    }
}

/// Reads a list. An image that it names and that is not there is for the one who loads it; if all are missing, the list
/// or the folder is the wrong one.
fn listed(list: &Path, folder: &Path) -> Result<FrameList, DatasetError> {
    let text = read_text(list)?;
    let (mut paths, mut times_ns): (Vec<PathBuf>, Vec<i64>) = (Vec::new(), Vec::new());
    for (number, line) in text.lines().enumerate().map(|(number, line)| (number, line.trim())) {
        let malformed =
            |problem: String| DatasetError::Malformed { path: list.into(), line: number as u64 + 1, problem };
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let (time, name) = line
            .split_once([',', ' ', '\t'])
            .map(|(time, name)| (time.trim(), name.trim()))
            .filter(|(_, name)| !name.is_empty())
            .ok_or_else(|| malformed("'timestamp [ns],filename' expected".into()))?;
        let Some(t_ns) = time_ns(time) else {
            let is_header = number == 0 && time.starts_with(char::is_alphabetic);
            if is_header {
                continue;
            }
            let problem = format!("'{time}' is not a time stamp: write whole nanoseconds, or seconds with a point");
            return Err(malformed(problem));
        };
        if times_ns.last().is_some_and(|last| *last >= t_ns) {
            let problem =
                format!("time stamp {t_ns} ns does not come after the one before it: sort the rows and remove doubles");
            return Err(malformed(problem));
        }
        times_ns.push(t_ns);
        paths.push(place(name, list, folder));
    }
    if !paths.iter().any(|path| path.is_file()) {
        let problem = match paths.first() {
            Some(path) => format!(
                "none of its {} pictures exists, such as {}: check the folder and the names",
                paths.len(),
                path.display()
            ),
            None => "it lists no pictures: write a line 'timestamp [ns],filename' for each, or remove the list".into(),
        };
        return Err(DatasetError::Unusable { path: list.into(), problem });
    }
    Ok(FrameList { paths, times_ns: Some(times_ns) })
}

/// Whole nanoseconds, or seconds with a decimal point; at most 2^62 ns (146 years) from 0, so that two times have a
/// difference.
fn time_ns(text: &str) -> Option<i64> {
    let t_ns = text.parse().ok().or_else(|| text.contains('.').then(|| seconds_to_ns(text)).flatten());
    t_ns.filter(|t: &i64| t.unsigned_abs() <= 1 << 62)
}

/// An image that a list names: in the folder's `data/`, in the folder, or beside the list.
fn place(name: &str, list: &Path, folder: &Path) -> PathBuf {
    let places = [folder.join("data").join(name), folder.join(name), list.with_file_name(name)];
    places.iter().find(|path| path.is_file()).unwrap_or(&places[0]).clone()
}

/// Images of a folder's `data/`, or else of the folder itself, sorted by name as people count.
fn found(folder: &Path) -> Result<Vec<PathBuf>, DatasetError> {
    let folder = [folder.join("data"), folder.into()].into_iter().find(|f| f.is_dir()).expect("the second exists");
    let entries = std::fs::read_dir(&folder).map_err(DatasetError::io("list", &folder))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| is_image(path)).collect();
    paths.sort_by(|a, b| natord::compare(&a.to_string_lossy(), &b.to_string_lossy()).then_with(|| a.cmp(b)));
    Ok(paths)
}

/// What to try instead of a folder without images.
fn where_else(folder: &Path) -> String {
    let below = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let holds_some = |path: &PathBuf| path.join("cam0").is_dir() || found(path).is_ok_and(|paths| !paths.is_empty());
    let mut names: Vec<String> =
        below.filter(|path| path.is_dir() && holds_some(path)).map(|p| p.display().to_string()).collect();
    names.sort_by(|a, b| natord::compare(a, b));
    match names.first() {
        Some(first) => format!("give one of the {} folders below that hold some, such as {first}", names.len()),
        None => "check the folder".into(),
    }
}

/// Whether a file's extension is that of an image; hidden files, which some systems leave beside images, are none.
fn is_image(path: &Path) -> bool {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    EXTENSIONS.contains(&extension.as_str()) && !hidden && path.is_file()
}

/// Images whose names are times, in order of time. Small whole numbers only count; where no name is a time, the order
/// stays.
fn timed_by_names(paths: Vec<PathBuf>) -> Result<FrameList, DatasetError> {
    const LEAST_TIME: i64 = 1_000_000;
    let time = |path: &PathBuf| path.file_stem().and_then(|stem| stem.to_str()).and_then(time_ns);
    let times: Vec<Option<i64>> = paths.iter().map(time).collect();
    if !times.iter().flatten().any(|t| *t >= LEAST_TIME) {
        return Ok(FrameList { paths, times_ns: None });
    }
    if let Some(other) = times.iter().position(Option::is_none) {
        let problem = "its name is no time stamp, those of other pictures are: rename or remove it, or state the times with \
                       --rate-hz or --times";
        return Err(DatasetError::Unusable { path: paths[other].clone(), problem: problem.into() });
    }
    let mut timed: Vec<(i64, PathBuf)> = times.into_iter().flatten().zip(paths).collect();
    timed.sort();
    if let Some(pair) = timed.windows(2).find(|w| w[0].0 == w[1].0) {
        let problem = format!("{} has the same time stamp, {} ns: remove one of them", pair[0].1.display(), pair[0].0);
        return Err(DatasetError::Unusable { path: pair[1].1.clone(), problem });
    }
    let (times_ns, paths) = timed.into_iter().unzip();
    Ok(FrameList { paths, times_ns: Some(times_ns) })
}
