@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var relative: texture_2d<f32>;
@group(0) @binding(2) var facet: texture_2d<f32>;
@group(0) @binding(3) var shading: texture_2d<f32>;
@group(0) @binding(4) var albedo: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// Linear radiance of the sky in a direction; also the ambient light from there.
fn sky(direction: vec3f) -> vec3f {
    let up = direction.y;
    let horizon = vec3f(0.62, 0.69, 0.76);
    let zenith = vec3f(0.22, 0.37, 0.62);
    let ground = vec3f(0.24, 0.22, 0.20);
    return select(mix(horizon, zenith, sqrt(max(up, 0.0))), mix(horizon, ground, sqrt(clamp(-4.0 * up, 0.0, 1.0))), up < 0.0);
}

/// Reflected sun light per unit irradiance, times n·l: Lambert plus GGX with Schlick's Fresnel and
/// Karis' visibility approximation.
fn reflect_light(n: vec3f, v: vec3f, l: vec3f, base: vec3f, metallic: f32, roughness: f32) -> vec3f {
    let h = normalize(v + l);
    let nl = max(dot(n, l), 0.0);
    let nv = max(dot(n, v), 1e-3);
    let nh = max(dot(n, h), 0.0);
    let a = max(roughness * roughness, 0.03);
    let d = nh * nh * (a * a - 1.0) + 1.0;
    let distribution = a * a / (3.14159265 * d * d);
    let k = 0.5 * a;
    let shadowing = 0.25 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    let f0 = mix(vec3f(0.04), base, metallic);
    let fresnel = f0 + (1.0 - f0) * pow(1.0 - max(dot(v, h), 0.0), 5.0);
    return nl * (base * (1.0 - metallic) * (1.0 - fresnel) / 3.14159265 + fresnel * distribution * shadowing);
}

/// Of a sample in the mean.
const share: f32 = 0.125;

struct Terms {
    @location(0) sun: vec4f,
    @location(1) rest: vec4f,
}

/// A sample's share of a pixel's light.
@fragment fn fragment(@builtin(position) position: vec4f) -> Terms {
    let pixel = vec2i(position.xy);
    let at = textureLoad(relative, pixel, 0);
    let ray = normalize(frame_ray(frame, position.xy).direction);
    if at.w == 0.0 {
        return Terms(vec4f(0.0), share * vec4f(0.9 * sky(ray), 1.0));
    }
    let world = frame.eye.xyz + at.xyz;
    let to_light = normalize(frame.to_light.xyz - world * frame.to_light.w);
    let n = textureLoad(shading, pixel, 0);
    let base = textureLoad(albedo, pixel, 0);
    // A facet turned away from the sun is dark whatever its smooth normal says.
    let facing = dot(textureLoad(facet, pixel, 0).xyz, to_light) > 0.0;
    let in_cone = smoothstep(frame.cone.x, frame.cone.x + 0.02, -dot(frame.cone.yzw, to_light));
    let cone = select(1.0, in_cone, frame.to_light.w > 0.0);
    let strength = 3.4 * vec3f(1.0, 0.94, 0.84) * select(0.0, cone, facing);
    let sun = strength * reflect_light(n.xyz, -ray, to_light, base.rgb, n.w, base.a);
    let bounce = 0.5 + 0.5 * n.y;
    let ambient = base.rgb * mix(vec3f(0.13, 0.12, 0.11), vec3f(0.30, 0.35, 0.43), bounce);
    return Terms(share * vec4f(sun, 1.0), share * vec4f(ambient, 1.0));
}
