//! `antumbra render`.

use crate::{
    arguments::{Render, Show},
    scene, techniques,
};
use antumbra::technique::{self, Bias};
use antumbra_lab::{
    classes::{self, ClassShare},
    compare::{self, Contestant},
    files,
    gpu::Gpu,
    lighting::{Lighting, Pictures},
    plane::Plane,
    stage::Stage,
};
use antumbra_truth::{CameraRays, Tracer};
use anyhow::{Context, Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Render) -> Result<()> {
    let extension = arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    match (extension.as_str(), arguments.show) {
        ("png", _) | ("exr", Show::Visibility) => {}
        ("exr", Show::Picture | Show::Classes) => {
            bail!("EXR holds raw visibility: add --show visibility, or write a .png")
        }
        _ => bail!("{}: the output must end in .png or .exr", arguments.output.display()),
    }
    scene::check(&arguments.scene)?;
    let bias: Bias = arguments.bias.parse()?;
    let truth = arguments.technique == "truth";
    let techniques = match truth {
        true => Vec::new(),
        false => techniques::read(std::slice::from_ref(&arguments.technique), arguments.scene.kernel)?,
    };
    if techniques.len() > 1 {
        bail!("--technique {}: render takes one technique", arguments.technique);
    }
    if arguments.show == Show::Classes && techniques.iter().all(|t| t.classes().is_empty()) {
        bail!("--show classes: {} tells no kinds of pixels apart", arguments.technique);
    }
    let setting = scene::load(&arguments.scene)?;
    let gpu = Gpu::new()?;
    let mut stage = Stage::new(&gpu, &setting.geometry, &setting.camera, &setting.light, setting.resolution)?;
    let lighting = Lighting::new(&gpu, &stage);
    let contestants = match truth {
        true => Vec::new(),
        false => {
            let (geometry, light) = (&setting.geometry, &setting.light);
            let entries: Vec<_> = techniques.into_iter().map(|technique| (technique, bias)).collect();
            compare::enter_biased(&gpu, &mut stage, geometry, light, &entries, arguments.scene.size)?
                .0
                .contestants
        }
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    stage.encode_surfaces(&mut encoder, None);
    match contestants.first() {
        None => {
            let [width, height] = setting.resolution;
            let rays = CameraRays::new(&setting.camera, width, height)?;
            let hard = Tracer::new(&setting.geometry)?.hard(&rays, &setting.light);
            lighting.write_visibility(&gpu, &Plane::new(width, height, hard.values)?);
        }
        Some(contestant) => {
            contestant.encode(&mut encoder, &stage, &lighting)?;
        }
    }
    gpu.finish(encoder)?;
    for why in contestants.iter().filter_map(Contestant::invalid) {
        let _ = writeln!(io::stderr(), "warning: {} is invalid: {why}", arguments.technique);
    }
    let mut shares = Vec::new();
    let bytes = match (extension.as_str(), arguments.show) {
        ("exr", _) => lighting.read_visibility(&gpu)?.to_exr()?,
        (_, Show::Visibility) => lighting.read_visibility(&gpu)?.to_gray_png()?,
        (_, Show::Picture) => {
            let pictures = Pictures::new(&gpu, &stage, &lighting)?;
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            pictures.encode(&mut encoder);
            gpu.finish(encoder)?;
            pictures.read(&gpu)?.to_png()?
        }
        (_, Show::Classes) => {
            let contestant = contestants.first().context("no technique was named")?;
            let (bytes, counted) = tinted(&gpu, &stage, &lighting, contestant)?;
            shares = counted;
            bytes
        }
    };
    files::write_atomically(&arguments.output, &bytes).context("nothing was written")?;
    let out = &mut io::stdout();
    writeln!(out, "{}", arguments.output.display())?;
    for ClassShare { name, share, .. } in shares {
        writeln!(out, "{name}: {:.2} % of the pixels that see geometry", 100.0 * share)?;
    }
    Ok(())
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
