// Makes the module and the pipelines of every shader, each on a device that has just the features that the
// library asks for where it composes that text. Runs in Node and in browsers.

/// What browsers lack: how they refuse a shader for devices that have it, if they do, and why it is no use.
const NATIVE = {
  VERTEX_WRITABLE_STORAGE: {
    refusal: "cannot be used by vertex pipeline stage",
    why: "refused, as it must be: in browsers vertices do not write to buffers",
  },
  CONSERVATIVE_RASTERIZATION: { why: "taken, but pipelines of browsers cannot ask for it" },
};
/// Shaders at a time.
const TOGETHER = 64;
/// The limit that more colours in a pass need raised, and how far.
const COLOURS = { maxColorAttachmentBytesPerSample: 128 };

/// Devices by what they have.
class Devices {
  #gpu;
  #made = new Map();

  constructor(gpu) {
    this.#gpu = gpu;
  }

  /// A device with these features and limits, and no others. An adapter gives one device.
  with(requiredFeatures, requiredLimits) {
    const key = JSON.stringify([requiredFeatures, requiredLimits]);
    const make = async () => (await this.#gpu.requestAdapter()).requestDevice({ requiredFeatures, requiredLimits });
    if (!this.#made.has(key)) this.#made.set(key, make());
    return this.#made.get(key);
  }
}

/// The module of a text, or what is wrong with it.
async function compile(device, path, code) {
  device.pushErrorScope("validation");
  const module = device.createShaderModule({ code });
  // Scopes are a stack that all shaders of the device share: nothing may come between.
  const popped = device.popErrorScope();
  const { messages } = await module.getCompilationInfo();
  const error = await popped;
  const wrong = messages
    .filter((message) => message.type === "error")
    .map((m) => `${path}:${m.lineNum}:${m.linePos}: ${m.message}\n    ${code.split("\n")[m.lineNum - 1]?.trim()}`);
  return wrong.length || error ? { wrong: wrong.length ? wrong : [`${path}: ${error.message}`] } : { module };
}

function descriptor(module, constants, pipeline) {
  const stage = (entryPoint) => ({ module, entryPoint, constants });
  if (pipeline.compute) return { layout: "auto", compute: stage(pipeline.compute) };
  const buffers = pipeline.attributes.map(([shaderLocation, format]) => ({
    arrayStride: 16,
    attributes: [{ shaderLocation, format, offset: 0 }],
  }));
  const targets = pipeline.targets?.map((format) => ({ format }));
  const depth = { format: "depth32float", depthWriteEnabled: true, depthCompare: "less" };
  return {
    layout: "auto",
    vertex: { ...stage(pipeline.vertex), buffers },
    fragment: pipeline.fragment && { ...stage(pipeline.fragment), targets },
    depthStencil: pipeline.depth ? depth : undefined,
  };
}

/// What is wrong with a pipeline, if anything.
async function build(device, path, module, constants, pipeline) {
  try {
    const all = descriptor(module, constants, pipeline);
    await (pipeline.compute ? device.createComputePipelineAsync(all) : device.createRenderPipelineAsync(all));
    return [];
  } catch (error) {
    const { compute, vertex, fragment } = pipeline;
    const entries = [compute, vertex, fragment].filter(Boolean).join(" and ");
    return [`${path}: pipeline of ${entries}: ${error.message.trim().replaceAll("\n", "\n    ")}`];
  }
}

/// What is wrong with a shader of an index.
async function one(devices, adapter, tally, shader) {
  const lacking = shader.features.filter((feature) => !adapter.features.has(feature));
  const room = Object.entries(COLOURS).every(([limit, value]) => adapter.limits[limit] >= value);
  if (lacking.length) {
    lacking.forEach((what) => tally.lacking.set(what, (tally.lacking.get(what) ?? 0) + 1));
    return [];
  }
  const device = await devices.with(shader.features, shader.colours && room ? COLOURS : {});
  const { module, wrong = [] } = await compile(device, shader.path, shader.code);
  tally.shaders += 1;
  for (const feature of shader.native) tally.native.set(feature, (tally.native.get(feature) ?? 0) + 1);
  const refusal = shader.native.map((feature) => NATIVE[feature]?.refusal).find(Boolean);
  if (refusal) {
    // Listed as for other devices only: then a browser must say so.
    const other = wrong.filter((message) => !message.includes(refusal));
    return wrong.length ? other : [`${shader.path}: is listed as a shader that no browser takes, and is taken`];
  }
  if (!module) return wrong;
  if (shader.colours && !room) {
    tally.alone += 1;
    return [];
  }
  tally.pipelines += shader.pipelines.length;
  const make = (pipeline) => build(device, shader.path, module, shader.constants, pipeline);
  return (await Promise.all(shader.pipelines.map(make))).flat();
}

/// Checks `{ name, shaders }` sets of shaders and that `control` is refused. Returns lines for people, and
/// what is wrong.
export async function check(gpu, sets, control) {
  const adapter = await gpu.requestAdapter();
  if (!adapter) return { lines: [], wrong: ["no WebGPU adapter"] };
  const devices = new Devices(gpu);
  const tally = { shaders: 0, pipelines: 0, alone: 0, native: new Map(), lacking: new Map() };
  const [lines, wrong] = [[], []];
  const refused = await compile(await devices.with([], {}), control.path, control.code);
  if (refused.wrong) lines.push(`the control is refused, as it must be: ${refused.wrong[0].split("\n")[0]}`);
  else wrong.push(`${control.path}: must be refused, and is not: this check tells nothing`);
  for (const { name, shaders } of sets) {
    const before = wrong.length;
    for (let at = 0; at < shaders.length; at += TOGETHER) {
      const part = shaders.slice(at, at + TOGETHER).map((shader) => one(devices, adapter, tally, shader));
      wrong.push(...(await Promise.all(part)).flat());
    }
    if (!shaders.length) wrong.push(`${name}: no shaders`);
    lines.push(`${name}: ${shaders.length} shaders, ${wrong.length - before} errors`);
  }
  for (const [feature, count] of tally.native) {
    lines.push(`${count} are for devices with ${feature} alone: ${NATIVE[feature]?.why ?? "unknown to browsers"}`);
  }
  for (const [what, count] of tally.lacking) lines.push(`${count} not tried: this adapter lacks ${what}`);
  if (tally.alone) lines.push(`${tally.alone} without pipelines: this adapter lacks room for their colours`);
  lines.push(`${tally.shaders} shaders, ${tally.pipelines} pipelines, ${wrong.length} errors`);
  if (!tally.shaders) wrong.push("no shaders");
  return { lines, wrong };
}
