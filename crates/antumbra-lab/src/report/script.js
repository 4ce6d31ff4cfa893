// Input for the slider, sorting, switches, tips.

{
  const { canvas, handle, view } = viewer;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * viewer.ratio(), (event.clientY - box.top) * viewer.ratio()];
  };

  byId("stage").addEventListener("wheel", (event) => {
    // At the fitted size the page keeps scrolling down.
    if (view.zoom === 1 && event.deltaY > 0) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    viewer.zoomBy(Math.exp(-clamp(event.deltaY * lines, -120, 120) * 0.0025), ...place(event));
  }, { passive: false });

  // One pointer pans, two pinch.
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
    viewer.point(place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    viewer.point(now);
    const before = pointers.get(event.pointerId);
    if (!before) return;
    if (pointers.size === 1) {
      viewer.panBy(now[0] - before[0], now[1] - before[1]);
    } else {
      const [id] = [...pointers.keys()].filter((other) => other !== event.pointerId);
      const fixed = pointers.get(id);
      const length = (p) => Math.hypot(p[0] - fixed[0], p[1] - fixed[1]);
      viewer.zoomBy(length(now) / Math.max(length(before), 1), (now[0] + fixed[0]) / 2, (now[1] + fixed[1]) / 2);
    }
    pointers.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("dblclick", viewer.reset);

  handle.addEventListener("pointerdown", (event) => {
    handle.setPointerCapture(event.pointerId);
    handle.focus();
    event.preventDefault();
  });
  handle.addEventListener("pointermove", (event) => {
    viewer.point(place(event));
    if (handle.hasPointerCapture(event.pointerId)) viewer.splitAt(place(event)[0] / canvas.width);
  });
  handle.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 0.1 : 0.02;
    const moves = { ArrowLeft: view.split - step, ArrowDown: view.split - step, ArrowRight: view.split + step,
      ArrowUp: view.split + step, PageDown: view.split - 0.1, PageUp: view.split + 0.1, Home: 0, End: 1 };
    if (!(event.key in moves)) return;
    event.preventDefault();
    viewer.splitAt(moves[event.key]);
  });
  handle.addEventListener("dblclick", () => viewer.splitAt(0.5));

  byId("stage").addEventListener("keydown", (event) => {
    const step = canvas.width / 10;
    const pans = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (event.target === canvas && event.key in pans) {
      // Nothing to pan: the arrows move the slider, or scroll the page.
      if (view.zoom > 1) viewer.panBy(...pans[event.key]);
      else if (pans[event.key][0] !== 0) viewer.splitAt(view.split - Math.sign(pans[event.key][0]) * 0.02);
      else return;
    } else if (event.key === "+" || event.key === "=") viewer.zoomBy(1.5);
    else if (event.key === "-") viewer.zoomBy(1 / 1.5);
    else if (event.key === "0") viewer.reset();
    else return;
    event.preventDefault();
  });

  byId("zoom-in").addEventListener("click", () => viewer.zoomBy(1.5));
  byId("zoom-out").addEventListener("click", () => viewer.zoomBy(1 / 1.5));
  byId("zoom-one").addEventListener("click", () => viewer.zoomBy(1 / viewer.scale()));
  byId("zoom-fit").addEventListener("click", viewer.reset);
  byId("swap").addEventListener("click", () => viewer.show(viewer.selects.right.value, viewer.selects.left.value));
  viewer.selects.left.addEventListener("change", viewer.load);
  viewer.selects.right.addEventListener("change", viewer.load);
  new ResizeObserver(viewer.resize).observe(byId("stage"));
  viewer.load();
}

// Heat maps: decoded when they come into sight.
{
  const seen = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      target.src = URL.createObjectURL(blob(target.dataset.file));
    }
  }, { rootMargin: "600px" });
  document.querySelectorAll("img[data-file]").forEach((img) => seen.observe(img));
  document.querySelectorAll(".map").forEach((map) => map.addEventListener("click", () => {
    viewer.show(map.dataset.visibility, map.dataset.image);
    byId("look").scrollIntoView({ block: "start" });
    viewer.handle.focus({ preventScroll: true });
  }));
}

// Switches between truths.
const onChoice = (name, act) => document.querySelectorAll(`input[name="${name}"]`).forEach((input) => {
  input.addEventListener("change", () => act(input.value));
  if (input.checked) act(input.value);
});
onChoice("against", (truth) => { byId("heat-maps").dataset.against = truth; });
onChoice("truth", (truth) => document.querySelectorAll(".plots").forEach((plots) => {
  plots.hidden = plots.dataset.truth !== truth;
}));

// Sorting: the good end first, again for the other; cells without a value stay last.
document.querySelectorAll("table.sortable").forEach((table) => {
  const heads = [...table.querySelectorAll("thead button")];
  const order = new Intl.Collator(undefined, { numeric: true });
  heads.forEach((button, column) => button.addEventListener("click", () => {
    const head = button.closest("th");
    const opposite = { ascending: "descending", descending: "ascending" };
    const direction = opposite[head.getAttribute("aria-sort")] ?? button.dataset.first;
    heads.forEach((other) => other.closest("th").removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", direction);
    const sign = direction === "ascending" ? 1 : -1;
    const value = (row) => row.cells[column]?.dataset.value;
    const compare = (a, b) => {
      const [x, y] = [value(a), value(b)];
      if (x === undefined || y === undefined) return (x === undefined) - (y === undefined);
      return sign * (column === 0 ? order.compare(x, y) : Number(x) - Number(y));
    };
    // Families stay together, each under its heading.
    for (const body of table.tBodies) {
      const [heading, ...rows] = body.rows;
      body.append(heading, ...rows.sort(compare));
    }
  }));
});

// Tables that go on beyond the edge say so.
{
  const check = new ResizeObserver((entries) => entries.forEach(({ target }) => {
    const box = target.closest(".scroll");
    box.toggleAttribute("data-cut", box.scrollWidth > box.clientWidth + 1);
  }));
  document.querySelectorAll(".scroll").forEach((box) => {
    check.observe(box);
    if (box.firstElementChild) check.observe(box.firstElementChild);
  });
}

// Tips for the pointer and for the keyboard.
{
  const tip = byId("tip");
  const show = (target) => {
    tip.textContent = target.dataset.tip;
    tip.hidden = false;
    const at = target.getBoundingClientRect();
    const left = at.left + at.width / 2 - tip.offsetWidth / 2;
    const below = at.top < tip.offsetHeight + 12;
    tip.style.left = `${clamp(left, 8, Math.max(document.documentElement.clientWidth - tip.offsetWidth - 8, 8))}px`;
    tip.style.top = `${below ? at.bottom + 8 : at.top - tip.offsetHeight - 8}px`;
    target.setAttribute("aria-describedby", "tip");
  };
  const hide = () => { tip.hidden = true; };
  for (const [start, end] of [["pointerover", "pointerout"], ["focusin", "focusout"]]) {
    document.addEventListener(start, (event) => {
      const target = event.target.closest?.("[data-tip]");
      if (target) show(target);
    });
    document.addEventListener(end, hide);
  }
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hide(); });
  document.addEventListener("scroll", hide, { capture: true, passive: true });
}
