// Tint must refuse this: WGSL has no order of precedence between << and |. naga takes it.
fn mixed(a: u32, b: u32) -> u32 {
    return a << 8u | b;
}
