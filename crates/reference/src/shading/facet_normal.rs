//! Normal around which the facets of a surface lie, for shading normals that lean away.

use glam::Vec3;

/// Cosine to which the facets' normal is bent where the shading normal faces away from the viewer.
const NORMAL_COSINE: f32 = 0.01;
/// Least height of a mirrored direction over the geometric surface, or, for a grazing viewer, this share of
/// the viewer's height.
const MIRRORED_HEIGHT: f32 = 0.01;
const MIRRORED_SHARE: f32 = 0.9;

/// Returns the normal around which facets lie: the shading normal, bent until it faces `o`, and then only so
/// far that `o` mirrored at it leaves the geometric surface.
pub(super) fn facet_normal(normal: Vec3, geometric_normal: Vec3, o: Vec3) -> Vec3 {
    let cosine = normal.dot(o);
    let facing =
        if cosine < NORMAL_COSINE { (normal + (NORMAL_COSINE - cosine) * o).normalize() } else { normal };
    let mirrored = 2.0 * facing.dot(o) * facing - o;
    let height = mirrored.dot(geometric_normal);
    let least = MIRRORED_HEIGHT.min(MIRRORED_SHARE * o.dot(geometric_normal));
    if height >= least {
        return facing;
    }
    let along = mirrored - height * geometric_normal;
    let squared = along.length_squared();
    if !(squared > 0.0) {
        return geometric_normal;
    }
    let lifted = geometric_normal * least + along * ((1.0 - least * least).sqrt() / squared.sqrt());
    (o + lifted).normalize()
}
