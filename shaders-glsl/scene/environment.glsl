// Radiance from the environment, and directions sampled by it. The environment is constant, or a
// latitude-longitude map of constant texels, which is sampled by texel.
// Reads: frame, environment radiance, environment distribution. Writes: nothing.
// Source: docs/shading.md, "Lights".
#ifndef SCENE_ENVIRONMENT_GLSL
#define SCENE_ENVIRONMENT_GLSL

#include "scene/accessors.glsl"

#define ENVIRONMENT_PI 3.14159265358979

bool environment_is_constant(Frame frame) {
    return !SHADING_ENVIRONMENT_MAP || frame.environment_kind == ENVIRONMENT_CONSTANT;
}

// Returns the column of the map in which a direction lies.
uint environment_column(vec3 direction, uint width) {
    float turn = atan(direction.z, direction.x) / (2.0 * ENVIRONMENT_PI);
    return min(uint((turn < 0.0 ? turn + 1.0 : turn) * float(width)), width - 1u);
}

// Returns the row of the map in which a direction lies.
uint environment_row(vec3 direction, uint height) {
    return min(uint(acos(clamp(direction.y, -1.0, 1.0)) / ENVIRONMENT_PI * float(height)), height - 1u);
}

// Returns the solid angle of a texel in a row, steradians.
float environment_solid_angle(uint row, uint width, uint height) {
    float step_angle = ENVIRONMENT_PI / float(height);
    return (2.0 * ENVIRONMENT_PI / float(width)) * 2.0 * sin(step_angle * (float(row) + 0.5)) * sin(0.5 * step_angle);
}

// Returns the share of entry `index` in a run of cumulative shares that begins at `first`.
float environment_share(uint first, uint index) {
    float above = scene_environment_cdf(first + index);
    return index == 0u ? above : above - scene_environment_cdf(first + index - 1u);
}

// Returns the first entry of a run whose cumulative share exceeds `random`, as an index in the run.
uint environment_search(uint first, uint count, float random) {
    uint low = 0u;
    uint high = count - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (scene_environment_cdf(first + middle) > random) high = middle;
        else low = middle + 1u;
    }
    return low;
}

// Returns the radiance, W/(sr m^2), that arrives from the unit `direction`.
vec3 environment_radiance(vec3 direction) {
    Frame frame = scene_frame();
    if (environment_is_constant(frame)) return frame.environment_radiance;
    uint row = environment_row(direction, frame.environment_height);
    uint column = environment_column(direction, frame.environment_width);
    return scene_environment_texel(row * frame.environment_width + column);
}

// Returns the density, 1/sr, with which environment_sample chooses directions in a texel. It leaves out the
// choice among the kinds of light.
float environment_pdf_of_texel(Frame frame, uint row, uint column) {
    float rows = environment_share(0u, row);
    float columns = environment_share(frame.environment_height + row * frame.environment_width, column);
    return rows * columns / environment_solid_angle(row, frame.environment_width, frame.environment_height);
}

// Returns the density, 1/sr, with which environment_sample chooses a direction. It leaves out the choice
// among the kinds of light.
float environment_pdf_alone(vec3 direction) {
    Frame frame = scene_frame();
    if (environment_is_constant(frame)) return 1.0 / (4.0 * ENVIRONMENT_PI);
    return environment_pdf_of_texel(frame, environment_row(direction, frame.environment_height),
                                    environment_column(direction, frame.environment_width));
}

// Chooses a direction, and returns it with its radiance and its pdf, which leaves out the choice among the
// kinds of light. `pick` chooses the row, `place.x` the column and the azimuth in it, `place.y` the polar
// angle in the row.
vec3 environment_sample(float pick, vec2 place, out vec3 radiance, out float pdf) {
    Frame frame = scene_frame();
    float cosine;
    float azimuth;
    if (environment_is_constant(frame)) {
        cosine = 1.0 - 2.0 * place.x;
        azimuth = 2.0 * ENVIRONMENT_PI * place.y;
        radiance = frame.environment_radiance;
        pdf = 1.0 / (4.0 * ENVIRONMENT_PI);
    } else {
        uint width = frame.environment_width;
        uint height = frame.environment_height;
        uint row = environment_search(0u, height, pick);
        uint first = height + row * width;
        uint column = environment_search(first, width, place.x);
        float share = environment_share(first, column);
        // The position of the random number within the texel's share gives the direction's position in the
        // texel.
        float within = share > 0.0 ? (scene_environment_cdf(first + column) - place.x) / share : 0.5;
        azimuth = 2.0 * ENVIRONMENT_PI * (float(column) + clamp(within, 0.0, 1.0)) / float(width);
        float upper = cos(ENVIRONMENT_PI * float(row) / float(height));
        float lower = cos(ENVIRONMENT_PI * float(row + 1u) / float(height));
        cosine = mix(upper, lower, place.y);
        radiance = scene_environment_texel(row * width + column);
        pdf = environment_pdf_of_texel(frame, row, column);
    }
    float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    return vec3(sine * cos(azimuth), cosine, sine * sin(azimuth));
}

#endif
