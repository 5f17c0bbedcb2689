//! The words of one key's line in the reference: type, unit, default, meaning.

use serde_json::Value;

/// Ends of keys and the units that they stand for; the first that fits counts.
const UNITS: &[(&str, &str)] = &[
    ("gyroscope_noise_density", "rad/s/√Hz"),
    ("accelerometer_noise_density", "m/s²/√Hz"),
    ("electrons_per_radiance_s", "electrons/s per I/F"),
    ("electrons_per_radiance", "electrons per I/F"),
    ("electrons_per_dn", "electrons/DN"),
    ("metres_per_px", "m/px"),
    ("metres_per_unit", "m"),
    ("px_per_deg", "px/°"),
    ("magnitude", "mag"),
    ("percent", "%"),
    ("bits", "bits"),
    ("_edges", "edges"),
    ("_if_px", "I/F px"),
    ("_electrons_s", "electrons/s"),
    ("_electrons", "electrons"),
    ("_bytes", "bytes"),
    ("_m3_s2", "m³/s²"),
    ("_m_s2", "m/s²"),
    ("_rad_s", "rad/s"),
    ("_rad", "rad"),
    ("_deg_s", "°/s"),
    ("_m_s", "m/s"),
    ("_deg", "°"),
    ("_dn", "DN"),
    ("_au", "au"),
    ("_hz", "Hz"),
    ("_px", "px"),
    ("_h", "h"),
    ("_m", "m"),
    ("_s", "s"),
];

/// Type and unit of a key.
pub(super) fn kind_text(key: &str, node: &Value) -> String {
    let kind = kind(node);
    match UNITS.iter().find(|(end, _)| key.ends_with(end)) {
        Some((_, unit)) if kind.contains("number") || kind.contains("integer") => format!("{kind}, {unit}"),
        _ => kind,
    }
}

fn kind(node: &Value) -> String {
    let any = |key: &str| node[key].as_array().map(Vec::as_slice).unwrap_or_default();
    let alternatives: Vec<String> = any("oneOf").iter().chain(any("anyOf")).map(kind).collect();
    if !alternatives.is_empty() {
        return alternatives.join(" or ");
    }
    if let Some(value) = node["const"].as_str() {
        return format!("`\"{value}\"`");
    }
    let named = |name: &str| match name {
        "boolean" => "`true` or `false`".to_string(),
        "string" => "text".into(),
        "array" => list(node),
        "object" => inner_kind(node),
        other => other.into(),
    };
    let types = node["type"].as_str().into_iter().chain(any("type").iter().filter_map(Value::as_str));
    types.filter(|name| *name != "null").map(named).collect::<Vec<_>>().join(" or ")
}

/// The type of what a choice's only key holds.
fn inner_kind(node: &Value) -> String {
    let inner = node["properties"].as_object().into_iter().flatten().next();
    let plain = inner.filter(|(_, node)| node["$ref"].is_null() && node["properties"].is_null());
    plain.map_or_else(|| "table".into(), |(_, node)| kind(node))
}

fn list(node: &Value) -> String {
    let plural = |kind: String| match kind.as_str() {
        "" => "tables".into(),
        "number" | "integer" | "text" => format!("{}s", kind.replace("text", "name")),
        other => format!("lists of {other}"),
    };
    let items = plural(kind(&node["items"]));
    match (node["minItems"].as_u64(), node["maxItems"].as_u64()) {
        (Some(least), Some(most)) if least == most => format!("{least} {items}"),
        _ => format!("list of {items}"),
    }
}

/// The default of a key: what its documentation says in brackets, or else the value itself.
pub(super) fn default_text(node: &Value) -> Option<String> {
    let description = single_spaced(node["description"].as_str()?);
    let said = bracketed_default(&description)
        .map(|(start, end)| description[start + OPENING.len()..end - 1].trim_start_matches(':').trim().to_string());
    let value = &node["default"];
    said.or_else(|| (!value.is_null() && !value.is_object()).then(|| format!("`{value}`")))
}

/// A command's default of a key: what the documentation says where it is the same, or else the value itself.
pub(super) fn agreed_default(said: Option<String>, value: &Value) -> Option<String> {
    if value.is_object() || value.is_null() {
        return None;
    }
    let plain = value.as_str().map_or_else(|| value.to_string(), String::from);
    let words = |text: &str| -> Vec<String> {
        let parts = text.split(|c: char| c.is_whitespace() || ":,[]`\"".contains(c));
        parts.filter(|part| !part.is_empty()).map(String::from).collect()
    };
    let same = |(said, holds): (&String, &String)| match (said.parse::<f64>(), holds.parse::<f64>()) {
        (Ok(said), Ok(holds)) => (said - holds).abs() <= 1e-4 * holds.abs(),
        _ => said == holds,
    };
    let holds = words(&plain);
    let agrees = |said: &String| words(said).len() >= holds.len() && words(said).iter().zip(&holds).all(same);
    said.filter(|said| !holds.is_empty() && agrees(said)).or_else(|| Some(format!("`{value}`")))
}

/// What a key may be, as its documentation says before the default.
pub(super) fn range_text(node: &Value) -> Option<String> {
    let text = single_spaced(node["description"].as_str()?);
    range_place(&text).map(|(start, end)| text[start..end].to_string())
}

/// Where a range stands in a text: after a comma, and before ` (default …)` or where the sentence or its first part ends.
fn range_place(text: &str) -> Option<(usize, usize)> {
    let default = text.find(OPENING);
    let mut ends: Vec<usize> = match default {
        Some(end) => vec![end],
        None => [": ", "; ", ". "].iter().flat_map(|mark| text.match_indices(mark)).map(|(end, _)| end).collect(),
    };
    ends.sort_unstable();
    ends.extend(default.is_none().then(|| text.trim_end_matches('.').len()));
    ends.into_iter().find_map(|end| range_before(text, end))
}

/// A range between the last comma before `end` and there.
fn range_before(text: &str, end: usize) -> Option<(usize, usize)> {
    let start = text[..end].rfind(", ")? + 2;
    let words: Vec<&str> = text[start..end].split(' ').collect();
    let is_range = match words.as_slice() {
        [low, "to", _]
        | [low, "or", "more"]
        | ["above", low]
        | ["above", low, "to", _]
        | ["between", low, "and", _] => low.starts_with(|c: char| c.is_ascii_digit() || c == '-'),
        ["its", "norm", "below", _] | ["no", "less" | "fewer", "than", _] => true,
        _ => false,
    };
    is_range.then_some((start, end))
}

/// What a key means, without its default and range, and what each of its values does.
pub(super) fn meaning_text(node: &Value, target: &Value) -> String {
    let own = node["description"].as_str().or(target["description"].as_str()).unwrap_or_default();
    let mut text = single_spaced(own);
    if let Some((start, end)) = bracketed_default(&text) {
        text.replace_range(start..end, "");
    }
    // The default is gone: the range, if any, now ends the sentence.
    let range = range_place(&single_spaced(own));
    if let Some((start, end)) = range {
        text.replace_range(start - 2..end, "");
    }
    let values = target["oneOf"].as_array().map(Vec::as_slice).unwrap_or_default();
    if values.iter().all(|value| value["const"].is_string()) {
        for value in values {
            let name = value["const"].as_str().unwrap_or_default();
            text += &format!(" `\"{name}\"`: {}", single_spaced(value["description"].as_str().unwrap_or_default()));
        }
    }
    text.replace('|', "\\|")
}

const OPENING: &str = " (default";

/// Where ` (default …)` stands in a text.
fn bracketed_default(text: &str) -> Option<(usize, usize)> {
    let start = text.find(OPENING)?;
    Some((start, start + text[start..].find(')')? + 1))
}

/// One line of text: line ends become spaces, and links into the code plain names.
pub(super) fn single_spaced(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut parts = line.split("`](");
    let first = parts.next().unwrap_or_default().to_string();
    let without_target = |told: String, rest: &str| told + "`]" + rest.split_once(')').map_or(rest, |(_, rest)| rest);
    parts.fold(first, without_target).replace("[`", "`").replace("`]", "`")
}
