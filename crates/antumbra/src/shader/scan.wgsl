struct ListPass { view: u32, fills: u32, entries: u32, triangles: u32 }
struct ListTotals { entries: atomic<u32>, longest: atomic<u32> }
@group(0) @binding(0) var<uniform> list_pass: ListPass;
@group(0) @binding(1) var<storage, read_write> list_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> list_totals: array<ListTotals>;
@group(0) @binding(3) var list_ranges: texture_storage_2d_array<r32uint, write>;

/// Texels of one invocation.
const list_segment: u32 = 128u;

/// Gives every texel as many entries as were counted. Segments of the map get theirs in the order in
/// which they come, which answers do not depend on. Counts become each list's first entry.
@compute @workgroup_size(64) fn compute(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(list_ranges);
    let start = id.x * list_segment;
    let end = min(start + list_segment, size.x * size.y);
    if start >= end {
        return;
    }
    var length = 0u;
    var longest = 0u;
    for (var i = start; i < end; i += 1u) {
        length += list_counts[i];
        longest = max(longest, list_counts[i]);
    }
    atomicMax(&list_totals[list_pass.view].longest, longest);
    var next = atomicAdd(&list_totals[list_pass.view].entries, length);
    for (var i = start; i < end; i += 1u) {
        let count = list_counts[i];
        let at = vec2u(i % size.x, i / size.x);
        textureStore(list_ranges, at, 0u, vec4u(min(next, list_pass.entries)));
        textureStore(list_ranges, at, 1u, vec4u(min(next + count, list_pass.entries)));
        list_counts[i] = next;
        next += count;
    }
}
