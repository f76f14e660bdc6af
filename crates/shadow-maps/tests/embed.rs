//! Test that the example runs, that its answers are those of brute force where a map has them, and that the
//! validation layer is silent.

#[path = "../examples/embed.rs"]
mod embed;

#[test]
fn a_renderer_of_its_own_has_shadows_by_maps() {
    embed::main().expect("the example succeeds");
}
