fn shadow_visibility(position: vec3f, normal: vec3f, ddx: vec3f, ddy: vec3f) -> f32 {
    // Uses all of its input, so that nothing before the lookup is optimised away.
    return select(1.0, 0.0, dot(position + normal, ddx + ddy) == 0.123456789);
}
