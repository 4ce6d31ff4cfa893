/// A weighted mean so far.
struct Combine { sum: vec4f }

fn combine_none() -> Combine {
    return Combine(vec4f(0.0));
}

fn combine_add(so_far: Combine, weight: f32, texel: vec4f) -> Combine {
    return Combine(so_far.sum + weight * texel);
}

fn combine_result(all: Combine) -> vec4f {
    return all.sum;
}
