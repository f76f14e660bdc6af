// Poses the vertices of draws that move: adds morph targets, then applies joints or the draw's placement.
// Reads: pose draws, their groups, placements, joint matrices and shown targets of the frame, shapes at rest.
// Writes: positions of the geometry, posed attributes, DRAW_MIRRORED of draws and draw shadings.
// One invocation per vertex, one workgroup per group.
// Source: docs/motion.md, "On the device".
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#include "scene/pose_types.glsl"
#include "scene/types.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer PoseGroupBuffer { PoseGroup pose_groups[]; };
layout(set = 0, binding = 1, scalar) readonly buffer PoseDrawBuffer { PoseDraw pose_draws[]; };
layout(set = 0, binding = 2, scalar) readonly buffer PosePlacementBuffer { PosePlacement pose_placements[]; };
layout(set = 0, binding = 3, scalar) readonly buffer PoseJointBuffer { PoseMatrix pose_joints[]; };
layout(set = 0, binding = 4, scalar) readonly buffer PoseTargetBuffer { PoseTarget pose_targets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PoseRestPositionBuffer { float pose_rest_positions[]; };
layout(set = 0, binding = 6, scalar) readonly buffer PoseRestAttributeBuffer { float pose_rest_attributes[]; };
layout(set = 0, binding = 7, scalar) readonly buffer PoseSkinBuffer { uint pose_skins[]; };
layout(set = 0, binding = 8, scalar) readonly buffer PoseDisplacementBuffer { float pose_displacements[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer PosePositionBuffer { float pose_positions[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer PoseAttributeBuffer { float pose_attributes[]; };
layout(set = 0, binding = 11, scalar) buffer PoseDrawShadingBuffer { DrawShading pose_draw_shadings[]; };
layout(set = 0, binding = 12, scalar) buffer PoseGeometryDrawBuffer { Draw pose_geometry_draws[]; };

#include "scene/pose_vertex.glsl"

void main() {
    uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
    if (group >= pose_groups.length()) {
        return;
    }
    PoseGroup vertices = pose_groups[group];
    PoseDraw draw = pose_draws[vertices.draw];
    uint vertex = vertices.first_vertex + gl_LocalInvocationIndex;
    if (vertex >= draw.vertex_count) {
        return;
    }
    PosePlacement placement = pose_placements[vertices.draw];
    if (vertex == 0u) {
        uint others = pose_draw_shadings[draw.draw].flags & ~DRAW_MIRRORED;
        pose_draw_shadings[draw.draw].flags = others | placement.flags;
        uint others_of_geometry = pose_geometry_draws[draw.draw].flags & ~DRAW_MIRRORED;
        pose_geometry_draws[draw.draw].flags = others_of_geometry | placement.flags;
    }
    bool has_joints = draw.skin != ATTRIBUTE_NONE;
    PoseMatrix place = placement.place;
    if (has_joints) {
        place = pose_blended(draw, vertex);
    }
    uint first = placement.first_target;
    uint count = placement.target_count;

    vec3 at_rest = pose_morphed(pose_rest_position(draw.rest_positions + 3u * vertex), first, count, 0u, vertex);
    precise vec3 position = pose_turned(place.x, place.y, place.z, at_rest) + place.translation;
    if (has_joints) {
        position = position + placement.place.translation;
    }
    pose_store_position(draw.first_vertex + vertex, position);

    if (draw.normals != ATTRIBUTE_NONE) {
        vec3 normal = pose_rest_attribute(draw.rest_normals + 3u * vertex);
        normal = pose_morphed(normal, first, count, 1u, vertex);
        vec3 x = placement.normal_x;
        vec3 y = placement.normal_y;
        vec3 z = placement.normal_z;
        if (has_joints) {
            x = place.x;
            y = place.y;
            z = place.z;
            pose_cofactors(x, y, z);
        }
        pose_store(draw.normals + 3u * vertex, pose_unit(pose_turned(x, y, z, normal)));
    }
    if (draw.tangents != ATTRIBUTE_NONE) {
        uint word = draw.rest_tangents + 4u * vertex;
        vec3 tangent = pose_morphed(pose_rest_attribute(word), first, count, 2u, vertex);
        float sign = pose_rest_attributes[word + 3u];
        word = draw.tangents + 4u * vertex;
        pose_store(word, pose_unit(pose_turned(place.x, place.y, place.z, tangent)));
        pose_attributes[word + 3u] = placement.flags == DRAW_MIRRORED ? -sign : sign;
    }
}
