//! `antumbra render`.

use crate::{
    arguments::{Render, Show},
    scene, techniques,
};
use antumbra::{Technique, technique};
use antumbra_lab::{
    cascades,
    classes::{self, ClassShare},
    compare::Contestant,
    files,
    gpu::Gpu,
    lighting::{Lighting, Pictures},
    plane::{Plane, Rgba8Image},
    report::significant,
    setting::{Setting, Setup},
    stage::Stage,
    views::MapViews,
};
use anyhow::{Context, Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Render) -> Result<()> {
    let techniques = checked(arguments)?;
    let setting = scene::load(&arguments.scene)?;
    let gpu = Gpu::new()?;
    let setup = setting.set_up(&gpu, &techniques)?;
    let Setup { stage, lighting, contestants, .. } = &setup;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    stage.encode_surfaces(&mut encoder, None);
    match contestants.first() {
        None => {
            let [width, height] = setting.resolution;
            let hard = setting.tracer()?.hard(&setting.rays()?, &setting.light);
            lighting.write_visibility(&gpu, &Plane::new(width, height, hard.values)?);
        }
        Some(contestant) => {
            contestant.encode(&mut encoder, stage, lighting)?;
        }
    }
    gpu.finish(encoder)?;
    for why in contestants.iter().filter_map(Contestant::invalid) {
        let _ = writeln!(io::stderr(), "warning: {} is invalid: {why}", arguments.technique);
    }
    let (bytes, lines) = shown(&gpu, &setting, &setup, arguments)?;
    files::write_atomically(&arguments.output, &bytes).context("nothing was written")?;
    let out = &mut io::stdout();
    writeln!(out, "{}", arguments.output.display())?;
    lines.iter().try_for_each(|line| writeln!(out, "{line}"))?;
    Ok(())
}

/// The technique, none for rays, if all that can be known beforehand is right.
fn checked(arguments: &Render) -> Result<Vec<Box<dyn Technique>>> {
    match (extension(arguments).as_str(), arguments.show) {
        ("png", _) | ("exr", Show::Visibility) => {}
        ("exr", Show::Picture | Show::Classes | Show::Cascades) => {
            bail!("EXR holds raw visibility: add --show visibility, or write a .png")
        }
        _ => bail!("{}: the output must end in .png or .exr", arguments.output.display()),
    }
    scene::check(&arguments.scene)?;
    let truth = arguments.technique == "truth";
    let kernel = arguments.scene.view.kernel;
    let techniques = match truth {
        true => Vec::new(),
        false => techniques::read(std::slice::from_ref(&arguments.technique), kernel)?,
    };
    if techniques.len() > 1 {
        bail!("--technique {}: render takes one technique", arguments.technique);
    }
    if arguments.show == Show::Classes && techniques.iter().all(|t| t.classes().is_empty()) {
        bail!("--show classes: {} tells no kinds of pixels apart", arguments.technique);
    }
    if arguments.show == Show::Cascades && truth {
        bail!("--show cascades: rays have none; name a technique with --technique");
    }
    Ok(techniques)
}

fn extension(arguments: &Render) -> String {
    arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase()
}

/// The file of what was drawn, and lines about it.
fn shown(gpu: &Gpu, setting: &Setting, setup: &Setup, arguments: &Render) -> Result<(Vec<u8>, Vec<String>)> {
    let Setup { stage, lighting, contestants, .. } = setup;
    let contestant = || contestants.first().context("no technique was named");
    let mut lines = Vec::new();
    let bytes = match (extension(arguments).as_str(), arguments.show) {
        ("exr", _) => lighting.read_visibility(gpu)?.to_exr()?,
        (_, Show::Visibility) => lighting.read_visibility(gpu)?.to_gray_png()?,
        (_, Show::Picture) => picture(gpu, stage, lighting)?.to_png()?,
        (_, Show::Classes) => {
            let (bytes, shares) = tinted(gpu, stage, lighting, contestant()?)?;
            for ClassShare { name, share, .. } in shares {
                lines.push(format!("{name}: {:.2} % of the pixels that see geometry", 100.0 * share));
            }
            bytes
        }
        (_, Show::Cascades) => {
            let reach = contestant()?.shadows.technique().reach_texels();
            let maps = MapViews::reaching(&setup.views, setting.map_size, reach.into())?;
            let pixels = cascades::pixels(gpu, stage, &setting.camera, &maps)?;
            let shares = cascades::shares(&pixels, setup.views.len());
            for (number, (share, view)) in shares.iter().zip(&setup.views).enumerate() {
                let (share, texel) = (100.0 * share, significant(view.texel_world.into()));
                lines.push(format!(
                    "cascade {number}, texels of {texel}: {share:.2} % of the pixels that see geometry"
                ));
            }
            cascades::tint(&picture(gpu, stage, lighting)?, &pixels)?.to_png()?
        }
    };
    Ok((bytes, lines))
}

/// The lit picture; what the stage's surfaces hold is lost.
fn picture(gpu: &Gpu, stage: &Stage, lighting: &Lighting) -> Result<Rgba8Image> {
    let pictures = Pictures::new(gpu, stage, lighting)?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pictures.encode(&mut encoder);
    gpu.finish(encoder)?;
    pictures.read(gpu)
}

/// Visibility with classes in colour, and their shares. The visibility buffer is filled.
fn tinted(
    gpu: &Gpu,
    stage: &Stage,
    lighting: &Lighting,
    contestant: &Contestant,
) -> Result<(Vec<u8>, Vec<ClassShare>)> {
    let technique = contestant.shadows.technique();
    let visibility = lighting.read_visibility(gpu)?;
    let numbers = contestant
        .read_classes(gpu, stage, lighting)?
        .with_context(|| format!("{} has no classes", technique::spec(technique)))?;
    let picture = classes::picture(&visibility, &numbers, technique.classes())?;
    Ok((picture.to_png()?, classes::shares(&numbers, technique.classes())))
}
