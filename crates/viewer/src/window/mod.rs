//! Window with the picture and its controls.

mod device;
mod options_panel;
mod painter;
mod panel;
mod picked_panel;
mod picture_area;
mod saving;
mod swapchain;
mod tables;
mod view_panel;

use std::sync::Arc;
use std::time::{Duration, Instant};

use rasray_experiment::ExperimentError;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

use crate::engine::Engine;
use crate::error::ViewerError;
use crate::rate::Rate;
use crate::session::Session;
use crate::viewer::{OpenScene, Viewer};
use painter::Painter;
use panel::Panel;
pub use saving::{SavePicture, SavedPicture};

/// Interval between checks for a signal that asks for the end.
const POLL: Duration = Duration::from_millis(100);

/// Longest wait for a requested frame before it is requested again.
const HIDDEN: Duration = Duration::from_secs(1);

/// Interval between frames while an animation plays.
const PLAYING: Duration = Duration::from_millis(16);

/// Least inner size of the window, pixels.
const LEAST: PhysicalSize<u32> = PhysicalSize::new(480, 320);

/// Inputs of a window.
pub struct Viewing<'a> {
    /// Function that makes the engine, in the thread where the engine stays.
    pub engine: Box<dyn FnOnce() -> Engine + Send>,
    /// Choices of the user.
    pub session: Session,
    /// Function that reads scenes that are dropped on the window or named in it.
    pub open: Arc<OpenScene>,
    /// Name of the engine's device, which also draws the window if it can present.
    pub device: String,
    /// True if messages of the validation layer are errors.
    pub validation: bool,
    /// Function that is true once the window shall close.
    pub stop: &'a dyn Fn() -> bool,
    /// Function that saves pictures.
    pub save: &'a mut SavePicture<'a>,
}

/// Reason for which a window was closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The user closed the window.
    Closed,
    /// [`Viewing::stop`] asked for the end.
    Stopped,
}

/// Makes the error of a refused window.
fn no_window(source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> ViewerError {
    ViewerError::NoWindow { source: source.into() }
}

/// Checks that there is a display, before anything is done for it: without one some window systems fail in
/// ways that cannot be caught.
///
/// # Errors
/// No environment variable names a display.
pub fn check_display() -> Result<(), ViewerError> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(all(unix, not(target_vendor = "apple")))
        && !["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(is_set)
    {
        return Err(ViewerError::NoDisplay);
    }
    Ok(())
}

/// Opens the window and shows the scene until the window is closed. Call it in the main thread, once per
/// process.
///
/// # Errors
/// There is no display, or the window cannot be drawn. Failures of a picture are shown in the window.
pub fn run(viewing: Viewing<'_>) -> Result<End, ViewerError> {
    check_display()?;
    // Missing libraries of the window system make its crate panic.
    let made = std::panic::catch_unwind(|| EventLoop::<()>::with_user_event().build());
    let events = match made {
        Ok(Ok(events)) => events,
        Ok(Err(error)) => return Err(no_window(error)),
        Err(_) => return Err(no_window("a library of the window system is missing")),
    };
    let Viewing { engine, session, open, device, validation, stop, save } = viewing;
    let wake = events.create_proxy();
    let viewer = Viewer::start(session, engine, open, move || {
        // A window that is gone needs no waking.
        _ = wake.send_event(());
    })
    .map_err(|error| device::window_error("a thread", error))?;
    let now = Instant::now();
    let mut shown = Shown {
        title: viewer.session.scene_name(),
        viewer,
        device,
        validation,
        stop,
        save,
        panel: Panel::default(),
        live: None,
        began: now,
        frame_began: now,
        frames: Rate::default(),
        wake_at: now,
        end: End::Closed,
        failed: None,
    };
    let ran = events.run_app(&mut shown);
    let log = shown.live.as_ref().map(|live| live.painter.validation_log());
    shown.live = None;
    let Shown { end, failed, viewer, .. } = shown;
    drop(viewer);
    if let Some(error) = failed {
        return Err(error);
    }
    ran.map_err(|error| device::window_error("events", error))?;
    match log.map(|log| log.messages()).unwrap_or_default().first() {
        Some(message) if validation => Err(ExperimentError::Validation { message: message.clone() }.into()),
        _ => Ok(end),
    }
}

/// Returns the title of a scene's window.
fn title(scene: &str) -> String {
    format!("{scene} - rasray")
}

/// Open window. The painter is dropped before the window.
struct Live {
    painter: Painter,
    input: egui_winit::State,
    window: Window,
}

/// Viewer with its window.
struct Shown<'a> {
    viewer: Viewer,
    /// Name of the scene in the window's title.
    title: String,
    device: String,
    validation: bool,
    stop: &'a dyn Fn() -> bool,
    save: &'a mut SavePicture<'a>,
    panel: Panel,
    live: Option<Live>,
    began: Instant,
    frame_began: Instant,
    /// Rate of frames of the window.
    frames: Rate,
    /// Time at which the next frame is due.
    wake_at: Instant,
    end: End,
    failed: Option<ViewerError>,
}

impl Shown<'_> {
    fn open(&self, events: &ActiveEventLoop) -> Result<Live, ViewerError> {
        let frame = &self.viewer.session.frame;
        let [width, height] = panel::window_size([frame.width, frame.height]);
        let attributes = Window::default_attributes()
            .with_title(title(&self.title))
            .with_min_inner_size(LEAST)
            .with_inner_size(winit::dpi::LogicalSize::new(width, height));
        let window = events.create_window(attributes).map_err(no_window)?;
        let painter = Painter::new(&window, &self.device, self.validation)?;
        let context = egui::Context::default();
        panel::set_style(&context);
        let scale = window.scale_factor() as f32;
        let input = egui_winit::State::new(context, egui::ViewportId::ROOT, &window, Some(scale), None, None);
        Ok(Live { painter, input, window })
    }

    /// Runs the interface of a frame, and draws the frame.
    fn frame(&mut self) -> Result<(), ViewerError> {
        let Some(live) = &mut self.live else { return Ok(()) };
        let elapsed = self.frame_began.elapsed().as_secs_f64();
        self.frame_began = Instant::now();
        let now = self.began.elapsed().as_secs_f64();
        self.frames.count(now);
        let session = &mut self.viewer.session;
        session.playback.advance(elapsed);
        let input = live.input.take_egui_input(&live.window);
        let context = live.input.egui_ctx().clone();
        let moment = panel::Moment { now, elapsed, frames: self.frames.per_second(now) };
        let (panel, save) = (&mut self.panel, &mut *self.save);
        let mut output = context.run_ui(input, |ui| panel.show(ui, session, moment, save));
        live.input.handle_platform_output(&live.window, std::mem::take(&mut output.platform_output));
        let scale = output.pixels_per_point;
        let primitives = context.tessellate(std::mem::take(&mut output.shapes), scale);
        let size = live.window.inner_size();
        let size = [size.width, size.height];
        let painted = live.painter.paint(size, scale, &primitives, &mut output.textures_delta);
        // Textures that remain after an error are dropped on purpose.
        output.textures_delta.clear();
        painted?;
        self.viewer.ask(now).map_err(|error| device::window_error("a thread", error))?;
        let session = &self.viewer.session;
        let mut pause = output
            .viewport_output
            .get(&egui::ViewportId::ROOT)
            .map_or(Duration::MAX, |viewport| viewport.repaint_delay);
        if session.playback.playing {
            pause = pause.min(PLAYING);
        }
        if let Some(at) = session.wakes_at() {
            pause = pause.min(Duration::from_secs_f64((at - now).clamp(0.001, 10.0)));
        }
        self.wake_at = Instant::now() + pause.min(Duration::from_secs(3600));
        Ok(())
    }

    fn request_frame(&self) {
        if let Some(live) = &self.live {
            live.window.request_redraw();
        }
    }

    /// Requests a frame if one is due. A hidden window may not get its frame, and must not request it all the
    /// time.
    fn request_due_frame(&mut self) {
        if Instant::now() >= self.wake_at {
            self.wake_at = Instant::now() + HIDDEN;
            self.request_frame();
        }
    }

    fn fail(&mut self, events: &ActiveEventLoop, error: ViewerError) {
        self.failed = Some(error);
        events.exit();
    }
}

impl ApplicationHandler<()> for Shown<'_> {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.live.is_none() {
            match self.open(events) {
                Ok(live) => {
                    self.live = Some(live);
                    self.request_frame();
                }
                Err(error) => self.fail(events, error),
            }
        }
    }

    fn new_events(&mut self, events: &ActiveEventLoop, cause: StartCause) {
        if (self.stop)() {
            self.end = End::Stopped;
            events.exit();
        }
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.request_due_frame();
        }
    }

    fn user_event(&mut self, _events: &ActiveEventLoop, (): ()) {
        self.viewer.take_updates(self.began.elapsed().as_secs_f64());
        let scene = self.viewer.session.scene_name();
        if scene != self.title
            && let Some(live) = &self.live
        {
            live.window.set_title(&title(&scene));
            self.title = scene;
        }
        self.request_frame();
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        let Some(live) = &mut self.live else { return };
        match &event {
            WindowEvent::CloseRequested => return events.exit(),
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.frame() {
                    self.fail(events, error);
                } else if self.panel.wants_to_close {
                    events.exit();
                }
                return;
            }
            // If several files are dropped, the last one is shown.
            WindowEvent::DroppedFile(path) => self.viewer.session.drop_file(path.clone()),
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => live.painter.resized(),
            _ => (),
        }
        let response = live.input.on_window_event(&live.window, &event);
        if response.repaint {
            live.window.request_redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        self.request_due_frame();
        let poll = Instant::now() + POLL;
        events.set_control_flow(ControlFlow::WaitUntil(poll.min(self.wake_at)));
    }
}
