//! Test that the example runs, that its hits are those of brute force, and that the validation layer is
//! silent.

#[path = "../examples/embed.rs"]
mod embed;

#[test]
fn a_renderer_of_its_own_traces_through_a_grid() {
    embed::main().expect("the example succeeds");
}
