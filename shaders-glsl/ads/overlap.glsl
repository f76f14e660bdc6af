// Tests whether a triangle reaches into a cell of a face, and finds its depths there. The test may accept
// more cells than is exact, never fewer.
// Reads, writes: nothing.
// Source: DIRT section 3.2 clips each primitive to the tile. Here the depths follow from the triangle's plane
// over the whole tile, where 1/z is affine in x/z and y/z, and from the corners of the triangle.
#ifndef ADS_OVERLAP_GLSL
#define ADS_OVERLAP_GLSL

#include "ads/coverage.glsl"

// True if all corners lie beyond the same side of the cell: their x/z is below `lower`, or above `upper`.
bool overlap_beyond(vec3 x, vec3 z, float lower, float upper) {
    precise vec3 at_lower = lower * z;
    precise vec3 at_upper = upper * z;
    return all(lessThan(x, at_lower)) || all(greaterThan(x, at_upper));
}

// Returns the plane through the eye and the edge pq, and a bound of the rounding of the plane's value
// anywhere in the face.
vec3 overlap_edge(vec3 p, vec3 q, out float slack) {
    precise vec3 span = q - p;
    precise vec3 edge = p.yzx * span.zxy - p.zxy * span.yzx;
    vec3 pm = abs(p);
    vec3 sm = abs(span);
    precise vec3 products = pm.yzx * sm.zxy + pm.zxy * sm.yzx;
    precise float rounding = 6.0e-7 * (products.x + products.y + products.z) + 4.0e-7 * (abs(edge.x) + abs(edge.y) + abs(edge.z));
    slack = rounding;
    return edge;
}

// What the tests of one triangle against all cells of a face share.
struct Overlap {
    vec3 x;               // x of the three corners, face space, metres
    vec3 y;               // y of the three corners
    vec3 z;               // z of the three corners
    vec3 edge_ab;         // plane through the eye and the edge from a to b
    vec3 edge_bc;         // plane through the eye and the edge from b to c
    vec3 edge_ca;         // plane through the eye and the edge from c to a
    vec3 edge_slack;      // bounds of the rounding of the values of the three planes
    vec3 normal;          // normal of the triangle
    vec3 normal_error;    // bound of the error of each of its components
    // dot(normal, corner), which is the same for all corners; its sign tells the winding
    float facing;
    float facing_error;   // bound of its error
};

// Begins the tests of a triangle, whose corners are in face space.
Overlap overlap_begin(vec3 a, vec3 b, vec3 c) {
    Overlap o;
    o.x = vec3(a.x, b.x, c.x);
    o.y = vec3(a.y, b.y, c.y);
    o.z = vec3(a.z, b.z, c.z);
    o.edge_ab = overlap_edge(a, b, o.edge_slack.x);
    o.edge_bc = overlap_edge(b, c, o.edge_slack.y);
    o.edge_ca = overlap_edge(c, a, o.edge_slack.z);
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = ab.yzx * ac.zxy - ab.zxy * ac.yzx;
    precise vec3 normal_error = 6.0e-7 * (abs(ab.yzx * ac.zxy) + abs(ab.zxy * ac.yzx));
    precise float facing = normal.x * a.x + normal.y * a.y + normal.z * a.z;
    precise float facing_error = dot(normal_error, abs(a)) + 4.0e-7 * dot(abs(normal), abs(a));
    o.normal = normal;
    o.normal_error = normal_error;
    o.facing = facing;
    o.facing_error = facing_error;
    return o;
}

// Returns the value of an edge's plane at the centre of a cell, and a bound of the change of this value
// within the cell.
float overlap_edge_at(vec3 edge, vec3 center, float half_side, float rounding, out float slack) {
    precise float value = edge.x * center.x + edge.y * center.y + edge.z;
    precise float reach = half_side * (abs(edge.x) + abs(edge.y)) + rounding;
    slack = reach;
    return value;
}

// True if the triangle reaches, in front of the eye, into the square with this centre (x/z, y/z, 1) and this
// half side. `depths` gets the smallest and the largest depth of the triangle there, at least half of
// near_size; the rounding of the corners is not included. All expressions are precise, since the passes that
// count and those that store must agree.
bool overlap_at(float near_size, Overlap o, vec3 center, float half_side, out vec2 depths) {
    depths = vec2(0.0);
    precise vec2 lower = center.xy - half_side;
    precise vec2 upper = center.xy + half_side;
    if (all(lessThanEqual(o.z, vec3(0.0))) || overlap_beyond(o.x, o.z, lower.x, upper.x)
        || overlap_beyond(o.y, o.z, lower.y, upper.y)) {
        return false;
    }
    vec3 slack;
    vec3 value = vec3(overlap_edge_at(o.edge_ab, center, half_side, o.edge_slack.x, slack.x),
        overlap_edge_at(o.edge_bc, center, half_side, o.edge_slack.y, slack.y),
        overlap_edge_at(o.edge_ca, center, half_side, o.edge_slack.z, slack.z));
    // Comparisons have a form in which a value that overflowed counts as inside.
    bool front = !any(lessThan(value, -slack));
    bool back = !any(greaterThan(value, slack));
    if (!front && !back) {
        return false;
    }
    depths = vec2(min(o.z.x, min(o.z.y, o.z.z)), max(o.z.x, max(o.z.y, o.z.z)));
    // Close to edge-on, rounding leaves winding and plane open. Then both windings count, and the depths are
    // those of the corners.
    if (abs(o.facing) > 64.0 * o.facing_error) {
        if (o.facing > 0.0 ? !front : !back) {
            return false;
        }
        vec3 farthest = vec3(abs(center.xy) + half_side, 1.0);
        precise float along = o.normal.x * center.x + o.normal.y * center.y + o.normal.z;
        float middle = o.facing > 0.0 ? along : -along;
        precise float swing = half_side * (abs(o.normal.x) + abs(o.normal.y)) + dot(o.normal_error, farthest)
            + 4.0e-7 * dot(abs(o.normal), farthest);
        precise float lowest = middle - swing;
        precise float highest = middle + swing;
        if (highest > 0.0) {
            precise float nearest = (abs(o.facing) - o.facing_error) / highest * (1.0 - 1.0e-6);
            depths.x = max(depths.x, nearest);
        }
        if (lowest > 0.0) {
            precise float farthest_depth = (abs(o.facing) + o.facing_error) / lowest * (1.0 + 1.0e-6);
            depths.y = min(depths.y, farthest_depth);
        }
    }
    // Parts at depths below half the near region are tested through the near-region list. Positive depths are
    // ordered as their bits are.
    depths.x = max(depths.x, 0.5 * near_size);
    depths.y = max(depths.y, depths.x);
    return true;
}

#endif
