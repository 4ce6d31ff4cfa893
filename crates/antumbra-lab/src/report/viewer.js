"use strict";
// The slider: two images on one canvas, one view (zoom and pan) for both.

const byId = (id) => document.getElementById(id);
const store = JSON.parse(byId("images").textContent);
const decoded = new Map();
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** The bytes of an image of this report. */
function blob(name) {
  const text = atob(store[name]);
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  return new Blob([bytes], { type: "image/png" });
}

/** A decoded image with its pixels; the last twelve are kept. */
function image(name) {
  if (!decoded.has(name)) {
    const plain = { colorSpaceConversion: "none", premultiplyAlpha: "none" };
    const promise = createImageBitmap(blob(name), plain).then((bitmap) => {
      const canvas = document.createElement("canvas");
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
      const context = canvas.getContext("2d", { willReadFrequently: true });
      context.drawImage(bitmap, 0, 0);
      return { bitmap, context, width: bitmap.width, height: bitmap.height };
    });
    decoded.set(name, promise);
    if (decoded.size > 12) decoded.delete(decoded.keys().next().value);
  }
  return decoded.get(name);
}

const viewer = (() => {
  const canvas = byId("canvas");
  const context = canvas.getContext("2d");
  const handle = byId("handle");
  const selects = { left: byId("left"), right: byId("right") };
  const sides = { left: null, right: null };
  // Zoom is relative to the fitted image; the centre is in image pixels. The split is a share of
  // the canvas width.
  const view = { zoom: 1, x: 0, y: 0, split: 0.5 };
  let pointer = null;
  let frame = 0;
  let loading = 0;

  const size = () => {
    const shown = sides.left ?? sides.right;
    return shown ? [shown.width, shown.height] : [16, 9];
  };
  const fit = () => {
    const [w, h] = size();
    return Math.min(canvas.width / w, canvas.height / h);
  };
  const scale = () => fit() * view.zoom;
  const ratio = () => canvas.width / canvas.clientWidth;

  function draw() {
    frame = 0;
    const [w, h] = size();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const s = scale();
    const left = canvas.width / 2 - view.x * s;
    const top = canvas.height / 2 - view.y * s;
    const split = view.split * canvas.width;
    for (const [side, from, to] of [["left", 0, split], ["right", split, canvas.width]]) {
      if (!sides[side]) continue;
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, canvas.height);
      context.clip();
      context.imageSmoothingEnabled = s < 1;
      context.imageSmoothingQuality = "high";
      context.drawImage(sides[side].bitmap, left, top, w * s, h * s);
      context.restore();
    }
    const percent = Math.round(view.split * 100);
    handle.style.left = `${view.split * 100}%`;
    handle.setAttribute("aria-valuenow", percent);
    handle.setAttribute("aria-valuetext", `${percent} % left`);
    byId("zoom").value = view.zoom === 1 ? "fit" : `${Math.round(s * 100)} %`;
    canvas.style.touchAction = view.zoom === 1 ? "pan-y" : "none";
    readout();
  }
  const redraw = () => { frame ||= requestAnimationFrame(draw); };

  function resize() {
    const [w, h] = size();
    const width = canvas.clientWidth;
    // Not shown, as while the page is printed: there is nothing to fit into.
    if (width === 0) return;
    const height = Math.min(width * h / w, Math.max(window.innerHeight * 0.78, 240));
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    settle();
  }

  /** Keeps the image in sight: centred where it is smaller than the canvas, else covering it. */
  function settle() {
    const [w, h] = size();
    const s = scale();
    const keep = (centre, pixels, length) => {
      const half = length / 2 / s;
      return half * 2 >= pixels ? pixels / 2 : clamp(centre, half, pixels - half);
    };
    view.x = keep(view.x, w, canvas.width);
    view.y = keep(view.y, h, canvas.height);
    redraw();
  }

  /** Zooms by a factor; the point (px, py) of the canvas keeps its place. */
  function zoomBy(factor, px = canvas.width / 2, py = canvas.height / 2) {
    const before = scale();
    const most = Math.max(48 / fit(), 1);
    view.zoom = clamp(view.zoom * factor, 1, most);
    if (view.zoom < 1.01) view.zoom = 1;
    const shift = 1 / before - 1 / scale();
    view.x += (px - canvas.width / 2) * shift;
    view.y += (py - canvas.height / 2) * shift;
    settle();
  }
  function panBy(dx, dy) {
    view.x -= dx / scale();
    view.y -= dy / scale();
    settle();
  }
  function reset() {
    view.zoom = 1;
    settle();
  }
  function splitAt(share) {
    view.split = clamp(share, 0, 1);
    redraw();
  }

  /** What a side says of the pixel under the pointer: gray as visibility, error maps as the
   *  difference that they show, the rest as colour. */
  function describe(side, x, y) {
    const shown = sides[side];
    if (x >= shown.width || y >= shown.height) return "–";
    const at = (of) => of.context.getImageData(x, y, 1, 1).data;
    const [r, g, b] = at(shown);
    if (shown.test && shown.truth) {
      if (r === 128 && g === 128 && b === 128) return "cannot be in shadow";
      const error = (at(shown.test)[0] - at(shown.truth)[0]) / 255;
      return `error ${error < 0 ? "−" : "+"}${Math.abs(error).toFixed(3)}`;
    }
    return r === g && g === b ? `${(r / 255).toFixed(3)} (gray ${r})` : `rgb ${r}, ${g}, ${b}`;
  }
  function loupe(side, x, y) {
    const target = byId(`loupe-${side}`);
    const lens = target.getContext("2d");
    target.width = target.height = 75;
    lens.imageSmoothingEnabled = false;
    lens.drawImage(sides[side].bitmap, x - 7, y - 7, 15, 15, 0, 0, 75, 75);
    lens.strokeStyle = "#000";
    lens.strokeRect(34.5, 34.5, 6, 6);
    lens.strokeStyle = "#fff";
    lens.strokeRect(33.5, 33.5, 8, 8);
  }
  function readout() {
    if (!pointer || !sides.left || !sides.right) return;
    const [w, h] = size();
    const x = Math.floor(view.x + (pointer[0] - canvas.width / 2) / scale());
    const y = Math.floor(view.y + (pointer[1] - canvas.height / 2) / scale());
    if (x < 0 || y < 0 || x >= w || y >= h) return;
    byId("pixel").textContent = `column ${x}, row ${y}`;
    for (const side of ["left", "right"]) {
      byId(`value-${side}`).textContent = describe(side, x, y);
      loupe(side, x, y);
    }
  }

  /** Shows what the selects say. */
  async function load() {
    const turn = ++loading;
    const wanted = (side) => {
      const { test, truth } = selects[side].selectedOptions[0].dataset;
      return Promise.all([selects[side].value, test, truth].map((name) => name && image(name)));
    };
    try {
      const both = await Promise.all([wanted("left"), wanted("right")]);
      if (turn !== loading) return;
      const first = !sides.left;
      ["left", "right"].forEach((side, i) => {
        const [shown, test, truth] = both[i];
        sides[side] = { ...shown, test, truth };
        byId(`tag-${side}`).textContent = selects[side].selectedOptions[0].textContent;
      });
      const labels = ["left", "right"].map((side) => `${side}: ${selects[side].selectedOptions[0].textContent}`);
      canvas.setAttribute("aria-label", `Two images, ${labels.join("; ")}`);
      byId("failure").hidden = true;
      if (first) resize(); else settle();
    } catch (error) {
      byId("failure").textContent = `An image cannot be shown: ${error.message}`;
      byId("failure").hidden = false;
    }
  }
  function show(left, right) {
    selects.left.value = left;
    selects.right.value = right;
    return load();
  }

  return { canvas, handle, selects, view, ratio, resize, zoomBy, panBy, reset, splitAt, load, show, scale,
    fit, point: (at) => { pointer = at; redraw(); } };
})();
