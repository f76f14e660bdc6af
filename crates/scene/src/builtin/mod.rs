//! Scenes generated in code, so that nothing has to be downloaded to see a picture or run a test.
//!
//! A built-in scene is named by a word with optional parameters, `name:value` or
//! `name:key=value,key=value`. The same name gives the same scene, bit for bit, on every machine
//! that rounds f64 arithmetic as IEEE 754 says and shares one mathematics library.
//!
//! | name | parameters (default) | triangles |
//! |---|---|---|
//! | `cornell` | none | 38 |
//! | `furnace` | `albedo` in [0, 1) (0.5), `emission` >= 0 (1), `shape` `sphere` or `box` (`sphere`) | 1,280 or 12 |
//! | `spheres` | `triangles` from 10k to 10M (300k), also as `spheres:10k` | as asked, within 10 |
//! | `atrium` | `detail` in [0.25, 4] (1) | about 98k at detail 1 |
//! | `ruins` | `triangles` from 10k to 10M (200k), also as `ruins:10k` | as asked, within 20 |
//! | `corridor` | `reflectance` in [0, 1] (0.95), `width` in metres in [0.5, 50] (2) | 1,300 |
//! | `mirror-hall` | `share` of mirrors among the pixels in percent, in [0, 80] (25), also as `mirror-hall:40` | 202,482 |
//! | `still-life` | `detail` in [0.25, 4] (1) | about 291k at detail 1 |
//! | `pool` | none; moves | 145,410 |
//! | `teapots` | `pots` from 1 to 2k (37), also as `teapots:100`; `ground` `mirror` or `matt` (`mirror`); `lamps` from 0 to 2 (2) | 6,320 a pot |
//! | `smithy` | none | 183,002 |
//! | `foliage` | `leaves` from 1k to 1M (40k), also as `foliage:100k`; `shape` `leaf` or `card` (`leaf`); moves | about 352k at 40k |
//! | `stadium` | `seats` from 100 to 15k (12k), also as `stadium:1k` | about 426k at 12k |
//! | `walker` | `triangles` from 8k to 2M (30k), also as `walker:10k`; moves | as asked, within 5 % |
//! | `cloth-ball` | `triangles` of the cloth from 1k to 1M (10k), also as `cloth-ball:100k`; moves | as asked, within 4 %, and 5,122 |
//!
//! Counts may be written with the suffixes `k` (thousand) and `M` (million).

mod atrium;
mod cloth_ball;
mod cornell;
mod corridor;
mod foliage;
mod forms;
mod furnace;
mod mirror_hall;
mod parameters;
mod pool;
mod ruins;
mod shape;
mod smithy;
mod solid;
mod spheres;
mod stadium;
mod still_life;
mod teapot;
mod teapots;
mod texture;
mod walker;

pub use atrium::{Atrium, atrium};
pub use cloth_ball::{ClothBall, cloth_ball};
pub use cornell::cornell;
pub use corridor::{Corridor, corridor};
pub use foliage::{Foliage, foliage};
pub use furnace::{Furnace, FurnaceShape, furnace};
pub use mirror_hall::{MirrorHall, mirror_hall};
pub use pool::pool;
pub use ruins::{Ruins, ruins};
pub use smithy::smithy;
pub use spheres::{Spheres, spheres};
pub use stadium::{Stadium, stadium};
pub use still_life::{StillLife, still_life};
pub use teapots::{Ground, Teapots, teapots};
pub use walker::{Walker, walker};

use crate::{Scene, SceneError};
use parameters::Parameters;

/// Names of all built-in scenes, in the order that help texts list them.
pub const NAMES: [&str; 15] = [
    "cornell",
    "furnace",
    "spheres",
    "atrium",
    "ruins",
    "corridor",
    "mirror-hall",
    "still-life",
    "pool",
    "teapots",
    "smithy",
    "foliage",
    "stadium",
    "walker",
    "cloth-ball",
];

/// Size and samples of a picture, for built-in scenes that the common defaults do not suit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels per row and number of rows, in the proportions of the part that the scene's camera looks at.
    pub size: [u32; 2],
    /// Samples per pixel.
    pub samples: u32,
}

/// Returns the picture that suits the built-in scene that `spec` names, seen by its own camera. `cornell` is
/// square and hard to light, so its picture has fewer pixels, all on the scene, and more samples.
pub fn picture(spec: &str) -> Option<Picture> {
    (spec.split(':').next() == Some("cornell")).then_some(Picture { size: [256, 256], samples: 32 })
}

/// Makes the built-in scene that `spec` names, such as `cornell` or `furnace:albedo=0.8,emission=2`.
///
/// `None` if the word before the first `:` is not the name of a built-in scene; it may then be a
/// file.
///
/// # Errors
/// Within `Some`: [`SceneError::Builtin`] for a parameter that the scene does not have, a value that
/// is no number, or one out of range.
pub fn builtin(spec: &str) -> Option<Result<Scene, SceneError>> {
    let (name, rest) = match spec.split_once(':') {
        Some((name, rest)) => (name, Some(rest)),
        None => (spec, None),
    };
    let name = NAMES.into_iter().find(|known| *known == name)?;
    let made = Parameters::parse(spec, rest).and_then(|parameters| make(name, parameters));
    Some(made.map(|mut scene| {
        spec.clone_into(&mut scene.name);
        scene
    }))
}

fn make(name: &str, mut given: Parameters) -> Result<Scene, SceneError> {
    match name {
        "furnace" => {
            let defaults = Furnace::default();
            let albedo = given.number("albedo", f64::from(defaults.albedo), 0.0..=0.999_999)? as f32;
            let emission = given.number("emission", f64::from(defaults.emission), 0.0..=1.0e9)? as f32;
            let shape = match given.word("shape", "sphere", &["sphere", "box"])? {
                "box" => FurnaceShape::Box,
                _ => FurnaceShape::Sphere,
            };
            given.finish()?;
            Ok(furnace(Furnace { albedo, emission, shape }))
        }
        "spheres" => {
            given.name_positional("triangles")?;
            let triangles = given.count("triangles", Spheres::default().triangles, Spheres::TRIANGLES)?;
            given.finish()?;
            Ok(spheres(Spheres { triangles }))
        }
        "atrium" => {
            let detail = given.number("detail", Atrium::default().detail, Atrium::DETAIL)?;
            given.finish()?;
            Ok(atrium(Atrium { detail }))
        }
        "ruins" => {
            given.name_positional("triangles")?;
            let triangles = given.count("triangles", Ruins::default().triangles, Ruins::TRIANGLES)?;
            given.finish()?;
            Ok(ruins(Ruins { triangles }))
        }
        "corridor" => {
            let defaults = Corridor::default();
            let reflectance = given.number("reflectance", f64::from(defaults.reflectance), 0.0..=1.0)? as f32;
            let width = given.number("width", defaults.width, 0.5..=50.0)?;
            given.finish()?;
            Ok(corridor(Corridor { reflectance, width }))
        }
        "mirror-hall" => {
            given.name_positional("share")?;
            let share = given.number("share", MirrorHall::default().share, MirrorHall::SHARE)?;
            given.finish()?;
            Ok(mirror_hall(MirrorHall { share }))
        }
        "still-life" => {
            let detail = given.number("detail", StillLife::default().detail, StillLife::DETAIL)?;
            given.finish()?;
            Ok(still_life(StillLife { detail }))
        }
        "pool" => {
            given.finish()?;
            Ok(pool())
        }
        "teapots" => {
            given.name_positional("pots")?;
            let pots = given.count("pots", Teapots::default().pots, Teapots::POTS)?;
            let ground = match given.word("ground", "mirror", &Ground::NAMES)? {
                "matt" => Ground::Matt,
                _ => Ground::Mirror,
            };
            let lamps = given.count("lamps", Teapots::default().lamps, Teapots::LAMPS)?;
            given.finish()?;
            Ok(teapots(Teapots { pots, ground, lamps }))
        }
        "smithy" => {
            given.finish()?;
            Ok(smithy())
        }
        "foliage" => {
            given.name_positional("leaves")?;
            let leaves = given.count("leaves", Foliage::default().leaves, Foliage::LEAVES)?;
            let cards = given.word("shape", "leaf", &["leaf", "card"])? == "card";
            given.finish()?;
            Ok(foliage(Foliage { leaves, cards }))
        }
        "stadium" => {
            given.name_positional("seats")?;
            let seats = given.count("seats", Stadium::default().seats, Stadium::SEATS)?;
            given.finish()?;
            Ok(stadium(Stadium { seats }))
        }
        "cloth-ball" => {
            given.name_positional("triangles")?;
            let triangles = given.count("triangles", ClothBall::default().triangles, ClothBall::TRIANGLES)?;
            given.finish()?;
            Ok(cloth_ball(ClothBall { triangles }))
        }
        "walker" => {
            given.name_positional("triangles")?;
            let triangles = given.count("triangles", Walker::default().triangles, Walker::TRIANGLES)?;
            given.finish()?;
            Ok(walker(Walker { triangles }))
        }
        _ => {
            given.finish()?;
            Ok(cornell())
        }
    }
}
