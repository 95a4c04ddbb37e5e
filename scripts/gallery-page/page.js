// The page itself: live pictures that are lit by hand, and sliders between two pictures.

const data = JSON.parse(document.getElementById('data').textContent);

// A file of the page: { name, bytes }. Those that are not compressed by themselves are deflated.
async function fileOf(key) {
  const { name, base64, deflated } = data.files[key];
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return { name, bytes: deflated ? await inflated(bytes) : bytes };
}
async function filesOf(keys) {
  const entries = await Promise.all(Object.entries(keys).map(async ([role, key]) => [role, await fileOf(key)]));
  return Object.fromEntries(entries);
}

// A point of the unit disc as the direction to the light above it.
const overDisc = ([x, y]) => [x, y, Math.sqrt(Math.max(1 - x * x - y * y, 0.0025))];

class Live {
  constructor(figure, piece) {
    Object.assign(this, { figure, piece, place: piece.place, turned: 0, loaded: new Map() });
    this.stage = figure.querySelector('.stage');
    this.lamp = figure.querySelector('.lamp');
    this.stage.addEventListener('pointerdown', (e) => { this.stage.setPointerCapture(e.pointerId); this.#follow(e); });
    this.stage.addEventListener('pointermove', (e) => { if (e.buttons & 1) this.#follow(e); });
    this.stage.addEventListener('keydown', (e) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
      if (!step) return;
      e.preventDefault();
      this.#move(this.place.map((p, i) => p + 0.05 * step[i]));
    });
    figure.querySelector('.turn')?.addEventListener('input', (e) => { this.turned = Number(e.target.value); this.draw(); });
    for (const button of figure.querySelectorAll('.choice button')) button.addEventListener('click', () => this.choose(button));
  }

  // The first of the variants, or the only one.
  async start() {
    const first = this.figure.querySelector('.choice button[aria-pressed=true]');
    await (first ? this.choose(first) : this.#show(this.piece.files));
  }

  async choose(button) {
    for (const b of this.figure.querySelectorAll('.choice button')) b.setAttribute('aria-pressed', b === button);
    const variant = this.piece.variants[Number(button.dataset.variant)];
    await this.#show({ ...this.piece.files, ...variant.files }, variant.scene, button);
  }

  // What was shown once is kept, by its button.
  async #show(keys, changes = {}, button = this.stage) {
    const load = async () => Scene.load(this.stage.querySelector('canvas'), data.shaders,
      { ...this.piece.scene, ...changes, files: await filesOf(keys) });
    this.wanted = button;
    if (!this.loaded.has(button)) this.loaded.set(button, load());
    const scene = await this.loaded.get(button);
    if (this.wanted !== button) return;
    this.scene = scene;
    this.draw();
  }

  #follow({ clientX, clientY }) {
    const box = this.stage.getBoundingClientRect();
    this.#move([(2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height]);
  }

  #move([x, y]) {
    const far = this.piece.extent ? 1 : 0.98, length = Math.hypot(x, y), s = length > far ? far / length : 1;
    this.place = this.piece.extent ? [x, y].map((c) => Math.min(Math.max(c, -1), 1)) : [x * s, y * s];
    this.asked ??= requestAnimationFrame(() => { this.asked = undefined; this.draw(); });
  }

  draw() {
    if (!this.scene) return;
    const { extent, scene, turn } = this.piece, [x, y] = this.place;
    this.lamp.style.left = `${50 + 50 * x}%`;
    this.lamp.style.top = `${50 - 50 * y}%`;
    const first = extent ? { position: [x * extent[0], y * extent[1], extent[2]] } : { direction: overDisc(this.place) };
    const object = { ...this.scene.scene.object };
    if (turn) object.rotate_deg = (object.rotate_deg ?? [0, 0, 0]).map((d, i) => d + turn[i] * this.turned);
    this.scene.draw({ lights: [{ ...scene.lights[0], ...first }, ...scene.lights.slice(1)], object });
    this.#showTable();
  }

  // The palette's colours in this very frame, an entry a pixel.
  #showTable() {
    const canvas = this.figure.querySelector('.table-of-colors');
    if (!canvas) return;
    canvas.parentElement.classList.toggle('without-table', !this.scene.table);
    if (!this.scene.table) return;
    const colors = this.scene.colorTable();
    canvas.width = { 16: 16, 64: 32, 256: 64 }[colors.length] ?? 128;
    canvas.height = Math.ceil(colors.length / canvas.width);
    const image = new ImageData(canvas.width, canvas.height);
    colors.forEach((c, i) => image.data.set([...Array.from(c, (x) => 255 * srgb(x)), 255], 4 * i));
    canvas.getContext('2d').putImageData(image, 0, 0);
  }
}

function fail(error) {
  const note = document.getElementById('without-webgl');
  note.hidden = false;
  note.textContent = `The live pictures cannot be drawn here (${error.message}); all others can be seen without.`;
}

const lives = new Map(data.live.map((piece) => [piece.id, new Live(document.getElementById(piece.id), piece)]));
const seen = new IntersectionObserver((entries) => {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting) continue;
    seen.unobserve(target);
    lives.get(target.id).start().then(() => { target.dataset.ready = ''; }, fail);
  }
}, { rootMargin: '400px' });
for (const { figure } of lives.values()) seen.observe(figure);

for (const compare of document.querySelectorAll('.compare')) {
  const slider = compare.querySelector('input');
  const follow = () => compare.style.setProperty('--at', `${slider.value}%`);
  slider.addEventListener('input', follow);
  follow();
  const button = compare.parentElement.querySelector('.differ');
  button?.addEventListener('click', () => {
    button.setAttribute('aria-pressed', compare.classList.toggle('differing'));
  });
}

// For tests: the same drawing of any scene, without antialiasing, as bytes of sRGB.
window.gallery = {
  async pixels({ width, height, ...scene }) {
    const canvas = Object.assign(document.createElement('canvas'), { width, height });
    const drawn = await Scene.load(canvas, data.shaders, scene, { antialias: false });
    drawn.draw();
    const { gl } = drawn, out = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, out);
    if (gl.getError()) throw Error('an error of WebGL');
    gl.getExtension('WEBGL_lose_context').loseContext();
    return out;
  },
  pictureOf: readPng,
};
