//! Changes on the disk.

use hray_session::FolderFiles;
use notify::{RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::Duration;

/// How long it has to be quiet before changes are passed on.
const QUIET: Duration = Duration::from_millis(60);
/// How often open files are looked at where the system does not tell of changes.
const LOOK: Duration = Duration::from_secs(2);

/// Tells `changed` of the files that were touched in a folder, for as long as somebody has the folder.
pub(crate) fn watch(files: &Arc<FolderFiles>, changed: impl Fn(&[String]) + Send + 'static) {
    let root = files.folder().full_path("");
    let (sender, receiver) = channel();
    let tell = move |event: notify::Result<notify::Event>| {
        let Ok(event) = event else { return };
        if !event.kind.is_access() {
            // Nobody is there to be told when the thread has ended.
            let _ = sender.send(event.paths);
        }
    };
    let files = Arc::downgrade(files);
    // To set it up takes a while where there are many folders.
    thread::spawn(move || {
        let watcher = notify::recommended_watcher(tell).and_then(|mut watcher| {
            watcher.watch(&root, RecursiveMode::Recursive)?;
            Ok(watcher)
        });
        // What changed until now nobody has told.
        changed(&[]);
        match watcher {
            Ok(watcher) => {
                pass_on(&root, &files, &receiver, &changed);
                drop(watcher);
            }
            Err(_) => {
                while files.strong_count() > 0 {
                    thread::sleep(LOOK);
                    changed(&[]);
                }
            }
        }
    });
}

fn pass_on(
    root: &Path,
    files: &Weak<FolderFiles>,
    events: &Receiver<Vec<PathBuf>>,
    changed: &dyn Fn(&[String]),
) {
    let mut paths = BTreeSet::new();
    loop {
        match events.recv_timeout(if paths.is_empty() { LOOK } else { QUIET }) {
            Ok(touched) => {
                let inside = touched.iter().filter_map(|path| path.strip_prefix(root).ok()?.to_str());
                paths.extend(inside.map(|path| path.replace('\\', "/")));
            }
            Err(RecvTimeoutError::Timeout) if paths.is_empty() => {
                if files.strong_count() == 0 {
                    return;
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                let paths: Vec<String> = std::mem::take(&mut paths).into_iter().collect();
                if let Some(files) = files.upgrade()
                    && paths.iter().any(|path| path.ends_with(".mtl") || path.ends_with(".bin"))
                {
                    files.forget();
                }
                changed(&paths);
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
