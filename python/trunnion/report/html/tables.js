"use strict";
/* Tables that sort and filter, and the story of every case.  All text enters as text. */
(function () {
  const SHOWN = 300, PRINTED = 3000;
  /* tables by element fill pages that few read: printed where they are asked for */
  const LONG = ["forces", "stresses", "cycle_forces", "spread_forces"];
  const make = (tag, text, kind) => {
    const found = document.createElement(tag);
    if (text !== undefined && text !== null) found.textContent = text;
    if (kind) found.className = kind;
    return found;
  };
  const host = document.getElementById("tables");
  const shown = (column, cell) => {
    if (cell === null) return "";
    if (typeof cell !== "number" || column.decimals === null) return String(cell);
    if (column.exponent) return cell.toExponential(column.decimals);
    const text = cell.toFixed(column.decimals);
    return Number(text) === 0 ? text.replace("-", "") : text;
  };

  function grid(table) {
    const columns = table.columns, n = columns[0].cells.length;
    const all = Array.from({ length: n }, (_, i) => i);
    let rows = all, limit = SHOWN, by = -1, falling = false;
    const section = make("section");
    section.dataset.table = table.name;
    section.append(make("h2", table.title), make("p", table.note, "note"));
    const bar = make("div", null, "bar"), count = make("span"), box = make("input");
    box.type = "search";
    box.placeholder = "Filter: words, or FX > 5";
    box.setAttribute("aria-label", "Filter " + table.title);
    bar.append(box, count);
    const wide = make("div", null, "wide"), sheet = make("table"), head = make("thead");
    const body = make("tbody"), top = make("tr"), more = make("button", "Show more");
    more.type = "button";
    const number = (c) => c.decimals !== null;
    columns.forEach((c, k) => {
      const cell = make("th", c.head, number(c) ? "number" : "");
      cell.append(make("small", c.unit || "\u00a0"));
      cell.title = "Sort";
      cell.addEventListener("click", () => {
        falling = by === k ? !falling : number(c);
        by = k;
        sort();
        fill();
      });
      top.append(cell);
    });
    head.append(top);
    sheet.append(head, body);
    wide.append(sheet);
    if (n > 8) section.append(bar);
    section.append(wide);
    if (columns.length <= 8 && n > 20) section.classList.add("halves");
    host.append(section);

    function sort() {
      if (by < 0) return;
      const cells = columns[by].cells, sign = falling ? -1 : 1;
      const natural = new Intl.Collator("en", { numeric: true });
      rows = [...rows].sort((a, b) => {
        const x = cells[a], y = cells[b];
        if (x === null || y === null) return (x === null) - (y === null) || a - b;
        if (typeof x === "number" && typeof y === "number") return sign * (x - y) || a - b;
        return sign * natural.compare(String(x), String(y)) || a - b;
      });
    }
    function filter() {
      const asked = box.value.trim();
      const limits = /^(.+?)\s*(>=|<=|>|<|=)\s*(-?[\d.]+(?:e[-+]?\d+)?)$/i.exec(asked);
      const column = limits && columns.find((c) => number(c) &&
        c.head.toLowerCase() === limits[1].trim().toLowerCase());
      if (column) {
        const y = Number(limits[3]), test = { ">": (x) => x > y, "<": (x) => x < y,
          ">=": (x) => x >= y, "<=": (x) => x <= y, "=": (x) => x === y }[limits[2]];
        rows = all.filter((i) => column.cells[i] !== null && test(column.cells[i]));
      } else if (asked) {
        const words = asked.toLowerCase().split(/\s+/);
        rows = all.filter((i) => {
          const text = columns.map((c) => shown(c, c.cells[i])).join(" ").toLowerCase();
          return words.every((word) => text.includes(word));
        });
      } else rows = all;
    }
    function fill() {
      const part = document.createDocumentFragment();
      let last;
      for (const i of rows.slice(0, limit)) {
        const row = make("tr"), key = columns[0].cells[i];
        if (by < 0 && table.keys > 1 && key !== last) row.className = "first";
        last = key;
        columns.forEach((c) => {
          const cell = c.cells[i], text = shown(c, cell);
          const td = make("td", text, number(c) ? "number" : "");
          if (number(c) && cell !== null) td.dataset.value = cell;
          else if (c.head === "STATE" || c.head === "STATUS" || c.head === "VERDICT")
            td.className = "s-" + text.split(/[ ,]/)[0];
          else if (text.length > 60 || c.head === "CAUSE") td.className = "long";
          row.append(td);
        });
        part.append(row);
      }
      body.replaceChildren(part);
      count.textContent = rows.length + " of " + n + " rows" +
        (rows.length > limit ? ", the first " + limit + " shown" : "");
      more.hidden = rows.length <= limit;
      top.querySelectorAll("th").forEach((th, k) => th.setAttribute("aria-sort",
        k !== by ? "none" : falling ? "descending" : "ascending"));
    }
    more.addEventListener("click", () => { limit += 1000; fill(); });
    section.append(more);
    let waiting = 0;
    box.addEventListener("input", () => {
      clearTimeout(waiting);
      waiting = setTimeout(() => { limit = SHOWN; filter(); sort(); fill(); }, 120);
    });
    window.addEventListener("beforeprint", () => { limit = Math.max(limit, PRINTED); fill(); });
    fill();
    return section;
  }

  const tabs = make("nav", null, "tabs"), buttons = [];
  host.append(make("h2", "Tables"), tabs);
  const sections = DATA.tables.map(grid);
  function choose(k) {
    sections.forEach((section, i) => {
      section.hidden = i !== k;
      buttons[i].setAttribute("aria-pressed", String(i === k));
    });
  }
  DATA.tables.forEach((table, k) => {
    const button = make("button", table.title);
    button.type = "button";
    button.addEventListener("click", () => choose(k));
    buttons.push(button);
    tabs.append(button);
  });
  choose(0);
  const long = DATA.tables.filter((table) => LONG.includes(table.name));
  const every = make("input"), label = make("label", null, "tick");
  every.type = "checkbox";
  every.id = "every";
  every.checked = location.hash === "#every";
  label.append(every, " print every table");
  if (long.length) tabs.append(label);
  const names = long.map((table) => table.title).join(", ");
  const unprinted = make("p", null, "unprinted");
  unprinted.textContent = "Not printed: " + names + ". They are in this page as a file, and are " +
    "printed where \u201cprint every table\u201d is ticked there.";
  host.append(unprinted);
  let chosen = null;
  window.addEventListener("beforeprint", () => {
    chosen = sections.map((section) => section.hidden);
    sections.forEach((section, i) => {
      section.hidden = !every.checked && long.includes(DATA.tables[i]);
    });
    unprinted.hidden = every.checked || !long.length;
  });
  window.addEventListener("afterprint", () => sections.forEach((section, i) => {
    section.hidden = chosen[i];
  }));

  const told = document.getElementById("stories");
  for (const story of DATA.stories) {
    told.append(make("h3", story.case + ": " + story.passes.length + " iteration" +
      (story.passes.length === 1 ? "" : "s")),
      make("p", story.note + ".", "note"),
      make("p", story.verdict, "verdict " + (story.good ? "good" : "bad")));
    const residuals = story.passes.map((p) => p.residual);
    if (residuals.filter((r) => r > 0).length > 2) {
      const chart = make("div", null, "residual");
      told.append(chart);
      const x = residuals.map((_, i) => i + 1), end = x.length + 1;
      const { limit, worst } = story, least = 1e-17, seen = (r) => Math.max(r, least);
      const tens = [...residuals.filter((r) => r > 0), limit].map((r) => Math.log10(seen(r)));
      if (worst !== null) tens.push(Math.log10(seen(worst)));
      const decades = Math.ceil(Math.max(...tens)) - Math.floor(Math.min(...tens));
      Plotly.newPlot(chart, [
        { x, y: story.passes.map((p) => p.n_changed), type: "bar", yaxis: "y2",
          marker: { color: "#d7dde6" }, name: "supports that changed", hoverinfo: "x+y+name" },
        { x, y: residuals.map((r) => (r === null ? null : seen(r))), mode: "lines+markers",
          line: { color: "#1f3864", width: 1.5 }, marker: { size: 4 }, name: story.measured,
          text: story.passes.map((p) => p.said + " (" + p.what + ")"),
          hovertemplate: "%{x}: %{y:.2e}, %{text}<extra></extra>" },
        { x: [0.4, end + 0.6], y: [limit, limit], mode: "lines", hoverinfo: "skip",
          line: { color: "#5b6675", width: 1, dash: "dash" },
          name: "allowed in the certificate, " + limit.toExponential(0) },
        ...(worst === null ? [] : [{ x: [end], y: [seen(worst)], mode: "markers", name:
          "certificate, worst item " + worst.toExponential(1), hoverinfo: "name",
          marker: { symbol: "star", size: 12, color: story.good ? "#1e7b34" : "#b00020" } }]),
      ], { margin: { l: 84, r: 56, t: 26, b: 38 }, font: { size: 11, color: "#1b2430" },
        legend: { orientation: "h", y: 1.16, x: 0 }, xaxis: { title: { text: "iteration" },
          range: [0.4, end + 0.6], showgrid: false,
          dtick: Math.max(1, Math.ceil(x.length / 15)) },
        yaxis: { type: "log", title: { text: story.axis }, exponentformat: "power",
          dtick: Math.max(1, Math.ceil(decades / 5)),
          overlaying: "y2", gridcolor: "#edf0f4" },
        yaxis2: { side: "right", title: { text: "supports changed" }, rangemode: "tozero",
          showgrid: false, dtick: Math.max(1, Math.ceil(
            Math.max(...story.passes.map((p) => p.n_changed)) / 5)) } },
      { displayModeBar: false, responsive: true });
    }
    const course = make("div", null, "course");
    told.append(course);
    for (const support of story.supports) {
      const block = make("details"), line = make("summary");
      line.append(make("b", support.name), support.words);
      block.append(line);
      let made = false;
      block.addEventListener("toggle", () => {
        if (made) return;
        made = true;
        if (support.axis) block.append(make("p", "angle from " + support.axis, "note"));
        const table = make("table"), top = make("tr");
        for (const text of ["iteration", "state", "N [" + story.force + "]", "F/(mu N)",
          "angle [deg]"]) top.append(make("th", text));
        table.append(top);
        for (const cells of support.rows) {
          const row = make("tr");
          cells.forEach((cell, k) => row.append(make("td", k === 2 && cell !== null
            ? Number(cell.toPrecision(5)) : cell, k === 1 ? "s-" + cell : "number")));
          table.append(row);
        }
        block.append(table);
      });
      course.append(block);
    }
  }
  document.body.dataset.ready = "yes";
})();
