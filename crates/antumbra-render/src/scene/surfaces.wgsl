@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var base_color: texture_2d<f32>;
@group(1) @binding(2) var base_sampler: sampler;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) color: vec4f,
}

struct Varying {
    @builtin(position) clip: vec4f,
    @location(0) relative: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) color: vec4f,
    @location(4) @interpolate(flat) triangle: u32,
}

@vertex fn surface_vertex(vertex: Vertex, @builtin(vertex_index) index: u32) -> Varying {
    let relative = vertex.position - frame.eye.xyz;
    return Varying(frame.clip_from_relative * vec4f(relative, 1.0), relative, vertex.normal, vertex.uv, vertex.color, index / 3u);
}

struct Surface {
    @location(0) relative: vec4f,
    @location(1) facet: vec4f,
    @location(2) shading: vec4f,
    @location(3) albedo: vec4f,
}

/// The same direction at a length near 1: squares of products of lengths in world units may be no 32-bit numbers.
fn scaled(v: vec3f) -> vec3f {
    let size = abs(v);
    return v / max(size.x, max(size.y, size.z));
}

fn surface_of(in: Varying) -> Surface {
    let across = cross(scaled(dpdx(in.relative)), scaled(dpdy(in.relative)));
    var facet = normalize(across);
    if !(dot(across, across) > 0.0) {
        facet = normalize(in.normal);
    }
    let sight = select(in.relative, frame.forward.xyz, frame.forward.w == 1.0);
    facet = select(facet, -facet, dot(facet, sight) > 0.0);
    var shading = normalize(in.normal);
    shading = select(shading, -shading, dot(shading, facet) < 0.0);
    let albedo = material.base_color * in.color * textureSample(base_color, base_sampler, in.uv);
    return Surface(vec4f(in.relative, 1.0), vec4f(facet, 0.0), vec4f(shading, material.metallic), vec4f(albedo.rgb, material.roughness));
}

@fragment fn surface(in: Varying) -> Surface {
    return surface_of(in);
}

/// Alpha exactly as rays look it up: bilinear, finest level.
fn alpha(uv: vec2f, color: vec4f) -> f32 {
    return material.base_color.a * color.a * textureSampleLevel(base_color, base_sampler, uv, 0.0).a;
}

@fragment fn masked_surface(in: Varying) -> Surface {
    let result = surface_of(in);
    if alpha(in.uv, in.color) < material.cutoff {
        discard;
    }
    return result;
}

@fragment fn triangle_id(in: Varying) -> @location(0) u32 {
    return in.triangle + 1u;
}

@fragment fn masked_triangle_id(in: Varying) -> @location(0) u32 {
    if alpha(in.uv, in.color) < material.cutoff {
        discard;
    }
    return in.triangle + 1u;
}
