fn store_keeps_vertices() -> bool {
    return true;
}

fn store_triangle(shaped: CasterTriangle, triangle: u32, seen: mat3x3f, id: u32) -> CasterTriangle {
    var out = shaped;
    out.id = id;
    out.slope = caster_slope(triangle, caster_places(out));
    return out;
}

/// No depth is stored.
fn store_depth(in: CasterTriangle, at: vec2f) -> f32 {
    return 0.5;
}

@fragment fn fragment(in: CasterTriangle) {
    let touch = caster_touch(in);
    if in.id >= caster_step.triangles {
        return;
    }
    let texel = vec2u(in.position.xy);
    let size = caster_view.layer_size;
    let i = (caster_view.layer * size.y + texel.y) * size.x + texel.x;
    let depth = in.depths.x + dot(in.slope, touch.centre);
    first_keys_max(i, key_of(false, depth, in.id, caster_step.words.x));
    vertices_keep_all(in);
}
