// The page as a whole.

function drawProvenance() {
  const facts = {processor: report.processor, OpenGL: report.device || "none", compiler: report.compiler,
                 commit: report.commit, date: report.date, command: report.command};
  byId("provenance").replaceChildren(...Object.entries(facts).flatMap(([term, text]) =>
    [element("dt", {}, term), element("dd", {}, text)]));
}

function drawSubjects() {
  byId("subjects").replaceChildren(...report.subjects.map((subject) => element("li", {}, element("a", {
    href: addressOf(subject, state.result), "aria-current": subject === state.subject ? "true" : undefined},
    subjectName(subject)))));
}

function drawChoice() {
  byId("shown").replaceChildren(...state.subject.results.map((result) => element("option", {
    value: slug(result.contestant), selected: result === state.result}, result.contestant)));
}

function showScene() {
  const {subject} = state;
  byId("scene-title").textContent = subjectName(subject);
  byId("scene-facts").textContent =
    `${subject.triangles} triangles, ${subject.width} x ${subject.height} pixels, ${subject.receivers} receivers; ` +
    `right: ${subject.reference_rays} rays a pixel, known to an RMSE of ${numberText(subject.noise_floor_rmse, 2)}.`;
  drawSubjects();
  drawPlot();
  drawFront();
  drawChoice();
  drawViews();
  drawPicture();
  drawCauses();
  drawFigures();
}

function begin() {
  readAddress();
  byId("heat-figure").replaceChildren(...figures.map(({key, text}) => element("option", {
    value: key, selected: key === "rmse"}, text)));
  byId("heat-figure").addEventListener("change", drawHeat);
  byId("shown").addEventListener("change", (event) => choose(state.subject,
    state.subject.results.find((one) => slug(one.contestant) === event.target.value)));
  byId("viewer").addEventListener("keydown", pressInViewer);
  byId("download").addEventListener("click", downloadCsv);
  for (const kind of ["pointermove", "pointerleave"]) byId("picture").addEventListener(kind, drawLens);
  addEventListener("hashchange", () => {
    if (!readAddress()) return;
    showScene();
    byId("scene").scrollIntoView();
  });
  drawProvenance();
  drawLegend();
  drawHeat();
  drawFronts();
  drawPapers();
  showScene();
}

begin();
