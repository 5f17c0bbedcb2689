//! The page as a browser shows it.

use super::sample::sample_page;
use opnav::report::*;
use std::path::{Path, PathBuf};
use std::process::Command;

fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file())
}

fn headless(browser: &Path, profile: &Path) -> Command {
    let mut command = Command::new(browser);
    command
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .arg(format!("--user-data-dir={}", profile.display()));
    command
}

/// What a browser made of a page.
#[derive(Debug, PartialEq)]
struct Seen {
    images: usize,
    broken_images: usize,
    empty_svgs: usize,
    svgs: usize,
    rows: usize,
    wider_than_the_window: bool,
}

const PROBE: &str = "<script>window.addEventListener('load', () => {
  const images = [...document.images], svgs = [...document.querySelectorAll('svg')];
  const seen = [images.length, images.filter(i => i.naturalWidth === 0).length,
    svgs.filter(s => s.getBoundingClientRect().height < 50 || s.querySelectorAll('text').length < 4).length,
    svgs.length, document.querySelectorAll('tbody tr').length,
    document.documentElement.scrollWidth > window.innerWidth ? 1 : 0];
  document.body.setAttribute('data-seen', seen.join(' '));
});</script>";

/// Opens a copy of the page, with a script that counts, and reads the counts from the resulting document.
fn look(browser: &Path, html: &str) -> Seen {
    let dir = tempfile::tempdir().expect("a folder");
    let file = dir.path().join("page.html");
    std::fs::write(&file, format!("{html}{PROBE}")).expect("write");
    let mut command = headless(browser, &dir.path().join("profile"));
    let output = command.arg("--dump-dom").arg(format!("file://{}", file.display())).output().expect("a browser");
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let seen = dom.split("data-seen=\"").nth(1).and_then(|rest| rest.split('"').next());
    let seen = seen.unwrap_or_else(|| panic!("no counts: {}", String::from_utf8_lossy(&output.stderr)));
    let n: Vec<usize> = seen.split(' ').map(|v| v.parse().expect("a count")).collect();
    Seen {
        images: n[0],
        broken_images: n[1],
        empty_svgs: n[2],
        svgs: n[3],
        rows: n[4],
        wider_than_the_window: n[5] == 1,
    }
}

#[test]
fn a_browser_shows_every_image_plot_and_row() {
    let Some(browser) = browser() else {
        eprintln!(
            "\n*** SKIPPED: no chromium, chromium-browser or google-chrome on PATH; the page was not opened ***\n"
        );
        return;
    };
    let page = sample_page();
    let html = render_page(&page);
    let seen = look(&browser, &html);
    let rows = |block: &Block| if let Block::Table { rows, .. } = block { rows.len() } else { 0 };
    let rows: usize = page.sections.iter().flat_map(|s| &s.blocks).map(rows).sum();
    let good = Seen { images: 6, broken_images: 0, empty_svgs: 0, svgs: 10, rows, wider_than_the_window: false };
    assert_eq!(seen, good);
    // The other way round: a picture that is none, and a plot without content, have to be noticed.
    let mut broken = page;
    let png = vec![0x89, b'P', b'N', b'G', 1, 2, 3];
    broken.sections[2].blocks.push(Block::PageImage(PageImage { caption: "broken".into(), png }));
    let svg = "<svg viewBox=\"0 0 100 1\"></svg>".into();
    broken.sections[2].blocks.push(Block::Plot(Plot { title: "empty".into(), svg, legend: vec![] }));
    assert_eq!(
        look(&browser, &render_page(&broken)),
        Seen { images: 7, broken_images: 1, empty_svgs: 1, svgs: 11, ..good }
    );
}

/// Makes the page and its screenshots for a person to look at: `OPNAV_LOOK=folder cargo test look_at_the_page`.
#[test]
fn look_at_the_page() {
    let Some(folder) = std::env::var_os("OPNAV_LOOK").map(PathBuf::from) else { return };
    let file = folder.join("page.html");
    write_report(&sample_page(), &file).expect("write");
    let Some(browser) = browser() else { return };
    for (name, size) in [("wide.png", "1200,7600"), ("narrow.png", "420,9000")] {
        let shot = format!("--screenshot={}", folder.join(name).display());
        let profile = tempfile::tempdir().expect("a folder");
        let mut command = headless(&browser, profile.path());
        command.arg(shot).arg(format!("--window-size={size}")).arg(format!("file://{}", file.display()));
        assert!(command.output().expect("a browser").status.success());
    }
}
