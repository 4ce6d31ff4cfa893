
@group(0) @binding(0) var rows: texture_2d_array<u32>;
@group(0) @binding(3) var sums: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64) fn compute(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2i(textureDimensions(rows));
    let x = i32(id.x);
    if x >= size.x {
        return;
    }
    var sum = vec4u(0u);
    for (var y = 0; y < size.y; y += 1) {
        sum = words_add(sum, textureLoad(rows, vec2i(x, y), 0, 0));
        textureStore(sums, vec2i(x, y), sum);
    }
}
