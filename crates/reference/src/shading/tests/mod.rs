mod albedo;
mod anisotropy;
mod bsdf;
mod environment;
mod surface;
mod texture;
