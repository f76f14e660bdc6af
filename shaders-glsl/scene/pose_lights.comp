// Computes the shares with which lights are chosen, as far as they depend on the bounds of the geometry: the
// power of lights far away falls on the circle around the bounds.
// Reads: bounds in the header of the geometry, powers of lights. Writes: kind shares of the frame, cumulative
// shares of lights. One workgroup.
// Source: docs/shading.md, "Tables": Lights, Kinds; docs/motion.md, "On the device".
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#include "ads/geometry.glsl"
#include "scene/pose_types.glsl"
#include "scene/types.glsl"

layout(set = 1, binding = 0, scalar) readonly buffer PosePowerBuffer { PoseLightPower pose_powers[]; };
layout(set = 1, binding = 1, scalar) buffer PoseFrameBuffer { Frame pose_frame; };
layout(set = 1, binding = 2, scalar) buffer PoseLightBuffer { Light pose_lights[]; };

// Lights and their powers. 20 bytes.
layout(push_constant, scalar) uniform PoseLightConstants {
    uint light_count;       // point, directional and spot lights
    uint emissive;          // 1 if emissive triangles have power
    float emissive_power;   // W
    uint environment;       // 1 if the environment emits
    float irradiance;       // W/m^2, of the environment
} pushed;

#define POSE_PI 3.14159265
// Least probability of a kind of light that exists.
#define POSE_LEAST 0.1
// Largest power, so that the sum of three powers is finite.
#define POSE_MOST 1.0e38

float pose_power(float power) {
    return min(power, POSE_MOST);
}

void main() {
    vec3 size = geometry_header.upper - geometry_header.lower;
    float disk = min(0.25 * POSE_PI * dot(size, size), POSE_MOST);
    float punctual = 0.0;
    if (pushed.light_count > 0u) {
        PoseLightPower all = pose_powers[pushed.light_count - 1u];
        punctual = pose_power(all.near + pose_power(all.far * disk));
    }
    for (uint light = gl_LocalInvocationIndex; light < pushed.light_count; light += gl_WorkGroupSize.x) {
        PoseLightPower here = pose_powers[light];
        float power = pose_power(here.near + pose_power(here.far * disk));
        pose_lights[light].cumulative = power < punctual ? power / punctual : 1.0;
    }
    if (gl_LocalInvocationIndex > 0u) {
        return;
    }
    bvec3 present = bvec3(pushed.light_count > 0u, pushed.emissive != 0u, pushed.environment != 0u);
    vec3 power = vec3(punctual, pushed.emissive_power, pose_power(pushed.irradiance * disk)) * vec3(present);
    // The powers are scaled, so that their sum is finite.
    power /= max(max(max(power.x, power.y), power.z), 1.0e-37);
    float total = power.x + power.y + power.z;
    vec3 shares = total > 0.0 ? power / total : vec3(1.0) / max(dot(vec3(present), vec3(1.0)), 1.0);
    vec3 weights = max(shares, POSE_LEAST) * vec3(present);
    shares = weights / max(weights.x + weights.y + weights.z, POSE_LEAST);
    // The last kind takes what rounding leaves over, so that every random number chooses a kind.
    if (present.z) shares.z = 1.0 - (shares.x + shares.y);
    else if (present.y) shares.y = 1.0 - shares.x;
    else if (present.x) shares.x = 1.0;
    pose_frame.kind_shares = shares;
}
