// Cuts a ray into segments, in order: those in the camera's view, then those in the faces of the cube.
// Reads: header. Writes: nothing.
// Source: MMRT section 3.4. Every view that sees a segment is marched, and the nearest hit counts. The
// camera's view comes first, because a hit there ends the traversal of the faces early. With ABUFFER_SNAPS
// views are switched as published.
#ifndef ABUFFER_SEGMENTS_GLSL
#define ABUFFER_SEGMENTS_GLSL

#include "contract/trace_log.glsl"
#include "ads/march_cube.glsl"
#include "abuffer/views.glsl"

// Stages of a ray: its segments in the camera's view before and behind the near region; the near region,
// where no faces cut it out; and the faces.
#define ABUFFER_STAGE_BEFORE 0u
#define ABUFFER_STAGE_BEHIND 1u
#define ABUFFER_STAGE_NEAR 2u
#define ABUFFER_STAGE_FACES 3u

// Value in place of a view's number: the segment lies in the face in which it begins.
#define ABUFFER_IN_FACES 8u

#define ABUFFER_SEGMENT_LIMIT (SEGMENT_LIMIT + ABUFFER_STAGE_FACES)

// Progress of a ray through its segments.
struct AbufferProgress {
    uint stage;           // the next stage, ABUFFER_STAGE_*
    float t;              // where the next segment in a face begins
};

// Returns the progress of a ray whose part within the bounds of the geometry is `clip`.
AbufferProgress abuffer_progress_begin(vec2 clip) {
    return AbufferProgress(ABUFFER_HAS_CAMERA ? ABUFFER_STAGE_BEFORE : ABUFFER_STAGE_FACES, clip.x);
}

// Returns the part of `clip` in which the ray lies in a view's pyramid; it is empty if x > y. `wider` is the
// number of cells by which the pyramid is widened, half of them on each side.
vec2 abuffer_pyramid_interval(AbufferRef s, uint view, vec3 origin, vec3 direction, vec2 clip, int wider) {
    vec3 o = abuffer_view_from_world(s, origin, view);
    vec3 d = abuffer_view_from_world(s, direction, view);
    vec2 interval = clip;
    // The sides of the pyramid are given in x/z and y/z.
    uint resolution = abuffer_resolution(s, view);
    ivec2 cells = view == ABUFFER_CAMERA ? abuffer_camera_cells(s) : ivec2(resolution);
    vec2 ends = vec2(cells + wider) / float(resolution);
    for (int side = 0; side < 4; side++) {
        float turn = (side & 1) != 0 ? -1.0 : 1.0;
        float end = side < 2 ? ends.x : ends.y;
        float value = end * o.z + turn * (side < 2 ? o.x : o.y);
        float slope = end * d.z + turn * (side < 2 ? d.x : d.y);
        if (slope > 0.0) {
            interval.x = max(interval.x, -value / slope);
        } else if (slope < 0.0) {
            interval.y = min(interval.y, -value / slope);
        } else if (value < 0.0) {
            return vec2(1.0, 0.0);
        }
    }
    return interval;
}

// Returns the t interval of the segment of a stage before the faces; it is empty if x > y.
vec2 abuffer_stage_interval(AbufferRef s, vec3 origin, vec3 direction, vec2 near, vec2 clip, uint stage) {
    bool has_near = near.x <= near.y;
    if (stage == ABUFFER_STAGE_NEAR) {
        return has_near && !ABUFFER_HAS_CUBE ? vec2(max(near.x, clip.x), min(near.y, clip.y)) : vec2(1.0, 0.0);
    }
    if (stage == ABUFFER_STAGE_BEHIND && !has_near) {
        return vec2(1.0, 0.0);
    }
    vec2 interval = abuffer_pyramid_interval(s, ABUFFER_CAMERA, origin, direction, clip, 0);
    if (has_near) {
        return stage == ABUFFER_STAGE_BEFORE ? vec2(interval.x, min(interval.y, near.x)) : vec2(max(interval.x, near.y), interval.y);
    }
    return interval;
}

// Returns the view in which a ray goes on at t. In the near region this is SEGMENT_NEAR; if no view is left,
// it is ABUFFER_IN_FACES.
uint abuffer_view_at(AbufferRef s, vec3 origin, vec3 direction, vec2 near, float t, uint stage) {
    if (near.x <= t && t < near.y) {
        return SEGMENT_NEAR;
    }
    if (ABUFFER_HAS_CAMERA && stage == ABUFFER_STAGE_BEFORE) {
        vec2 seen = abuffer_pyramid_interval(s, ABUFFER_CAMERA, origin, direction, vec2(t), 0);
        if (seen.x <= seen.y) {
            return ABUFFER_CAMERA;
        }
    }
    return ABUFFER_HAS_CUBE ? face_of(origin + t * direction) : ABUFFER_IN_FACES;
}

// Returns the t at which a ray goes on that was followed through a view up to `end`. The ray is then half a
// cell outside the view, or enters the near region if that begins before.
float abuffer_snapped(AbufferRef s, vec3 origin, vec3 direction, vec2 near, vec2 clip, uint view, float end) {
    if (view == SEGMENT_NEAR || !(end < clip.y)) {
        return end;
    }
    vec2 outside = abuffer_pyramid_interval(s, view, origin, direction, vec2(end, clip.y), 1);
    bool near_ahead = near.x <= near.y && near.x >= end;
    return max(end, near_ahead ? min(outside.y, near.x) : outside.y);
}

// Finds the next segment as abuffer_next_interval does, but follows the ray in one view at a time. The
// camera's view is first, if it sees the ray's start or the point where the ray leaves the near region. After
// it come the faces that the ray passes. A segment ends half a cell before the side of its view.
bool abuffer_next_snapped_interval(AbufferRef s, vec3 origin, vec3 direction, vec2 near, vec2 clip, float best,
    inout AbufferProgress progress, out vec2 ends, out uint view) {
    for (uint segments = 0u; segments < ABUFFER_SEGMENT_LIMIT; segments++) {
        float t = progress.t;
        view = abuffer_view_at(s, origin, direction, near, t, progress.stage);
        if (!(t < clip.y) || t > best || view == ABUFFER_IN_FACES) {
            trace_log(STEP_SKIP, t > best ? SKIP_BEHIND : SKIP_BOUNDS, 0u, 0u, t, clip.y);
            return false;
        }
        float end = near.y;
        if (view != SEGMENT_NEAR) {
            end = abuffer_pyramid_interval(s, view, origin, direction, vec2(t, clip.y), -1).y;
            end = near.x <= near.y && near.x > t ? min(end, near.x) : end;
        }
        ends = vec2(t, max(t, min(end, clip.y)));
        progress.stage = view == SEGMENT_NEAR ? ABUFFER_STAGE_BEFORE : ABUFFER_STAGE_FACES;
        progress.t = abuffer_snapped(s, origin, direction, near, clip, view, ends.y);
        if (ends.x < ends.y) {
            return true;
        }
    }
    return false;
}

// Finds the ends and the view of the next segment that may hold something nearer than `best`. If the view is
// ABUFFER_IN_FACES, abuffer_segment still has to find the face and where the ray leaves it. Returns false if
// no segment is left.
bool abuffer_next_interval(AbufferRef s, vec3 origin, vec3 direction, vec2 near, vec2 clip, float best,
    inout AbufferProgress progress, out vec2 ends, out uint view) {
    if (ABUFFER_SNAPS) {
        return abuffer_next_snapped_interval(s, origin, direction, near, clip, best, progress, ends, view);
    }
    view = ABUFFER_IN_FACES;
    while (progress.stage < ABUFFER_STAGE_FACES) {
        uint stage = progress.stage++;
        vec2 interval = abuffer_stage_interval(s, origin, direction, near, clip, stage);
        if (interval.x < interval.y && !(interval.x > best)) {
            view = stage == ABUFFER_STAGE_NEAR ? SEGMENT_NEAR : ABUFFER_CAMERA;
            ends = interval;
            return true;
        }
    }
    ends = vec2(progress.t, clip.y);
    if (!ABUFFER_HAS_CUBE || !(ends.x < clip.y) || ends.x > best) {
        trace_log(STEP_SKIP, ABUFFER_HAS_CUBE && ends.x < clip.y ? SKIP_BEHIND : SKIP_BOUNDS, 0u, 0u, ends.x, ends.y);
        return false;
    }
    return true;
}

// Returns the segment with these ends in that view. With ABUFFER_IN_FACES it finds the face, and cuts the
// segment where the ray leaves the face.
Segment abuffer_segment(vec3 origin, vec3 direction, vec2 near, vec2 ends, uint view, inout AbufferProgress progress) {
    Segment segment = segment_at(origin, direction, ends.x, ends.y, near);
    if (view == ABUFFER_IN_FACES) {
        progress.t = segment.t_end;
    } else {
        segment.face = view;
        segment.t_end = ends.y;
    }
    return segment;
}

#endif
