//! Painter that draws the shapes of egui to a window, one frame at a time.

use std::time::Duration;

use egui_ash_renderer::allocator::DefaultAllocator;
use egui_ash_renderer::{Options, RenderMode, Renderer};
use rasray_gpu::{ValidationLog, vk};
use winit::window::Window;

use crate::error::ViewerError;

use super::device::{WindowDevice, window_error};
use super::swapchain::{Swapchain, is_srgb, surface_format};

/// Longest wait for the window system or the device.
const TIMEOUT: Duration = Duration::from_secs(10);

/// Painter of a window. It waits for every frame, so that no resource of a frame is in use afterwards.
pub(super) struct Painter {
    /// Renderer, taken when the painter is dropped, before the device.
    renderer: Option<Renderer<DefaultAllocator>>,
    swapchain: Option<Swapchain>,
    /// True if the swapchain no longer fits the window.
    is_old: bool,
    format: vk::SurfaceFormatKHR,
    render_pass: vk::RenderPass,
    pool: vk::CommandPool,
    command: vk::CommandBuffer,
    fence: vk::Fence,
    acquired: vk::Semaphore,
    device: WindowDevice,
}

impl Painter {
    /// Makes the painter for a window, on the device of this name if that can present.
    pub(super) fn new(window: &Window, name: &str, validation: bool) -> Result<Self, ViewerError> {
        let device = WindowDevice::new(window, name, validation)?;
        let format = surface_format(&device)?;
        // From here on, dropping the value destroys everything made so far; null handles are ignored.
        let mut made = Self {
            renderer: None,
            swapchain: None,
            is_old: true,
            format,
            render_pass: vk::RenderPass::null(),
            pool: vk::CommandPool::null(),
            command: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            acquired: vk::Semaphore::null(),
            device,
        };
        made.make_commands()?;
        made.render_pass = made.make_render_pass()?;
        let options = Options { srgb_framebuffer: is_srgb(format.format), ..Options::default() };
        let renderer = Renderer::with_default_allocator(
            &made.device.owner.instance,
            made.device.physical,
            made.device.device.clone(),
            RenderMode::RenderPass(made.render_pass),
            options,
        );
        made.renderer = Some(renderer.map_err(|error| window_error("interface", error))?);
        Ok(made)
    }

    fn make_commands(&mut self) -> Result<(), ViewerError> {
        let failed = |error| window_error("commands", error);
        let device = &self.device.device;
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER)
            .queue_family_index(self.device.family);
        // SAFETY: the family exists.
        self.pool = unsafe { device.create_command_pool(&info, None) }.map_err(failed)?;
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(self.pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool is fresh.
        let commands = unsafe { device.allocate_command_buffers(&info) }.map_err(failed)?;
        self.command = commands.first().copied().unwrap_or_default();
        // SAFETY: no conditions.
        self.fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }.map_err(failed)?;
        // SAFETY: no conditions.
        self.acquired =
            unsafe { device.create_semaphore(&vk::SemaphoreCreateInfo::default(), None) }.map_err(failed)?;
        Ok(())
    }

    fn make_render_pass(&self) -> Result<vk::RenderPass, ViewerError> {
        let attachments = [vk::AttachmentDescription::default()
            .format(self.format.format)
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
            .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
            .initial_layout(vk::ImageLayout::UNDEFINED)
            .final_layout(vk::ImageLayout::PRESENT_SRC_KHR)];
        let colours = [vk::AttachmentReference::default().layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let passes = [vk::SubpassDescription::default()
            .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
            .color_attachments(&colours)];
        let output = vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT;
        // The image is written only after it was acquired.
        let dependencies = [vk::SubpassDependency::default()
            .src_subpass(vk::SUBPASS_EXTERNAL)
            .src_stage_mask(output)
            .dst_stage_mask(output)
            .dst_access_mask(vk::AccessFlags::COLOR_ATTACHMENT_WRITE)];
        let info = vk::RenderPassCreateInfo::default()
            .attachments(&attachments)
            .subpasses(&passes)
            .dependencies(&dependencies);
        // SAFETY: all pointers live until the call returns.
        unsafe { self.device.device.create_render_pass(&info, None) }
            .map_err(|error| window_error("vkCreateRenderPass", error))
    }

    /// Takes note that the window has, or may have, another size.
    pub(super) fn resized(&mut self) {
        self.is_old = true;
    }

    /// Returns the messages of the validation layer; the log outlives the painter.
    pub(super) fn validation_log(&self) -> ValidationLog {
        self.device.validation_log()
    }

    /// Uploads the textures of a frame. They must be uploaded in order even if nothing is drawn.
    fn set_textures(&mut self, textures: &mut egui::TexturesDelta) -> Result<(), ViewerError> {
        let Some(renderer) = &mut self.renderer else { return Ok(()) };
        for (id, deltas) in std::mem::take(&mut textures.set) {
            for delta in deltas {
                renderer
                    .set_texture(self.device.queue, self.pool, id, &delta)
                    .map_err(|error| window_error("a texture", error))?;
            }
        }
        Ok(())
    }

    /// Draws a frame and waits for it. Returns false, without drawing, if the window has no pixels or another
    /// size than its images. `size` is the window's in pixels.
    pub(super) fn paint(
        &mut self,
        size: [u32; 2],
        scale: f32,
        primitives: &[egui::ClippedPrimitive],
        textures: &mut egui::TexturesDelta,
    ) -> Result<bool, ViewerError> {
        self.set_textures(textures)?;
        let drawn = self.draw(size, scale, primitives)?;
        // The last frame was waited for.
        if let Some(renderer) = &mut self.renderer {
            for id in std::mem::take(&mut textures.free) {
                renderer.free_texture(id).map_err(|error| window_error("a texture", error))?;
            }
        }
        Ok(drawn)
    }

    fn draw(
        &mut self,
        size: [u32; 2],
        scale: f32,
        primitives: &[egui::ClippedPrimitive],
    ) -> Result<bool, ViewerError> {
        if self.is_old || self.swapchain.is_none() {
            let before = self.swapchain.take();
            let made = Swapchain::new(&self.device, self.format, self.render_pass, size, before.as_ref());
            if let Some(mut before) = before {
                self.wait_idle();
                before.destroy(&self.device);
            }
            self.swapchain = made?;
            self.is_old = false;
        }
        let Some(swapchain) = &self.swapchain else { return Ok(false) };
        // SAFETY: the semaphore is not signalled: the frame before waited for it and was waited for.
        let acquired = unsafe {
            swapchain.functions.acquire_next_image(
                swapchain.handle,
                TIMEOUT.as_nanos() as u64,
                self.acquired,
                vk::Fence::null(),
            )
        };
        let index = match acquired {
            Ok((index, suboptimal)) => {
                self.is_old |= suboptimal;
                index
            }
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => {
                self.is_old = true;
                return Ok(false);
            }
            Err(error) => return Err(window_error("vkAcquireNextImageKHR", error)),
        };
        self.record_and_submit(index, scale, primitives)?;
        self.present(index)
    }

    fn record_and_submit(
        &mut self,
        index: u32,
        scale: f32,
        primitives: &[egui::ClippedPrimitive],
    ) -> Result<(), ViewerError> {
        let failed = |error| window_error("a frame", error);
        let Self { swapchain: Some(swapchain), renderer: Some(renderer), device: owner, .. } = self else {
            return Ok(());
        };
        let (device, target, extent) = (&owner.device, &swapchain.targets[index as usize], swapchain.extent);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        let clear = [vk::ClearValue { color: vk::ClearColorValue { float32: [0.0, 0.0, 0.0, 1.0] } }];
        let pass = vk::RenderPassBeginInfo::default()
            .render_pass(self.render_pass)
            .framebuffer(target.framebuffer)
            .render_area(vk::Rect2D { offset: vk::Offset2D::default(), extent })
            .clear_values(&clear);
        // SAFETY: the last use of the command buffer was waited for, and beginning the buffer resets it.
        unsafe { device.begin_command_buffer(self.command, &begin) }.map_err(failed)?;
        // SAFETY: recording; the framebuffer was made for the render pass.
        unsafe { device.cmd_begin_render_pass(self.command, &pass, vk::SubpassContents::INLINE) };
        let drawn = renderer.cmd_draw(self.command, extent, scale, primitives);
        // SAFETY: inside of the render pass.
        unsafe { device.cmd_end_render_pass(self.command) };
        // SAFETY: recording.
        unsafe { device.end_command_buffer(self.command) }.map_err(failed)?;
        drawn.map_err(|error| window_error("the interface", error))?;
        let (commands, waits, signals) = ([self.command], [self.acquired], [target.drawn]);
        let stages = [vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT];
        let submit = [vk::SubmitInfo::default()
            .command_buffers(&commands)
            .wait_semaphores(&waits)
            .wait_dst_stage_mask(&stages)
            .signal_semaphores(&signals)];
        let fences = [self.fence];
        // SAFETY: the queue is used by this thread alone, and the fence is not signalled.
        unsafe { device.queue_submit(owner.queue, &submit, self.fence) }.map_err(failed)?;
        // SAFETY: the fence belongs to the device.
        unsafe { device.wait_for_fences(&fences, true, TIMEOUT.as_nanos() as u64) }.map_err(failed)?;
        // SAFETY: no submission waits to signal it.
        unsafe { device.reset_fences(&fences) }.map_err(failed)
    }

    fn present(&mut self, index: u32) -> Result<bool, ViewerError> {
        let Some(swapchain) = &self.swapchain else { return Ok(false) };
        let (chains, indices) = ([swapchain.handle], [index]);
        let waits = [swapchain.targets[index as usize].drawn];
        let info =
            vk::PresentInfoKHR::default().swapchains(&chains).image_indices(&indices).wait_semaphores(&waits);
        // SAFETY: the queue is used by this thread alone, and the image was acquired and drawn to.
        match unsafe { swapchain.functions.queue_present(self.device.queue, &info) } {
            Ok(suboptimal) => {
                self.is_old |= suboptimal;
                Ok(true)
            }
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => {
                self.is_old = true;
                Ok(false)
            }
            Err(error) => Err(window_error("vkQueuePresentKHR", error)),
        }
    }

    fn wait_idle(&self) {
        // SAFETY: the queue is used by this thread alone. If the wait fails, the device is lost, and nothing
        // runs on it.
        _ = unsafe { self.device.device.device_wait_idle() };
    }
}

impl Drop for Painter {
    fn drop(&mut self) {
        self.wait_idle();
        self.renderer = None;
        if let Some(mut swapchain) = self.swapchain.take() {
            swapchain.destroy(&self.device);
        }
        // SAFETY: the device is idle; null handles are ignored.
        unsafe {
            self.device.device.destroy_semaphore(self.acquired, None);
            self.device.device.destroy_fence(self.fence, None);
            self.device.device.destroy_command_pool(self.pool, None);
            self.device.device.destroy_render_pass(self.render_pass, None);
        }
    }
}
