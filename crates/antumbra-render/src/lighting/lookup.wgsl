@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var relative: texture_2d<f32>;
@group(0) @binding(2) var facet: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// Where the plane through `at` with normal `n` is met by a ray, minus `at`. A plane seen nearly edge-on
/// is taken to be met no more than 32 times as far away.
fn neighbour(at: vec3f, n: vec3f, ray: FrameRay, own_ray: FrameRay) -> vec3f {
    let own = dot(n, own_ray.direction);
    let rise = select(max(dot(n, ray.direction), own / 32.0), min(dot(n, ray.direction), own / 32.0), own < 0.0);
    return ray.start + ray.direction * (dot(n, at - ray.start) / rise) - at;
}

@fragment fn fragment(@builtin(position) position: vec4f) -> @location(0) f32 {
    let pixel = vec2i(position.xy);
    let at = textureLoad(relative, pixel, 0);
    if at.w == 0.0 {
        return nothing;
    }
    let n = textureLoad(facet, pixel, 0).xyz;
    let ray = frame_ray(frame, position.xy);
    let ddx = neighbour(at.xyz, n, frame_step(frame, ray, frame.ray_right.xyz), ray);
    let ddy = neighbour(at.xyz, n, frame_step(frame, ray, frame.ray_down.xyz), ray);
    return answer(frame.eye.xyz + at.xyz, n, ddx, ddy);
}
