//! `antumbra render`.

use crate::{
    arguments::{Render, Show},
    scene, techniques,
};
use antumbra::{Capabilities, Technique};
use antumbra_lab::{
    cascades,
    classes::ClassShare,
    files,
    gpu::{self, Gpu},
    image::GrayImage,
    map_views::MapViews,
    prepared::Prepared,
    progress::NoProgress,
    report::significant,
    session::Session,
    truth::{TracedShot, Truth},
};
use anyhow::{Context, Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Render) -> Result<()> {
    let techniques = checked(arguments)?;
    let shot = scene::load(&arguments.scene)?;
    let gpu = gpu::open()?;
    let session = Session::new(&gpu, &shot, &techniques)?;
    let visibility = match session.prepared().first() {
        None => TracedShot::new(&shot)?.trace(Truth::Hard, &[], &NoProgress)?.image,
        Some(prepared) => session.draw_and_ask(prepared)?,
    };
    for why in session.prepared().iter().filter_map(Prepared::invalid) {
        let _ = writeln!(io::stderr(), "warning: {} is invalid: {why}", arguments.technique);
    }
    let (bytes, lines) = shown(&gpu, &session, &visibility, arguments)?;
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
    let described = techniques.iter().map(|t| t.describe(&Capabilities::full()));
    let classifies = described.flatten().any(|described| !described.classes.is_empty());
    if arguments.show == Show::Classes && !classifies {
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
fn shown(
    gpu: &Gpu,
    session: &Session<'_>,
    visibility: &GrayImage,
    arguments: &Render,
) -> Result<(Vec<u8>, Vec<String>)> {
    let mut lines = Vec::new();
    let bytes = match (extension(arguments).as_str(), arguments.show) {
        ("exr", _) => visibility.to_exr()?,
        (_, Show::Visibility) => visibility.to_gray_png()?,
        (_, Show::Picture) => session.picture_of(visibility)?.to_png()?,
        (_, Show::Classes) => {
            let prepared = first(session)?;
            let classes = session.classes(prepared, visibility)?;
            let classes = classes.with_context(|| format!("{} has no classes", arguments.technique))?;
            for ClassShare { name, share, .. } in classes.shares {
                lines.push(format!("{name}: {:.2} % of the pixels that see geometry", 100.0 * share));
            }
            classes.picture.to_png()?
        }
        (_, Show::Cascades) => {
            let (shot, views) = (session.shot(), session.views());
            let reach = first(session)?.shadows.description().filter_radius_texels;
            let maps = MapViews::reaching(views, shot.map_size, reach.into())?;
            let pixels = cascades::pixels(gpu, session.scene(), &shot.camera, &maps)?;
            let shares = cascades::shares(&pixels, views.len());
            for (number, (share, view)) in shares.iter().zip(views).enumerate() {
                let (share, texel) = (100.0 * share, significant(view.texel_world.into()));
                lines.push(format!(
                    "cascade {number}, texels of {texel}: {share:.2} % of the pixels that see geometry"
                ));
            }
            cascades::tint(&session.picture_of(visibility)?, &pixels)?.to_png()?
        }
    };
    Ok((bytes, lines))
}

fn first<'s>(session: &'s Session<'_>) -> Result<&'s Prepared> {
    session.prepared().first().context("no technique was named")
}
