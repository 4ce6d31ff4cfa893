/// Clip position of a caster's vertex. A vertex in front of the near plane is moved onto it
/// ("pancaking"), so that it still casts where the device cannot clamp depth. With depth clamping
/// multiply by the matrix alone: moving vertices bends large triangles.
fn caster_pancaked(clip_from_world: mat4x4f, position: vec3f) -> vec4f {
    let clip = clip_from_world * vec4f(position, 1.0);
    return vec4f(clip.xy, max(clip.z, 0.0), clip.w);
}
