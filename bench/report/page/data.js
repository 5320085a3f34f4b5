// What was measured, and where one is on the page: scene and method are in the address, #scene/method.

const report = JSON.parse(document.getElementById("report-data").textContent);
const byId = (id) => document.getElementById(id);

// Colours that most eyes tell apart, also on dark paper (after Okabe and Ito, and Tol).
const familyColours = {
  query: "#0072b2", embree: "#d55e00", patterns: "#56b4e9", tables: "#009e73", levels: "#7a7a00", raster: "#cc79a7",
  volumes: "#e69f00", splats: "#8c564b", alchemy: "#9467bd", vao: "#17a2a2", gtao: "#e15759", vbao: "#59a14f",
};

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

const figures = [
  {key: "milliseconds", text: "ms", digits: 4},
  {key: "query_ratio", text: "× query 128", digits: 3},
  {key: "bias", text: "bias", digits: 3},
  {key: "mae", text: "MAE", digits: 3},
  {key: "rmse", text: "RMSE", digits: 3},
  {key: "median", text: "50 %", digits: 3},
  {key: "percentile_95", text: "95 %", digits: 3},
  {key: "percentile_99", text: "99 %", digits: 3},
  {key: "largest", text: "largest", digits: 3},
  {key: "psnr", text: "PSNR dB", digits: 3},
  {key: "equal_8bit_share", text: "equal at 8 bits", digits: 3},
  {key: "log_error", text: "Eq. 14", digits: 3},
  {key: "own_falloff_rmse", text: "RMSE, own falloff", digits: 3},
  {key: "own_falloff_bias", text: "bias, own falloff", digits: 3},
  {key: "mismatch_rate", text: "mismatched rays", digits: 2},
];

function valueOf(result, key) {
  if (key === "milliseconds") return 1000 * result.seconds;
  if (key === "own_falloff_rmse") return result.own_falloff_errors?.rmse;
  if (key === "own_falloff_bias") return result.own_falloff_errors?.bias;
  return result[key] ?? result.errors[key] ?? undefined;
}

function numberText(value, digits) {
  if (value === undefined || value === null) return "–";
  if (value === 0) return "0";
  return Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5 ? value.toExponential(1).replace(".0e", "e")
                                                          : String(+value.toPrecision(digits));
}

const subjectName = (subject) => `${subject.scene}, radius ${numberText(subject.radius, 4)}`;
const slug = (text) => text.toLowerCase().replace(/[^a-z0-9.]+/g, "-");

// What the page shows now.
const state = {subject: report.subjects[0], result: report.subjects[0].results[0], view: "picture", hidden: new Set()};

function readAddress() {
  const [scene, method] = decodeURIComponent(location.hash.slice(1)).split("/");
  const subject = report.subjects.find((one) => slug(subjectName(one)) === scene);
  if (!subject) return false;
  state.subject = subject;
  const wanted = method ?? slug(state.result.contestant);
  state.result = subject.results.find((one) => slug(one.contestant) === wanted) ?? subject.results[0];
  return true;
}

function addressOf(subject, result) { return `#${slug(subjectName(subject))}/${slug(result.contestant)}`; }

function choose(subject, result) {
  state.subject = subject;
  state.result = result;
  history.replaceState(null, "", addressOf(subject, result));
  showScene();
}
