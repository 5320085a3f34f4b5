// Time against error, both by their logarithms.

const svgNamespace = "http://www.w3.org/2000/svg";

function svgElement(name, attributes, ...children) {
  const made = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

// Powers of ten around some values.
function decades(values) {
  const low = Math.floor(Math.log10(Math.min(...values))), high = Math.ceil(Math.log10(Math.max(...values)));
  return [low, Math.max(high, low + 1)];
}

// Those than which no other is both faster and nearer, from the fastest.
function paretoFront(results) {
  const sorted = [...results].sort((a, b) => a.seconds - b.seconds || a.errors.rmse - b.errors.rmse);
  const front = [];
  let best = Infinity;
  for (const result of sorted) {
    if (result.errors.rmse < best) front.push(result);
    best = Math.min(best, result.errors.rmse);
  }
  return front;
}

function describePoint(result) {
  const device = result.device || report.processor;
  const name = result.contestant + (result.mode ? ` (${result.mode})` : "");
  return `${name}: ${numberText(1000 * result.seconds, 4)} ms, RMSE ${numberText(result.errors.rmse, 3)}, ` +
         `bias ${numberText(result.errors.bias, 2)}; ${device}` + (result.command ? `; ${result.command}` : "");
}

function drawPlot() {
  const {subject} = state;
  const shown = subject.results.filter((one) => !state.hidden.has(one.family) && one.errors.rmse > 0);
  const holder = byId("plot");
  holder.replaceChildren();
  if (shown.length === 0) return;
  const width = 900, height = 520, left = 70, right = 20, top = 15, bottom = 50;
  const [x0, x1] = decades(shown.map((one) => 1000 * one.seconds));
  const [y0, y1] = decades([...shown.map((one) => one.errors.rmse), subject.noise_floor_rmse]);
  const x = (ms) => left + (width - left - right) * (Math.log10(ms) - x0) / (x1 - x0);
  const y = (rmse) => height - bottom - (height - top - bottom) * (Math.log10(rmse) - y0) / (y1 - y0);
  const svg = svgElement("svg", {viewBox: `0 0 ${width} ${height}`, role: "group",
                                 "aria-label": `Time against error of ${shown.length} methods on ${subjectName(subject)}`});
  const line = (a, b, c, d, kind) => svgElement("line", {x1: a, y1: b, x2: c, y2: d, class: kind});
  const label = (text, a, b, anchor = "middle") => {
    const made = svgElement("text", {x: a, y: b, "text-anchor": anchor});
    made.textContent = text;
    return made;
  };
  for (let decade = x0; decade <= x1; ++decade) {
    svg.append(line(x(10 ** decade), top, x(10 ** decade), height - bottom, "grid"),
               label(numberText(10 ** decade, 3), x(10 ** decade), height - bottom + 18));
  }
  for (let decade = y0; decade <= y1; ++decade) {
    svg.append(line(left, y(10 ** decade), width - right, y(10 ** decade), "grid"),
               label(numberText(10 ** decade, 3), left - 8, y(10 ** decade) + 4, "end"));
  }
  const floor = y(subject.noise_floor_rmse);
  svg.append(line(left, floor, width - right, floor, "floor"),
             label("noise floor of the reference", width - right - 4, floor - 5, "end"),
             label("milliseconds", (left + width - right) / 2, height - 10),
             svgElement("g", {transform: `translate(16 ${(top + height - bottom) / 2}) rotate(-90)`}, label("RMSE", 0, 0)));
  const front = paretoFront(shown).map((one) => `${x(1000 * one.seconds)},${y(one.errors.rmse)}`);
  svg.append(svgElement("polyline", {points: front.join(" "), class: "front"}));
  for (const result of shown) {
    const point = svgElement("circle", {
      cx: x(1000 * result.seconds), cy: y(result.errors.rmse), r: 6, fill: familyColours[result.family],
      class: result === state.result ? "point chosen" : "point", tabindex: 0, role: "button",
      "aria-label": describePoint(result), onclick: () => choose(subject, result),
      onkeydown: (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); choose(subject, result); } },
      onfocus: () => { byId("plot-caption").textContent = describePoint(result); },
      onmouseenter: () => { byId("plot-caption").textContent = describePoint(result); },
    });
    const title = svgElement("title", {});
    title.textContent = describePoint(result);
    point.append(title);
    svg.append(point);
  }
  holder.append(svg);
  byId("plot-caption").textContent = describePoint(state.result);
}

// Whether the exact query, with whatever rays, is the front at the errors that it has, and what else is.
function frontText(subject) {
  const isExact = (one) => one.family === "query" || one.family === "patterns";
  const exact = subject.results.filter(isExact);
  if (exact.length === 0) return "";
  const largest = Math.max(...exact.map((one) => one.errors.rmse));
  const front = subject.results.filter((one) => !one.beaten_by && one.errors.rmse <= largest);
  const others = front.filter((one) => !isExact(one));
  const names = (list) => list.map((one) => one.contestant.replace("query, ", "")).join("; ");
  const beaten = exact.flatMap((one) => {
    const better = subject.results.find((other) => other.contestant === one.beaten_by);
    if (!better || isExact(better)) return [];
    return `${one.contestant}, is beaten by ${better.contestant}: ${numberText(better.seconds / one.seconds, 2)} of ` +
           `the time, ${numberText(better.errors.rmse / one.errors.rmse, 3)} of the RMSE. `;
  });
  const own = front.length === others.length ? "The exact query is nowhere on the Pareto front. "
    : `From an RMSE of ${numberText(largest, 2)} down, the exact query is on the Pareto front with: ` +
      `${names(front.filter(isExact))}. `;
  return (own + (others.length === 0 ? "Nothing else is. " : `So are: ${names(others)}. `) + beaten.join("")).trim();
}

function drawFront() {
  const {subject} = state, left = subject.left_out ?? [];
  byId("front-text").textContent = frontText(subject);
  byId("left-out").hidden = left.length === 0;
  byId("left-out").querySelector("summary").textContent = `${left.length} methods are left out`;
  byId("left-out").querySelector("ul").replaceChildren(...left.map((one) =>
    element("li", {}, `${one.contestant}: ${one.left_out}`)));
}

function drawFronts() {
  byId("fronts").replaceChildren(...report.subjects.filter(frontText).map((subject) => element("li", {},
    element("a", {href: addressOf(subject, state.result)}, subjectName(subject)), `: ${frontText(subject)}`)));
}

function drawLegend() {
  const present = [...new Set(report.subjects.flatMap((one) => one.results.map((result) => result.family)))];
  byId("legend").replaceChildren(...present.map((family) => element("button", {
    type: "button", "aria-pressed": String(!state.hidden.has(family)),
    onclick: () => {
      if (!state.hidden.delete(family)) state.hidden.add(family);
      drawLegend();
      drawPlot();
    },
  }, element("span", {class: "swatch", style: `background:${familyColours[family]}`}), family)));
}
