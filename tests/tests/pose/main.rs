//! Motion of a scene, posed on the device: held against the same scene posed on the host.

mod deformed;
mod far_away;
mod held;
mod lit;
mod made;
mod real;
mod recordings;
mod shapes;
