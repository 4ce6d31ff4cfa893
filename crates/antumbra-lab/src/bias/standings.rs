//! How biases do over several scenes.

use super::{Ranking, Row, rank_biases};
use serde::Serialize;

/// A ratio of errors above which a bias counts as worse.
const WORSE: f64 = 1.1;

/// Biases over several scenes, and [`Bias::Auto`](antumbra::technique::Bias::Auto) in each.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Standings {
    /// Techniques in the order of the rows, each with its biases in theirs, the automatic one first.
    pub standings: Vec<Standing>,
    /// Scenes in their order, each with its techniques.
    pub places: Vec<Place>,
}

/// One bias of one technique over several scenes. Ratios are of errors, to that of the best fixed bias of
/// each scene: among those that do their work ([`Ranking::best`]), and among all.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Standing {
    /// The technique with its settings.
    pub technique: String,
    /// The bias as text.
    pub bias: String,
    /// Scenes that it was tried in.
    pub scenes: usize,
    /// Mean of the ratios; `None` where no fixed bias does its work in any scene.
    pub mean_ratio: Option<f64>,
    /// Scenes whose ratio is above 1.1.
    pub above_a_tenth: usize,
    /// Largest ratio.
    pub worst_ratio: Option<f64>,
    /// Mean of the ratios among all.
    pub mean_ratio_of_all: Option<f64>,
    /// Scenes whose ratio among all is above 1.1.
    pub above_a_tenth_of_all: usize,
    /// Largest ratio among all.
    pub worst_ratio_of_all: Option<f64>,
    /// Mean of [`Row::acne`].
    pub mean_acne: Option<f64>,
    /// Largest of them.
    pub worst_acne: Option<f64>,
    /// Mean of [`Row::detached_texels`], over scenes that have it.
    pub mean_detached_texels: Option<f64>,
    /// Largest of them.
    pub worst_detached_texels: Option<f64>,
}

/// The automatic bias of one technique in one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// The scene.
    pub scene: String,
    /// The technique with its settings.
    pub technique: String,
    /// The best of the fixed biases that do their work.
    pub best: Option<String>,
    /// Its error.
    pub best_rmse: Option<f64>,
    /// Error of the automatic bias.
    pub rmse: f64,
    /// Its acne.
    pub acne: f64,
    /// Its detachment.
    pub detached_texels: Option<f64>,
    /// Ratio of both errors.
    pub ratio: Option<f64>,
    /// Ratio to the least error of any fixed bias.
    pub ratio_of_all: f64,
}

/// What one bias is in one scene.
struct Entry<'a> {
    row: &'a Row,
    ratio: Option<f64>,
    ratio_of_all: f64,
}

/// Biases over scenes, each given with its rows. Rows that [`rank_biases`] leaves out do not count.
#[must_use]
pub fn standings(scenes: &[(&str, &[Row])]) -> Standings {
    let mut result = Standings::default();
    let mut groups: Vec<Vec<Entry<'_>>> = Vec::new();
    for (scene, rows) in scenes {
        for ranking in rank_biases(rows) {
            let ratio = |row: &Row| ranking.best.map(|best| row.rmse / best.rmse);
            let ratio_of_all = |row: &Row| row.rmse / ranking.best_of_all.rmse;
            result.places.push(place(scene, &ranking, ratio(ranking.auto)));
            for row in std::iter::once(ranking.auto).chain(ranking.others.iter().copied()) {
                let entry = Entry { row, ratio: ratio(row), ratio_of_all: ratio_of_all(row) };
                let of = |e: &Entry<'_>| e.row.technique == row.technique && e.row.bias == row.bias;
                match groups.iter_mut().find(|group| of(&group[0])) {
                    Some(group) => group.push(entry),
                    None => groups.push(vec![entry]),
                }
            }
        }
    }
    result.standings = groups.iter().map(|group| standing(group)).collect();
    result
}

fn place(scene: &str, ranking: &Ranking<'_>, ratio: Option<f64>) -> Place {
    let Ranking { auto, best, best_of_all, .. } = ranking;
    Place {
        scene: scene.into(),
        technique: auto.technique.clone(),
        best: best.map(|best| best.bias.clone()),
        best_rmse: best.map(|best| best.rmse),
        rmse: auto.rmse,
        acne: auto.acne,
        detached_texels: auto.detached_texels,
        ratio,
        ratio_of_all: auto.rmse / best_of_all.rmse,
    }
}

fn standing(group: &[Entry<'_>]) -> Standing {
    let ratios: Vec<f64> = group.iter().filter_map(|e| e.ratio).collect();
    let of_all: Vec<f64> = group.iter().map(|e| e.ratio_of_all).collect();
    let acne: Vec<f64> = group.iter().map(|e| e.row.acne).collect();
    let detached: Vec<f64> = group.iter().filter_map(|e| e.row.detached_texels).collect();
    let above = |ratios: &[f64]| ratios.iter().filter(|ratio| **ratio > WORSE).count();
    Standing {
        technique: group[0].row.technique.clone(),
        bias: group[0].row.bias.clone(),
        scenes: group.len(),
        mean_ratio: mean(&ratios),
        above_a_tenth: above(&ratios),
        worst_ratio: largest(&ratios),
        mean_ratio_of_all: mean(&of_all),
        above_a_tenth_of_all: above(&of_all),
        worst_ratio_of_all: largest(&of_all),
        mean_acne: mean(&acne),
        worst_acne: largest(&acne),
        mean_detached_texels: mean(&detached),
        worst_detached_texels: largest(&detached),
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn largest(values: &[f64]) -> Option<f64> {
    values.iter().copied().max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_count_alike_and_failing_biases_do_not_compete() {
        let row = |bias: &str, acne, rmse, detached_texels| Row {
            technique: "hard".into(),
            bias: bias.into(),
            acne,
            detached_texels,
            rmse,
            over_darkening: 0.0,
            invalid: None,
        };
        let one = [row("auto", 0.0, 0.2, Some(1.0)), row("none", 0.5, 0.1, None), row("a", 0.0, 0.4, None)];
        let two = [row("auto", 0.01, 0.3, None), row("none", 0.5, 9.0, None), row("a", 0.0, 0.2, Some(2.0))];
        let found = standings(&[("one", &one), ("two", &two)]);
        let [auto, none, a] = found.standings.try_into().unwrap();
        assert_eq!((auto.bias.as_str(), auto.scenes), ("auto", 2));
        let close = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs() < 1e-12;
        // 0.2/0.4 and 0.3/0.2; among all 0.2/0.1 and 0.3/0.2.
        assert!(close(auto.mean_ratio, 1.0) && close(auto.worst_ratio, 1.5) && auto.above_a_tenth == 1);
        assert!(close(auto.mean_ratio_of_all, 1.75) && auto.above_a_tenth_of_all == 2);
        assert!(close(auto.mean_acne, 0.005) && close(auto.worst_detached_texels, 1.0));
        assert!(close(a.mean_ratio, 1.0) && none.mean_detached_texels.is_none());
        let [place, other] = found.places.try_into().unwrap();
        assert_eq!((place.best.as_deref(), place.ratio_of_all), (Some("a"), 2.0));
        assert_eq!((other.scene.as_str(), other.best_rmse), ("two", Some(0.2)));
    }
}
