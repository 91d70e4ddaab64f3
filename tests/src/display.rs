//! Windows without a screen: a display of one's own, and the real program in it.

use std::ffi::OsStr;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Columns and rows of the display; also those of the program's window.
pub const SIZE: [u16; 2] = [1440, 900];

/// An X server that nobody looks at. It ends with this.
#[derive(Debug)]
pub struct Display {
    server: Child,
    /// As `DISPLAY` has it.
    pub name: String,
}

impl Display {
    /// Starts one.
    ///
    /// # Panics
    /// There is no program `Xvfb`, or it does not start.
    pub fn start() -> Self {
        let [width, height] = SIZE;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &format!("{width}x{height}x24")])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts (Debian: the package xvfb)");
        let mut number = String::new();
        let read = server.stdout.take().map(|out| BufReader::new(out).read_line(&mut number));
        assert!(matches!(read, Some(Ok(1..))), "Xvfb says which display it is");
        Self { server, name: format!(":{}", number.trim()) }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        end(&mut self.server);
    }
}

fn end(child: &mut Child) {
    // It may have ended by itself.
    child.kill().ok();
    child.wait().ok();
}

/// The program in a display. It ends with this.
#[derive(Debug)]
pub struct Window {
    program: Child,
    started: Instant,
    milestones: Receiver<(String, Instant)>,
}

impl Window {
    /// Starts `program` with whatever it keeps in `home`, which is its current folder too.
    ///
    /// # Panics
    /// It does not start.
    pub fn open(
        program: &Path,
        display: &Display,
        home: &Path,
        arguments: impl IntoIterator<Item = impl AsRef<OsStr>>,
    ) -> Self {
        let mut command = Command::new(program);
        command.arg("--timings").args(arguments).current_dir(home).env("HOME", home);
        command.env("DISPLAY", &display.name).env("LIBGL_ALWAYS_SOFTWARE", "1").stdout(Stdio::piped());
        // What else a person's session has is not the test's.
        for variable in [
            "WAYLAND_DISPLAY",
            "DBUS_SESSION_BUS_ADDRESS",
            "XDG_RUNTIME_DIR",
            "XDG_CONFIG_HOME",
            "XDG_CACHE_HOME",
            "XDG_DATA_HOME",
        ] {
            command.env_remove(variable);
        }
        let started = Instant::now();
        let mut program = command.spawn().expect("the program starts");
        let (send, milestones) = channel();
        let lines = BufReader::new(program.stdout.take().expect("its output is a pipe")).lines();
        let listen = move || {
            // It ends with the program, or when nobody listens.
            for line in lines.map_while(Result::ok) {
                let line: serde_json::Value = serde_json::from_str(&line).unwrap_or_default();
                let name = line["shown"].as_str().unwrap_or_default().to_owned();
                if send.send((name, Instant::now())).is_err() {
                    break;
                }
            }
        };
        std::thread::Builder::new().name("milestones".to_owned()).spawn(listen).expect("a thread");
        Self { program, started, milestones }
    }

    /// How long after the start something was first shown: `window`, then `garment`. To be asked in this order.
    ///
    /// # Panics
    /// It is not shown in time.
    pub fn shown(&self, what: &str, patience: Duration) -> Duration {
        loop {
            let left = patience.saturating_sub(self.started.elapsed());
            match self.milestones.recv_timeout(left) {
                Ok((name, at)) if name == what => return at - self.started,
                Ok(_) => {}
                Err(_) => panic!("no {what} was shown within {patience:?}"),
            }
        }
    }

    /// The process.
    pub fn id(&self) -> u32 {
        self.program.id()
    }

    /// Its exit status, if it has ended.
    ///
    /// # Panics
    /// The system does not say.
    pub fn ended(&mut self) -> Option<ExitStatus> {
        self.program.try_wait().expect("the system knows its child")
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        end(&mut self.program);
    }
}

/// The program that was built together with this test: named by `AMC_STUDIO`, else where cargo puts it.
///
/// # Panics
/// It is not there.
pub fn program() -> PathBuf {
    let named = std::env::var_os("AMC_STUDIO").map(PathBuf::from);
    let built = || {
        let here = std::env::current_exe().expect("the system knows where this test is");
        let folder = here.parent().and_then(Path::parent).expect("tests are built two folders down");
        folder.join(format!("amc-studio{}", std::env::consts::EXE_SUFFIX))
    };
    let program = named.unwrap_or_else(built);
    assert!(program.exists(), "{} is not there: cargo build -p amc-studio", program.display());
    program
}
