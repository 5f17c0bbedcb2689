//! What a page shows of a table, in Markdown.

/// A table of keys, or a choice between several.
pub(super) struct Section {
    pub(super) type_name: String,
    /// Paths with their brackets: `[sensor]`, `[[cameras]]`.
    pub(super) headings: Vec<String>,
    /// The commands that have it; none for a scenario's.
    pub(super) commands: Vec<String>,
    pub(super) about: String,
    pub(super) rows: Vec<Row>,
}

/// One key.
pub(super) struct Row {
    pub(super) key: String,
    pub(super) kind: String,
    /// The default of each command, in the order of the section's commands.
    pub(super) defaults: Vec<String>,
    pub(super) range: String,
    pub(super) meaning: String,
}

/// Sections made so far.
#[derive(Default)]
pub(super) struct KeyChapters {
    pub(super) sections: Vec<Section>,
}

impl KeyChapters {
    pub(super) fn markdown(&self, preface: &str) -> String {
        let sections: Vec<String> = self.sections.iter().map(Section::markdown).collect();
        format!("{preface}\n{}", sections.join("\n"))
    }
}

impl Section {
    /// Notes another place where the table stands, with its defaults there.
    pub(super) fn add(&mut self, heading: String, command: Option<&str>, defaults: Vec<String>) {
        if !self.headings.contains(&heading) {
            self.headings.push(heading);
        }
        let is_new = command.is_none() || !self.commands.iter().any(|known| Some(known.as_str()) == command);
        self.commands.extend(command.filter(|_| is_new).map(String::from));
        if is_new {
            self.rows.iter_mut().zip(defaults).for_each(|(row, default)| row.defaults.push(default));
        }
    }

    fn markdown(&self) -> String {
        let is_top = self.headings[0].starts_with("`opnav");
        let of = self.commands.iter().map(|command| format!("`{command}`")).collect::<Vec<_>>().join(", ");
        let of = if is_top || of.is_empty() { String::new() } else { format!(" Of {of}.") };
        let headings = self.headings.join(", ");
        let head = "| key | type, unit | default | range | meaning |\n|---|---|---|---|---|\n";
        let mut text = format!("## {headings}\n\n{}{of}\n\n{head}", self.about);
        for row in &self.rows {
            let Row { key, kind, range, meaning, .. } = row;
            text += &format!("| `{key}` | {kind} | {} | {range} | {meaning} |\n", row.default(&self.commands));
        }
        text
    }
}

impl Row {
    /// The first command's default, and those of others where they differ.
    fn default(&self, commands: &[String]) -> String {
        let Some(first) = self.defaults.first() else { return String::new() };
        let others = self.defaults.iter().zip(commands).filter(|(default, _)| *default != first);
        let others = others.map(|(default, command)| format!("; in `{command}` {default}"));
        first.clone() + &others.collect::<String>()
    }
}
