/// The beginning of what the convert pass reads: weights of an adaptive kernel from the middle outwards; where the
/// view lies, its origin and size, in a layer of that size; how many texels the kernel reaches.
struct Blur { side: array<vec4f, 4>, linear_over: vec4f, linear_under: vec4f, tile: vec4f, size: vec2f, reach: f32 }
@group(0) @binding(1) var<uniform> blur: Blur;
