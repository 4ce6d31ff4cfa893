// Position across the map, from −1 to 1, and depth.
@group(1) @binding(0) var<storage, read> receivers: array<vec2f>;
@group(1) @binding(1) var<storage, read_write> answers: array<f32>;

@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&receivers) {
        return;
    }
    // A footprint far below a texel.
    let ddx = vec3f(1e-6, 0.0, 0.0);
    let ddy = vec3f(0.0, 1e-6, 0.0);
    let at = receivers[id.x];
    answers[id.x] = shadow_visibility(vec3f(at.x, 0.0, at.y), vec3f(0.0, 0.0, -1.0), ddx, ddy);
}
