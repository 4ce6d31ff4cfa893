//! Exact Euclidean distance transform in O(pixels) [Meijster, Roerdink and Hesselink 2000].

/// Squared distance, in pixels², from each pixel's centre to the nearest seed's centre; `u64::MAX`
/// everywhere if there is no seed.
pub(super) fn squared(seeds: &[bool], width: u32, height: u32) -> Vec<u64> {
    let (w, h) = (width as usize, height as usize);
    if !seeds.contains(&true) {
        return vec![u64::MAX; seeds.len()];
    }
    // Larger than any distance in the image, and its square still fits.
    let far = (w + h) as i64;
    let columns = column_distances(seeds, w, h, far);
    let mut result = vec![0; seeds.len()];
    for (row, out) in columns.chunks_exact(w).zip(result.chunks_exact_mut(w)) {
        lower_envelope(row, out);
    }
    result
}

/// Distance to the nearest seed in the same column, `far` if it has none.
fn column_distances(seeds: &[bool], w: usize, h: usize, far: i64) -> Vec<i64> {
    let mut distance = vec![far; seeds.len()];
    for y in 0..h {
        for x in 0..w {
            let above = if y > 0 { distance[(y - 1) * w + x] + 1 } else { far };
            distance[y * w + x] = if seeds[y * w + x] { 0 } else { above.min(far) };
        }
    }
    for y in (0..h.saturating_sub(1)).rev() {
        for x in 0..w {
            let below = distance[(y + 1) * w + x] + 1;
            distance[y * w + x] = distance[y * w + x].min(below);
        }
    }
    distance
}

/// min over i of (x − i)² + row[i]², for every x: the lower envelope of the row's parabolas.
fn lower_envelope(row: &[i64], out: &mut [u64]) {
    let f = |x: i64, i: usize| (x - i as i64).pow(2) + row[i].pow(2);
    // First x where parabola u lies below parabola i < u, rounded down.
    let crossing = |i: usize, u: usize| {
        let (a, b) = (i as i64, u as i64);
        (b * b - a * a + row[u].pow(2) - row[i].pow(2)).div_euclid(2 * (b - a))
    };
    let mut parts: Vec<(usize, i64)> = vec![(0, 0)];
    for u in 1..row.len() {
        while parts.last().is_some_and(|&(i, start)| f(start, i) > f(start, u)) {
            parts.pop();
        }
        match parts.last() {
            None => parts.push((u, 0)),
            Some(&(i, _)) => {
                let start = 1 + crossing(i, u);
                if start < row.len() as i64 {
                    parts.push((u, start));
                }
            }
        }
    }
    for (x, out) in out.iter_mut().enumerate().rev() {
        while parts.len() > 1 && parts.last().is_some_and(|&(_, start)| start > x as i64) {
            parts.pop();
        }
        *out = parts.last().map_or(0, |&(i, _)| f(x as i64, i) as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brute_force(seeds: &[bool], w: usize) -> Vec<u64> {
        let place = |i: usize| [(i % w) as i64, (i / w) as i64];
        let to = |i: usize, j: usize| {
            let ([a, b], [c, d]) = (place(i), place(j));
            ((a - c).pow(2) + (b - d).pow(2)) as u64
        };
        let nearest = |i| (0..seeds.len()).filter(|&j| seeds[j]).map(|j| to(i, j)).min();
        (0..seeds.len()).map(|i| nearest(i).unwrap_or(u64::MAX)).collect()
    }

    #[test]
    fn equals_brute_force_on_random_masks() {
        let mut state = 1_u32;
        for (w, h, density) in [(1, 1, 2), (1, 9, 4), (9, 1, 4), (23, 17, 2), (23, 17, 40), (40, 31, 300)] {
            let seeds: Vec<bool> = (0..w * h)
                .map(|_| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (state >> 8).is_multiple_of(density)
                })
                .collect();
            assert_eq!(squared(&seeds, w, h), brute_force(&seeds, w as usize), "{w}×{h}, 1 in {density}");
        }
    }

    #[test]
    fn transposed_mask_gives_other_distances() {
        let seeds = |at: usize| (0..12).map(|i| i == at).collect::<Vec<_>>();
        assert_eq!(squared(&seeds(3), 4, 3)[0], 9);
        assert_eq!(squared(&seeds(3), 3, 4)[0], 1, "the same list read with the axes swapped");
    }
}
