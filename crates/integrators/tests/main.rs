//! All tests of this package as one program, which is built and linked once: a module for each concern, whose
//! first lines say what it holds. `tools/run-tests` runs each module in a process of its own.

#[path = "fetch/main.rs"]
mod fetch;
#[path = "../../../tests/tests/kept_pictures.rs"]
mod kept_pictures;
#[path = "pages/main.rs"]
mod pages;
#[path = "pictures/main.rs"]
mod pictures;
#[path = "visibility/main.rs"]
mod visibility;
