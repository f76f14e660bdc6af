// Poses one vertex of a draw that moves: its position, normal and tangent at rest, morphed, and the blend of
// its joints.
// Reads: the buffers that scene/pose_vertices.comp declares before it includes this file. Writes: posed
// positions and attributes.
// Source: docs/motion.md, "On the device"; Knuth's two-sum.
#ifndef SCENE_POSE_VERTEX_GLSL
#define SCENE_POSE_VERTEX_GLSL

#include "scene/pose_types.glsl"
#include "scene/types.glsl"

vec3 pose_rest_position(uint word) {
    return vec3(pose_rest_positions[word], pose_rest_positions[word + 1u], pose_rest_positions[word + 2u]);
}

vec3 pose_rest_attribute(uint word) {
    return vec3(pose_rest_attributes[word], pose_rest_attributes[word + 1u], pose_rest_attributes[word + 2u]);
}

vec3 pose_displacement(uint word) {
    return vec3(pose_displacements[word], pose_displacements[word + 1u], pose_displacements[word + 2u]);
}

void pose_store(uint word, vec3 value) {
    pose_attributes[word] = value.x;
    pose_attributes[word + 1u] = value.y;
    pose_attributes[word + 2u] = value.z;
}

// A sum that keeps the error of its rounding (Knuth's two-sum).
struct PoseSum {
    // rounded sum
    vec3 value;
    // sum of the errors of rounding
    vec3 lost;
};

void pose_add(inout PoseSum sum, vec3 term) {
    precise vec3 next = sum.value + term;
    precise vec3 added = next - sum.value;
    precise vec3 lost = (sum.value - (next - added)) + (term - added);
    sum.value = next;
    sum.lost += lost;
}

// Returns a vector at rest with the displacements of the shown morph targets added. `kind` is 0 for
// positions, 1 for normals, 2 for tangents.
vec3 pose_morphed(vec3 at_rest, uint first, uint count, uint kind, uint vertex) {
    PoseSum sum = PoseSum(at_rest, vec3(0.0));
    for (uint target = first; target < first + count; target++) {
        PoseTarget shown = pose_targets[target];
        uint word = kind == 0u ? shown.positions : kind == 1u ? shown.normals : shown.tangents;
        if (word != ATTRIBUTE_NONE) {
            precise vec3 term = shown.weight * pose_displacement(word + 3u * vertex);
            pose_add(sum, term);
        }
    }
    return sum.value + sum.lost;
}

// Returns the weighted sum of the maps of a vertex's joints.
PoseMatrix pose_blended(PoseDraw draw, uint vertex) {
    precise vec3 x = vec3(0.0);
    precise vec3 y = vec3(0.0);
    precise vec3 z = vec3(0.0);
    precise vec3 translation = vec3(0.0);
    uint word = draw.skin + 2u * draw.joints_per_vertex * vertex;
    for (uint place = 0u; place < draw.joints_per_vertex; place++) {
        float weight = uintBitsToFloat(pose_skins[word + draw.joints_per_vertex + place]);
        if (weight > 0.0) {
            PoseMatrix joint = pose_joints[draw.first_joint + pose_skins[word + place]];
            x = x + weight * joint.x;
            y = y + weight * joint.y;
            z = z + weight * joint.z;
            translation = translation + weight * joint.translation;
        }
    }
    return PoseMatrix(x, y, z, translation);
}

// Returns a vector under a linear map with the columns x, y, z.
vec3 pose_turned(vec3 x, vec3 y, vec3 z, vec3 vector) {
    precise vec3 turned = vector.x * x + vector.y * y + vector.z * z;
    return turned;
}

float pose_largest(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// True if a number that is not negative can be a divisor: it is neither 0, nor so small that devices may take
// it for 0, nor infinite, nor NaN.
bool pose_divides(float x) {
    uint bits = floatBitsToUint(x);
    return bits >= 0x00800000u && bits < 0x7F800000u;
}

// Returns the unit vector along a vector; zero if the vector has no direction.
vec3 pose_unit(vec3 vector) {
    float scale = pose_largest(vector);
    if (!pose_divides(scale)) return vec3(0.0);
    vec3 scaled = vector / scale;
    return scaled / length(scaled);
}

// Converts a linear map of positions to the map of normals that belongs to it: the cofactors. For a map that
// mirrors, these also turn normals back to the side of the winding.
void pose_cofactors(inout vec3 x, inout vec3 y, inout vec3 z) {
    float scale = max(pose_largest(x), max(pose_largest(y), pose_largest(z)));
    if (!pose_divides(scale)) {
        x = y = z = vec3(0.0);
        return;
    }
    vec3 a = x / scale;
    vec3 b = y / scale;
    vec3 c = z / scale;
    vec3 bc = cross(b, c);
    float side = dot(a, bc) < 0.0 ? -1.0 : 1.0;
    x = side * bc;
    y = side * cross(c, a);
    z = side * cross(a, b);
}

// Stores the posed position of a vertex.
void pose_store_position(uint vertex, vec3 position) {
    // The values are compared as bits, which finds NaN on every device.
    uvec3 magnitude = floatBitsToUint(position) & 0x7FFFFFFFu;
    if (max(max(magnitude.x, magnitude.y), magnitude.z) > floatBitsToUint(LARGEST_COORDINATE)) {
        // No bounds contain this position, so the check of a build counts the triangles at this vertex.
        position = vec3(uintBitsToFloat(0x7F800000u));
    }
    pose_positions[3u * vertex] = position.x;
    pose_positions[3u * vertex + 1u] = position.y;
    pose_positions[3u * vertex + 2u] = position.z;
}

#endif
