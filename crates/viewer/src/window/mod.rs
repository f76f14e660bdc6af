//! The window.

mod device;
mod options_panel;
mod painter;
mod panel;
mod picture_area;
mod saving;
mod swapchain;
mod tables;

use std::sync::mpsc;
use std::time::{Duration, Instant};

use rasray_experiment::ExperimentError;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

use crate::engine::Engine;
use crate::session::Session;
use crate::worker::{Update, Worker};
use painter::Painter;
use panel::Panel;
pub use saving::{SavePicture, SavedPicture};

/// How often is looked whether a signal asked for the end.
const POLL: Duration = Duration::from_millis(100);

/// How long a frame that was asked for may take to come before it is asked for again.
const HIDDEN: Duration = Duration::from_secs(1);

/// From one frame to the next while an animation plays.
const PLAYING: Duration = Duration::from_millis(16);

/// Least inner size of the window, pixels.
const LEAST: PhysicalSize<u32> = PhysicalSize::new(480, 320);

/// What a window is opened with.
pub struct Viewing<'a> {
    /// Makes what makes pictures, in the thread where it stays.
    pub engine: Box<dyn FnOnce() -> Engine + Send>,
    /// What is chosen.
    pub session: Session,
    /// Name of the engine's device: the window is drawn by the same where that can present.
    pub device: String,
    /// Whether messages of the validation layer are errors.
    pub validation: bool,
    /// Whether the window shall close.
    pub stop: &'a dyn Fn() -> bool,
    /// Saves pictures.
    pub save: &'a mut SavePicture<'a>,
}

/// Why a window was closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By hand.
    Closed,
    /// [`Viewing::stop`] asked for it.
    Stopped,
}

/// There is no display.
fn no_display(reason: impl std::fmt::Display) -> ExperimentError {
    ExperimentError::device(
        format!("there is no display for a window: {reason}"),
        "set DISPLAY or WAYLAND_DISPLAY, or run `rasray render`, which needs none; a virtual display will do: xvfb-run \
         rasray view SCENE",
    )
}

/// That there is a display, before anything is done for it: without one some window systems fail in ways that nothing can
/// catch.
///
/// # Errors
/// Nothing names a display.
pub fn check_display() -> Result<(), ExperimentError> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(all(unix, not(target_vendor = "apple")))
        && !["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(is_set)
    {
        return Err(no_display("neither DISPLAY nor WAYLAND_DISPLAY is set"));
    }
    Ok(())
}

/// Opens the window and shows the scene until it is closed. Call it in the main thread, once in a process.
///
/// # Errors
/// There is no display, or the window cannot be drawn. What goes wrong with a picture is shown in the window.
pub fn run(viewing: Viewing<'_>) -> Result<End, ExperimentError> {
    check_display()?;
    // Libraries of the window system that are not there are a panic of theirs.
    let made = std::panic::catch_unwind(|| EventLoop::<()>::with_user_event().build());
    let events = match made {
        Ok(Ok(events)) => events,
        Ok(Err(error)) => return Err(no_display(error)),
        Err(_) => return Err(no_display("a library of the window system is missing")),
    };
    let Viewing { engine, session, device, validation, stop, save } = viewing;
    let (sender, updates) = mpsc::channel();
    let wake = events.create_proxy();
    let worker = Worker::start(engine, move |update| {
        // Whoever has gone wants no more pictures.
        _ = sender.send(update);
        _ = wake.send_event(());
    })
    .map_err(|error| device::window_error("a thread", error))?;
    let now = Instant::now();
    let mut viewer = Viewer {
        session,
        worker,
        updates,
        device,
        validation,
        stop,
        save,
        panel: Panel::default(),
        live: None,
        began: now,
        frame_began: now,
        wake_at: now,
        end: End::Closed,
        failed: None,
    };
    let ran = events.run_app(&mut viewer);
    let log = viewer.live.as_ref().map(|live| live.painter.validation_log());
    viewer.live = None;
    let Viewer { end, failed, worker, .. } = viewer;
    drop(worker);
    if let Some(error) = failed {
        return Err(error);
    }
    ran.map_err(|error| device::window_error("events", error))?;
    match log.map(|log| log.messages()).unwrap_or_default().first() {
        Some(message) if validation => Err(ExperimentError::device(
            format!("the validation layer says: {message}"),
            "this is a defect; please report it with the command line",
        )),
        _ => Ok(end),
    }
}

/// A window that is open. The painter goes before the window.
struct Live {
    painter: Painter,
    input: egui_winit::State,
    window: Window,
}

struct Viewer<'a> {
    session: Session,
    worker: Worker,
    updates: mpsc::Receiver<Update>,
    device: String,
    validation: bool,
    stop: &'a dyn Fn() -> bool,
    save: &'a mut SavePicture<'a>,
    panel: Panel,
    live: Option<Live>,
    began: Instant,
    frame_began: Instant,
    /// When the next frame is due.
    wake_at: Instant,
    end: End,
    failed: Option<ExperimentError>,
}

impl Viewer<'_> {
    fn open(&self, events: &ActiveEventLoop) -> Result<Live, ExperimentError> {
        let [width, height] = panel::window_size([self.session.frame.width, self.session.frame.height]);
        let attributes = Window::default_attributes()
            .with_title(format!("{} - rasray", self.session.scene_name()))
            .with_min_inner_size(LEAST)
            .with_inner_size(winit::dpi::LogicalSize::new(width, height));
        let window = events.create_window(attributes).map_err(no_display)?;
        let painter = Painter::new(&window, &self.device, self.validation)?;
        let context = egui::Context::default();
        panel::set_style(&context);
        let scale = window.scale_factor() as f32;
        let input = egui_winit::State::new(context, egui::ViewportId::ROOT, &window, Some(scale), None, None);
        Ok(Live { painter, input, window })
    }

    /// Takes what the worker says, lets the frame's interface run, and draws it.
    fn frame(&mut self) -> Result<(), ExperimentError> {
        let Some(live) = &mut self.live else { return Ok(()) };
        let elapsed = self.frame_began.elapsed().as_secs_f64();
        self.frame_began = Instant::now();
        self.session.playback.advance(elapsed);
        let now = self.began.elapsed().as_secs_f64();
        let input = live.input.take_egui_input(&live.window);
        let context = live.input.egui_ctx().clone();
        let (session, panel, save) = (&mut self.session, &mut self.panel, &mut *self.save);
        let mut output = context.run_ui(input, |ui| panel.show(ui, session, now, elapsed, save));
        live.input.handle_platform_output(&live.window, std::mem::take(&mut output.platform_output));
        let scale = output.pixels_per_point;
        let primitives = context.tessellate(std::mem::take(&mut output.shapes), scale);
        let size = live.window.inner_size();
        let size = [size.width, size.height];
        let painted = live.painter.paint(size, scale, &primitives, &mut output.textures_delta);
        // What an error left there is dropped on purpose.
        output.textures_delta.clear();
        painted?;
        if let Some(settings) = self.session.changed_settings(now) {
            self.worker.want(settings);
        }
        let mut pause = output
            .viewport_output
            .get(&egui::ViewportId::ROOT)
            .map_or(Duration::MAX, |viewport| viewport.repaint_delay);
        if self.session.playback.playing {
            pause = pause.min(PLAYING);
        }
        if let Some(at) = self.session.wakes_at() {
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

    /// Asks for a frame where one is due. A window that is hidden may not get it, and must not ask all the time.
    fn request_due_frame(&mut self) {
        if Instant::now() >= self.wake_at {
            self.wake_at = Instant::now() + HIDDEN;
            self.request_frame();
        }
    }

    fn fail(&mut self, events: &ActiveEventLoop, error: ExperimentError) {
        self.failed = Some(error);
        events.exit();
    }
}

impl ApplicationHandler<()> for Viewer<'_> {
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
        while let Ok(update) = self.updates.try_recv() {
            self.session.take(update);
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
