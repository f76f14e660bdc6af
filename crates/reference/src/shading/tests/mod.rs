mod albedo;
mod bsdf;
mod environment;
mod surface;
mod texture;
