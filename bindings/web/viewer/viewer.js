// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The viewer: one page that holds the decoder, and a clip where `anicodec render` has put one.
import { clipInGlb } from '../glb.js';
import { open, readMetadata } from '../index.js';
import { provideModule } from '../module.js';
import { MEANINGS, chunkSizes } from './chunks.js';
import { fieldColour, fieldNames, gradient, rangeOf, sharesOf } from '../fields.js';
import { ClipView, Orbit, SurfaceView, errorColour } from './surface_view.js';

const SPEEDS = [-1, 0.1, 0.25, 0.5, 1, 2, 4];
const $ = (id) => document.getElementById(id);
const orbit = new Orbit();
/** Whether what is in a file fits beside its picture. */
function isRoomy() {
  return innerWidth > 700 && innerHeight > 400;
}
const state = { clips: [], name: undefined, time: 0, playing: false, speed: 1, loop: true, wires: false, error: false, about: isRoomy(), dirty: true, fps: 0, decode: 0 };
let view;

function fromBase64(text) {
  const raw = atob(text.trim()), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i)
    bytes[i] = raw.charCodeAt(i);
  return bytes;
}

async function unzipped(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function say(text) {
  $('message').textContent = text;
  $('message').hidden = !text;
}

const inBytes = (n) => (n < 1e4 ? `${n} B` : n < 1e7 ? `${(n / 1e3).toFixed(1)} kB` : `${(n / 1e6).toFixed(1)} MB`);
const number = (n) => n.toLocaleString('en').replaceAll(',', '\u202f');

function describe() {
  const rows = (list) => {
    const table = document.createElement('table');
    for (const [name, value] of list) {
      const row = table.insertRow();
      row.insertCell().textContent = name;
      row.insertCell().textContent = value;
    }
    return table;
  };
  $('info').replaceChildren(...state.clips.flatMap(({ clip, name, bytes, openMs }) => {
    const title = document.createElement('h2'), { info } = clip, one = shown(clip), several = clip.clips.length > 1;
    title.textContent = name;
    const sum = (key) => clip.meshes.reduce((all, mesh) => all + mesh[key], 0);
    const bits = 8 * bytes.length / Math.max(sum('sourceVertexCount') * info.frames, 1);
    return [title, rows([
      ['file', inBytes(bytes.length)], ['per vertex and frame', `${bits.toPrecision(3)} bits`],
      ['vertices', number(sum('sourceVertexCount'))], ['triangles', number(sum('triangleCount'))], ['meshes', number(clip.meshes.length)],
      ...(several ? [['clips', number(clip.clips.length)], ['frames of all', number(info.frames)], ['this clip', one.name]] : []),
      ['frames', `${number(one.frames)}, ${+one.rate.toFixed(3)} a second${one.rateAssumed ? ' (assumed)' : ''}`],
      ['largest error', `${one.maxError.toPrecision(3)}, ${(100 * one.maxError / one.diagonal).toPrecision(2)} % of the size`],
      ['opened in', `${openMs.toFixed(0)} ms`], ['memory', inBytes(clip.memoryBytes)],
    ]), rows(chunkSizes(bytes).map(({ type, size, share }) => [`${MEANINGS[type] ?? type}`, `${inBytes(size)}, ${(100 * share).toFixed(0)} %`]))];
  }), Object.assign(document.createElement('div'), { id: 'figures' }));
}

const correspond = () => state.clips.length === 2 && state.clips[0].clip.meshes.length === state.clips[1].clip.meshes.length &&
  state.clips[0].clip.meshes.every((mesh, m) => mesh.sourceVertexCount === state.clips[1].clip.meshes[m].sourceVertexCount);

/** The clip of a file that is shown: the one that was chosen, where the file has it. */
const shown = (clip) => clip.clips.find(({ name }) => name === state.name) ?? clip.find();

/** Distances of the vertices of the second clip from those of the first at this time, as shares of the largest. */
function measure() {
  const [a, b] = state.clips.map(({ clip }) => clip);
  let largest = 0, sum = 0, count = 0;
  const [of, by] = [a, b].map((clip) => ({ clip: shown(clip).index }));
  const distances = b.meshes.map((mesh, m) => {
    if (!mesh.isPresent(state.time, by) || !a.meshes[m].isPresent(state.time, of))
      return undefined;
    const p = a.meshes[m].sourcePositions(state.time, undefined, of), q = mesh.sourcePositions(state.time, undefined, by);
    const far = Float32Array.from({ length: p.length / 3 }, (_, v) => Math.hypot(p[3 * v] - q[3 * v], p[3 * v + 1] - q[3 * v + 1], p[3 * v + 2] - q[3 * v + 2]));
    for (const d of far) {
      largest = Math.max(largest, d);
      sum += d * d;
    }
    count += far.length;
    return Array.from(mesh.sourceVertices, (v) => far[v]);
  });
  state.errors = { largest, rmse: Math.sqrt(sum / Math.max(count, 1)) };
  return distances.map((d) => d?.map((x) => (largest > 0 ? x / largest : 0)));
}

/** Colours by the error of the second clip, by a field, or their own. */
function paint() {
  const errors = correspond() ? measure() : undefined;
  state.clips.forEach((one, i) => {
    if (i === 1 && state.error && errors) {
      one.colour(errors, errorColour);
      return;
    }
    const { index } = shown(one.clip), options = { clip: index, wrap: state.loop ? 'loop' : 'clamp' };
    one.colour(state.field && sharesOf(one.clip, state.field, state.time, options), fieldColour);
  });
}

/** Shows a field of the first clip as colours, in both; without a name none. */
function chooseField(name) {
  const [{ clip, metadata }] = state.clips, range = name ? rangeOf(clip, name, shown(clip)) : undefined;
  state.field = range && { name, ...range };
  $('field').value = range ? name : '';
  $('legend').hidden = !range;
  if (range) {
    const unit = metadata?.fields?.[name]?.unit, text = (value) => `${+value.toPrecision(4)}`;
    $('legend').title = `${name} of the frames${unit ? ` in ${unit}` : ''}`;
    $('low').textContent = text(range.low);
    $('high').textContent = `${text(range.high)}${unit ? ` ${unit}` : ''}`;
  }
  state.dirty = true;
}

function background() {
  const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g).map((v) => v / 255);
  return [r, g, b];
}

const duration = () => Math.max(...state.clips.map(({ clip }) => shown(clip)).map((c) => (c.loop && state.loop ? c.loopDuration : c.duration)), 0);

function draw() {
  const before = performance.now();
  for (const one of state.clips)
    one.seek(state.time, { clip: shown(one.clip).index, wrap: state.loop ? 'loop' : 'clamp' });
  state.decode = performance.now() - before;
  paint();
  view.draw(state.clips, orbit, { wires: state.wires, unlit: false, background: background() });
  const end = duration(), frame = state.clips.length ? Math.round(Math.min(state.time, end) * shown(state.clips[0].clip).rate) : 0;
  $('time').value = end > 0 ? state.time / end : 0;
  $('clock').textContent = `${state.time.toFixed(2)} s, ${frame}`;
  if (state.about && $('figures'))
    $('figures').textContent = `${state.decode.toFixed(2)} ms to decode a frame${state.playing && state.fps > 0 ? `, ${state.fps.toFixed(0)} frames a second` : ''}` +
      (correspond() ? `; error of the second now: largest ${state.errors.largest.toPrecision(3)}, RMSE ${state.errors.rmse.toPrecision(3)}` : '');
}

let last = 0;
function tick(now) {
  const seconds = Math.min((now - last) / 1000, 0.25), end = duration();
  last = now;
  if (state.playing && end > 0) {
    state.time += seconds * state.speed;
    if (seconds > 0)
      state.fps += (1 / seconds - state.fps) * 0.05;
    if (state.loop) {
      state.time = ((state.time % end) + end) % end;
    } else if (state.time >= end || state.time <= 0) {
      state.time = Math.min(Math.max(state.time, 0), end);
      set('playing', false);
    }
    state.dirty = true;
  }
  if (state.dirty) {
    state.dirty = false;
    draw();
  }
  requestAnimationFrame(tick);
}

function set(name, value) {
  state[name] = value;
  state.dirty = true;
  $('play').textContent = state.playing ? 'Pause' : 'Play';
  for (const id of ['loop', 'wires', 'error', 'about'])
    $(id).setAttribute('aria-pressed', state[id]);
  $('info').hidden = !state.about || state.clips.length === 0;
  $('speed').value = state.speed;
}

/** Adds a file; a third one begins anew. */
async function add(name, file) {
  const bytes = clipInGlb(file), metadata = await readMetadata(bytes), before = performance.now(), clip = await open(bytes, { worker: false });
  if (state.clips.length === 2) {
    for (const old of state.clips)
      old.dispose();
    state.clips = [];
  }
  state.clips.push(Object.assign(new ClipView(view, clip), { name, bytes, metadata, openMs: performance.now() - before }));
  if (state.clips.length === 1) {
    orbit.show(clip.bounds, clip.info.up === 'z');
    state.time = 0;
  }
  say('');
  document.title = state.clips.map((c) => c.name).join(', ');
  $('drop').hidden = true;
  $('controls').hidden = false;
  $('error').hidden = !correspond();
  const { clips } = state.clips[0].clip;
  $('clip').replaceChildren(...clips.map((one) => Object.assign(document.createElement('option'), { value: one.name, textContent: one.name || `clip ${one.index}` })));
  $('clip').hidden = clips.length === 1;
  const fields = fieldNames(state.clips[0].clip);
  $('field').replaceChildren(...['', ...fields].map((value) => Object.assign(document.createElement('option'), { value, textContent: value || 'Colours' })));
  $('field').hidden = fields.length === 0;
  if (!fields.includes(state.field?.name))
    state.field = undefined;
  choose(shown(state.clips[0].clip).name);
}

function choose(name) {
  state.name = $('clip').value = name;
  state.time = 0;
  chooseField(state.field?.name);
  describe();
  set('playing', state.clips.some(({ clip }) => shown(clip).frames > 1));
}

async function addFiles(files) {
  for (const file of files) {
    try {
      await add(file.name, new Uint8Array(await file.arrayBuffer()));
    } catch (error) {
      say(`${file.name}: ${error.status ? `${error.status}, ` : ''}${error.message}`);
    }
  }
}

function listen() {
  for (const speed of SPEEDS)
    $('speed').append(Object.assign(document.createElement('option'), { value: speed, textContent: `${speed} ×` }));
  $('speed').onchange = () => set('speed', Number($('speed').value));
  $('clip').onchange = () => choose($('clip').value);
  $('field').onchange = () => chooseField($('field').value);
  $('legend').querySelector('i').style.background = gradient;
  $('play').onclick = () => set('playing', !state.playing);
  for (const id of ['loop', 'wires', 'error', 'about'])
    $(id).onclick = () => set(id, !state[id]);
  $('time').oninput = () => {
    state.time = Number($('time').value) * duration();
    set('playing', false);
  };
  $('choose').onclick = $('open').onclick = () => $('files').click();
  $('files').onchange = () => addFiles($('files').files).then(() => { $('files').value = ''; });
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    addFiles(event.dataTransfer.files);
  });
  new ResizeObserver(() => set('dirty', true)).observe($('canvas'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => set('dirty', true));

  const pointers = new Map();
  const canvas = $('canvas');
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => pointers.delete(event.pointerId);
  const apart = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  canvas.onpointermove = (event) => {
    const before = pointers.get(event.pointerId);
    if (!before)
      return;
    const dx = (event.clientX - before[0]) / canvas.clientHeight, dy = (event.clientY - before[1]) / canvas.clientHeight;
    const distance = pointers.size === 2 ? apart() : 0;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (pointers.size === 2) {
      orbit.zoom(distance / Math.max(apart(), 1));
      orbit.pan(dx / 2, -dy / 2);
    } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) {
      orbit.pan(dx, -dy);
    } else {
      orbit.turn(4 * dx, 4 * dy);
    }
    state.dirty = true;
  };
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    orbit.zoom(Math.exp(event.deltaY * 0.001));
    state.dirty = true;
  }, { passive: false });

  const step = (frames) => {
    state.time = Math.min(Math.max(state.time + frames / (state.clips.length ? shown(state.clips[0].clip).rate : 1), 0), duration());
    set('playing', false);
  };
  const other = () => {
    const clips = state.clips[0]?.clip.clips ?? [];
    if (clips.length > 1)
      choose(clips[(shown(state.clips[0].clip).index + 1) % clips.length].name);
  };
  const nextField = () => {
    const names = Array.from($('field').options, ({ value }) => value);
    if (names.length > 1)
      chooseField(names[(names.indexOf($('field').value) + 1) % names.length]);
  };
  const speed = (by) => set('speed', SPEEDS[Math.min(Math.max(SPEEDS.indexOf(state.speed) + by, 0), SPEEDS.length - 1)]);
  const keys = {
    ' ': () => set('playing', !state.playing), l: () => set('loop', !state.loop), w: () => set('wires', !state.wires),
    e: () => correspond() && set('error', !state.error), i: () => set('about', !state.about), c: other, f: nextField, o: () => $('files').click(),
    ',': () => step(-1), '.': () => step(1), '[': () => speed(-1), ']': () => speed(1), Home: () => step(-1e9),
    '+': () => orbit.zoom(0.9), '-': () => orbit.zoom(1.1), ArrowLeft: () => orbit.turn(0.1, 0), ArrowRight: () => orbit.turn(-0.1, 0),
    ArrowUp: () => orbit.turn(0, 0.1), ArrowDown: () => orbit.turn(0, -0.1),
  };
  addEventListener('keydown', (event) => {
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey || (event.target !== document.body && event.target !== canvas))
      return;
    event.preventDefault();
    act();
    state.dirty = true;
  });
}

async function start() {
  view = new SurfaceView($('canvas'));
  const module = WebAssembly.compile(await unzipped(fromBase64($('decoder').textContent)));
  provideModule('small', module);
  provideModule('full', module);
  listen();
  requestAnimationFrame(tick);
  const inside = [...document.querySelectorAll('script.clip')].map((script) => ({ name: script.dataset.name, load: () => fromBase64(script.textContent) }));
  const asked = new URLSearchParams(location.search).getAll('url').map((url) => ({ name: url.split('/').pop(), load: async () => {
    const response = await fetch(url);
    if (!response.ok)
      throw new Error(`${response.status} ${response.statusText}`);
    return new Uint8Array(await response.arrayBuffer());
  } }));
  for (const { name, load } of [...inside, ...asked]) {
    try {
      await add(name, await load());
    } catch (error) {
      say(`${name}: ${error.status ? `${error.status}, ` : ''}${error.message}`);
    }
  }
  document.documentElement.dataset.ready = 'true';
}

start().catch((error) => say(error.message));
