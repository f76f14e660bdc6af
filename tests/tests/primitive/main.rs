//! Primitive lists and bricks: exactness, rules that lose hits, pools of every edge capacity.

mod bricks_axes;
mod capacity;
mod exact;
