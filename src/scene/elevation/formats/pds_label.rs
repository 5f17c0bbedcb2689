//! Labels of the Planetary Data System, version 3.
//!
//! Source: PDS Standards Reference 3.8, chapter 12, "Object Description Language".

/// `KEY = VALUE` lines of a label, each with the names of the objects around it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Label {
    entries: Vec<(String, String)>,
}

impl Label {
    /// Reads a label up to its line `END`. Keys inside objects read `OBJECT.KEY`.
    pub(super) fn parse(text: &str) -> Label {
        let mut entries = Vec::new();
        let mut inside: Vec<String> = Vec::new();
        for line in statements(text) {
            let Some((key, value)) = line.split_once('=') else {
                match line.trim() {
                    "END" => break,
                    "END_OBJECT" | "END_GROUP" => drop(inside.pop()),
                    _ => {}
                }
                continue;
            };
            let (key, value) = (key.trim(), value.trim());
            match key {
                "OBJECT" | "GROUP" => inside.push(value.into()),
                "END_OBJECT" | "END_GROUP" => drop(inside.pop()),
                _ => {
                    let name = inside.iter().map(String::as_str).chain([key]).collect::<Vec<_>>().join(".");
                    entries.push((name, value.into()));
                }
            }
        }
        Label { entries }
    }

    /// The value of a key whose name, objects included, ends in `name`.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        let ends = |key: &str| key == name || key.strip_suffix(name).is_some_and(|front| front.ends_with('.'));
        self.entries.iter().find(|(key, _)| ends(key)).map(|(_, value)| value.trim_matches('"'))
    }

    /// A number, and its unit in upper case if it has one.
    pub(super) fn number_with_unit(&self, name: &str) -> Option<(f64, String)> {
        let text = self.text(name)?;
        let (number, unit) = text.split_once('<').unwrap_or((text, ""));
        Some((parse_number(number)?, unit.trim_end_matches('>').trim().to_uppercase()))
    }

    /// A number, whatever its unit.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.number_with_unit(name).map(|(number, _)| number)
    }
}

/// Lines without comments; a value that spans lines becomes one.
fn statements(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut open = false;
    for line in text.lines() {
        let line = line.split("/*").next().unwrap_or_default();
        if open {
            if let Some(last) = found.last_mut() {
                last.push(' ');
                last.push_str(line.trim());
            }
        } else {
            found.push(line.into());
        }
        let last = found.last().map_or("", String::as_str);
        open = last.matches('"').count() % 2 == 1 || last.matches('(').count() > last.matches(')').count();
    }
    found
}

/// A decimal number, or an IEEE 754 pattern such as `16#FF7FFFFB#`.
fn parse_number(text: &str) -> Option<f64> {
    let text = text.trim().trim_matches('"');
    if let Some(hex) = text.strip_prefix("16#").and_then(|t| t.strip_suffix('#')) {
        return u32::from_str_radix(hex, 16).ok().map(|bits| f64::from(f32::from_bits(bits)));
    }
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_object_and_unit() {
        let label = Label::parse(
            "PDS_VERSION_ID = PDS3\r\n^IMAGE = (\"A.IMG\",\r\n  3 <BYTES>)\r\nOBJECT = IMAGE\r\n LINES = 4 /* rows */\r\n\
             END_OBJECT = IMAGE\r\nOBJECT = MAP\r\n A_AXIS_RADIUS = 3396.0 <KM>\r\nEND_OBJECT\r\nMISSING = 16#FF7FFFFB#\r\n\
             END\r\nLINES = 9",
        );
        assert_eq!(label.number("IMAGE.LINES"), Some(4.0));
        assert_eq!(label.number_with_unit("A_AXIS_RADIUS"), Some((3396.0, "KM".into())));
        assert_eq!(label.text("^IMAGE"), Some("(\"A.IMG\", 3 <BYTES>)"));
        assert_eq!(label.number("MISSING"), Some(f64::from(f32::from_bits(0xFF7F_FFFB))));
        assert_eq!(label.number("AXIS_RADIUS"), None);
    }
}
