#!/usr/bin/python3
"""gltf_test.py LKAO FOLDER SHARED: models with baked occlusion, before the Khronos validator and in a viewer.

Bakes small models, and the sample models of SHARED where they are there, into FOLDER, which is emptied. What the
validator has nothing against before, it has nothing against after. three.js in headless Chromium shows the occlusion;
screenshots stay in FOLDER. Both are installed with npm into FOLDER.npm, and kept there.
"""

import base64
import functools
import http.server
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import threading
import urllib.parse

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

PACKAGES = ["gltf-validator@2.0.0-dev.3.10", "three@0.187.0"]

VALIDATE = """
const fs = require("fs"), path = require("path"), validator = require("gltf-validator");
const read = (file) => new Uint8Array(fs.readFileSync(file));
(async () => {
  for (const file of process.argv.slice(1)) {
    const beside = (uri) => Promise.resolve(read(path.join(path.dirname(file), decodeURIComponent(uri))));
    const options = {uri: path.basename(file), maxIssues: 0, externalResourceFunction: beside};
    console.log(JSON.stringify((await validator.validateBytes(read(file), options)).issues.messages));
  }
})();
"""

PAGE = """<!DOCTYPE html><html><body style="margin:0;background:#000"><canvas width="400" height="300"></canvas>
<script type="importmap">{"imports": {"three": "/npm/three/build/three.module.js",
  "three/addons/": "/npm/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
const canvas = document.querySelector("canvas");
const renderer = new THREE.WebGLRenderer({canvas, preserveDrawingBuffer: true, antialias: false});
const loader = new GLTFLoader();
loader.setDRACOLoader(new DRACOLoader().setDecoderPath("/npm/three/examples/jsm/libs/draco/gltf/"));

// Mean and least brightness of the pixels that show the model, and their number; occlusion shows in light from all
// around.
window.show = async (url, eye) => {
  const model = (await loader.loadAsync(url)).scene;
  const box = new THREE.Box3().setFromObject(model), size = box.getSize(new THREE.Vector3()).length();
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, size / 100, size * 10);
  const middle = box.getCenter(new THREE.Vector3());
  camera.position.copy(middle).addScaledVector(new THREE.Vector3(...eye).normalize(), size * 1.2);
  camera.lookAt(middle);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0, 0, 1);
  scene.add(model, new THREE.AmbientLight(0xffffff, 3));
  let facts = {attributes: 0, maps: 0};
  model.traverse((part) => {
    if (!part.isMesh) return;
    facts.attributes += part.geometry.getAttribute("_occlusion") ? 1 : 0;
    facts.maps += part.material.aoMap ? 1 : 0;
    part.material.metalness = 0;
    part.material.side = THREE.DoubleSide;
  });
  renderer.render(scene, camera);
  const gl = renderer.getContext(), pixels = new Uint8Array(400 * 300 * 4);
  gl.readPixels(0, 0, 400, 300, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let sum = 0, count = 0, darkest = 255;
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i] === 0 && pixels[i + 1] === 0 && pixels[i + 2] > 250) continue;
    const brightness = (pixels[i] + pixels[i + 1] + pixels[i + 2]) / 3;
    sum += brightness;
    darkest = Math.min(darkest, brightness);
    ++count;
  }
  return {...facts, mean: sum / count, darkest, count};
};
window.isReady = true;
</script></body></html>
"""


def skip(reason):
    print(f"Skipped\nNOT TESTED: {reason}")
    sys.exit(0)


def install_packages(folder):
    if not shutil.which("npm") or not shutil.which("node"):
        skip("needs npm and node")
    modules = folder / "node_modules"
    missing = [package for package in PACKAGES
               if not (modules / package.rsplit("@", 1)[0] / "package.json").exists()
               or json.loads((modules / package.rsplit("@", 1)[0] / "package.json").read_text())["version"]
               != package.rsplit("@", 1)[1]]
    if missing:
        folder.mkdir(parents=True, exist_ok=True)
        command = ["npm", "install", "--no-audit", "--no-fund", "--no-save", "--prefix", str(folder), *PACKAGES]
        result = subprocess.run(command, capture_output=True, text=True, timeout=200)
        if result.returncode != 0:
            skip(f"npm cannot install {' '.join(PACKAGES)}: {result.stderr.strip().splitlines()[-1:]}")
    return modules


def grid(steps, corner, along, across, left):
    """Positions, texture coordinates (half of the image) and indices of a rectangle of steps x steps squares."""
    positions, uvs, indices = [], [], []
    for i in range(steps + 1):
        for k in range(steps + 1):
            u, v = i / steps, k / steps
            positions.append([corner[a] + u * along[a] + v * across[a] for a in range(3)])
            uvs.append([left + u / 2, v])
            if i < steps and k < steps:
                first = i * (steps + 1) + k
                indices += [first, first + 1, first + steps + 1, first + 1, first + steps + 2, first + steps + 1]
    return positions, uvs, indices


def corner_model():
    """A floor and a wall on it, each a mesh; the floor is shown twice, one time far from everything."""
    document = {"asset": {"version": "2.0", "generator": "a test"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
                "nodes": [{"mesh": 0, "name": "floor"}, {"mesh": 1}, {"mesh": 0, "translation": [0, 0, 5.5]}],
                "meshes": [], "materials": [{"name": "paint", "extras": {"kept": [1.5, "x"]}}],
                "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]}
    data = bytearray()

    def add(numbers, letter, component_type, shape, target, extra=None):
        flat = [n for row in numbers for n in row] if isinstance(numbers[0], list) else numbers
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "target": target,
                                        "byteLength": len(flat) * struct.calcsize(letter)})
        data.extend(struct.pack(f"<{len(flat)}{letter}", *flat))
        data.extend(bytes(-len(data) % 4))
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "count": len(numbers),
                                      "componentType": component_type, "type": shape, **(extra or {})})
        return len(document["accessors"]) - 1

    for positions, uvs, indices in (grid(16, [-2, 0, -2], [4, 0, 0], [0, 0, 4], 0),
                                    grid(16, [-2, 0, -2], [0, 3, 0], [4, 0, 0], 0.5)):
        bounds = {"min": [min(p[a] for p in positions) for a in range(3)],
                  "max": [max(p[a] for p in positions) for a in range(3)]}
        document["meshes"].append({"primitives": [{
            "attributes": {"POSITION": add(positions, "f", 5126, "VEC3", 34962, bounds),
                           "TEXCOORD_0": add(uvs, "f", 5126, "VEC2", 34962)},
            "indices": add(indices, "H", 5123, "SCALAR", 34963), "material": 0}]})
    document["buffers"][0]["byteLength"] = len(data)
    return document, bytes(data)


def glb_of(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(data)) + b"BIN\0" + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def write_models(folder):
    """The model as GLB, as text with a file beside, and as text alone."""
    document, data = corner_model()
    (folder / "corner.glb").write_bytes(glb_of(document, data))
    beside = {**document, "buffers": [{"byteLength": len(data), "uri": "the%20data.bin"}]}
    (folder / "the data.bin").write_bytes(data)
    (folder / "corner.gltf").write_text(json.dumps(beside, indent=1))
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    (folder / "alone.gltf").write_text(json.dumps({**document, "buffers": [{"byteLength": len(data), "uri": uri}]}))
    return [folder / name for name in ("corner.glb", "corner.gltf", "alone.gltf")]


def bake(program, model, output, *options):
    command = [program, "bake", str(model), "-o", str(output), "--radius", "20%", "--samples", "64", "--quiet"]
    result = subprocess.run([*command, *options], capture_output=True, text=True)
    assert result.returncode == 0, f"{model}: {result.stderr}"


@functools.cache
def bakes_textures(program):
    return "--texture" in subprocess.run([program, "bake", "--help"], capture_output=True, text=True).stdout


def messages_of(modules, files):
    """What the validator has to say, by file: severity, code and place."""
    result = subprocess.run(["node", "-e", VALIDATE, *map(str, files)], capture_output=True, text=True, cwd=modules)
    assert result.returncode == 0, result.stderr
    return [json.loads(line) for line in result.stdout.splitlines()]


def check_valid(modules, model, outputs):
    before, *afters = messages_of(modules, [model, *outputs])
    known = {(message["severity"], message["code"]) for message in before}
    for output, after in zip(outputs, afters):
        new = [message for message in after if (message["severity"], message["code"]) not in known
               and message["severity"] < 2]
        assert not new, f"{output}: {new}"
        assert sum(m["severity"] == 0 for m in after) <= sum(m["severity"] == 0 for m in before), output


class Server(http.server.ThreadingHTTPServer):
    """The folder and the npm packages, on loopback."""

    def __init__(self, folder, modules):
        class Handler(http.server.SimpleHTTPRequestHandler):
            def translate_path(self, path):
                path = path.split("?")[0]
                root = modules if path.startswith("/npm/") else folder
                return str(root / urllib.parse.unquote(path).removeprefix("/npm").lstrip("/"))

            def log_message(self, *_):
                pass

        Handler.extensions_map = {**Handler.extensions_map, ".js": "text/javascript", ".wasm": "application/wasm"}
        super().__init__(("127.0.0.1", 0), functools.partial(Handler, directory=str(folder)))
        threading.Thread(target=self.serve_forever, daemon=True).start()


def open_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--ignore-gpu-blocklist", "--window-size=420,420", "--no-first-run"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    browser.set_script_timeout(60)
    return browser


class Viewer:
    def __init__(self, browser, folder, modules):
        (folder / "page.html").write_text(PAGE)
        self.browser, self.folder = browser, folder
        self.server = Server(folder, modules)
        browser.get(f"http://127.0.0.1:{self.server.server_port}/page.html")

    def show(self, name, eye):
        facts = self.browser.execute_async_script("""
            const [name, eye, done] = arguments;
            const go = () => window.isReady ? show(name, eye).then(done, (error) => done(String(error)))
                                            : setTimeout(go, 20);
            go();""", name, eye)
        assert isinstance(facts, dict), f"{name}: {facts}"
        self.browser.save_screenshot(str(self.folder / (name.replace("/", "_") + ".png")))
        return facts


def check_viewer(viewer, model, shown, plain, eye):
    """`plain` has its occlusion in an attribute that viewers do not show; `shown` in one that they do.

    At the foot of the wall half of the light is gone: 0.735 of the brightness in sRGB.
    """
    before, hidden, dark = (viewer.show(name, eye) for name in (model, plain, shown))
    assert before["count"] > 2000 and before["count"] == hidden["count"] == dark["count"], (before, hidden, dark)
    assert hidden["mean"] == before["mean"], f"{plain} looks otherwise: {hidden}, {before}"
    assert hidden["attributes"] > 0 and before["attributes"] == 0
    assert 0.9 * before["mean"] < dark["mean"] < 0.99 * before["mean"], f"{shown}: {dark}, {before}"
    assert 0.7 * before["darkest"] < dark["darkest"] < 0.8 * before["darkest"], f"{shown}: {dark}, {before}"
    print(f"{shown}: down to {dark['darkest'] / before['darkest']:.3f} of the brightness of {model}")


def main():
    program, folder, shared = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    modules = install_packages(folder.with_name(folder.name + ".npm"))
    models = write_models(folder)
    for name in ("BoxTextured.glb", "DamagedHelmet.gltf"):
        if (shared / "models" / name).exists():
            models.append(shared / "models" / name)
        else:
            print(f"NOT TESTED: the sample model {name} is missing (looked in {shared / 'models'})")
    for model in models:
        outputs = [folder / f"{model.stem}_{kind}{model.suffix}" for kind in ("occlusion", "color")]
        for output in outputs:
            bake(program, model, output, "--attribute", output.stem.rsplit("_", 1)[1])
        other = folder / f"{model.stem}_other{'.glb' if model.suffix == '.gltf' else '.gltf'}"
        bake(program, model, other)
        outputs.append(other)
        if bakes_textures(program):
            outputs.append(folder / f"{model.stem}_map{model.suffix}")
            bake(program, model, outputs[-1], "--texture", "128")
        check_valid(modules, model, outputs)
    print(f"{len(models)} models are as valid as before")
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        skip("the viewer needs chromium, chromium-driver and python3-selenium")
    browser = open_browser()
    try:
        viewer = Viewer(browser, folder, modules)
        check_viewer(viewer, "corner.glb", "corner_color.glb", "corner_occlusion.glb", [0.5, 0.5, 1])
        check_viewer(viewer, "corner.gltf", "corner_color.gltf", "corner_occlusion.gltf", [0.5, 0.5, 1])
        if bakes_textures(program):
            facts = viewer.show("corner_map.glb", [0.5, 0.5, 1])
            assert facts["maps"] == 3, facts
            assert 0.7 * facts["mean"] < facts["darkest"] < 0.85 * facts["mean"], facts
        for name in ("BoxTextured_color.glb", "DamagedHelmet_other.glb"):
            if (folder / name).exists():
                assert viewer.show(name, [0.6, 0.4, 1])["count"] > 2000, f"{name} is not to be seen"
        severe = [entry for entry in browser.get_log("browser")
                  if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]
        assert not severe, severe
    finally:
        browser.quit()


main()
