//! The server.

use crate::guard::Guard;
use crate::{connection, embedded, page, watch};
use axum::Router;
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{FromRequestParts, Request, State};
use axum::http::{Method, Response, StatusCode};
use axum::middleware::{Next, from_fn_with_state};
use hray_session::{About, Files, FolderFiles, MOST_TEXT, Session};
use std::fmt;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use tokio::net::TcpListener;
use tokio::runtime::Runtime;
use tokio::sync::{broadcast, oneshot};

/// The port that is taken where it is free and none is asked for: what a page keeps in the browser belongs to its port, so
/// it had better be the same each time.
pub const FIRST_PORT: u16 = 4005;
/// How many ports are tried before the system chooses one.
const PORTS: u16 = 20;
/// The most pages that are open at a time.
const MOST_PAGES: usize = 16;
/// The longest message of a page: a text, each of its bytes written as six.
const MOST_MESSAGE: usize = 6 * MOST_TEXT + (1 << 16);

/// What the studio is to show.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A scene to begin with, or a folder; the current folder where not given.
    pub target: Option<PathBuf>,
    /// The port, which must be free.
    pub port: Option<u16>,
}

/// Why there is no studio.
#[derive(Debug)]
pub enum StartError {
    /// What was to be opened cannot be.
    Target(String),
    /// There is no port.
    Port(u16, std::io::Error),
    /// The system refuses something else.
    System(String),
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Target(what) => f.write_str(what),
            Self::Port(port, error) => {
                write!(f, "the port {port} is not to be had: {error}; choose another with --port, or none")
            }
            Self::System(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for StartError {}

/// A studio that is running. It ends with the value.
pub struct Server {
    address: String,
    stop: Option<oneshot::Sender<()>>,
    runtime: Runtime,
    served: Option<tokio::task::JoinHandle<std::io::Result<()>>>,
    _files: Arc<FolderFiles>,
}

impl fmt::Debug for Server {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Server").finish_non_exhaustive()
    }
}

/// What all requests share.
#[derive(Clone)]
struct Shared {
    guard: Arc<Guard>,
    files: Arc<FolderFiles>,
    about: Arc<About>,
    touched: broadcast::Sender<Arc<[String]>>,
    pages: Arc<AtomicUsize>,
}

impl Server {
    /// Starts to serve, on this machine alone.
    ///
    /// # Errors
    /// [`StartError`]
    pub fn start(options: &Options) -> Result<Self, StartError> {
        let (root, start) = target(options.target.as_deref())?;
        let files = FolderFiles::open(&root).map_err(|error| StartError::Target(error.to_string()))?;
        let files = Arc::new(files);
        let start = start.map(|file| files.folder().path_to(&file).ok_or(file)).transpose();
        let start = start
            .map_err(|file| StartError::Target(format!("{} has a name that is no text", file.display())))?;
        let system =
            |error: &dyn fmt::Display| StartError::System(format!("the studio cannot be started: {error}"));
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build();
        let runtime = runtime.map_err(|error| system(&error))?;
        let (listener, port) = runtime.block_on(listen(options.port))?;
        let guard = Arc::new(Guard::new(port).map_err(|error| system(&error))?);
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let about = Arc::new(About {
            start,
            examples: hray_session::examples(|picture| embedded::page(picture).is_some()),
            cores,
        });
        let (touched, _) = broadcast::channel(16);
        let tell = touched.clone();
        // Without a page there is nobody to be told.
        watch::watch(&files, move |paths| drop(tell.send(paths.into())));
        let address = format!("http://127.0.0.1:{port}/?token={}", guard.token());
        let shared = Shared { guard, files: files.clone(), about, touched, pages: Arc::default() };
        let routes = Router::new().fallback(answer).with_state(shared.clone());
        let routes = routes.layer(from_fn_with_state(shared, admit));
        let (stop, stopped) = oneshot::channel::<()>();
        let served = runtime.spawn(async move {
            let serve = axum::serve(listener, routes).with_graceful_shutdown(async {
                let _ = stopped.await;
            });
            serve.await
        });
        Ok(Self { address, stop: Some(stop), runtime, served: Some(served), _files: files })
    }

    /// The address of the page, with the token.
    #[must_use]
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Serves until the program ends.
    ///
    /// # Errors
    /// Where the system takes the port away.
    pub fn wait(mut self) -> Result<(), StartError> {
        let Some(served) = self.served.take() else { return Ok(()) };
        let ended = self.runtime.block_on(served);
        let failed = |error: &dyn fmt::Display| StartError::System(format!("the studio has ended: {error}"));
        ended.map_err(|error| failed(&error))?.map_err(|error| failed(&error))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(served) = self.served.take() {
            served.abort();
        }
    }
}

/// The folder that is opened, and the scene in it that is shown first.
fn target(target: Option<&Path>) -> Result<(PathBuf, Option<PathBuf>), StartError> {
    let Some(path) = target else { return Ok((PathBuf::from("."), None)) };
    if path.is_dir() {
        return Ok((path.to_owned(), None));
    }
    if !path.is_file() {
        let what = format!("there is no file and no folder {}", path.display());
        return Err(StartError::Target(what));
    }
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Ok((parent.to_owned(), Some(path.to_owned())))
}

/// A port on this machine.
async fn listen(asked: Option<u16>) -> Result<(TcpListener, u16), StartError> {
    let bind = |port: u16| TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    let listener = match asked {
        Some(port) => bind(port).await.map_err(|error| StartError::Port(port, error))?,
        None => {
            let mut found = None;
            for port in FIRST_PORT..FIRST_PORT + PORTS {
                found = bind(port).await.ok();
                if found.is_some() {
                    break;
                }
            }
            match found {
                Some(listener) => listener,
                None => bind(0).await.map_err(|error| StartError::Port(0, error))?,
            }
        }
    };
    let address = listener.local_addr().map_err(|error| StartError::Port(0, error))?;
    Ok((listener, address.port()))
}

/// Lets nobody in who does not come from here.
async fn admit(State(shared): State<Shared>, request: Request, next: Next) -> Response<Body> {
    if shared.guard.admits(request.headers()) {
        next.run(request).await
    } else {
        page::text(StatusCode::FORBIDDEN, "the studio answers its own page alone\n")
    }
}

async fn answer(State(shared): State<Shared>, request: Request) -> Response<Body> {
    let method = request.method();
    if method != Method::GET && method != Method::HEAD {
        return page::text(StatusCode::METHOD_NOT_ALLOWED, "there is nothing here to write to\n");
    }
    let known = shared.guard.knows(request.uri().query());
    match request.uri().path() {
        "/alive" => {
            let body = serde_json::json!({ "alive": true, "token": known }).to_string();
            page::answer(StatusCode::OK, "application/json", Body::from(body))
        }
        "/ws" if known => connect(shared, request).await,
        "/ws" => page::text(StatusCode::FORBIDDEN, "the token is not the one of this studio\n"),
        path => page::file(path),
    }
}

/// Makes a connection of a request for one.
async fn connect(shared: Shared, request: Request) -> Response<Body> {
    let (mut parts, _) = request.into_parts();
    let Ok(upgrade) = WebSocketUpgrade::from_request_parts(&mut parts, &()).await else {
        return page::text(StatusCode::BAD_REQUEST, "this is an address for WebSockets\n");
    };
    let Some(place) = Place::take(&shared.pages) else {
        return page::text(StatusCode::SERVICE_UNAVAILABLE, "too many pages are open; close some of them\n");
    };
    let files: Arc<dyn Files> = shared.files.clone();
    let session = Session::new(files, shared.about.clone(), hray_session::Limits::default());
    let (renderers, touched) = (shared.about.cores, shared.touched.subscribe());
    let upgrade = upgrade.max_message_size(MOST_MESSAGE).max_frame_size(MOST_MESSAGE);
    upgrade.on_upgrade(async move |socket| {
        connection::serve(socket, session, renderers, touched).await;
        drop(place);
    })
}

/// One of the pages that may be open.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn take(pages: &Arc<AtomicUsize>) -> Option<Self> {
        if pages.fetch_add(1, Ordering::Relaxed) >= MOST_PAGES {
            pages.fetch_sub(1, Ordering::Relaxed);
            return None;
        }
        Some(Self(pages.clone()))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}
