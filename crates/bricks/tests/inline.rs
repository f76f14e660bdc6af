//! Test that the example runs, that every complete frame has the hits of brute force, and that the validation
//! layer is silent.

#[path = "../examples/inline.rs"]
mod inline;

#[test]
fn a_host_traces_from_a_shader_of_its_own_with_two_frames_in_flight() {
    inline::main().expect("the example succeeds");
}
