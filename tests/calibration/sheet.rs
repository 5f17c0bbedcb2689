//! The new constants with where they come from, as a table and as the file.

use opnav::vision::{Constant, NoiseModel, NoiseModelFile};

/// A fitted number.
#[derive(Debug, Clone)]
pub struct Found {
    pub key: &'static str,
    pub value: f64,
    pub interval_95: [f64; 2],
    pub samples: usize,
    pub source: String,
    pub validity: String,
}

impl Found {
    fn constant(&self) -> Constant {
        let [low, high] = self.interval_95;
        let value = rounded(self.value, f64::round);
        // The interval never excludes the number: a few scenes drawn again may all lie on one side of it.
        let [low, high] = [rounded(low, f64::floor).min(value), rounded(high, f64::ceil).max(value)];
        let both = [low, high];
        Constant {
            value,
            interval_95: both.iter().all(|v| v.is_finite()).then_some(both),
            samples: self.samples,
            source: self.source.clone(),
            validity: self.validity.clone(),
        }
    }
}

/// Three significant digits.
fn rounded(value: f64, to_whole: fn(f64) -> f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let digits = 2 - value.abs().log10().floor() as i32;
    let text = format!("{:.*}", digits.max(0) as usize, to_whole(value * 10f64.powi(digits)) / 10f64.powi(digits));
    text.parse().expect("a number")
}

/// The old file with the numbers that were found.
pub fn updated(old: &NoiseModelFile, found: &[Found], (date, scenes): (&str, Vec<String>)) -> NoiseModelFile {
    let keys: Vec<(&str, Constant)> = old.constants.entries().into_iter().map(|(k, c)| (k, c.clone())).collect();
    let mut rest = keys.into_iter();
    let constants: NoiseModel<Constant> = {
        let next = std::cell::RefCell::new(&mut rest);
        // `map` visits the constants in the order of `entries`.
        old.constants.map(|_| {
            let (key, before) = next.borrow_mut().next().expect("as many constants as keys");
            found.iter().find(|f| f.key == key).map_or(before, Found::constant)
        })
    };
    let file = NoiseModelFile {
        format: 1,
        command: "make calibrate".into(),
        date: date.into(),
        seed: super::SEED,
        scenes,
        constants,
    };
    // The same numbers are those of the day on which they were found.
    let same = NoiseModelFile { date: old.date.clone(), ..file.clone() };
    if same == *old { same } else { file }
}

/// Text of the file.
pub fn text(file: &NoiseModelFile) -> String {
    let head = "# The noise model of the front end: written by `make calibrate`, read by `vision/noise_model`, where the meaning and the\n\
                # unit of each constant stand. Change the recipe (tests/calibration), not the numbers.\n\n";
    format!("{head}{}", toml::to_string(file).expect("plain numbers and texts"))
}

/// Old and new numbers side by side.
pub fn table(old: &NoiseModelFile, new: &NoiseModelFile) -> String {
    let mut lines = vec![format!("{:<30} {:>10} {:>10}   {:<22} {:>8}", "constant", "old", "new", "95 %", "samples")];
    for ((key, before), (_, after)) in old.constants.entries().into_iter().zip(new.constants.entries()) {
        let interval = after.interval_95.map_or("not fitted".into(), |[low, high]| format!("{low} to {high}"));
        lines.push(format!("{key:<30} {:>10} {:>10}   {interval:<22} {:>8}", before.value, after.value, after.samples));
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_found_number_takes_its_place_and_the_file_reads_back() {
        let old = NoiseModelFile::default();
        let found = Found {
            key: "map.standing_out",
            value: 0.123_456,
            interval_95: [0.1111, 0.2222],
            samples: 7,
            source: "a synthetic one, for this test alone".into(),
            validity: "nowhere".into(),
        };
        let new = updated(&old, &[found], ("2030-01-02", vec!["a.toml".into()]));
        let read = NoiseModelFile::parse(&text(&new)).expect("it reads back");
        assert_eq!(read, new);
        let constant = &read.constants.map.standing_out;
        assert_eq!((constant.value, constant.interval_95), (0.123, Some([0.111, 0.223])));
        assert_eq!((read.constants.corner, &read.date[..]), (old.constants.corner.clone(), "2030-01-02"));
        assert!(table(&old, &new).contains("0.123"));
    }

    #[test]
    fn the_same_numbers_keep_their_date_and_bytes() {
        let old = NoiseModelFile::parse(&text(&NoiseModelFile {
            command: "make calibrate".into(),
            seed: super::super::SEED,
            ..NoiseModelFile::default()
        }))
        .expect("usable");
        let again = updated(&old, &[], ("2030-01-02", old.scenes.clone()));
        assert_eq!(text(&again), text(&old));
        let elsewhere = updated(&old, &[], ("2030-01-02", vec!["b.toml".into()]));
        assert_ne!(text(&elsewhere), text(&old));
    }
}
