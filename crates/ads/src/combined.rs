//! A structure in two parts, combined when rays are traced.

use rasray_gpu::{Device, GpuError, Recorder, Requirements};

use crate::{
    AdsError, BuildStatus, Check, Counters, Dependencies, Domain, Geometry, GeometryParts, ListCounts,
    RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport, TraceMode, TracedPart,
    Viewpoint,
};

/// Number of parts.
const PARTS: usize = 2;

/// Two structures of a kind over the two parts of a geometry. A ray is traced through the static part and then through the
/// moving one: the nearer of the hits that either alone gives wins, and at the same t the lower id, as within one
/// structure; of stored fragments the static one. So hits are those of one structure over all triangles, bit for bit, where
/// it finds every triangle ([`StructureKind::Primitive`]). Others have the errors of two structures, each with views and
/// cells around its own part.
///
/// As a [`Structure`] it builds both parts. What builds only the part that moved is a loop over frames that keeps each
/// part by itself (`rasray_tracer::FrameStructure`), through [`Combined::change_part`].
pub struct Combined {
    geometry: GeometryParts,
    /// The static part first.
    parts: [Box<dyn Structure>; PARTS],
    /// The pools of both.
    sizes: Sizes,
}

impl Combined {
    /// Makes both structures, the static one first.
    ///
    /// # Errors
    /// What `make` returns, or [`AdsError::InParts`] for structures that are not of a kind.
    pub fn new<E: From<AdsError>>(
        geometry: &GeometryParts,
        mut make: impl FnMut(&Geometry) -> Result<Box<dyn Structure>, E>,
    ) -> Result<Self, E> {
        let parts = [make(geometry.static_part())?, make(geometry.moving_part())?];
        let structure = parts[0].name();
        if parts[1].name() != structure || parts[0].counters() != parts[1].counters() {
            let reason = "both are the same structure, with the same counters";
            return Err(AdsError::InParts { structure, reason }.into());
        }
        let sizes = joined(&parts);
        Ok(Self { geometry: geometry.clone(), parts, sizes })
    }

    /// The parts of the geometry.
    pub fn geometry(&self) -> &GeometryParts {
        &self.geometry
    }

    /// Both structures, the static one first.
    pub fn parts(&self) -> [&dyn Structure; PARTS] {
        self.parts.each_ref().map(AsRef::as_ref)
    }

    /// Changes one of the structures, the static one or the moving one.
    ///
    /// # Errors
    /// What `change` returns.
    pub fn change_part<T>(
        &mut self,
        moving: bool,
        change: impl FnOnce(&mut dyn Structure) -> Result<T, AdsError>,
    ) -> Result<T, AdsError> {
        let changed = change(self.parts[usize::from(moving)].as_mut());
        self.sizes = joined(&self.parts);
        changed
    }

    /// Takes other triangles, of which others may move; the next build of each part reads them.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_parts(&mut self, device: &Device, geometry: &GeometryParts) -> Result<(), AdsError> {
        for (part, geometry) in self.parts.iter_mut().zip([geometry.static_part(), geometry.moving_part()]) {
            part.set_geometry(device, geometry)?;
        }
        self.geometry = geometry.clone();
        self.sizes = joined(&self.parts);
        Ok(())
    }

    /// Records the trace of each part: all rounds that it asks for where the caller asks for all.
    fn trace(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        mode: TraceMode,
        rounds: u32,
        mut continues: bool,
    ) {
        let all = rounds == self.rounds();
        for part in &self.parts {
            let rounds = if all { part.rounds() } else { rounds };
            if continues {
                part.record_continued_trace(recorder, queue, domain, mode, rounds);
            } else {
                part.record_trace(recorder, queue, domain, mode, rounds);
            }
            continues = true;
        }
    }
}

impl Structure for Combined {
    fn name(&self) -> &'static str {
        self.parts[0].name()
    }

    fn kind(&self) -> StructureKind {
        self.parts[0].kind()
    }

    fn requirements(&self) -> Requirements {
        self.parts[0].requirements()
    }

    fn counters(&self) -> Counters {
        self.parts[0].counters()
    }

    fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        let (first, second) = sizes.pools.split_at(self.parts[0].sizes().pools.len().min(sizes.pools.len()));
        for (part, pools) in self.parts.iter_mut().zip([first, second]) {
            part.resize(device, &Sizes { pools: pools.to_vec() })?;
        }
        self.sizes = joined(&self.parts);
        Ok(())
    }

    /// As many triangles as before, of which the same move, within the bounds that are stated for all of them; for others
    /// [`Combined::set_parts`].
    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        if geometry.triangle_count() != self.geometry.moving_part().whole().triangle_count() {
            let reason = "for another number of triangles `set_parts` says which of them move";
            return Err(AdsError::InParts { structure: self.name(), reason });
        }
        let parts = geometry.parts(device, self.geometry.moving(), [geometry.bounds(); PARTS])?;
        self.set_parts(device, &parts)
    }

    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.set_scene(scene))
    }

    fn prepare_build(&mut self, device: &Device) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.prepare_build(device))
    }

    fn builds_on_host(&self) -> bool {
        self.parts[0].builds_on_host()
    }

    fn slots(&self) -> u32 {
        self.parts[0].slots()
    }

    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError> {
        self.parts.iter_mut().try_for_each(|part| part.set_slots(device, slots))
    }

    fn depends_on(&self) -> Dependencies {
        self.parts[0].depends_on()
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
        // Each of them allows more.
        self.parts.each_ref().map(|part| part.allow_more_rounds()).contains(&true)
    }

    fn record_trace(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        mode: TraceMode,
        rounds: u32,
    ) {
        self.trace(recorder, queue, domain, mode, rounds, false);
    }

    fn record_continued_trace(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        mode: TraceMode,
        rounds: u32,
    ) {
        self.trace(recorder, queue, domain, mode, rounds, true);
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
    ) -> Result<(), AdsError> {
        if self.kind().finds_triangles() {
            // The queue has noted faults of the first.
            return self.parts[1].record_surfaces(recorder, queue, domain);
        }
        for (structure, part) in self.parts.iter().zip([TracedPart::First, TracedPart::Next]) {
            structure.record_surfaces_of_part(recorder, queue, domain, part)?;
        }
        Ok(())
    }

    fn fault(&self, device: &Device) -> Result<Option<String>, GpuError> {
        let faults = self.parts.iter().map(|part| part.fault(device)).collect::<Result<Vec<_>, _>>()?;
        Ok(faults.into_iter().flatten().next())
    }

    fn list_counts(&self, device: &Device) -> Result<Vec<ListCounts>, AdsError> {
        let mut sums: Vec<ListCounts> = Vec::new();
        for counts in self.parts.iter().map(|part| part.list_counts(device)) {
            for count in counts? {
                match sums.iter_mut().find(|sum| sum.cells_of == count.cells_of) {
                    Some(sum) => sum.add(&count),
                    None => sums.push(count),
                }
            }
        }
        Ok(sums)
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let [mut sum, moving] = [self.parts[0].report()?, self.parts[1].report()?];
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
        Ok(sum)
    }
}

impl std::fmt::Debug for Combined {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Combined")
            .field("structure", &self.name())
            .field("moving", &self.geometry.moving())
            .finish_non_exhaustive()
    }
}

/// The pools of both parts, one after the other.
fn joined(parts: &[Box<dyn Structure>; PARTS]) -> Sizes {
    Sizes { pools: parts.iter().flat_map(|part| part.sizes().pools.clone()).collect() }
}
