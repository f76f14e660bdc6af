//! A structure made of parts whose hits are combined when rays are traced.

use rasray_gpu::{Device, GpuError, Recorder};

use crate::{
    AdsError, BuildStatus, Check, Counters, Description, Domain, Geometry, GeometryParts, Inspect,
    ListCounts, RayQueue, SceneBinding, Sizes, Start, Structure, StructureReport, Trace, TracedPart,
    Viewpoint,
};

/// Structures of one kind over the parts of a geometry. A ray is traced through the static part and then
/// through the moving parts, one after the other. The nearest of the hits in the parts wins. At equal t the
/// hit with the lower id wins, as within one structure; among stored fragments the fragment of the earlier
/// part wins. So the hits are those of one structure over all triangles, bit for bit, if the structure finds
/// every triangle ([`StructureKind::Primitive`](crate::StructureKind::Primitive)). Other kinds have the
/// errors of several structures, each with views and cells around its own part.
///
/// As a [`Structure`] it builds all parts. To build only the parts that moved, a loop over frames keeps track
/// of each part separately (`rasray_tracer::FrameStructure`), through [`Combined::change_part`].
pub struct Combined {
    description: Description,
    geometry: GeometryParts,
    /// Structures over the parts, the static part first.
    parts: Vec<Box<dyn Structure>>,
    /// Sizes of the pools of all parts.
    sizes: Sizes,
}

impl Combined {
    /// Makes the structures, that of the static part first.
    ///
    /// # Errors
    /// The error of `make`, or [`AdsError::InParts`] if the structures are not all of one kind.
    pub fn new<E: From<AdsError>>(
        geometry: &GeometryParts,
        make: impl FnMut(&Geometry) -> Result<Box<dyn Structure>, E>,
    ) -> Result<Self, E> {
        let parts = geometry.parts().iter().map(make).collect::<Result<Vec<_>, E>>()?;
        // No single part has the first hits of all triangles, and all triangles together are not in a space
        // of their own.
        let description = Description { follows: false, first_hits: false, ..parts[0].description().clone() };
        let is_other =
            |part: &Description| part.name != description.name || part.counters != description.counters;
        if parts.iter().any(|part| is_other(part.description())) {
            let structure = description.name;
            let reason = "all are the same structure, with the same counters";
            return Err(AdsError::InParts { structure, reason }.into());
        }
        let sizes = joined(&parts);
        Ok(Self { description, geometry: geometry.clone(), parts, sizes })
    }

    /// Returns the parts of the geometry.
    pub fn geometry(&self) -> &GeometryParts {
        &self.geometry
    }

    /// Returns the number of parts, the static part included.
    pub fn count(&self) -> usize {
        self.parts.len()
    }

    /// Returns the structure of a part: 0 is the static part, followed by the moving parts in the order of
    /// [`GeometryParts::moving`].
    ///
    /// # Panics
    /// The part does not exist.
    pub fn part(&self, part: usize) -> &dyn Structure {
        self.parts[part].as_ref()
    }

    /// Changes the structure of a part, numbered as for [`Combined::part`].
    ///
    /// # Errors
    /// The error of `change`.
    ///
    /// # Panics
    /// The part does not exist.
    pub fn change_part<T>(
        &mut self,
        part: usize,
        change: impl FnOnce(&mut dyn Structure) -> Result<T, AdsError>,
    ) -> Result<T, AdsError> {
        let changed = change(self.parts[part].as_mut());
        self.sizes = joined(&self.parts);
        changed
    }

    /// Replaces the triangles and the selection of those that move, in the same number of parts; the next
    /// build of each part reads the new triangles.
    ///
    /// # Errors
    /// [`AdsError::InParts`] if the number of parts differs; out of memory.
    pub fn set_parts(&mut self, device: &Device, geometry: &GeometryParts) -> Result<(), AdsError> {
        if geometry.parts().len() != self.parts.len() {
            let reason = "other triangles are in as many parts as there are structures";
            return Err(AdsError::InParts { structure: self.description.name, reason });
        }
        for (part, geometry) in self.parts.iter_mut().zip(geometry.parts()) {
            part.set_geometry(device, geometry)?;
        }
        self.geometry = geometry.clone();
        self.sizes = joined(&self.parts);
        Ok(())
    }
}

impl Structure for Combined {
    fn description(&self) -> &Description {
        &self.description
    }

    fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        self.sizes.check_pools(self.description.name, sizes)?;
        let mut rest = &sizes.pools[..];
        for part in &mut self.parts {
            let (pools, others) = rest.split_at(part.sizes().pools.len());
            rest = others;
            part.resize(device, &Sizes { pools: pools.to_vec() })?;
        }
        self.sizes = joined(&self.parts);
        Ok(())
    }

    /// Takes new positions for the same number of triangles, in the same parts, within the bounds that the
    /// geometry states for all of them; [`Combined::set_parts`] takes other triangles.
    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        if geometry.triangle_count() != self.geometry.whole().triangle_count() {
            let reason = "for another number of triangles `set_parts` says which of them move";
            return Err(AdsError::InParts { structure: self.description.name, reason });
        }
        let parts = self.geometry.of(device, geometry)?;
        self.set_parts(device, &parts)
    }

    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.set_scene(scene))
    }

    fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.set_counters(device, counters))?;
        self.description.counters = counters;
        Ok(())
    }

    fn prepare_build(&mut self, device: &Device) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.prepare_build(device))
    }

    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.set_slots(device, slots))
    }

    fn is_stale(&self, built: Viewpoint, wanted: Viewpoint) -> bool {
        self.parts.iter().any(|part| part.is_stale(built, wanted))
    }

    fn record_build(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.record_build(recorder, slot, viewpoint))
    }

    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError> {
        let parts = self.parts.iter().map(|part| part.status(slot)).collect::<Result<Vec<_>, _>>()?;
        let all = |of: fn(&BuildStatus) -> bool| parts.iter().all(of);
        Ok(BuildStatus {
            complete: all(|part| part.complete),
            was_complete: all(|part| part.was_complete),
            pools: parts.iter().flat_map(|part| part.pools.clone()).collect(),
            unsorted: parts.iter().map(|part| part.unsorted).sum(),
            outside: parts.iter().fold(0, |sum, part| sum.saturating_add(part.outside)),
            corrupted: parts.iter().map(|part| part.corrupted).sum(),
            parts,
        })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        let mut grows = false;
        let mut pools = Vec::with_capacity(self.sizes.pools.len());
        for (part, status) in self.parts.iter().zip(&status.parts) {
            match part.check(status, headroom)? {
                Check::Complete => pools.extend_from_slice(&part.sizes().pools),
                Check::Grow(sizes) => {
                    grows = true;
                    pools.extend(sizes.pools);
                }
            }
        }
        Ok(if grows { Check::Grow(Sizes { pools }) } else { Check::Complete })
    }

    fn rounds(&self) -> u32 {
        self.parts.iter().map(|part| part.rounds()).max().unwrap_or(1)
    }

    fn allow_more_rounds(&self) -> bool {
        // Every part must allow more rounds, so the iteration does not stop at the first that does.
        self.parts.iter().filter(|part| part.allow_more_rounds()).count() > 0
    }

    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, trace: Trace<'_>) {
        for (number, part) in self.parts.iter().enumerate() {
            if number > 0 {
                self.geometry.record_note(recorder, queue, number);
            }
            let start = match number {
                0 => trace.start.of_all_rays(),
                // With a single moving part most rays meet its bounds, so selecting rays does not pay.
                _ if self.parts.len() == 2 => Start::Continue,
                _ => Start::Part(self.geometry.rays_of(number)),
            };
            part.record_trace(recorder, queue, Trace { start, ..trace });
        }
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        _part: TracedPart,
    ) -> Result<(), AdsError> {
        let last = self.parts.len() - 1;
        if self.description.kind.finds_triangles() {
            // The queue has noted the faults of the other parts already.
            return self.parts[last].record_surfaces(recorder, queue, domain, TracedPart::Whole);
        }
        for (number, part) in self.parts.iter().enumerate() {
            let after = (last - number) as u32;
            if number > 0 {
                self.geometry.record_note(recorder, queue, number);
            }
            let which = if number == 0 { TracedPart::First { after } } else { TracedPart::Next { after } };
            part.record_surfaces(recorder, queue, domain, which)?;
        }
        Ok(())
    }

    fn inspect(&self) -> Option<&dyn Inspect> {
        self.parts[0].inspect().map(|_| self as &dyn Inspect)
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let mut sum = self.parts[0].report()?;
        for part in &self.parts[1..] {
            let moving = part.report()?;
            for (name, bytes) in moving.bytes_by_part {
                match sum.bytes_by_part.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, known)) => *known += bytes,
                    None => sum.bytes_by_part.push((name, bytes)),
                }
            }
            sum.formula_bytes += moving.formula_bytes;
            sum.diagnostic_bytes += moving.diagnostic_bytes;
            sum.stored = sum.stored.zip(moving.stored).map(|(one, other)| one + other);
            sum.lost = sum.lost.zip(moving.lost).map(|(one, other)| one + other);
        }
        Ok(sum)
    }
}

impl Combined {
    fn inspected(&self) -> impl Iterator<Item = &dyn Inspect> {
        self.parts.iter().filter_map(|part| part.inspect())
    }

    fn pools_are_of_parts(&self) -> GpuError {
        let reason = "is in parts, each of which has pools of its own".to_owned();
        GpuError::InvalidUse { name: self.description.name.to_owned(), reason }
    }
}

impl Inspect for Combined {
    fn download_pools(&self, _device: &Device) -> Result<Vec<(&'static str, Vec<u32>)>, GpuError> {
        Err(self.pools_are_of_parts())
    }

    unsafe fn upload_pools(
        &self,
        _device: &Device,
        _pools: &[(&'static str, Vec<u32>)],
    ) -> Result<(), GpuError> {
        Err(self.pools_are_of_parts())
    }

    fn fault(&self, device: &Device) -> Result<Option<String>, GpuError> {
        let faults = self.inspected().map(|part| part.fault(device)).collect::<Result<Vec<_>, _>>()?;
        Ok(faults.into_iter().flatten().next())
    }

    fn list_counts(&self, device: &Device) -> Result<Vec<ListCounts>, AdsError> {
        let mut sums: Vec<ListCounts> = Vec::new();
        for counts in self.inspected().map(|part| part.list_counts(device)) {
            for count in counts? {
                match sums.iter_mut().find(|sum| sum.cells_of == count.cells_of) {
                    Some(sum) => sum.add(&count),
                    None => sums.push(count),
                }
            }
        }
        Ok(sums)
    }
}

impl std::fmt::Debug for Combined {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Combined")
            .field("structure", &self.description.name)
            .field("parts", &self.count())
            .finish_non_exhaustive()
    }
}

/// Joins the pools of all parts in the order of the parts.
fn joined(parts: &[Box<dyn Structure>]) -> Sizes {
    Sizes { pools: parts.iter().flat_map(|part| part.sizes().pools.clone()).collect() }
}
