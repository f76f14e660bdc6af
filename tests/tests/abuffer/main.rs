//! A-buffers: lists, layers, planes, views, both builders, pools of every edge capacity, options that change
//! no hit.

mod boxes;
mod builders;
mod capacity;
mod first_hits;
mod invariance;
mod layers;
mod lists;
mod lost;
mod planes;
mod switching;
mod views;
