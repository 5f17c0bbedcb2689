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

/// What a key means, without its default, and what each of its values does.
pub(super) fn meaning_text(node: &Value, target: &Value) -> String {
    let own = node["description"].as_str().or(target["description"].as_str()).unwrap_or_default();
    let mut text = single_spaced(own);
    if let Some((start, end)) = bracketed_default(&text) {
        text.replace_range(start..end, "");
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
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace("[`", "`").replace("`]", "`")
}
