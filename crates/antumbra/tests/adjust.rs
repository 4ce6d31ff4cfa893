//! Settings of a map that lives.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{Depth, NoProbe, ShadowMap, Size, Technique, Unsupported, technique, technique::Bias};
use antumbra_testing::ask::{Random, Receiver, depth_layers, view, visibility};
use antumbra_testing::{Gpu, Trials};

const SIZE: Size = Size::square(32);

fn receivers() -> Vec<Receiver> {
    let mut random = Random::new(3);
    (0..512).map(|_| Receiver::point(random.unit(), random.unit(), random.unit())).collect()
}

fn depth(gpu: &Gpu) -> wgpu::Texture {
    depth_layers(gpu, SIZE, 1, |_, x, y| ((x / 5 * 7 + y / 5 * 13) % 41 + 2) as f32 / 44.0)
}

/// What the map answers after another frame.
fn answers(gpu: &Gpu, shadows: &mut ShadowMap) -> Vec<f32> {
    shadows.prepare(&gpu.queue, &[view(SIZE)]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode_filter(&mut encoder, &mut NoProbe);
    gpu.queue.submit([encoder.finish()]);
    visibility(gpu, shadows, &receivers())
}

fn made(gpu: &Gpu, technique: &dyn Technique, depth: &wgpu::Texture) -> ShadowMap {
    ShadowMap::from_depth(&gpu.device, technique, Depth::new(depth), SIZE).unwrap()
}

fn adjusted_maps_are_as_new(gpu: &Gpu) {
    let depth = depth(gpu);
    let pairs = [
        ("vsm", "vsm.reduction=0.4"),
        ("vsm.least_variance=0.01", "vsm.least_variance=0.0001,reduction=0.1"),
        ("csm", "csm.offset=0.3"),
        ("esm", "esm.c=40,epsilon=0.01"),
    ];
    for (before, after) in pairs {
        let [before, after] = [before, after].map(|spec| technique::parse(spec).unwrap());
        let mut shadows = made(gpu, before.as_ref(), &depth);
        let first = answers(gpu, &mut shadows);
        let group = shadows.bind_group().clone();
        shadows.adjust(after.as_ref()).unwrap();
        assert_eq!(&group, shadows.bind_group(), "the group stays");
        assert_eq!(technique::spec(shadows.technique()), technique::spec(after.as_ref()));
        let expected = answers(gpu, &mut made(gpu, after.as_ref(), &depth));
        let found = answers(gpu, &mut shadows);
        assert_eq!(found, expected);
        assert_ne!(found, first, "negative control");
    }
}

fn biases_are_taken(gpu: &Gpu) {
    let depth = depth(gpu);
    let mut shadows = made(gpu, &technique::Hard::default(), &depth);
    let first = answers(gpu, &mut shadows);
    let mut terms = technique::BiasTerms::NONE;
    terms.constant_texels = 3.0;
    shadows.set_bias(Bias::Fixed(terms)).unwrap();
    assert!(answers(gpu, &mut shadows).iter().sum::<f32>() > first.iter().sum::<f32>());
    terms.constant_texels = f32::NAN;
    assert!(shadows.set_bias(Bias::Fixed(terms)).unwrap_err().to_string().contains("constant_texels"));
}

fn what_needs_a_new_map_is_refused(gpu: &Gpu) {
    let depth = depth(gpu);
    let mut shadows = made(gpu, &technique::Vsm::default(), &depth);
    let first = answers(gpu, &mut shadows);
    for spec in ["vsm.kernel=9", "vsm.kernel=1,sampling=nearest", "esm", "hard"] {
        let error = shadows.adjust(technique::parse(spec).unwrap().as_ref()).unwrap_err();
        assert!(matches!(error, Unsupported::Fixed { .. }), "{error}");
        let message = error.to_string();
        assert!(message.contains("a map of vsm ") && message.contains(spec), "{message}");
    }
    let wrong = technique::Vsm { least_variance: -1.0, ..Default::default() };
    assert!(matches!(shadows.adjust(&wrong), Err(Unsupported::Setting(_))));
    assert_eq!(answers(gpu, &mut shadows), first, "nothing has changed");
}

fn main() {
    let mut trials = Trials::default();
    trials.add("adjusted maps are as new", adjusted_maps_are_as_new);
    trials.add("biases are taken", biases_are_taken);
    trials.add("what needs a new map is refused", what_needs_a_new_map_is_refused);
    trials.run();
}
