// Pictures that flip in place. How they are held: report/picture.h.

const noReceiver = 65535;
const errorScale = 0.1;  // of signed errors: full colour; the same everywhere, so that pictures can be compared
const views = [
  {key: "picture", text: "picture", shortcut: "1"},
  {key: "rays", text: "rays", shortcut: "2"},
  {key: "error", text: "signed error", shortcut: "3"},
  {key: "mismatch", text: "mismatched rays", shortcut: "4"},
];
const decoded = new Map();

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// What the pixels to the left and above let expect of pixel i.
function expected(values, i, width) {
  const hasLeft = i % width !== 0, hasUp = i >= width;
  const left = hasLeft ? values[i - 1] : 0, up = hasUp ? values[i - width] : 0;
  if (!hasLeft) return up;
  if (!hasUp) return left;
  return Math.max(Math.min(left, up), Math.min(Math.max(left, up), left + up - values[i - width - 1]));
}

async function unpack({steps, coding, data}, width, base) {
  const bytes = await inflate(data), count = bytes.length / 2;
  const differences = new Int32Array(count), values = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const code = bytes[i] + 256 * bytes[count + i];
    if (code === noReceiver) {
      values[i] = NaN;
      continue;
    }
    differences[i] = (code & 1 ? -(code + 1) / 2 : code / 2) + (coding === "smooth" ? expected(differences, i, width) : 0);
    const from = base && !Number.isNaN(base[i]) ? Math.floor(base[i] * steps + 0.5) : 0;
    values[i] = (differences[i] + from) / steps;
  }
  values.digits = steps === 250 ? 3 : 4;  // that can be read
  return values;
}

// Numbers of a picture, row by row, NaN where there is no receiver; none where the report has no such picture.
function decode(subject, name) {
  const {pictures} = subject, own = pictures?.[pictures?.[name]?.as ?? name];
  if (!own) return undefined;
  if (!decoded.has(own)) {
    const hasBase = name !== "rays" && own.steps > 1;
    decoded.set(own, Promise.resolve(hasBase ? decode(subject, "rays") : undefined)
      .then((base) => unpack(own, subject.width, base)));
  }
  return decoded.get(own);
}

// White is open. What no camera ray meets is a pale blue.
function greyOf(occlusion) {
  if (Number.isNaN(occlusion)) return [196, 208, 224];
  const grey = Math.round(255 * (1 - occlusion));
  return [grey, grey, grey];
}

// Too dark is red, too light is blue.
function colourOfError(error) {
  if (Number.isNaN(error)) return [128, 128, 128];
  const share = Math.min(Math.abs(error) / errorScale, 1), pale = Math.round(255 * (1 - share));
  return error > 0 ? [255, pale, pale] : [pale, pale, 255];
}

function colourOfCount(count) {
  if (Number.isNaN(count)) return [128, 128, 128];
  return count === 0 ? [245, 245, 245] : count === 1 ? [250, 160, 40] : [190, 20, 20];
}

async function shownPictures() {
  const {subject, result} = state;
  const [picture, rays, mismatch] = await Promise.all(
    [decode(subject, result.contestant), decode(subject, "rays"), decode(subject, `${result.contestant} mismatch`)]);
  return {picture, rays, mismatch};
}

function colourAt(pictures, i) {
  const {picture, rays, mismatch} = pictures;
  switch (state.view) {
    case "rays": return greyOf(rays[i]);
    case "error": return colourOfError(picture[i] - rays[i]);
    case "mismatch": return mismatch ? colourOfCount(mismatch[i]) : [245, 245, 245];
    default: return greyOf(picture[i]);
  }
}

function captionOf(pictures) {
  const {subject, result, view} = state;
  const where = subjectName(subject);
  if (!pictures.picture) return `The report has no picture of ${result.contestant} on ${where}.`;
  switch (view) {
    case "rays": return `Visibility by ${subject.reference_rays} rays a pixel: ${where}.`;
    case "error":
      return `Signed error of ${result.contestant} on ${where}: red is too dark, blue too light, full at ` +
             `±${errorScale}. Bias ${numberText(result.errors.bias, 2)}, RMSE ${numberText(result.errors.rmse, 3)}.`;
    case "mismatch":
      if (result.mismatch_rate === undefined) return `${result.contestant} does not tell ray by ray.`;
      return `Rays of ${result.contestant} unlike Embree's on ${where}: ${numberText(result.mismatch_rate, 2)} of all; ` +
             `orange: one in a pixel, red: more.`;
    default: return `Visibility by ${result.contestant} on ${where}.`;
  }
}

async function drawPicture() {
  const asked = `${addressOf(state.subject, state.result)} ${state.view}`;
  const pictures = await shownPictures();
  if (asked !== `${addressOf(state.subject, state.result)} ${state.view}`) return;  // the user was faster
  const canvas = byId("picture"), {width, height} = state.subject;
  const caption = captionOf(pictures);
  byId("picture-caption").textContent = caption;
  canvas.setAttribute("aria-label", caption);
  canvas.width = width;
  canvas.height = height;
  if (!pictures.picture) return;
  const context = canvas.getContext("2d"), image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) image.data.set([...colourAt(pictures, i), 255], 4 * i);
  context.putImageData(image, 0, 0);
}

function showView(view) {
  state.view = view;
  drawViews();
  drawPicture();
}

function drawViews() {
  byId("views").replaceChildren(...views.map(({key, text}) => element("button", {
    type: "button", "aria-pressed": String(state.view === key), onclick: () => showView(key)}, text)));
}

// A few pixels around the pointer, large, with the numbers of the one in the middle.
async function drawLens(event) {
  const lens = byId("lens"), canvas = byId("picture"), around = 7, zoom = 14, side = (2 * around + 1) * zoom;
  lens.hidden = !byId("magnify").checked || event.type === "pointerleave";
  if (lens.hidden) return;
  const {width, height} = state.subject, box = canvas.getBoundingClientRect();
  const column = Math.floor((event.clientX - box.left) / box.width * width);
  const row = Math.floor((event.clientY - box.top) / box.height * height);
  const pictures = await shownPictures();
  if (!pictures.picture || column < 0 || row < 0 || column >= width || row >= height) return;
  lens.width = side;
  lens.height = side + 44;
  const context = lens.getContext("2d");
  context.fillStyle = getComputedStyle(document.body).backgroundColor;
  context.fillRect(0, 0, lens.width, lens.height);
  for (let y = -around; y <= around; ++y) {
    for (let x = -around; x <= around; ++x) {
      if (column + x < 0 || row + y < 0 || column + x >= width || row + y >= height) continue;
      context.fillStyle = `rgb(${colourAt(pictures, (row + y) * width + column + x)})`;
      context.fillRect((x + around) * zoom, (y + around) * zoom, zoom, zoom);
    }
  }
  context.strokeStyle = "#e15759";
  context.strokeRect(around * zoom, around * zoom, zoom, zoom);
  const i = row * width + column, own = pictures.picture[i], right = pictures.rays[i];
  context.fillStyle = getComputedStyle(document.body).color;
  context.font = "12px system-ui, sans-serif";
  const {digits} = pictures.picture;
  context.fillText(`(${column}, ${row}): ${own.toFixed(digits)}, rays ${right.toFixed(4)}`, 4, side + 16);
  context.fillText(`error ${(own - right).toFixed(digits)}`, 4, side + 34);
  const leftSide = event.clientX - box.left > box.width / 2;
  lens.style.left = `${event.clientX - box.left + (leftSide ? -side - 20 : 20)}px`;
  lens.style.top = `${Math.max(event.clientY - box.top - side / 2, 0)}px`;
}

function nextResult(step) {
  const {results} = state.subject, place = results.indexOf(state.result);
  choose(state.subject, results[(place + step + results.length) % results.length]);
}

function pressInViewer(event) {
  const view = views.find((one) => one.shortcut === event.key);
  const isInControl = ["SELECT", "INPUT", "BUTTON"].includes(event.target.tagName);
  if (view) showView(view.key);
  else if (event.key === "m") byId("magnify").click();
  else if (!isInControl && event.key === "ArrowRight") nextResult(1);
  else if (!isInControl && event.key === "ArrowLeft") nextResult(-1);
  else if (!isInControl && event.key === " ") showView(state.view === "rays" ? "picture" : "rays");
  else return;
  event.preventDefault();
}
