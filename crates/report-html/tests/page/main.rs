//! Tests of the page of a report, as text and in a browser.

mod browser;
mod campaign;
mod fixture;
mod text;
mod visit;
