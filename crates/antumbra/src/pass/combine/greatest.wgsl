/// The greatest so far.
struct Combine { top: vec4f }

fn combine_none() -> Combine {
    return Combine(vec4f(-3e38));
}

fn combine_add(so_far: Combine, weight: f32, texel: vec4f) -> Combine {
    return Combine(max(so_far.top, texel));
}

fn combine_result(all: Combine) -> vec4f {
    return all.top;
}
