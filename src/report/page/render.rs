//! The page as HTML.

use super::page::{Block, Page, PageImage};
use crate::dataset::write_text;
use crate::evaluation::Verdict;
use crate::report::error::ReportError;
use crate::report::numbers::label_of;
use crate::report::plot::Plot;
use base64::Engine;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::path::Path;

const STYLE: &str = include_str!("style.css");

/// Writes a page as one self-contained HTML file.
///
/// # Errors
/// Names the file that could not be written.
pub fn write_report(page: &Page, out: &Path) -> Result<(), ReportError> {
    Ok(write_text(out, &render_page(page))?)
}

/// The page as HTML text.
pub fn render_page(page: &Page) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content={ "opnav " (env!("CARGO_PKG_VERSION")) };
                title { (page.title) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (page.title) }
                    @if !page.lead.is_empty() { p class="lead" { (page.lead) } }
                }
                @if page.sections.len() > 1 {
                    nav aria-label="Contents" {
                        ol {
                            @for (number, section) in page.sections.iter().enumerate() {
                                li { a href={ "#section-" (number + 1) } { (section.heading) } }
                            }
                        }
                    }
                }
                main {
                    @for (number, section) in page.sections.iter().enumerate() {
                        section id={ "section-" (number + 1) } {
                            h2 { (section.heading) }
                            @for block in &section.blocks { (block_markup(block)) }
                        }
                    }
                }
                footer { p { "Made by opnav " (env!("CARGO_PKG_VERSION")) ". This page is self-contained." } }
            }
        }
    };
    markup.into_string()
}

fn block_markup(block: &Block) -> Markup {
    match block {
        Block::Heading(text) => html! { h3 { (text) } },
        Block::Paragraph(text) => html! { p { (text) } },
        Block::Notes(notes) => html! { ul class="notes" { @for note in notes { li { (note) } } } },
        Block::Verdicts(verdicts) => html! { ul class="verdicts" { @for v in verdicts { (verdict_markup(v)) } } },
        Block::Table { caption, header, rows } => table_markup(caption, header, rows),
        Block::PageImage(image) => image_markup(image),
        Block::Gallery(images) => html! { div class="gallery" { @for p in images { (image_markup(p)) } } },
        Block::Plot(plot) => plot_markup(plot),
    }
}

fn verdict_markup(verdict: &Verdict) -> Markup {
    let mark = if verdict.holds { "✓ Yes" } else { "✗ No" };
    html! {
        li class=[verdict.holds.then_some("holds")] {
            (label_of(&verdict.name)) "? " strong { (mark) } br; span { (verdict.reason) }
        }
    }
}

fn table_markup(caption: &str, header: &[String], rows: &[Vec<String>]) -> Markup {
    let numeric: Vec<bool> = (0..header.len()).map(|column| column > 0 && is_numeric(rows, column)).collect();
    let class = |column: usize| numeric.get(column).copied().unwrap_or(false).then_some("number");
    html! {
        div class="table" {
            table {
                caption { (caption) }
                thead { tr { @for (k, name) in header.iter().enumerate() { th scope="col" class=[class(k)] { (name) } } } }
                tbody {
                    @for row in rows {
                        tr {
                            @for (k, cell) in row.iter().enumerate() {
                                @if k == 0 { th scope="row" { (cell) } } @else { td class=[class(k)] { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Whether a column holds numbers, which stand at its right.
fn is_numeric(rows: &[Vec<String>], column: usize) -> bool {
    let mut cells = rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.is_empty()).peekable();
    cells.peek().is_some() && cells.all(|cell| cell.starts_with(|c: char| c.is_ascii_digit() || c == '−' || c == '–'))
}

fn image_markup(image: &PageImage) -> Markup {
    let data = base64::engine::general_purpose::STANDARD.encode(&image.png);
    html! {
        figure class="picture" {
            img alt=(image.caption) src={ "data:image/png;base64," (data) };
            figcaption { (image.caption) }
        }
    }
}

fn plot_markup(plot: &Plot) -> Markup {
    html! {
        figure class="plot" {
            figcaption { (plot.title) }
            ul class="legend" {
                @for entry in &plot.legend {
                    li {
                        @if !entry.color.is_empty() { span class="swatch" style={ "background:" (entry.color) } {} }
                        (entry.label)
                    }
                }
            }
            (PreEscaped(&plot.svg))
        }
    }
}
