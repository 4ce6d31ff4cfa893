@group(0) @binding(0) var<uniform> light_clip_from_world: mat4x4f;
@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var base_color: texture_2d<f32>;
@group(1) @binding(2) var base_sampler: sampler;

struct Cutout {
    @builtin(position) clip: vec4f,
    @location(0) uv: vec2f,
    @location(1) alpha: f32,
}

@vertex fn clamped(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return light_clip_from_world * vec4f(position, 1.0);
}

@vertex fn pancaked(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return caster_pancaked(light_clip_from_world, position);
}

@vertex fn masked_clamped(@location(0) position: vec3f, @location(2) uv: vec2f, @location(3) color: vec4f) -> Cutout {
    return Cutout(light_clip_from_world * vec4f(position, 1.0), uv, color.a);
}

@vertex fn masked_pancaked(@location(0) position: vec3f, @location(2) uv: vec2f, @location(3) color: vec4f) -> Cutout {
    return Cutout(caster_pancaked(light_clip_from_world, position), uv, color.a);
}

@fragment fn cutout(in: Cutout) {
    if material.base_color.a * in.alpha * textureSampleLevel(base_color, base_sampler, in.uv, 0.0).a < material.cutoff {
        discard;
    }
}
