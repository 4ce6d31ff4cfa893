struct Frame {
    clip_from_relative: mat4x4f,
    eye: vec4f,
    ray: vec4f,
    ray_right: vec4f,
    ray_down: vec4f,
    to_light: vec4f,
    cone: vec4f,
}

struct Material {
    base_color: vec4f,
    metallic: f32,
    roughness: f32,
    cutoff: f32,
}
