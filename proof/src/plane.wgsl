//! needs tile key coverage

fn plane_visibility(uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let point = uv * tile_size(view);
    let texel = min(vec2u(max(point, vec2f(0.0))), vec2u(tile_size(view)) - 1u);
    let key = shadow_first(tile_index(view, texel));
    if key == 0u {
        return 1.0;
    }
    let id = key_number(key, shadow_first_bits());
    let ray = vec3f(point, 0.0);
    let a = shadow_corner(view, id, 0u) - ray;
    let b = shadow_corner(view, id, 1u) - ray;
    let c = shadow_corner(view, id, 2u) - ray;
    let met = a.z - dot(coverage_slope(mat3x3f(a, b, c)), a.xy);
    return select(1.0, 0.0, met < depth && shadow_stops(view, id, a, b, c));
}
