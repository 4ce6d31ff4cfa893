struct Frame {
    clip_from_relative: mat4x4f,
    eye: vec4f,
    ray: vec4f,
    ray_right: vec4f,
    ray_down: vec4f,
    to_light: vec4f,
    cone: vec4f,
    forward: vec4f,
}

struct Material {
    base_color: vec4f,
    metallic: f32,
    roughness: f32,
    cutoff: f32,
    mask: u32,
}

/// A line of sight; its start is relative to the eye.
struct FrameRay {
    start: vec3f,
    direction: vec3f,
}

fn frame_ray(frame: Frame, picture: vec2f) -> FrameRay {
    let through = frame.ray.xyz + frame.ray_right.xyz * picture.x + frame.ray_down.xyz * picture.y;
    if frame.forward.w == 1.0 {
        return FrameRay(through, frame.forward.xyz);
    }
    return FrameRay(vec3f(0.0), through);
}

/// The same ray a step of `ray_right` or `ray_down` further on.
fn frame_step(frame: Frame, ray: FrameRay, step: vec3f) -> FrameRay {
    return FrameRay(ray.start + step * frame.forward.w, ray.direction + step * (1.0 - frame.forward.w));
}
