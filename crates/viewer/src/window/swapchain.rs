//! Swapchain: the images of a window, and their presentation.

use rasray_gpu::{ash, vk};

use crate::error::ViewerError;

use super::device::{WindowDevice, window_error};

/// Returns the format of a surface's images: an sRGB format, which keeps the bytes of pictures, otherwise the
/// first format.
pub(super) fn surface_format(device: &WindowDevice) -> Result<vk::SurfaceFormatKHR, ViewerError> {
    // SAFETY: physical device and surface belong to one instance.
    let formats = unsafe {
        device.owner.surfaces.get_physical_device_surface_formats(device.physical, device.owner.surface)
    }
    .map_err(|error| window_error("surface formats", error))?;
    let srgb = [vk::Format::B8G8R8A8_SRGB, vk::Format::R8G8B8A8_SRGB, vk::Format::A8B8G8R8_SRGB_PACK32];
    let is_srgb = |format: &&vk::SurfaceFormatKHR| {
        srgb.contains(&format.format) && format.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR
    };
    let chosen = formats.iter().find(is_srgb).or(formats.first()).copied();
    chosen.ok_or_else(|| window_error("surface formats", "the surface has none"))
}

/// True if the format stores bytes of sRGB unchanged.
pub(super) fn is_srgb(format: vk::Format) -> bool {
    format!("{format:?}").contains("SRGB")
}

/// Image of the swapchain, with the objects for drawing to it.
pub(super) struct Target {
    view: vk::ImageView,
    pub(super) framebuffer: vk::Framebuffer,
    /// Semaphore that is signalled when drawing to the image has ended.
    pub(super) drawn: vk::Semaphore,
}

/// A swapchain with its framebuffers.
pub(super) struct Swapchain {
    pub(super) functions: ash::khr::swapchain::Device,
    pub(super) handle: vk::SwapchainKHR,
    pub(super) targets: Vec<Target>,
    pub(super) extent: vk::Extent2D,
}

impl Swapchain {
    /// Makes a swapchain of the window's size in pixels; `None` if the window has no pixels, as while it is
    /// minimised. The old swapchain is retired, and its owner must destroy it.
    pub(super) fn new(
        device: &WindowDevice,
        format: vk::SurfaceFormatKHR,
        render_pass: vk::RenderPass,
        [width, height]: [u32; 2],
        before: Option<&Self>,
    ) -> Result<Option<Self>, ViewerError> {
        // SAFETY: physical device and surface belong to one instance.
        let able = unsafe {
            device
                .owner
                .surfaces
                .get_physical_device_surface_capabilities(device.physical, device.owner.surface)
        }
        .map_err(|error| window_error("surface capabilities", error))?;
        // A width of all ones lets the swapchain decide the size.
        let extent = if able.current_extent.width == u32::MAX {
            let (least, most) = (able.min_image_extent, able.max_image_extent);
            vk::Extent2D {
                width: width.clamp(least.width, most.width.max(least.width)),
                height: height.clamp(least.height, most.height.max(least.height)),
            }
        } else {
            able.current_extent
        };
        if extent.width == 0 || extent.height == 0 || width == 0 || height == 0 {
            return Ok(None);
        }
        let most = if able.max_image_count == 0 { u32::MAX } else { able.max_image_count };
        let alpha = [vk::CompositeAlphaFlagsKHR::OPAQUE, vk::CompositeAlphaFlagsKHR::INHERIT]
            .into_iter()
            .find(|alpha| able.supported_composite_alpha.contains(*alpha))
            .unwrap_or(vk::CompositeAlphaFlagsKHR::POST_MULTIPLIED);
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(device.owner.surface)
            .min_image_count((able.min_image_count + 1).min(most))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(extent)
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::COLOR_ATTACHMENT)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(able.current_transform)
            .composite_alpha(alpha)
            .present_mode(vk::PresentModeKHR::FIFO)
            .clipped(true)
            .old_swapchain(before.map_or(vk::SwapchainKHR::null(), |before| before.handle));
        let functions = ash::khr::swapchain::Device::new(&device.owner.instance, &device.device);
        // SAFETY: the surface belongs to the instance, and the format is one of its formats.
        let handle = unsafe { functions.create_swapchain(&info, None) }
            .map_err(|error| window_error("vkCreateSwapchainKHR", error))?;
        let mut made = Self { functions, handle, targets: Vec::new(), extent };
        let filled = made.fill(device, format.format, render_pass);
        if let Err(error) = filled {
            made.destroy(device);
            return Err(error);
        }
        Ok(Some(made))
    }

    fn fill(
        &mut self,
        device: &WindowDevice,
        format: vk::Format,
        render_pass: vk::RenderPass,
    ) -> Result<(), ViewerError> {
        let failed = |error| window_error("images of the window", error);
        // SAFETY: the swapchain is live.
        let images = unsafe { self.functions.get_swapchain_images(self.handle) }.map_err(failed)?;
        for image in images {
            let range = vk::ImageSubresourceRange::default()
                .aspect_mask(vk::ImageAspectFlags::COLOR)
                .level_count(1)
                .layer_count(1);
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(format)
                .subresource_range(range);
            self.targets.push(Target {
                view: vk::ImageView::null(),
                framebuffer: vk::Framebuffer::null(),
                drawn: vk::Semaphore::null(),
            });
            let Some(target) = self.targets.last_mut() else { continue };
            // SAFETY: the image is the swapchain's and has this format.
            target.view = unsafe { device.device.create_image_view(&info, None) }.map_err(failed)?;
            let views = [target.view];
            let info = vk::FramebufferCreateInfo::default()
                .render_pass(render_pass)
                .attachments(&views)
                .width(self.extent.width)
                .height(self.extent.height)
                .layers(1);
            // SAFETY: the view has the format of the render pass's attachment.
            target.framebuffer = unsafe { device.device.create_framebuffer(&info, None) }.map_err(failed)?;
            // SAFETY: no conditions.
            target.drawn =
                unsafe { device.device.create_semaphore(&vk::SemaphoreCreateInfo::default(), None) }
                    .map_err(failed)?;
        }
        Ok(())
    }

    /// Destroys the swapchain; the device must no longer use it.
    pub(super) fn destroy(&mut self, device: &WindowDevice) {
        // SAFETY: the caller guarantees that the device is idle; null handles are ignored.
        unsafe {
            for target in self.targets.drain(..) {
                device.device.destroy_framebuffer(target.framebuffer, None);
                device.device.destroy_image_view(target.view, None);
                device.device.destroy_semaphore(target.drawn, None);
            }
            self.functions.destroy_swapchain(self.handle, None);
        }
    }
}
