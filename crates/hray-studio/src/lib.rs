//! `hray studio`: a page in the browser to write scenes in and watch them appear.
//!
//! A server on 127.0.0.1 gives the page, which is part of the program, and answers it over a WebSocket; what is answered comes
//! from `hray-session`. Nobody else is to reach it: the address has a random token in it, and requests that were sent by pages of
//! other origins, or to other hosts, are refused. Only files in the folder that was opened are read, and nothing is written but
//! a scene that the user saves.

mod browser;
mod connection;
mod embedded;
mod guard;
mod page;
mod server;
mod watch;

pub use browser::open_in_browser;
pub use server::{FIRST_PORT, Options, Server, StartError};
