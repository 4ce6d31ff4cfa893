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
    const value = (row) => row.cells[column].dataset.value;
    const compare = (a, b) => {
      const [x, y] = [value(a), value(b)];
      if (x === undefined || y === undefined) return (x === undefined) - (y === undefined);
      return sign * (column < 2 ? order.compare(x, y) : Number(x) - Number(y));
    };
    const [body] = table.tBodies;
    body.append(...[...body.rows].sort(compare));
  }));
});

// Choices of a scene and a technique show their rows only.
document.querySelectorAll(".choose").forEach((choices) => {
  const selects = [...choices.querySelectorAll("select")];
  const rows = document.querySelectorAll(`#${choices.dataset.table} tbody tr`);
  const show = () => rows.forEach((row) => {
    row.hidden = selects.some((select) => select.value && row.dataset[select.name] !== select.value);
  });
  selects.forEach((select) => select.addEventListener("change", show));
});
