//! The page of a report, as text and in a browser.

mod browser;
mod fixture;
mod text;
mod visit;
