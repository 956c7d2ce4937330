//! What is counted over the whole process, and so has a process of its own.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests may fail loudly")]

#[path = "studio/page.rs"]
#[allow(dead_code, reason = "others use the rest")]
mod page;

use page::{BALL, PATIENCE, Studio};
use std::time::{Duration, Instant};

#[test]
fn a_page_that_goes_away_takes_its_render_along() {
    let studio = Studio::with(&[]);
    let threads = || std::fs::read_dir("/proc/self/task").map_or(0, Iterator::count);
    let come_and_go = || {
        let mut page = studio.page();
        page.view("a.hry");
        page.edit("a.hry", 1, &BALL.replace("size = (64, 48)", "size = (4000, 4000), samples = 64")).unwrap();
        page.event_named("frame");
        page.close();
    };
    // Some threads are there from the first use on, and stay; a render that went on would add one for each page.
    come_and_go();
    std::thread::sleep(Duration::from_secs(1));
    let before = threads();
    (0..5).for_each(|_| come_and_go());
    let start = Instant::now();
    while threads() > before + 2 && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(threads() <= before + 2, "{before} threads became {}", threads());
}
