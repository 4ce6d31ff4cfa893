//! needs ray tile

/// 0 if any triangle of the list of the receiver's texel is between it and the light, else 1. `depth` is
/// projected depth, in which triangles are planes under any light.
fn exact_visibility(uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let point = uv * tile_size(view);
    let list = shadow_list(view, vec2i(point));
    for (var i = list.x; i < list.y; i += 1u) {
        let id = shadow_entry(view, i);
        let ray = vec3f(point, 0.0);
        let a = shadow_corner(view, id, 0u) - ray;
        let b = shadow_corner(view, id, 1u) - ray;
        let c = shadow_corner(view, id, 2u) - ray;
        if ray_depth(a, b, c) < depth && shadow_stops(view, id, a, b, c) {
            return 0.0;
        }
    }
    return 1.0;
}
