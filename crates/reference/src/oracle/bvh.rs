//! Hierarchy of boxes in double precision that proposes a superset of the triangles that a ray may touch.

use super::contact::ContactTest;

const LEAF_SIZE: usize = 4;
const BINS: usize = 16;
/// Padding of boxes, as a share of the distance between their farthest corner and the ray's origin. Double
/// precision needs 4 * 2^-53; single-precision tests may accept triangles that the ray misses by about 64 *
/// 2^-24 of that distance, and those must be proposed as well.
const PADDING: f64 = 1.0 / 65536.0;

#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    fn grow(&mut self, other: &Self) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
    }

    fn of(triangle: &[[f32; 3]; 3]) -> Self {
        let mut bounds = Self::EMPTY;
        for vertex in triangle {
            let point = vertex.map(f64::from);
            bounds.grow(&Self { low: point, high: point });
        }
        bounds
    }

    fn center(&self, axis: usize) -> f64 {
        0.5 * (self.low[axis] + self.high[axis])
    }

    fn area(&self) -> f64 {
        let [x, y, z] = std::array::from_fn(|axis| (self.high[axis] - self.low[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

struct Node {
    bounds: Bounds,
    /// Index of the first child (the second follows), or of the first entry of `slots`.
    first: usize,
    /// Number of entries of a leaf; zero for an inner node.
    count: usize,
}

pub(super) struct Bvh {
    nodes: Vec<Node>,
    slots: Vec<usize>,
}

impl Bvh {
    pub fn build(triangles: &[[[f32; 3]; 3]]) -> Self {
        let bounds: Vec<Bounds> = triangles.iter().map(Bounds::of).collect();
        let mut slots: Vec<usize> = (0..triangles.len()).collect();
        let mut nodes = vec![Node { bounds: Bounds::EMPTY, first: 0, count: triangles.len() }];
        let mut open = vec![0];
        while let Some(index) = open.pop() {
            let (first, count) = (nodes[index].first, nodes[index].count);
            let range = &mut slots[first..first + count];
            range.iter().for_each(|&slot| nodes[index].bounds.grow(&bounds[slot]));
            if count <= LEAF_SIZE {
                continue;
            }
            let left = split(range, &bounds);
            let children = nodes.len();
            nodes.push(Node { bounds: Bounds::EMPTY, first, count: left });
            nodes.push(Node { bounds: Bounds::EMPTY, first: first + left, count: count - left });
            (nodes[index].first, nodes[index].count) = (children, 0);
            open.extend([children, children + 1]);
        }
        Self { nodes, slots }
    }

    /// Calls `triangle(slot, cutoff)` for every triangle that the ray may touch before the cutoff,
    /// which the callee may lower.
    pub fn visit(&self, test: &ContactTest, triangle: impl FnMut(usize, &mut f64)) {
        self.visit_nodes(test, |_, _, _| (), triangle);
    }

    /// Visits triangles like [`Bvh::visit`], and calls `node(number, least t, triangles)` before, for every
    /// node entered.
    pub fn visit_nodes(
        &self,
        test: &ContactTest,
        mut node_entered: impl FnMut(usize, f64, usize),
        mut triangle: impl FnMut(usize, &mut f64),
    ) {
        let mut cutoff = f64::INFINITY;
        let inverse = test.direction.map(|d| 1.0 / d);
        let entry = |node: usize| test.entry(&self.nodes[node].bounds, &inverse);
        let mut open: Vec<(f64, usize)> = entry(0).map(|t| (t, 0)).into_iter().collect();
        while let Some((t, index)) = open.pop() {
            if t > cutoff {
                continue;
            }
            let node = &self.nodes[index];
            node_entered(index, t, node.count);
            if node.count > 0 {
                for &slot in &self.slots[node.first..node.first + node.count] {
                    triangle(slot, &mut cutoff);
                }
                continue;
            }
            let children = [node.first, node.first + 1].map(|child| entry(child).map(|t| (t, child)));
            match children {
                // The nearer child is pushed last and popped first.
                [Some(a), Some(b)] if a.0 <= b.0 => open.extend([b, a]),
                [a, b] => open.extend(a.into_iter().chain(b)),
            }
        }
    }
}

impl ContactTest {
    /// Returns a lower bound of the t of every contact in the box along the direction's longest axis; `None`
    /// if the ray's line misses the padded box or the box lies outside of the range. Contacts may report a t
    /// before the ray enters the box on the other axes, so those axes do not raise the bound.
    fn entry(&self, bounds: &Bounds, inverse: &[f64; 3]) -> Option<f64> {
        let relative: [[f64; 2]; 3] = std::array::from_fn(|axis| {
            [bounds.low[axis] - self.origin[axis], bounds.high[axis] - self.origin[axis]]
        });
        let padding = PADDING * relative.iter().flatten().fold(0.0_f64, |far, x| far.max(x.abs()));
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut first = f64::NEG_INFINITY;
        for axis in 0..3 {
            let [low, high] = [relative[axis][0] - padding, relative[axis][1] + padding];
            if self.direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low * inverse[axis], high * inverse[axis]);
            let (near, far) = (a.min(b), a.max(b));
            enter = enter.max(near);
            leave = leave.min(far);
            if axis == self.axis_z {
                if far < self.t_min || near > self.t_max {
                    return None;
                }
                first = near;
            }
        }
        (enter <= leave).then_some(first)
    }
}

/// Partitions the slots of a node and returns the number that goes left; never none, never all.
fn split(slots: &mut [usize], bounds: &[Bounds]) -> usize {
    let half = slots.len() / 2;
    let centers = |axis: usize| slots.iter().map(move |&slot| bounds[slot].center(axis));
    let extents: [(f64, f64); 3] = std::array::from_fn(|axis| {
        let low = centers(axis).fold(f64::INFINITY, f64::min);
        (low, centers(axis).fold(f64::NEG_INFINITY, f64::max) - low)
    });
    let mut best = (f64::INFINITY, 0, 0);
    for (axis, &(low, extent)) in extents.iter().enumerate().filter(|(_, (_, extent))| *extent > 0.0) {
        let mut bins = [(Bounds::EMPTY, 0_usize); BINS];
        for &slot in slots.iter() {
            let bin = &mut bins[bin_of(bounds[slot].center(axis), low, extent)];
            bin.0.grow(&bounds[slot]);
            bin.1 += 1;
        }
        for cut in 1..BINS {
            let side = |range: &[(Bounds, usize)]| {
                let mut total = (Bounds::EMPTY, 0);
                for (bin, count) in range {
                    total.0.grow(bin);
                    total.1 += count;
                }
                if total.1 == 0 { f64::INFINITY } else { total.0.area() * total.1 as f64 }
            };
            let cost = side(&bins[..cut]) + side(&bins[cut..]);
            if cost < best.0 {
                best = (cost, axis, cut);
            }
        }
    }
    let (cost, axis, cut) = best;
    if cost.is_finite() {
        let (low, extent) = extents[axis];
        let mut left = 0;
        for index in 0..slots.len() {
            if bin_of(bounds[slots[index]].center(axis), low, extent) < cut {
                slots.swap(index, left);
                left += 1;
            }
        }
        if left > 0 && left < slots.len() {
            return left;
        }
    }
    // If all centres coincide (or the areas are not finite), any balanced split will do.
    half
}

fn bin_of(center: f64, low: f64, extent: f64) -> usize {
    (((center - low) / extent * BINS as f64) as usize).min(BINS - 1)
}
