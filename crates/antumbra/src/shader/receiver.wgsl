/// Projects a world position into a light's view: normalised device coordinates in xyz, distance
/// along the light's axis in w (1 for directional lights).
fn receiver_project(clip_from_world: mat4x4f, position: vec3f) -> vec4f {
    let clip = clip_from_world * vec4f(position, 1.0);
    return vec4f(clip.xyz / clip.w, clip.w);
}

/// How the normalised device coordinates change along a world direction, to first order, at a
/// point that projects to `ndc`.
fn receiver_gradient(clip_from_world: mat4x4f, ndc: vec4f, direction: vec3f) -> vec3f {
    let clip = clip_from_world * vec4f(direction, 0.0);
    return (clip.xyz - ndc.xyz * clip.w) / ndc.w;
}

/// Texture coordinates, y down, of normalised device coordinates, y up.
fn receiver_uv(ndc: vec2f) -> vec2f {
    return vec2f(0.5, -0.5) * ndc + 0.5;
}

/// A unit vector at right angles to the unit vector n.
fn receiver_tangent(n: vec3f) -> vec3f {
    let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(n.x) > 0.7);
    return normalize(cross(n, axis));
}

/// The depth that a plane gains per unit of texture coordinate, from how texture coordinates
/// (`duv_*`) and depth (`ddepth`) change along two of the plane's tangents. Its components are kept
/// within ±`steepest`, also for planes seen edge-on by the light, where the quotient has no value.
fn receiver_plane(duv_s: vec2f, duv_t: vec2f, ddepth: vec2f, steepest: vec2f) -> vec2f {
    let area = duv_s.x * duv_t.y - duv_s.y * duv_t.x;
    let gain = vec2f(
        ddepth.x * duv_t.y - ddepth.y * duv_s.y,
        ddepth.y * duv_s.x - ddepth.x * duv_t.x,
    );
    // gain / area without dividing by zero: the sign of a vanishing area is of no consequence.
    let safe = select(area, select(1e-30, -1e-30, area < 0.0), abs(area) < 1e-30);
    return clamp(gain / safe, -steepest, steepest);
}

/// The plane that comparisons follow: `share` times the receiver's, but at most 1.5 texels of depth per
/// texel steeper than it. `diagonal` is what a plane at 45° gains.
fn receiver_followed(plane: vec2f, share: f32, diagonal: vec2f) -> vec2f {
    return plane * min(share, 1.0 + 1.5 / max(length(plane / diagonal), 1e-6));
}
