//! Every metric against a value computed by hand, and against an image that it must tell apart.

use antumbra_lab::image::GrayImage;
use antumbra_lab::metrics::{ScoreError, no_shadow_baseline, score};

/// Left half shadowed, right half lit: 20 columns, 10 rows, the edge between columns 9 and 10.
fn halves() -> GrayImage {
    GrayImage::from_fn(20, 10, |x, _| if x < 10 { 0.0 } else { 1.0 })
}

const ALL: [bool; 200] = [true; 200];

/// `halves`, moved right by `columns`.
fn moved(columns: u32) -> GrayImage {
    GrayImage::from_fn(20, 10, |x, _| if x < 10 + columns { 0.0 } else { 1.0 })
}

fn near(measured: f64, by_hand: f64) {
    assert!((measured - by_hand).abs() < 1e-6, "{measured} is not {by_hand}");
}

#[test]
fn equal_images_are_perfect() {
    let score = score(&halves(), &halves(), &ALL).unwrap();
    assert_eq!(score.pixel_match, 1.0);
    assert_eq!(score.pixel_match_near_edges, Some(1.0));
    assert_eq!((score.rmse, score.mae, score.flip, score.psnr), (0.0, 0.0, 0.0, None));
    near(score.ssim, 1.0);
    assert_eq!((score.leak, score.over_darkening, score.acne), (Some(0.0), Some(0.0), Some(0.0)));
    assert_eq!((score.shadowable_pixels, score.lit_pixels), (200, 100));
}

#[test]
fn shifted_image_loses_the_columns_between() {
    // One of 20 columns differs by 1; of the four columns near the edge (8, 9, 10, 11) one is wrong.
    let score = score(&moved(1), &halves(), &ALL).unwrap();
    near(score.pixel_match, 0.95);
    assert_eq!(score.edge_pixels, 40);
    near(score.pixel_match_near_edges.unwrap(), 0.75);
    near(score.mae, 0.05);
    near(score.rmse, 0.05_f64.sqrt());
    near(score.psnr.unwrap(), -20.0 * 0.05_f64.sqrt().log10());
    near(score.acne.unwrap(), 0.1);
    // Column 10 is one pixel from the shadow: not deep in the light, so not over-darkening.
    assert_eq!((score.leak, score.over_darkening), (Some(0.0), Some(0.0)));
    assert!(score.ssim < 0.99 && score.flip > 0.01);
}

#[test]
fn leak_counts_deep_shadow_only() {
    // Shadowed columns 0..=9; column 6 is four pixels from column 10, the nearest lit one, and the
    // last to be deep. A visibility of 0.2 everywhere in columns 5..=9 is deep in 5 and 6 of 7.
    let test = GrayImage::from_fn(20, 10, |x, _| if (5..10).contains(&x) { 0.2 } else { f32::from(x >= 10) });
    let score_of_test = score(&test, &halves(), &ALL).unwrap();
    near(score_of_test.leak.unwrap(), 2.0 * f64::from(0.2_f32) / 7.0);
    assert_eq!(score_of_test.over_darkening, Some(0.0));
    assert_eq!(score_of_test.acne, Some(0.0));
}

#[test]
fn over_darkening_counts_deep_light_only() {
    // Lit columns 10..=19, deep from column 13 on: seven columns, of which 13 and 14 are at 0.7.
    let test =
        GrayImage::from_fn(20, 10, |x, _| if (10..15).contains(&x) { 0.7 } else { f32::from(x >= 10) });
    let score_of_test = score(&test, &halves(), &ALL).unwrap();
    near(score_of_test.over_darkening.unwrap(), 2.0 * f64::from(1.0 - 0.7_f32) / 7.0);
    assert_eq!(score_of_test.leak, Some(0.0));
}

#[test]
fn inverted_image_is_as_wrong_as_can_be() {
    let inverted = GrayImage::from_fn(20, 10, |x, _| f32::from(x < 10));
    let score = score(&inverted, &halves(), &ALL).unwrap();
    assert_eq!((score.pixel_match, score.pixel_match_near_edges), (0.0, Some(0.0)));
    assert_eq!((score.rmse, score.mae, score.psnr), (1.0, 1.0, Some(0.0)));
    assert_eq!((score.leak, score.over_darkening, score.acne), (Some(1.0), Some(1.0), Some(1.0)));
    assert!(score.ssim < 0.1 && score.flip > 0.8);
}

#[test]
fn pixels_that_are_not_shadowable_count_for_nothing() {
    let mut test = moved(0);
    let mut mask = ALL;
    for (i, (value, counted)) in test.values.iter_mut().zip(&mut mask).enumerate() {
        if i % 20 >= 15 {
            *value = 0.0;
            *counted = false;
        }
    }
    let masked = score(&test, &halves(), &mask).unwrap();
    assert_eq!((masked.pixel_match, masked.rmse, masked.acne), (1.0, 0.0, Some(0.0)));
    assert_eq!((masked.flip, masked.shadowable_pixels), (0.0, 150));
    near(masked.ssim, 1.0);
    let whole = score(&test, &halves(), &ALL).unwrap();
    near(whole.pixel_match, 0.75);
}

#[test]
fn transposed_mask_changes_every_pixel_metric() {
    let truth = GrayImage::from_fn(10, 10, |x, _| if x < 3 { 0.0 } else { 1.0 });
    let columns: Vec<bool> = (0..100).map(|i| i % 10 < 5).collect();
    let rows: Vec<bool> = (0..100).map(|i| i / 10 < 5).collect();
    let by_columns = no_shadow_baseline(&truth, &columns).unwrap();
    let by_rows = no_shadow_baseline(&truth, &rows).unwrap();
    near(by_columns.pixel_match, 0.4);
    near(by_rows.pixel_match, 0.7);
    assert!((by_columns.flip - by_rows.flip).abs() > 0.05);
}

#[test]
fn no_shadow_at_all_matches_every_lit_pixel() {
    let score = no_shadow_baseline(&halves(), &ALL).unwrap();
    near(score.pixel_match, 0.5);
    near(score.rmse, 0.5_f64.sqrt());
    assert_eq!((score.leak, score.over_darkening, score.acne), (Some(1.0), Some(0.0), Some(0.0)));
}

#[test]
fn what_a_truth_does_not_have_is_none() {
    let lit = GrayImage::filled(20, 10, 1.0);
    let score = score(&lit, &lit, &ALL).unwrap();
    assert_eq!((score.leak, score.pixel_match_near_edges), (None, None));
    assert_eq!(score.acne, Some(0.0));
    let json = serde_json::to_string(&score).unwrap();
    assert!(json.contains("\"psnr\":null"), "{json}");
}

#[test]
fn nan_is_an_error_that_names_the_pixel() {
    let mut test = halves();
    test.values[3 * 20 + 7] = f32::NAN;
    let error = score(&test, &halves(), &ALL).unwrap_err();
    assert!(matches!(error, ScoreError::Value { image: "test", x: 7, y: 3, .. }), "{error}");
    assert!(error.to_string().contains("column 7, row 3"));
}

#[test]
fn values_that_are_no_visibility_are_refused() {
    let mut truth = halves();
    truth.values[0] = 1.5;
    assert!(matches!(score(&halves(), &truth, &ALL), Err(ScoreError::Value { image: "truth", .. })));
}

#[test]
fn other_sizes_and_empty_masks_are_refused() {
    let transposed = GrayImage::from_fn(10, 20, |_, _| 1.0);
    assert!(matches!(score(&transposed, &halves(), &ALL), Err(ScoreError::Size { .. })));
    assert!(matches!(score(&halves(), &halves(), &ALL[1..]), Err(ScoreError::Size { .. })));
    assert_eq!(score(&halves(), &halves(), &[false; 200]), Err(ScoreError::NothingShadowable(200)));
}

#[test]
fn means_over_few_pixels_are_not_told() {
    // Deep shadow is columns 0..=6 of 10 rows, deep light as many.
    let few = score(&halves(), &halves(), &ALL).unwrap();
    assert_eq!((few.deep_shadow_pixels, few.deep_lit_pixels), (70, 70));
    assert_eq!((few.reliable().leak, few.reliable().over_darkening), (None, None));
    assert_eq!((few.reliable().acne, few.reliable().rmse), (few.acne, few.rmse));
    // Of twenty columns of shadow and sixty of light, in 20 rows, 17 and 57 are deep.
    let wide = GrayImage::from_fn(80, 20, |x, _| if x < 20 { 0.0 } else { 1.0 });
    let some = score(&wide, &wide, &[true; 1600]).unwrap();
    assert_eq!((some.deep_shadow_pixels, some.deep_lit_pixels), (17 * 20, 57 * 20));
    assert_eq!((some.reliable().leak, some.reliable().over_darkening), (None, Some(0.0)));
}
