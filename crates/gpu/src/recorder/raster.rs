//! Commands that draw without attachments.

use ash::vk;

use super::{Recorder, RenderArea};
use crate::buffer::Buffer;
use crate::error::GpuError;
use crate::features::Feature;

impl Recorder<'_> {
    /// Begins a rendering of `width` x `height` pixels of one layer. Viewport and scissor cover the whole
    /// area.
    pub fn begin_rendering(&mut self, width: u32, height: u32) {
        self.begin_rendering_area(RenderArea { width, height, layers: 1, view_mask: 0 });
    }

    /// Begins a rendering of several layers or views.
    pub fn begin_rendering_area(&mut self, area: RenderArea) {
        if !self.outside_rendering("begin_rendering") {
            return;
        }
        let RenderArea { width, height, layers, view_mask } = area;
        let limits = self.device.limits();
        let views = u32::BITS - view_mask.leading_zeros();
        let checks: [(&'static str, u32, u32); 4] = [
            ("the width", width, limits.max_framebuffer_size[0]),
            ("the height", height, limits.max_framebuffer_size[1]),
            ("the number of layers", layers, limits.max_framebuffer_layers),
            ("the number of views", views, limits.max_multiview_views),
        ];
        if let Some((what, asked, limit)) = checks.into_iter().find(|(_, asked, limit)| asked > limit) {
            return self.exceed(what, asked.into(), limit.into());
        }
        if width == 0 || height == 0 || (layers == 0 && view_mask == 0) {
            return self.misuse("rendering needs at least one pixel and one layer");
        }
        let core = self.core();
        let multiview = || match view_mask {
            0 => Ok(()),
            _ => core.require(Feature::Multiview, "begin_rendering with a view mask"),
        };
        if let Err(error) =
            core.require(Feature::DynamicRendering, "begin_rendering").and_then(|()| multiview())
        {
            return self.fail(error);
        }
        let Some(begin) = self.core().commands.begin_rendering else {
            let what = "begin_rendering".to_owned();
            return self.fail(GpuError::FeatureNotEnabled { feature: Feature::DynamicRendering, what });
        };
        let extent = vk::Rect2D::default().extent(vk::Extent2D { width, height });
        let info =
            vk::RenderingInfo::default().render_area(extent).layer_count(layers.max(1)).view_mask(view_mask);
        let viewport =
            vk::Viewport::default().width(width as f32).height(height as f32).min_depth(0.0).max_depth(1.0);
        // SAFETY: the command buffer is being recorded, outside of rendering, on a device with dynamic
        // rendering and within its limits.
        unsafe {
            begin(self.command, &info);
            self.raw_device().cmd_set_viewport(self.command, 0, &[viewport]);
            self.raw_device().cmd_set_scissor(self.command, 0, &[extent]);
        }
        self.rendering = Some(area);
    }

    /// Draws `vertices` vertices `instances` times, with the bound raster pipeline.
    pub fn draw(&mut self, vertices: u32, instances: u32, first_instance: u32) {
        if !self.can_draw() {
            return;
        }
        // SAFETY: the command buffer is being recorded, within rendering, with a raster pipeline of the same
        // views. The sets that the pipeline uses and its push constants were found bound.
        unsafe { self.raw_device().cmd_draw(self.command, vertices, instances, 0, first_instance) };
        self.count(|pass| {
            pass.draws += 1;
            pass.vertices += u64::from(vertices) * u64::from(instances);
        });
    }

    /// Draws with arguments that the device reads as four u32 from a buffer (vertices, instances, 0, 0), at
    /// an offset that is a multiple of 4.
    pub fn draw_indirect(&mut self, buffer: &Buffer, offset: u64) {
        if !self.can_draw() || !self.indirect_arguments(buffer, offset, 16) {
            return;
        }
        // SAFETY: as for `draw`; the arguments lie within a buffer made for them.
        unsafe { self.raw_device().cmd_draw_indirect(self.command, buffer.raw(), offset, 1, 16) };
        self.count(|pass| pass.indirect += 1);
    }

    /// Ends the rendering.
    pub fn end_rendering(&mut self) {
        if !self.is_recording() {
            return;
        }
        if self.rendering.take().is_none() {
            return self.misuse("rendering was ended that was not begun");
        }
        if let Some(end) = self.core().commands.end_rendering {
            // SAFETY: the command buffer is being recorded, within rendering that this recorder began.
            unsafe { end(self.command) };
        }
    }

    fn can_draw(&mut self) -> bool {
        if !self.has_pipeline(vk::PipelineBindPoint::GRAPHICS) {
            return false;
        }
        let view_mask = self.bound.pipeline.as_ref().map_or(0, |pipeline| pipeline.view_mask);
        match self.rendering {
            None => self.misuse("a draw was recorded outside of begin_rendering and end_rendering"),
            Some(area) if area.view_mask != view_mask => {
                self.misuse("pipeline and rendering have different view masks");
            }
            Some(_) => {}
        }
        self.is_recording()
    }
}
