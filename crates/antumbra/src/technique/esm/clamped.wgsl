
/// What a clamp would give: no custom filtering.
fn esm_custom(map: LookupMap, uv: vec2f, view: u32, depth: f32) -> f32 {
    return 1.0;
}
