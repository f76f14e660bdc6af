//! Layered depth cubes: hits, layers, the march, pools of every edge capacity.

mod capacity;
mod hits;
mod layers;
mod march;
