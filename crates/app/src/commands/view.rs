//! Command `rasray view`.

#[cfg(not(feature = "viewer"))]
pub(crate) use without_window::view;

#[cfg(feature = "viewer")]
mod with_window;
#[cfg(feature = "viewer")]
pub(crate) use with_window::view;

#[cfg(not(feature = "viewer"))]
mod without_window {
    use crate::arguments::ViewerArguments;
    use crate::error::AppError;
    use crate::interrupt::Interrupt;

    /// Explains how to get the window.
    ///
    /// # Errors
    /// Always.
    pub(crate) fn view(given: &ViewerArguments, _interrupt: &Interrupt) -> Result<(), AppError> {
        Err(AppError::usage(
            "this rasray was built without its window",
            format!(
                "build it with: cargo run --release --package rasray-app --features viewer -- view {}",
                given.scene.to_string_lossy()
            ),
        ))
    }
}
