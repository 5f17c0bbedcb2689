//! Figures beside their bounds: cheap in the ordinary tests, in full as tables of `make accuracy`.

/// How much is measured.
#[cfg(feature = "render")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// Enough to notice a fault.
    Small,
    /// Enough to state a figure.
    Full,
}

/// One figure and its bound.
#[derive(Debug, Clone)]
pub struct Bar {
    pub quantity: String,
    pub measured: f64,
    bound: f64,
    unit: &'static str,
    side: Side,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    AtMost,
    AtLeast,
    Stated,
}

impl Bar {
    /// The same quantity, told and not judged.
    #[cfg(feature = "vision")]
    pub fn without_bound(self) -> Self {
        Bar { side: Side::Stated, ..self }
    }

    pub fn at_most(quantity: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound, unit, side: Side::AtMost }
    }

    pub fn at_least(quantity: impl Into<String>, measured: f64, bound: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound, unit, side: Side::AtLeast }
    }

    /// A figure that helps to judge the others and has no bound.
    pub fn stated(quantity: impl Into<String>, measured: f64, unit: &'static str) -> Self {
        Bar { quantity: quantity.into(), measured, bound: f64::NAN, unit, side: Side::Stated }
    }

    /// NaN never holds.
    pub fn holds(&self) -> bool {
        match self.side {
            Side::AtMost => self.measured <= self.bound,
            Side::AtLeast => self.measured >= self.bound,
            Side::Stated => true,
        }
    }

    fn row(&self) -> String {
        let bound = match self.side {
            Side::AtMost => format!("<= {}", figure(self.bound)),
            Side::AtLeast => format!(">= {}", figure(self.bound)),
            Side::Stated => String::new(),
        };
        let verdict = match self.side {
            Side::Stated => "",
            _ if self.holds() => "pass",
            _ => "FAIL",
        };
        format!("{:<72} {:>10} {:>12} {:<12} {verdict}", self.quantity, figure(self.measured), bound, self.unit)
    }
}

fn figure(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) { format!("{value:.1e}") } else { format!("{value:.4}") }
}

/// Prints the bars and fails if one does not hold.
#[cfg(feature = "render")]
pub fn check(bars: &[Bar]) {
    bars.iter().for_each(|bar| println!("{}", bar.row()));
    let failed: Vec<String> = bars.iter().filter(|bar| !bar.holds()).map(Bar::row).collect();
    assert!(failed.is_empty(), "not held:\n{}", failed.join("\n"));
}

/// Prints parts of a table as they are measured, and fails at the end if a bar does not hold.
pub fn check_table(title: &str, parts: impl Iterator<Item = Vec<Bar>>) {
    println!("\n{title:<72} {:>10} {:>12}", "measured", "bound");
    let mut failed = Vec::new();
    for bar in parts.flatten() {
        println!("{}", bar.row());
        failed.extend((!bar.holds()).then(|| bar.row()));
    }
    assert!(failed.is_empty(), "not held:\n{}", failed.join("\n"));
}
