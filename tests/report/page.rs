//! The page: whole in one file, escaped, every figure explained.

use super::sample::{landing_metrics, pictures, sample_page};
use opnav::evaluation::{Series, Verdict};
use opnav::report::*;

#[test]
fn the_page_needs_nothing_from_outside() {
    let html = render_page(&sample_page());
    for outside in ["http://", "https://", "<script", "@import", "url(", "<iframe", "<link rel=\"stylesheet"] {
        let found = html.replace("http://www.w3.org/2000/svg", "").find(outside);
        assert_eq!(found, None, "{outside} in the page");
    }
    assert!(html.starts_with("<!DOCTYPE html><html lang=\"en\">"));
    assert!(html.len() < 4_000_000, "{} bytes", html.len());
}

#[test]
fn text_is_escaped() {
    let evil = "<img src=x onerror=alert(1)> & \"quotes\"".to_string();
    let table = Block::Table { caption: evil.clone(), header: vec![evil.clone()], rows: vec![vec![evil.clone()]] };
    let verdict = Verdict { name: evil.clone(), holds: true, reason: evil.clone() };
    let series = Series { t_s: vec![0.0, 1.0], values: vec![1.0, 2.0], ..Series::default() };
    let curve = Curve { label: evil.clone(), t_s: &series.t_s, values: &series.values, sigma: &[] };
    let plot = error_with_envelope(&evil, &evil, &[curve]).expect("a plot");
    let blocks = vec![
        Block::Heading(evil.clone()),
        Block::Paragraph(evil.clone()),
        Block::Notes(vec![evil.clone()]),
        Block::Verdicts(vec![verdict]),
        table,
        Block::PageImage(PageImage { caption: evil.clone(), png: vec![] }),
        Block::Plot(plot),
    ];
    let section = Section { heading: evil.clone(), blocks };
    let html = render_page(&Page { title: evil.clone(), lead: evil.clone(), sections: vec![section.clone(), section] });
    assert!(!html.contains("<img src=x"), "markup came through");
    assert!(html.matches("&lt;img src=x").count() > 20);
}

#[test]
fn every_plot_and_image_says_what_it_shows() {
    let html = render_page(&sample_page());
    assert_eq!(html.matches("<svg").count(), html.matches("<svg role=\"img\"").count());
    assert_eq!(html.matches("<svg").count(), html.matches("<title>").count() - 1);
    assert_eq!(html.matches("<img").count(), html.matches("<img alt=\"Frame at").count());
    assert!(html.contains("<caption>Errors of the landing</caption>"));
    assert!(html.contains("scope=\"col\"") && html.contains("scope=\"row\""));
}

#[test]
fn tables_carry_units_and_readable_numbers() {
    let html = render_page(&sample_page());
    for text in ["−4.693", "0.1062", "1.20 × 10⁻⁴".replace("1.20", "−1.20").as_str(), "123.5", "°/s", "Filter", "41.25"]
    {
        assert!(html.contains(text), "{text}");
    }
}

#[test]
fn wide_images_are_shrunk_for_the_page() {
    let wide = image::RgbImage::from_pixel(64, 48, image::Rgb([100, 90, 80]));
    let small = image::load_from_memory(&image_png(&wide, 32).expect("a PNG")).expect("it decodes");
    assert_eq!((small.width(), small.height()), (32, 24));
    let same = image::load_from_memory(&image_png(&wide, 100).expect("a PNG")).expect("it decodes");
    assert_eq!((same.width(), same.height()), (64, 48));
}

#[test]
fn a_result_folder_becomes_a_section() {
    let dir = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).expect("write");
    put("summary.json", "{\"mission\": \"landing\", \"timing_ms\": {\"filter\": 12.5}}");
    let error = result_section(dir.path(), vec![]).expect_err("not evaluated yet").to_string();
    assert!(error.contains("metrics.json is missing") && error.contains("opnav evaluate"), "{error}");
    landing_metrics().write(dir.path()).expect("write");
    let section = result_section(dir.path(), pictures()).expect("a section");
    assert_eq!(section.heading, "Landing");
    let plots = section.blocks.iter().filter(|b| matches!(b, Block::Plot(_))).count();
    let tables = section.blocks.iter().filter(|b| matches!(b, Block::Table { .. })).count();
    assert_eq!((plots, tables), (5, 4));
    let nowhere = dir.path().join("taken/page.html");
    put("taken", "a file where a folder should be");
    let error = write_report(&Page::default(), &nowhere).expect_err("no folder").to_string();
    assert!(error.contains("taken"), "{error}");
}
