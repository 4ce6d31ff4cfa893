//! What all experiments share: scenes, pictures with every technique, truths, scores, races. All of
//! it is kept on disk ([`Cache`]), so that asking twice costs nothing.

use crate::{
    cache::{Cache, fingerprint, packed},
    raster::Raster,
    study::{File, Look, Moving, Shot, Study, StudyFile, Traced, TracedFile, Truth, ViewFacts},
};
use antumbra::{ShadowMap, Technique, technique, technique::Bias};
use antumbra_lab::{
    classes,
    compare::{self, Contestant, Entered, Progress},
    curve, flicker,
    gpu::Gpu,
    lighting::{Lighting, Lookup, Pictures},
    maps::{self, Sheet},
    metrics::{self, Score},
    motion::Path,
    plane::Plane,
    regions,
    results::{AdapterFacts, LeftOut, Refused, TimeResult},
    setting::{Setting, Setup},
    stage::Stage,
    timing::{self, Entrant},
};
use antumbra_scene::{Camera, procedural};
use anyhow::{Context, Result, bail};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::{cell::RefCell, collections::BTreeMap, sync::Arc};

/// Width of the light-space ideal's kernel where an experiment names none, texels.
const KERNEL: u32 = 5;

/// Shared services of all experiments.
pub struct Bench<'a> {
    gpu: Gpu,
    cache: Cache,
    scenes: RefCell<BTreeMap<&'static str, Setting>>,
    progress: &'a dyn Progress,
    /// Whether everything is made small, to see that it works rather than to measure.
    pub quick: bool,
    /// Fingerprint of the program.
    pub build: String,
}

impl std::fmt::Debug for Bench<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bench")
            .field("cache", &self.cache)
            .field("quick", &self.quick)
            .finish_non_exhaustive()
    }
}

/// The first spec that this program can read, if any.
#[must_use]
pub fn first_known<'s>(specs: &[&'s str]) -> Option<&'s str> {
    specs.iter().copied().find(|spec| technique::parse(spec).is_ok())
}

fn parse(specs: &[&str]) -> Result<Vec<Box<dyn Technique>>> {
    specs.iter().map(|spec| Ok(technique::parse(spec)?)).collect()
}

impl<'a> Bench<'a> {
    /// Opens the graphics device. Measurements are kept in `cache`.
    ///
    /// # Errors
    /// No adapter; an executable that cannot be read.
    pub fn new(cache: &std::path::Path, quick: bool, progress: &'a dyn Progress) -> Result<Self> {
        let gpu = Gpu::new()?;
        let adapter = compare::adapter_facts(&gpu);
        let program = std::env::current_exe().context("the path of this program")?;
        let program = std::fs::read(&program).with_context(|| program.display().to_string())?;
        let build = format!("{:032x}", fingerprint(&program));
        let adapter = serde_json::to_string(&adapter)?;
        let cache = Cache::new(cache, &format!("{} {build}", env!("CARGO_PKG_VERSION")), &adapter);
        Ok(Self { gpu, cache, scenes: RefCell::default(), progress, quick, build })
    }

    /// What the graphics device says of itself.
    #[must_use]
    pub fn adapter(&self) -> AdapterFacts {
        compare::adapter_facts(&self.gpu)
    }

    /// A scene at a resolution, a quarter of that each way in a quick run.
    #[must_use]
    pub fn shot(&self, scene: &'static str, resolution: [u32; 2]) -> Shot {
        let scale = if self.quick { 4 } else { 1 };
        Shot { scene, distance: 1.0, cascades: 1, resolution: resolution.map(|n| (n / scale).max(1)) }
    }

    /// A map's size, a quarter of it in a quick run.
    #[must_use]
    pub fn map(&self, texels: u32) -> u32 {
        if self.quick { (texels / 4).max(32) } else { texels }
    }

    /// Frames to time, one in a quick run.
    #[must_use]
    pub fn rounds(&self, frames: u32) -> u32 {
        if self.quick { 1 } else { frames }
    }

    /// A scene as a shot sees it, with maps of `map` texels.
    fn setting(&self, shot: &Shot, map: u32) -> Result<Setting> {
        let name = shot.scene;
        let known = self.scenes.borrow().get(name).cloned();
        let own = match known {
            Some(setting) => setting,
            None => {
                self.progress.step(&format!("build the scene {name}"));
                let entry =
                    procedural::by_name(name).with_context(|| format!("no scene is called {name}"))?;
                let scene = entry.scene(procedural::Procedural::DEFAULT_SEED);
                let setting = Setting {
                    name: name.into(),
                    geometry: Arc::new(scene.flatten()),
                    camera: scene.main_camera(),
                    light: scene.main_light(),
                    resolution: shot.resolution,
                    map_size: map,
                    kernel: KERNEL,
                    cascades: 1,
                    bias: Bias::Auto,
                };
                self.scenes.borrow_mut().insert(name, setting.clone());
                setting
            }
        };
        let Camera { position, target, .. } = own.camera;
        let camera = Camera { position: target + (position - target) * shot.distance, ..own.camera };
        let Shot { resolution, cascades, .. } = *shot;
        Ok(Setting { camera, resolution, map_size: map, cascades, ..own })
    }

    /// Draws a shot with every technique of `specs`, maps being `map` texels wide.
    ///
    /// # Errors
    /// Unknown techniques or settings; [`Refused`] if the device or the scene refuses any of them.
    pub fn study(&self, shot: Shot, map: u32, specs: &[&str]) -> Result<Study> {
        self.study_biased(shot, map, specs, Bias::Auto)
    }

    /// The same with one bias for all techniques instead of each one's own.
    ///
    /// # Errors
    /// As [`study`](Self::study); a bias that is not finite.
    pub fn study_biased(&self, shot: Shot, map: u32, specs: &[&str], bias: Bias) -> Result<Study> {
        let study = self.drawn(shot, map, specs, bias)?;
        if study.left_out.is_empty() { Ok(study) } else { Err(Refused(study.left_out).into()) }
    }

    /// The same with each technique's own bias, without those of `specs` that cannot be drawn: what
    /// [`Study::left_out`] holds.
    ///
    /// # Errors
    /// Unknown techniques or settings; [`Refused`] where none is left.
    pub fn possible(&self, shot: Shot, map: u32, specs: &[&str]) -> Result<Study> {
        self.drawn(shot, map, specs, Bias::Auto)
    }

    fn drawn(&self, shot: Shot, map: u32, specs: &[&str], bias: Bias) -> Result<Study> {
        let key = ("study", shot, map, specs, bias.to_string());
        let StudyFile { looks, left_out, views } =
            self.cache.memo(&key, || self.draw(&shot, map, specs, bias))?;
        let key = serde_json::to_string(&key)?;
        Ok(Study { shot, map, looks, left_out, views, key })
    }

    fn draw(&self, shot: &Shot, map: u32, specs: &[&str], bias: Bias) -> Result<StudyFile> {
        let gpu = &self.gpu;
        let setting = Setting { bias, ..self.setting(shot, map)? };
        self.progress.step(&format!("prepare {} techniques on {}", specs.len(), shot.scene));
        let Setup { stage, lighting, contestants, left_out, views } = setting.set_up(gpu, &parse(specs)?)?;
        let (contestants, left_out) = sound(Entered { contestants, left_out });
        let pictures = Pictures::new(gpu, &stage, &lighting)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        stage.encode_surfaces(&mut encoder, None);
        gpu.finish(encoder)?;
        let mut looks = Vec::new();
        for (i, contestant) in contestants.iter().enumerate() {
            let spec = specs[contestant.entry];
            self.progress.step(&format!("draw {spec} on {}", shot.scene));
            self.progress.share(i as f32 / specs.len() as f32);
            looks.push(look(gpu, &stage, (&lighting, &pictures), contestant, spec)?);
        }
        Ok(StudyFile { looks, left_out, views: views.iter().map(ViewFacts::of).collect() })
    }

    /// Traces what a study's pictures ought to be. The scene's tree of triangles is built once for all
    /// that are not known yet.
    ///
    /// # Errors
    /// A lost device.
    pub fn truths(&self, study: &Study, truths: &[Truth]) -> Result<Vec<Traced>> {
        let setting = self.setting(&study.shot, study.map)?;
        let light = &setting.light;
        let mut tracer = None;
        let [width, height] = setting.resolution;
        let mut traced = Vec::new();
        for truth in truths {
            let views = matches!(truth, Truth::LightSpace(_)).then_some((study.map, &study.views));
            let key = ("truth", study.shot, truth, views);
            let file = self.cache.memo(&key, || {
                self.progress.step(&format!("trace rays: {}, {}", study.shot.scene, name(*truth)));
                let tracer = match &mut tracer {
                    Some(tracer) => tracer,
                    none => none.insert(setting.tracer()?),
                };
                let rays = setting.rays()?;
                let report = |share| self.progress.share(share);
                let seen = match truth {
                    Truth::Hard => tracer.hard(&rays, light),
                    Truth::LightSpace(kernel) => {
                        let maps = setting.map_views(&study.views(), *kernel)?;
                        let kernel = compare::ideal_kernel(*kernel)?;
                        tracer.light_space_ideal(&rays, light, &kernel, &maps, &report)
                    }
                    Truth::ScreenSpace(grid) => tracer.supersampled(&rays, light, *grid, &report),
                };
                let plane = Plane::new(width, height, seen.values.clone())?;
                Ok(TracedFile {
                    picture: self.shade(&setting, &plane)?,
                    values: seen.values,
                    shadowable: seen.shadowable.into_iter().map(u8::from).collect(),
                })
            })?;
            traced.push(Traced {
                plane: Plane::new(width, height, file.values)?,
                shadowable: file.shadowable.into_iter().map(|s| s != 0).collect(),
                picture: file.picture,
                key: serde_json::to_string(&key)?,
            });
        }
        Ok(traced)
    }

    /// The picture that a given visibility makes.
    fn shade(&self, setting: &Setting, visibility: &Plane) -> Result<Raster> {
        let stage = setting.stage(&self.gpu)?;
        let lighting = Lighting::new(&self.gpu, &stage);
        lighting.write_visibility(&self.gpu, visibility);
        let pictures = Pictures::new(&self.gpu, &stage, &lighting)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        pictures.encode(&mut encoder);
        self.gpu.finish(encoder)?;
        Ok(pictures.read(&self.gpu)?.into())
    }

    /// Scores a technique of a study against one of its truths, over the pixels that can be in shadow
    /// or, where `among` names a mask, over those of them that it holds.
    ///
    /// # Errors
    /// A spec that is not in the study; a mask without any such pixel.
    pub fn score(
        &self,
        study: &Study,
        spec: &str,
        truth: &Traced,
        among: Option<(&str, &[bool])>,
    ) -> Result<Score> {
        let key = ("score", &study.key, spec, &truth.key, among.map(|(name, _)| name));
        self.cache.memo(&key, || {
            let both = |(a, b): (&bool, &bool)| *a && *b;
            let mask: Vec<bool> = match among {
                Some((_, among)) => truth.shadowable.iter().zip(among).map(both).collect(),
                None => truth.shadowable.clone(),
            };
            let score = metrics::score(&study.look(spec)?.visibility()?, &truth.plane, &mask);
            score.with_context(|| format!("{spec} on {}", study.shot.scene))
        })
    }

    /// Pixels of a study where techniques are known to differ, by name: see [`regions::regions`]; `near`
    /// is a share of the depth range.
    ///
    /// # Errors
    /// A scene that cannot be traced.
    pub fn regions(&self, study: &Study, near: f64) -> Result<BTreeMap<String, Vec<bool>>> {
        #[derive(Serialize, Deserialize)]
        struct Mask(#[serde(with = "packed")] Vec<u8>);
        let key = ("regions", study.shot, study.map, &study.views, near);
        let masks: BTreeMap<String, Mask> = self.cache.memo(&key, || {
            let setting = self.setting(&study.shot, study.map)?;
            self.progress.step(&format!("trace rays: {}, regions", study.shot.scene));
            let (tracer, rays) = (setting.tracer()?, setting.rays()?);
            let maps = setting.map_views(&study.views(), setting.kernel)?;
            let shadowable = tracer.hard(&rays, &setting.light).shadowable;
            let near = |point: DVec3| near * f64::from(maps.view(point).depth_world);
            let hits = tracer.primary(&rays);
            let found = regions::regions(&tracer, &hits, &shadowable, &setting.light, &near);
            let mask =
                |r: regions::Region| (r.name.into(), Mask(r.pixels.into_iter().map(u8::from).collect()));
            Ok(found.into_iter().map(mask).collect())
        })?;
        Ok(masks.into_iter().map(|(name, m)| (name, m.0.into_iter().map(|v| v != 0).collect())).collect())
    }

    /// Times frames of all `entrants`, each a map's size and a spec, in turns, so that their ratios can
    /// be trusted. The spec `none` shades without shadows.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn race(&self, shot: Shot, entrants: &[(u32, &str)], rounds: u32) -> Result<Vec<TimeResult>> {
        if rounds == 0 {
            bail!("a race of no rounds");
        }
        self.cache.memo(&("race", shot, entrants, rounds), || {
            let gpu = &self.gpu;
            self.progress.step(&format!("prepare {} entrants on {}", entrants.len(), shot.scene));
            let setting = self.setting(&shot, 1)?;
            let stage = setting.stage(gpu)?;
            let lighting = Lighting::new(gpu, &stage);
            let mut groups: BTreeMap<u32, Vec<&str>> = BTreeMap::new();
            for (map, spec) in entrants.iter().filter(|e| e.1 != "none") {
                groups.entry(*map).or_default().push(spec);
            }
            let mut ready: BTreeMap<u32, std::vec::IntoIter<Contestant>> = BTreeMap::new();
            for (map, specs) in groups {
                let sized = Setting { map_size: map, ..setting.clone() };
                let entries = sized.entries(&parse(&specs)?);
                let (entered, _) = sized.enter(gpu, &stage, &entries)?;
                let (contestants, left_out) = sound(entered);
                if !left_out.is_empty() {
                    return Err(Refused(left_out).into());
                }
                ready.insert(map, contestants.into_iter());
            }
            let unshadowed = Lookup::unshadowed(gpu, &stage);
            let runners: Vec<Option<Contestant>> = entrants
                .iter()
                .map(|(map, spec)| if *spec == "none" { None } else { ready.get_mut(map)?.next() })
                .collect();
            let none = Entrant { shadows: None, lookup: &unshadowed };
            let runners: Vec<Entrant<'_>> =
                runners.iter().map(|r| r.as_ref().map_or(none, Contestant::entrant)).collect();
            self.progress.step(&format!("time {} entrants on {}", entrants.len(), shot.scene));
            timing::race(gpu, &stage, &lighting, &runners, rounds, &|share| self.progress.share(share))
        })
    }

    /// Moves camera and light of a scene along a path of `frames`, traces the first `until` of them, and
    /// says how `specs` flicker. A quick run takes the whole path in 4 frames, a part of it in 3.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn moving(
        &self,
        shot: Shot,
        path: Path,
        [frames, until]: [u32; 2],
        map: u32,
        specs: &[&str],
    ) -> Result<Moving> {
        let [frames, until] = match (self.quick, until < frames) {
            (true, true) => [frames, 3],
            (true, false) => [4, 4],
            (false, _) => [frames, until],
        };
        self.cache.memo(&("moving", shot, path.name(), [frames, until], map, specs), || {
            let request = flicker::Request {
                setting: self.setting(&shot, map)?,
                path,
                frames,
                until,
                techniques: parse(specs)?,
                stride: 8,
                grid: 4,
                command: Vec::new(),
            };
            let flicker::Outcome { results, images } = flicker::measure(&self.gpu, &request, self.progress)?;
            Ok(Moving {
                results,
                images: images.into_iter().map(|(name, file)| (name, File(file))).collect(),
            })
        })
    }

    /// What [`curve::visibility`] answers to a caster at the depth `caster`.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn curve(&self, spec: &str, caster: f32, receivers: &[f32]) -> Result<Vec<f32>> {
        self.cache.memo(&("curve", spec, caster, receivers), || {
            self.progress.step(&format!("curve of {spec}"));
            curve::visibility(&self.gpu, technique::parse(spec)?.as_ref(), caster, receivers)
        })
    }

    /// What [`curve::edge`] answers across the edge of a caster.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn edge(&self, spec: &str, positions: &[f32]) -> Result<Vec<f32>> {
        self.cache.memo(&("edge", spec, positions), || {
            self.progress.step(&format!("edge with {spec}"));
            curve::edge(&self.gpu, technique::parse(spec)?.as_ref(), positions)
        })
    }

    /// Depth and every channel of a technique's filtered maps, on one sheet.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn sheet(&self, shot: Shot, map: u32, spec: &str) -> Result<Raster> {
        self.cache.memo(&("sheet", shot, map, spec), || {
            let gpu = &self.gpu;
            self.progress.step(&format!("maps of {spec} on {}", shot.scene));
            let setup = self.setting(&shot, map)?.set_up(gpu, &parse(&[spec])?)?;
            let Setup { stage, contestants, views, .. } = setup;
            let contestant = contestants.first().context("no technique")?;
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let shadows = &contestant.shadows;
            shadows.encode(&mut encoder, |pass| stage.draw_casters(&contestant.casters, pass))?;
            gpu.finish(encoder)?;
            let mut sheet = Sheet::default();
            for (number, view) in views.iter().enumerate() {
                let name = maps::cascade_prefix(&views, number) + "depth";
                sheet.add(&maps::depth(gpu, &stage, view, [map; 2], &name)?);
            }
            maps::pictures(gpu, shadows, 0, &mut |picture| {
                sheet.add(&picture);
                Ok(())
            })?;
            Ok(sheet.image().into())
        })
    }
}

/// Techniques that can be trusted, and all others with the reasons.
fn sound(entered: Entered) -> (Vec<Contestant>, Vec<LeftOut>) {
    let Entered { contestants, mut left_out } = entered;
    let (invalid, sound): (Vec<_>, Vec<_>) = contestants.into_iter().partition(|c| c.invalid().is_some());
    left_out.extend(invalid.iter().filter_map(|c| {
        Some(LeftOut { spec: technique::spec(c.shadows.technique()), reason: c.invalid()? })
    }));
    (sound, left_out)
}

/// Draws one technique on the surfaces that the stage already holds.
fn look(
    gpu: &Gpu,
    stage: &Stage,
    (lighting, pictures): (&Lighting, &Pictures),
    contestant: &Contestant,
    spec: &str,
) -> Result<Look> {
    let shadows: &ShadowMap = &contestant.shadows;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    contestant.encode(&mut encoder, stage, lighting)?;
    pictures.encode(&mut encoder);
    gpu.finish(encoder)?;
    let visibility = lighting.read_visibility(gpu)?;
    let picture = pictures.read(gpu)?;
    let numbers = contestant.read_classes(gpu, stage, lighting)?;
    let known = shadows.technique().classes();
    let tinted = match &numbers {
        Some(numbers) => Some(classes::picture(&visibility, numbers, known)?.into()),
        None => None,
    };
    Ok(Look {
        spec: spec.into(),
        title: shadows.technique().page().title.into(),
        picture: picture.into(),
        visibility: visibility.values,
        tinted,
        classes: numbers.map(|numbers| classes::shares(&numbers, known)).unwrap_or_default(),
        memory: compare::memory(&shadows.memory()),
        work: compare::work(shadows),
    })
}

fn name(truth: Truth) -> String {
    match truth {
        Truth::Hard => "hard truth".into(),
        Truth::LightSpace(kernel) => format!("light-space ideal of {kernel}×{kernel}"),
        Truth::ScreenSpace(grid) => format!("screen-space ideal of {grid}×{grid}"),
    }
}
