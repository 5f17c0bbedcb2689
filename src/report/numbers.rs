//! Numbers and names as people read them.

/// A number with four significant digits: whole numbers as they are, very large and very small ones with a power of ten.
pub fn format_number(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    if value.fract() == 0.0 && value.abs() < 1e6 {
        return minus(format!("{value}"));
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-3..5).contains(&magnitude) {
        return scientific(value);
    }
    let digits = (3 - magnitude).clamp(0, 6) as usize;
    minus(format!("{value:.digits$}"))
}

fn scientific(value: f64) -> String {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').expect("a number in scientific notation has an exponent");
    minus(format!("{mantissa} × 10{}", superscript(exponent)))
}

/// The label of a tick: short, with a power of ten where it has to be.
#[cfg(feature = "report")]
pub fn tick_label(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".into();
    }
    if (1e-3..1e5).contains(&size) {
        let digits = (0..6).find(|d| (size - format!("{size:.d$}").parse::<f64>().unwrap_or(size)).abs() < 1e-6 * size);
        return minus(format!("{value:.*}", digits.unwrap_or(6)));
    }
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').expect("a number in scientific notation has an exponent");
    let power = format!("10{}", superscript(exponent));
    minus(match mantissa {
        "1" => power,
        "-1" => format!("-{power}"),
        _ => format!("{mantissa}·{power}"),
    })
}

fn superscript(digits: &str) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    digits.chars().map(raise).collect()
}

/// A true minus sign, as wide as a digit.
fn minus(text: String) -> String {
    text.replace('-', "−")
}

/// A unit as people write it; nothing for a ratio or a count.
pub fn unit_label(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        "deg" => "°".into(),
        "deg/s" => "°/s".into(),
        other => other.into(),
    }
}

/// A name in snake case as words, with the abbreviations of the field.
pub fn label_of(name: &str) -> String {
    let word = |word: &str| match word {
        "nees" => "NEES".to_string(),
        "ate" => "ATE,".to_string(),
        "rpe" => "RPE over".to_string(),
        "10s" => "10 s,".to_string(),
        "rms" => "r.m.s.".to_string(),
        "p95" => "95th percentile".to_string(),
        "95" => "95 %".to_string(),
        "per" => "per".to_string(),
        "dof" => "degree of freedom,".to_string(),
        "sigma" => "1σ".to_string(),
        other => other.to_string(),
    };
    let words: Vec<String> = name.split('_').map(word).collect();
    let text = words.join(" ").trim_end_matches(',').to_string();
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
