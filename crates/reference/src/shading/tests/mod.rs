mod bsdf;
mod environment;
mod glass_albedo;
mod surface;
mod texture;
