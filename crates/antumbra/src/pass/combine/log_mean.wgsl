/// A weighted sum of powers so far, divided by the greatest of them. Texels t stand for e^(`combine_steepness` · t), a
/// constant that is written in front.
struct Combine { top: vec4f, sum: vec4f }

fn combine_none() -> Combine {
    return Combine(vec4f(-3e38), vec4f(0.0));
}

fn combine_add(so_far: Combine, weight: f32, texel: vec4f) -> Combine {
    let top = max(so_far.top, texel);
    let before = so_far.sum * exp(combine_steepness * (so_far.top - top));
    return Combine(top, before + weight * exp(combine_steepness * (texel - top)));
}

fn combine_result(all: Combine) -> vec4f {
    return all.top + log(all.sum) / combine_steepness;
}
