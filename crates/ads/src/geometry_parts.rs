//! A geometry in two parts: triangles that stay, and those that move.

use std::ops::Range;

use rasray_gpu::{BindingSet, Device, GpuError, SetLayout};

use crate::geometry::Run;
use crate::{AdsError, Geometry};

/// Two geometries that share the buffers of a third, of which each triangle is in one of them: those that move, and the
/// static ones. Hits on either have the ids of the whole.
#[derive(Clone, Debug)]
pub struct GeometryParts {
    moving: Vec<Range<u32>>,
    static_part: Geometry,
    moving_part: Geometry,
    /// The headers of both, for [`BoundsPass::record_parts`](crate::BoundsPass::record_parts).
    headers: BindingSet,
}

impl GeometryParts {
    pub(crate) fn layout(device: &Device) -> Result<SetLayout, GpuError> {
        device.create_set_layout("geometry parts", 2)
    }

    /// The triangles that stay.
    pub fn static_part(&self) -> &Geometry {
        &self.static_part
    }

    /// The triangles that move.
    pub fn moving_part(&self) -> &Geometry {
        &self.moving_part
    }

    /// Ids of the triangles that move: in order, no range empty, none that touch.
    pub fn moving(&self) -> &[Range<u32>] {
        &self.moving
    }

    pub(crate) fn headers(&self) -> &BindingSet {
        &self.headers
    }
}

impl Geometry {
    /// The geometry in two parts: the triangles with ids in `moving`, in any order, and all others. `static_bounds` hold
    /// all positions of the others, `moving_bounds` those that move; a pass of the host or
    /// [`BoundsPass::record_parts`](crate::BoundsPass::record_parts) may write others for the moving part, as for any geometry.
    ///
    /// A part whose triangles follow one another reads the indices of the whole. Any other one takes 12 bytes per triangle
    /// and 8 per run, and gathers its indices in each build.
    ///
    /// # Errors
    /// Ids beyond the triangles, or in two ranges; a number of triangles that only the device knows; a geometry that is a
    /// part itself; bounds that are not finite or the wrong way round; out of memory.
    pub fn parts(
        &self,
        device: &Device,
        moving: &[Range<u32>],
        [static_bounds, moving_bounds]: [[[f32; 3]; 2]; 2],
    ) -> Result<GeometryParts, AdsError> {
        let wrong = |reason: String| Err(AdsError::Geometry { reason });
        if self.is_part() {
            return wrong("a part of a geometry has no parts".to_owned());
        }
        if self.desc().count.is_some() {
            return wrong("triangles that only the device counts cannot be in parts".to_owned());
        }
        let count = self.triangle_count();
        let mut sorted: Vec<_> = moving.iter().filter(|ids| !ids.is_empty()).cloned().collect();
        sorted.sort_by_key(|ids| ids.start);
        let mut joined: Vec<Range<u32>> = Vec::new();
        for ids in sorted {
            if ids.end > count {
                return wrong(format!("triangles {ids:?} are to move, of {count}"));
            }
            match joined.last_mut() {
                Some(last) if ids.start < last.end => {
                    return wrong(format!("triangles {last:?} and {ids:?} are to move, which overlap"));
                }
                Some(last) if ids.start == last.end => last.end = ids.end,
                _ => joined.push(ids),
            }
        }
        let part = |ids: &[Range<u32>], bounds| {
            let (mut runs, mut first) = (Vec::with_capacity(ids.len()), 0);
            for ids in ids {
                runs.push(Run { first, id: ids.start });
                first += ids.end - ids.start;
            }
            Self::part_of(device, self, (&runs, first), bounds)
        };
        let static_part = part(&between(&joined, count), static_bounds)?;
        let moving_part = part(&joined, moving_bounds)?;
        let layout = GeometryParts::layout(device)?;
        let headers = [static_part.header(), moving_part.header()];
        let headers = device.create_binding_set(&layout, "geometry parts", &headers)?;
        Ok(GeometryParts { moving: joined, static_part, moving_part, headers })
    }
}

/// What ranges below `count` leave out; they are in order and do not overlap.
fn between(ranges: &[Range<u32>], count: u32) -> Vec<Range<u32>> {
    let starts = std::iter::once(0).chain(ranges.iter().map(|ids| ids.end));
    let ends = ranges.iter().map(|ids| ids.start).chain([count]);
    starts.zip(ends).map(|(start, end)| start..end).filter(|ids| !ids.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn what_does_not_move_is_static() {
        let all = std::slice::from_ref(&(0..5));
        assert_eq!(between(&[], 5), all);
        assert!(between(all, 5).is_empty());
        assert_eq!(between(&[1..2, 3..5], 7), [0..1, 2..3, 5..7]);
        assert_eq!(between(&[], 0), []);
    }
}
