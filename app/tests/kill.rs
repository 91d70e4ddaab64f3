//! Killed at any instant: the last saved file is whole, and unsaved work is offered again.
//!
//! The test starts itself as a process that edits, saves and autosaves without end, kills it, and looks at what is on
//! the disk. The full run: `cargo test -p amc-studio --test kill -- --ignored --nocapture`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the process that is killed reports to its killer")]

use std::collections::BTreeMap;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::{Duration, SystemTime};

use amc_core::Progress;
use amc_studio::project::{Autosave, Claim, ProjectLock, System, Unknown, open, recoverable, save};
use studio_plugin::document::{Document, Edit, Project};

/// Tells a process that it is the one to be killed, and where to work.
const FOLDER: &str = "AMC_STUDIO_KILL_TEST_FOLDER";

/// What its reports begin with: the test harness writes to the same pipe.
const REPORT: &str = "report";

/// The shortest time between two autosaves: the program's, 250 times as fast.
const INTERVAL: Duration = Duration::from_millis(20);

/// How old work may be that is lost: the interval, and the rest of the promised 10 s for a write on a busy machine.
const PROMISE: Duration = Duration::from_millis(500);

/// An edit leaves a text of some 40 KB that says which it was, everywhere.
fn notes(edit: usize) -> String {
    format!("{edit:09} ").repeat(4000)
}

/// Which edit left this project; fails if it is no whole one.
fn edit_of(project: &Project) -> usize {
    let edit = project.notes[..9].parse().unwrap();
    assert_eq!(project.notes, notes(edit), "a torn project");
    edit
}

fn file(folder: &Path) -> PathBuf {
    folder.join("coat.amcproj")
}

fn milliseconds(time: SystemTime) -> u64 {
    time.duration_since(SystemTime::UNIX_EPOCH).unwrap().as_millis() as u64
}

fn report(what: &str, edit: usize) {
    println!("{REPORT} {what} {edit} {}", milliseconds(SystemTime::now()));
}

/// Not a test of its own: the process that is killed.
#[test]
fn worker() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let file = file(&folder);
    let mut autosave = Autosave::start_every(INTERVAL, &folder.join("recovery"), Arc::new(System)).unwrap();
    let Claim::Ours(_lock) = ProjectLock::claim(&folder.join("locks"), &file).unwrap() else {
        panic!("the one before is dead")
    };
    let mut document = Document::new(Project::default());
    let unknown = Arc::new(Unknown::default());
    let mut reported = 0;
    println!("\n{REPORT} ready 0 0");
    for edit in 1.. {
        document.submit(Edit::SetNotes(notes(edit)), None).unwrap();
        report("edited", edit);
        autosave.follow(&document, &unknown, Some(&file));
        std::thread::sleep(Duration::from_millis(1));
        if let Some(kept) = autosave.kept().map(|kept| edit_of(&kept)).filter(|&kept| kept != reported) {
            report("kept", kept);
            reported = kept;
        }
        // Longer and shorter spells without a save.
        if edit % 97 % 40 == 0 {
            report("saving", edit);
            save(&System, &file, document.project(), &unknown).unwrap();
            document.mark_saved();
            report("saved", edit);
            autosave.follow(&document, &unknown, Some(&file));
        }
    }
}

/// What a killed process reported: of each kind, the edits and when, milliseconds.
type Reports = BTreeMap<String, Vec<(usize, u64)>>;

/// Lets a process work in `folder` for `life`, and kills it; what it reported, and when it died.
fn killed_after(life: Duration, folder: &Path) -> (Reports, u64) {
    let mut process = Command::new(std::env::current_exe().unwrap())
        .args(["worker", "--exact", "--nocapture", "--test-threads=1"])
        .env(FOLDER, folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::inherit())
        .spawn()
        .unwrap();
    let lines = BufReader::new(process.stdout.take().unwrap()).lines();
    let (send, receive) = channel();
    let reader = std::thread::Builder::new().name("reports".to_owned());
    let reader = reader.spawn(move || lines.map_while(Result::ok).for_each(|line| drop(send.send(line))));
    let mut reports = Reports::new();
    let mut take = |line: String| {
        let mut words = line.split(' ').skip_while(|word| *word != REPORT).skip(1);
        if let (Some(what), Some(edit), Some(when)) = (words.next(), words.next(), words.next()) {
            let entry = (edit.parse().unwrap(), when.parse().unwrap());
            reports.entry(what.to_owned()).or_default().push(entry);
            return what == "ready";
        }
        false
    };
    while !take(receive.recv_timeout(Duration::from_secs(30)).unwrap()) {}
    std::thread::sleep(life);
    // SIGKILL where there are signals.
    process.kill().unwrap();
    let died = milliseconds(SystemTime::now());
    process.wait().unwrap();
    reader.unwrap().join().unwrap();
    receive.try_iter().for_each(|line| {
        take(line);
    });
    (reports, died)
}

fn last(reports: &Reports, what: &str) -> usize {
    reports.get(what).and_then(|all| all.last()).map_or(0, |&(edit, _)| edit)
}

/// What was found after one kill.
#[derive(Debug)]
struct Found {
    was_saving: bool,
    has_work: bool,
    /// How old the oldest work was that was lost, milliseconds.
    lost: u64,
}

fn kill_once(life: Duration) -> Found {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path();
    let (reports, died) = killed_after(life, folder);

    let (saving, saved) = (last(&reports, "saving"), last(&reports, "saved"));
    let in_file = match file(folder).exists() {
        true => edit_of(&open(&System, &file(folder), &Progress::none()).unwrap().project),
        false => 0,
    };
    assert!(
        (saved..=saving).contains(&in_file),
        "{in_file} is in the file, {saved} was saved, then {saving}"
    );

    let claim = ProjectLock::claim(&folder.join("locks"), &file(folder)).unwrap();
    assert!(matches!(claim, Claim::Ours(_)), "a dead process holds the project");

    let found = recoverable(&System, &folder.join("recovery")).unwrap();
    assert!(found.notices.is_empty(), "{:?}", found.notices);
    assert!(found.works.len() <= 1);
    let offered = found.works.first().map_or(0, |work| {
        assert_eq!(work.belongs_to.as_deref(), Some(&*file(folder)));
        edit_of(&work.read.project)
    });
    let kept = last(&reports, "kept");
    let on_disk = in_file.max(offered);
    assert!(on_disk >= kept, "{kept} was kept, {on_disk} is on the disk");
    let lost = reports.get("edited").into_iter().flatten().find(|&&(edit, _)| edit > on_disk);
    let lost = lost.map_or(0, |&(_, when)| died.saturating_sub(when));
    assert!(u128::from(lost) <= PROMISE.as_millis(), "work of {lost} ms is lost");
    Found { was_saving: saving != saved, has_work: !found.works.is_empty(), lost }
}

/// `count` kills after up to `longest`, at instants that look random and are the same every time.
fn kill(count: u64, longest: Duration) -> Vec<Found> {
    // Steps of the golden ratio fill the range evenly, never with a beat.
    let life = |k: u64| longest.mul_f64((k as f64 * 0.618_033_988_75).fract());
    (0..count).map(|k| kill_once(life(k))).collect()
}

#[test]
fn killed_twenty_times_it_loses_nothing_that_was_promised() {
    kill(20, Duration::from_millis(60));
}

#[test]
#[ignore = "takes minutes: CONTRIBUTING.md says when to run it"]
fn killed_two_hundred_times_it_loses_nothing_that_was_promised() {
    let found = kill(200, Duration::from_millis(1200));
    let count = |is: fn(&Found) -> bool| found.iter().filter(|found| is(found)).count();
    let (saving, works) = (count(|found| found.was_saving), count(|found| found.has_work));
    let lost = found.iter().map(|found| found.lost).max().unwrap();
    println!("{saving} died while saving, {works} left unsaved work; the oldest work lost was {lost} ms old");
    assert!(saving >= 5 && works >= 50);
}
