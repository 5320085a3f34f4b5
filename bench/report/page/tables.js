// Tables: all figures of a scene, where its errors come from, all scenes at once, and the papers'.

const sorting = {key: "milliseconds", down: false};

function sortedResults() {
  const valueFor = (result) => sorting.key === "contestant" ? result.contestant : valueOf(result, sorting.key);
  const order = (a, b) => {
    const [x, y] = [valueFor(a), valueFor(b)];
    if (x === undefined || x === null) return 1;  // what was not measured comes last, whichever way
    if (y === undefined || y === null) return -1;
    const sign = x < y ? -1 : x > y ? 1 : 0;
    return sorting.down ? -sign : sign;
  };
  return [...state.subject.results].sort(order);
}

function headingCell(key, text) {
  const isSorted = sorting.key === key;
  const sort = () => {
    sorting.down = isSorted ? !sorting.down : false;
    sorting.key = key;
    drawFigures();
    document.querySelector(`#figures th[data-key="${key}"] button`).focus();
  };
  return element("th", {scope: "col", "data-key": key,
                        "aria-sort": isSorted ? (sorting.down ? "descending" : "ascending") : undefined},
                 element("button", {type: "button", onclick: sort}, text));
}

function drawFigures() {
  const head = element("tr", {}, headingCell("contestant", "method"), ...figures.map(({key, text}) => headingCell(key, text)),
                       element("th", {scope: "col"}, "command"));
  const rows = sortedResults().map((result) => element("tr", {"aria-current": result === state.result ? "true" : undefined},
    element("th", {scope: "row"}, element("a", {href: addressOf(state.subject, result)}, result.contestant)),
    ...figures.map(({key, digits}) => element("td", {}, numberText(valueOf(result, key), digits))),
    element("td", {}, result.command ? element("code", {}, result.command) : "–")));
  byId("figures").replaceChildren(element("caption", {}, subjectName(state.subject)), element("thead", {}, head),
                                  element("tbody", {}, ...rows));
}

function csvText() {
  const cell = (value) => value === undefined || value === null ? "" : `"${String(value).replaceAll('"', '""')}"`;
  const lines = [["scene", "radius", "method", ...figures.map(({key}) => key)].map(cell).join(",")];
  for (const subject of report.subjects) {
    for (const result of subject.results) {
      lines.push([subject.scene, subject.radius, result.contestant,
                  ...figures.map(({key}) => valueOf(result, key))].map(cell).join(","));
    }
  }
  return lines.join("\n") + "\n";
}

function downloadCsv() {
  const url = URL.createObjectURL(new Blob([csvText()], {type: "text/csv"}));
  element("a", {href: url, download: "report.csv"}).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

function drawCauses() {
  const rows = (state.subject.causes ?? []).map((cause) => element("tr", {},
    element("th", {scope: "row"}, cause.cause), element("td", {}, cause.from), element("td", {}, cause.to),
    element("td", {}, numberText(cause.rmse, 3)), element("td", {}, numberText(cause.bias, 2))));
  const heading = ["cause", "from", "to", "RMSE", "mean change"].map((text) => element("th", {scope: "col"}, text));
  byId("causes").replaceChildren(element("thead", {}, element("tr", {}, ...heading)), element("tbody", {}, ...rows));
}

// A colour from good (blue) to bad (orange) of a number between two, by their logarithms.
function heatColour(value, low, high) {
  if (!(value > 0) || high <= low) return "transparent";
  const share = Math.min(Math.max(Math.log(value / low) / Math.log(high / low), 0), 1);
  const good = [74, 144, 217], bad = [240, 128, 48];
  return `rgb(${good.map((from, i) => Math.round(from + share * (bad[i] - from))).join(" ")} / 45%)`;
}

function drawHeat() {
  const key = byId("heat-figure").value, {digits} = figures.find((one) => one.key === key);
  const names = [...new Set(report.subjects.flatMap((one) => one.results.map((result) => result.contestant)))];
  const all = report.subjects.flatMap((one) => one.results.map((result) => valueOf(result, key))).filter((v) => v > 0);
  const low = Math.min(...all), high = Math.max(...all);
  const head = report.subjects.map((subject) => element("th", {scope: "col"}, `${subject.scene} ${numberText(subject.radius, 3)}`));
  const rows = names.map((name) => element("tr", {}, element("th", {scope: "row"}, name), ...report.subjects.map((subject) => {
    const result = subject.results.find((one) => one.contestant === name);
    if (!result) return element("td", {}, "–");
    const value = valueOf(result, key);
    return element("td", {style: `background:${heatColour(value, low, high)}`},
                   element("a", {href: addressOf(subject, result)}, numberText(value, digits)));
  })));
  byId("heat").replaceChildren(element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "method"), ...head)),
                               element("tbody", {}, ...rows));
}

// Each {title, note, heading: [...], rows: [[...], ...]}.
function drawPapers() {
  const tables = report.papers ?? [];
  byId("papers").hidden = tables.length === 0;
  byId("papers-tables").replaceChildren(...tables.map(({title, note, heading, rows}) => element("section", {},
    element("h3", {}, title), element("p", {}, note),
    element("div", {class: "scroll"}, element("table", {},
      element("thead", {}, element("tr", {}, ...heading.map((text) => element("th", {scope: "col"}, text)))),
      element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map((value, column) => element(
        column === 0 ? "th" : "td", column === 0 ? {scope: "row"} : {},
        typeof value === "number" ? numberText(value, 3) : value ?? "–"))))))))));
}
