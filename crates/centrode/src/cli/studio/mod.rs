//! `centrode studio`: serves the design page to the browser of this computer.

mod document;
mod files;
mod guard;
mod listener;
mod meshes;
mod path;
mod routes;
mod solver;
mod start;
mod start_routes;
mod watch;

use std::io::Write;
use std::net::{Ipv4Addr, SocketAddr};
use std::process::Stdio;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;

use crate::cli::Status;
use crate::cli::args::Studio;
use crate::cli::failure::Failure;
use crate::page::{self, search::Searching};
use document::Document;
use guard::Guard;
use solver::Solver;
use start::StartPage;
use watch::Watch;

/// Shared state of all requests.
pub(crate) struct StudioState {
    document: Document,
    solver: Arc<Solver>,
    searching: Searching,
    watch: Watch,
    /// Whether this page was opened from a start page.
    started: bool,
}

impl StudioState {
    /// State of a page whose file is watched from now on; to be called where tasks can be spawned.
    fn watched(document: Document, started: bool) -> Arc<Self> {
        let state = Arc::new(Self {
            watch: Watch::default(),
            searching: Searching::default(),
            solver: Arc::default(),
            document,
            started,
        });
        tokio::spawn(watch::disk(Arc::clone(&state)));
        state
    }
}

/// Serves the page until Ctrl-C.
pub(crate) fn run(command: &Studio, out: &mut impl Write) -> Result<Status, Failure> {
    let document = command.design.as_deref().map(Document::open).transpose()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .enable_all()
        .build()
        .map_err(Failure::Serve)?;
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, command.port));
    let listener = runtime
        .block_on(TcpListener::bind(address))
        .map_err(Failure::Serve)?;
    let port = listener.local_addr().map_err(Failure::Serve)?.port();
    let guard = Guard::new(port).map_err(Failure::Serve)?;
    writeln!(out, "{}", guard.url())?;
    out.flush()?;
    if command.open {
        open(&guard.url());
    }
    runtime.block_on(async {
        let page = match document {
            Some(document) => {
                let page = routes::design_page(StudioState::watched(document, false));
                routes::guarded(page::INDEX, page, guard)
            }
            None => {
                let folder = std::env::current_dir().map_err(Failure::Serve)?;
                let page = start_routes::start_page(Arc::new(StartPage::new(folder)));
                routes::guarded(page::START, page, guard)
            }
        };
        tokio::select! {
            () = listener::serve(listener, page) => {}
            stopped = tokio::signal::ctrl_c() => stopped.map_err(Failure::Serve)?,
        }
        Ok::<(), Failure>(())
    })?;
    // The result of a solve that is still running is not needed any more.
    runtime.shutdown_timeout(Duration::from_millis(100));
    Ok(Status::Good)
}

/// Opens an address in the browser; if there is no browser, the user has the printed address.
fn open(url: &str) {
    let opener = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let command = std::process::Command::new(opener)
        .arg(url)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    if let Err(error) = command {
        let _ = writeln!(
            anstream::stderr(),
            "cannot open the browser with {opener}: {error}"
        );
    }
}
