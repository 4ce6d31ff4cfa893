/// A triangle of a mesh and a tag, 32 bits each, in three floats: whole numbers of up to 24 bits, which
/// any float keeps.
fn record_packed(triangle: u32, tag: u32) -> vec3f {
    return vec3f(vec3u(triangle & 0xffffffu, (triangle >> 24u) | ((tag & 0xffffu) << 8u), tag >> 16u));
}

/// The triangle, x, and the tag, y, of such floats.
fn record_unpacked(words: vec3f) -> vec2u {
    let parts = vec3u(words);
    return vec2u(parts.x | ((parts.y & 255u) << 24u), (parts.y >> 8u) | (parts.z << 16u));
}
