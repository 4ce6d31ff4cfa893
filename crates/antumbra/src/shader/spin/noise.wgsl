/// Cosine and sine of an angle that differs from pixel to pixel: interleaved gradient noise [Jimenez
/// 2014, "Next generation post processing in Call of Duty"]. The noise asks for the pixel's place on the
/// screen; the map knows `uv` and its steps to the next pixels, so that a pixel's place is the number of
/// steps (x, y) with x·ddx + y·ddy = uv: the same up to a shift wherever the steps are even.
fn spin_rotation(uv: vec2f, ddx: vec2f, ddy: vec2f) -> vec2f {
    let area = ddx.x * ddy.y - ddx.y * ddy.x;
    let safe = select(area, 1e-30, abs(area) < 1e-30);
    let steps = vec2f(uv.x * ddy.y - uv.y * ddy.x, ddx.x * uv.y - ddx.y * uv.x) / safe;
    let pixel = clamp(steps, vec2f(-1e6), vec2f(1e6));
    let turn = fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
    return vec2f(cos(6.2831853 * turn), sin(6.2831853 * turn));
}
