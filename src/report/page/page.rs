//! What a report consists of, as plain data.

use crate::evaluation::Verdict;
use crate::report::plot::Plot;

/// A whole report.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title of the page.
    pub title: String,
    /// One or two sentences under the title: what was done.
    pub lead: String,
    /// The sections, in order.
    pub sections: Vec<Section>,
}

/// A part of the page with a heading, listed in the table of contents.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// The heading.
    pub heading: String,
    /// What stands under it.
    pub blocks: Vec<Block>,
}

/// An image as PNG bytes.
#[derive(Debug, Clone, PartialEq)]
pub struct PageImage {
    /// What it shows; also the text for those who cannot see it.
    pub caption: String,
    /// The PNG file's bytes.
    pub png: Vec<u8>,
}

/// A piece of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A heading within the section.
    Heading(String),
    /// Running text.
    Paragraph(String),
    /// Remarks, one a line, in small type.
    Notes(Vec<String>),
    /// Judgements with their reasons.
    Verdicts(Vec<Verdict>),
    /// A table; the first column names the row.
    Table {
        /// What it shows.
        caption: String,
        /// Names of the columns.
        header: Vec<String>,
        /// The rows, as long as the header.
        rows: Vec<Vec<String>>,
    },
    /// An image over the full width.
    PageImage(PageImage),
    /// Images side by side.
    Gallery(Vec<PageImage>),
    /// A plot.
    Plot(Plot),
}
