// What: evaluates the bucket function, for tests.
// Reads: depths with their bounds. Writes: bucket of z.
#version 460
#include "contract/extensions.glsl"
#include "ads/bucket.glsl"

layout(local_size_x = 64) in;

struct Case {
    float z_min;
    float z_max;
    float z;
    uint buckets;
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { Case cases[]; };
layout(set = 0, binding = 1, scalar) buffer BucketBuffer { uint buckets[]; };

layout(push_constant, scalar) uniform Constants {
    uint case_count;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < case_count) {
        Case c = cases[index];
        buckets[index] = bucket_of(c.z, c.z_min, bucket_scale(c.z_min, c.z_max, c.buckets), c.buckets);
    }
}
