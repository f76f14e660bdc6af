mod ambient_occlusion;
mod direct;
mod furnace;
mod transparency;
