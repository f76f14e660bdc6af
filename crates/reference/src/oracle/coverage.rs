use super::contact::Contact;
use std::collections::HashMap;
use std::f64::consts::PI;

type Triangle = [[f32; 3]; 3];
/// Bits of an edge's end points in a fixed order.
type Edge = [[u32; 3]; 2];

/// Triangle that the ray touches, with some winding.
struct Member {
    /// Touched edges, each with true if the winding runs along their fixed order.
    touched: Vec<(Edge, bool)>,
    /// Sum of the angles at which the ray sees the other edges.
    angle: f64,
}

/// True if the unsure triangles share edges all around the ray, so that a test which rounds every vertex in
/// one way and decides every edge in one way must find one of them.
///
/// Rounding moves vertices by less than their distance from untouched edges. If all touched edges cancel, the
/// boundary of the touched triangles consists of untouched edges; its winding number about the ray is the
/// same before and after rounding, and unless it is zero some triangle contains the ray. Two windings are
/// tried: as given, which holds for meshes with triangles seen edge-on, and as the ray sees them, which holds
/// for meshes that are wound inconsistently.
pub(super) fn covered<'a>(contacts: impl Iterator<Item = (&'a Triangle, &'a Contact)>) -> bool {
    let touching: Vec<_> =
        contacts.filter(|(_, contact)| contact.in_range && contact.touched.contains(&true)).collect();
    let winds = |flip: fn(&Contact) -> bool| {
        let members = touching.iter().map(|(triangle, contact)| member(triangle, contact, flip(contact)));
        surrounded(members.collect())
    };
    winds(|_| false) || winds(|contact| !contact.facing)
}

fn surrounded(mut members: Vec<Member>) -> bool {
    loop {
        // Numbers of times that triangles run along each edge in its fixed order, and against it.
        let mut runs: HashMap<Edge, [usize; 2]> = HashMap::new();
        for (edge, along) in members.iter().flat_map(|member| &member.touched) {
            runs.entry(*edge).or_default()[usize::from(*along)] += 1;
        }
        let before = members.len();
        // Triangles at borders of the surface guarantee nothing.
        members.retain(|member| member.touched.iter().all(|(edge, _)| runs[edge].iter().all(|n| *n > 0)));
        if members.len() == before {
            let angle: f64 = members.iter().map(|member| member.angle).sum();
            return runs.values().all(|[against, along]| against == along) && angle.abs() > PI;
        }
    }
}

fn member(triangle: &Triangle, contact: &Contact, flip: bool) -> Member {
    // Adding zero turns -0 into +0: both are the same position.
    let corner = |vertex: usize| triangle[vertex].map(|x| (x + 0.0).to_bits());
    let mut member = Member { touched: Vec::new(), angle: 0.0 };
    for opposite in 0..3 {
        let (from, to) = ((opposite + 1) % 3, (opposite + 2) % 3);
        let (a, b) = (corner(from), corner(to));
        if !contact.touched[opposite] {
            let ([ax, ay], [bx, by]) = (contact.seen[from], contact.seen[to]);
            let angle = (ax * by - ay * bx).atan2(ax * bx + ay * by);
            member.angle += if flip { -angle } else { angle };
        } else if a != b {
            // An edge without length bounds nothing.
            member.touched.push((if a < b { [a, b] } else { [b, a] }, (a < b) != flip));
        }
    }
    member
}
