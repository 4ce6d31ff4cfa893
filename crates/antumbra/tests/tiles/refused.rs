//! What tiles and lights may not be, and what is told of them.

use crate::casters::{LAYER, LAYERS, alone, ask, options, placed, seen, tiles};
use antumbra::{
    Capabilities, Options, Placed, PrepareError, ShaderText, ShadowMap, Size, Technique, Tile, Unsupported,
    technique,
};
use antumbra_testing::{Gpu, ask::Receiver, broken::Broken};

fn map(gpu: &Gpu, spec: &str, options: Options) -> ShadowMap {
    ShadowMap::new(&gpu.device, technique::parse(spec).unwrap().as_ref(), options).unwrap()
}

/// Each is told with the view, the tile, and what is allowed; and the tiles before stay.
pub(crate) fn unfit_tiles(gpu: &Gpu) {
    use PrepareError as E;
    let tile = |layer, x, y, width, height| Tile { layer, origin: [x, y], size: Size { width, height } };
    let good = tile(0, 0, 0, 64, 64);
    let mut flat = map(gpu, "pcf", options(gpu, LAYER).views(3).tiled(LAYERS));
    let mut mips = map(gpu, "vsm", options(gpu, LAYER).views(3).tiled(LAYERS));
    type Good = fn(&PrepareError) -> bool;
    let cases: [(bool, Tile, Good, &str); 8] = [
        (false, tile(0, 64, 0, 0, 8), |e| matches!(e, E::EmptyTile { view: 1, .. }), "at least 1"),
        (false, tile(2, 0, 0, 8, 8), |e| matches!(e, E::TileOutside { view: 1, .. }), "layers 0 to 1"),
        (false, tile(0, 185, 0, 8, 8), |e| matches!(e, E::TileOutside { .. }), "192×128"),
        (false, tile(0, u32::MAX, 0, u32::MAX, 8), |e| matches!(e, E::TileOutside { .. }), "192×128"),
        (
            false,
            tile(0, 63, 63, 8, 8),
            |e| matches!(e, E::TilesOverlap { view: 1, other: 0, .. }),
            "views[0]",
        ),
        (true, tile(0, 68, 0, 8, 8), |e| matches!(e, E::TileUnaligned { step: 8, .. }), "multiples of 8"),
        (true, tile(0, 64, 96, 64, 1), |e| matches!(e, E::TileOutside { step: 64, .. }), "64 texels along"),
        (true, tile(1, 0, 124, 4, 8), |e| matches!(e, E::TileOutside { step: 8, .. }), "8 texels along"),
    ];
    for (with_mips, wrong, is_good, says) in cases {
        let shadows = if with_mips { &mut mips } else { &mut flat };
        shadows.prepare_tiles(&gpu.queue, &placed(&[good])).unwrap();
        let views = [seen(good.size).at(good), seen(LAYER).at(wrong)];
        let error = shadows.prepare_tiles(&gpu.queue, &views).unwrap_err();
        assert!(is_good(&error), "{wrong}: {error:?}");
        assert!(
            error.to_string().contains(says) && error.to_string().contains(&format!("{wrong}")),
            "{error}"
        );
        assert_eq!(shadows.tiles(), [good]);
    }
    // The coarsest level of a flat tile covers what lies below it.
    let below = [tile(0, 64, 64, 64, 1), tile(0, 64, 66, 2, 2)];
    let error = mips.prepare_tiles(&gpu.queue, &placed(&below)).unwrap_err();
    assert!(matches!(error, E::TilesOverlap { view: 1, other: 0, .. }), "{error:?}");
    flat.prepare_tiles(&gpu.queue, &placed(&below)).unwrap();
    // Without mip levels the same lie one beside the other.
    let thin = [tile(0, 64, 0, 64, 1), tile(0, 64, 1, 64, 1), tile(0, 68, 2, 9, 8)];
    flat.prepare_tiles(&gpu.queue, &placed(&thin)).unwrap();
    let error = mips.prepare_tiles(&gpu.queue, &placed(&thin[..2])).unwrap_err();
    assert!(matches!(error, E::TileUnaligned { view: 1, step: 64, .. }), "{error:?}");
    let untiled = map(gpu, "pcf", options(gpu, LAYER).views(3)).prepare_tiles(&gpu.queue, &placed(&thin));
    let error = untiled.unwrap_err();
    assert!(
        matches!(error, E::Untiled { view: 0 }) && error.to_string().contains("Options::tiled"),
        "{error}"
    );
}

/// WGSL that never asks where views lie.
pub(crate) fn techniques(gpu: &Gpu) {
    let plain = Broken::saying("hard", "//! needs uphill tile", "//! needs uphill")
        .with(|d| d.wgsl = d.wgsl.replace("tile_size(view)", "vec2f(textureDimensions(casters))").into())
        .with(|d| d.wgsl = d.wgsl.replace("tile_uv(view, centre), tile_layer(view)", "centre, view").into());
    ShadowMap::new(&gpu.device, &plain, options(gpu, LAYER)).unwrap();
    let tiled = options(gpu, LAYER).tiled(1);
    let error = ShadowMap::new(&gpu.device, &plain, tiled.clone()).unwrap_err();
    assert_eq!(error, Unsupported::Tiles { technique: "hard".into() });
    assert!(error.to_string().contains("tile_layer"), "{error}");
    let text = ShaderText::receiver(&plain, &Capabilities::full(), &tiled, 0);
    assert_eq!(text.unwrap_err(), error);
    let none = ShadowMap::new(&gpu.device, &plain, options(gpu, LAYER).lights(0)).unwrap_err();
    assert_eq!(none, Unsupported::Lights);
    let layers = technique::parse("pcf").unwrap();
    for tiled in [
        options(gpu, LAYER).tiled(0),
        options(gpu, LAYER).tiled(1 << 20),
        options(gpu, LAYER).views(0).tiled(1),
    ] {
        let error = ShadowMap::new(&gpu.device, layers.as_ref(), tiled).unwrap_err();
        assert!(matches!(error, Unsupported::Layers { .. }), "{error}");
    }
}

/// A light sees its own views alone; one without views, or that is none, lights everything.
pub(crate) fn lights(gpu: &Gpu) {
    let technique = technique::parse("pcf").unwrap();
    let all = tiles();
    let mut shadows = map(gpu, "pcf", options(gpu, LAYER).views(5).lights(3).tiled(LAYERS));
    let views = placed(&all);
    let casters = crate::casters::Casters::new(
        gpu,
        technique.as_ref(),
        LAYER,
        &all.iter().copied().enumerate().collect::<Vec<_>>(),
    );
    casters.fill(gpu, &mut map(gpu, "pcf", options(gpu, LAYER).views(5).lights(5).tiled(LAYERS)), &views);
    // The second light has no view, the third the last three.
    shadows.prepare_lights(&gpu.queue, &[&views[..2], &[], &views[2..]]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let draw = |pass: &mut antumbra::CasterPass<'_>| {
        let crate::casters::Casters::Depth(painter) = &casters else { panic!("depth") };
        let index = pass.index();
        painter.draw(pass, index);
    };
    shadows.encode(&mut encoder, draw).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let receivers: Vec<Receiver> = (0..900)
        .map(|i| Receiver::point((i % 30) as f32 / 30.0 + 0.01, (i / 30) as f32 / 30.0 + 0.01, 0.6))
        .collect();
    let mut answers = Vec::new();
    for (light, first) in [(0, 0), (2, 2)] {
        let found = ask(gpu, &shadows, Some(light), &receivers);
        // Views of a light hold the same, so that the first of them that reaches so far answers.
        let expected = ask(gpu, &alone(gpu, technique.as_ref(), first, all[first].size), None, &receivers);
        let inside = |r: &&Receiver| (r.uv - 0.5).abs().max_element() < 0.4;
        let pairs = receivers.iter().zip(found.iter().zip(&expected));
        assert!(pairs.filter(|(r, _)| inside(r)).all(|(_, (f, e))| f == e), "light {light}");
        answers.push(found);
    }
    assert_ne!(answers[0], answers[1]);
    for light in [1, 3, 9] {
        assert!(ask(gpu, &shadows, Some(light), &receivers).iter().all(|v| *v == 1.0), "light {light}");
    }
    let error = shadows.prepare_lights(&gpu.queue, &[&views[..1]; 4]).unwrap_err();
    assert_eq!(error, PrepareError::TooManyLights { given: 4, max: 3 });
    let error = shadows.prepare_lights(&gpu.queue, &[&views, &views]).unwrap_err();
    assert_eq!(error, PrepareError::TooManyViews { given: 10, max: 5 });
}

/// Layers are counted, not views, in what is allocated and in what is said.
pub(crate) fn told(gpu: &Gpu) {
    let shadows = map(gpu, "vsm", options(gpu, LAYER).views(9).tiled(LAYERS));
    assert!(
        shadows
            .explain()
            .iter()
            .any(|line| line == "up to 9 views, each in a tile of 2 layers of 192×128 texels"),
        "{:?}",
        shadows.explain()
    );
    let item = |name: &str| shadows.memory().items.into_iter().find(|item| item.name == name).unwrap();
    assert_eq!([item("moments").layers, item("casters' depth").layers], [2, 1]);
    let exact = map(gpu, "exact", options(gpu, LAYER).views(9).tiled(LAYERS)).memory();
    assert!(exact.items.iter().any(|item| item.name == "A-buffer ranges" && item.layers == 4), "{exact:?}");
    let plain: &[Placed] = &[];
    map(gpu, "vsm", options(gpu, LAYER)).prepare_tiles(&gpu.queue, plain).unwrap();
    let _: &dyn Technique = shadows.technique();
}
