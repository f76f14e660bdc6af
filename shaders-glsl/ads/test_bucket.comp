// Computes the buckets of depths, for tests.
// Reads: depths, each with its range. Writes: the bucket of each depth.
// One invocation per case.
#version 460
#include "contract/extensions.glsl"
#include "ads/bucket.glsl"

layout(local_size_x = 64) in;

// A depth within a range of depths. Shared, 16 bytes.
struct BucketCase {
    float z_min;          // smallest depth of the range, metres
    float z_max;          // largest depth of the range, metres
    float z;              // the depth, metres
    uint buckets;         // number of buckets of the range
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { BucketCase cases[]; };
layout(set = 0, binding = 1, scalar) buffer BucketBuffer { uint buckets[]; };

// Number of cases. 4 bytes.
layout(push_constant, scalar) uniform BucketTestConstants {
    uint case_count;      // cases
} pushed;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < pushed.case_count) {
        BucketCase c = cases[index];
        buckets[index] = bucket_of(c.z, c.z_min, bucket_scale(c.z_min, c.z_max, c.buckets), c.buckets);
    }
}
