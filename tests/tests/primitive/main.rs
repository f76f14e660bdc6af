//! Lists of triangles, per tile and in bricks: exactness, rules that lose hits, pools of every edge capacity.

mod bricks_capacity;
mod bricks_cells;
mod camera;
mod capacity;
mod edges;
mod exact;
