//! `antumbra curve`.

use crate::arguments::Curve;
use antumbra::{Filter, Technique, technique};
use antumbra_lab::{
    chart::{self, Panel},
    curve, files, gpu, specs,
};
use anyhow::{Context, Result, bail};
use serde::Serialize;
use std::io::{self, Write};

const X_LABEL: &str = "d - z, as a share of the light's depth range";
const Y_LABEL: &str = "visibility, 0 in shadow, 1 lit";

pub(crate) fn run(arguments: &Curve) -> Result<()> {
    let extension = arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    if !["svg", "png"].contains(&extension.as_str()) {
        bail!("{}: the output must end in .svg or .png", arguments.output.display());
    }
    let behind = places(arguments)?;
    let groups = arguments.techniques.split(|spec| spec == "/").map(|specs| {
        // All texels are alike here, so that the width of the kernel does not matter.
        let techniques = specs::techniques(specs, Filter::default().kernel)?;
        if techniques.is_empty() {
            bail!("a panel is empty: name a technique before and after each /");
        }
        Ok(techniques)
    });
    let groups: Vec<Vec<Box<dyn Technique>>> = groups.collect::<Result<_>>()?;
    let gpu = gpu::open()?;
    let depths: Vec<f32> = behind.iter().map(|b| (arguments.caster + b).clamp(0.0, 1.0)).collect();
    let one = |technique: &dyn Technique| -> Result<chart::Curve> {
        let answers = curve::visibility(&gpu, technique, arguments.caster, &depths)?;
        let points = behind.iter().zip(answers).map(|(x, y)| [f64::from(*x), f64::from(y)]).collect();
        Ok(chart::Curve { name: technique::spec(technique), points })
    };
    let ends = [behind.first(), behind.last()].map(|x| x.map_or(0.0, |x| f64::from(*x)));
    let panels = groups.iter().map(|group| {
        Ok(Panel {
            curves: group.iter().map(|t| one(t.as_ref())).collect::<Result<_>>()?,
            x: ends,
            y: [-0.05, 1.05],
            x_label: X_LABEL.into(),
            y_label: Y_LABEL.into(),
        })
    });
    let panels: Vec<Panel> = panels.collect::<Result<_>>()?;
    let bytes = match extension.as_str() {
        "png" => chart::png(&panels)?,
        _ => chart::svg(&panels).into_bytes(),
    };
    files::write_atomically(&arguments.output, &bytes).context("nothing was written")?;
    let out = &mut io::stdout();
    if arguments.json {
        writeln!(out, "{}", serde_json::to_string(&Values::new(arguments.caster, &panels))?)?;
    } else {
        writeln!(out, "{}", arguments.output.display())?;
    }
    Ok(())
}

/// d − z of every receiver.
fn places(arguments: &Curve) -> Result<Vec<f32>> {
    let (caster, points) = (arguments.caster, arguments.points);
    if !(0.0..=1.0).contains(&caster) {
        bail!("--caster {caster}: allowed are 0 to 1, shares of the light's depth range");
    }
    if !(2..=65536).contains(&points) {
        bail!("--points {points}: allowed are 2 to 65536");
    }
    let ends = || -> Option<[f32; 2]> {
        let (from, to) = arguments.range.split_once(',')?;
        let ends = [from.trim().parse().ok()?, to.trim().parse().ok()?];
        let room = -caster..=1.0 - caster;
        (ends[0] < ends[1] && ends.iter().all(|end| room.contains(end))).then_some(ends)
    };
    let [from, to] = ends().with_context(|| {
        format!(
            "--range {}: write two numbers from,to in rising order, for example -0.1,0.3; with a caster at \
             {caster} receivers can be {} to {} behind it",
            arguments.range,
            -caster,
            1.0 - caster
        )
    })?;
    let share = |i: u32| i as f32 / (points - 1) as f32;
    Ok((0..points).map(|i| from + (to - from) * share(i)).collect())
}

/// What `--json` prints. Depths are shares of the light's range; visibility is 0 in shadow, 1 lit.
#[derive(Debug, Serialize)]
struct Values<'a> {
    schema: &'static str,
    caster: f32,
    panels: Vec<Vec<CurveValues<'a>>>,
}

/// Receiver by receiver.
#[derive(Debug, Serialize)]
struct CurveValues<'a> {
    technique: &'a str,
    /// d − z.
    behind: Vec<f32>,
    visibility: Vec<f32>,
}

impl<'a> Values<'a> {
    fn new(caster: f32, panels: &'a [Panel]) -> Self {
        let curve = |curve: &'a chart::Curve| {
            let column = |axis: usize| curve.points.iter().map(|p| p[axis] as f32).collect();
            CurveValues { technique: &curve.name, behind: column(0), visibility: column(1) }
        };
        let panels = panels.iter().map(|panel| panel.curves.iter().map(curve).collect()).collect();
        Self { schema: "antumbra-curve/1", caster, panels }
    }
}
