// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Plays a live stream some files behind, so that one that comes late or is lost makes no stop.
import { Anicodec } from '../../index.js';
import { ClipView, Orbit, SurfaceView } from '../../viewer/surface_view.js';

const BEHIND = 3;  // files
const LATE = 1.5;  // more files behind than that: skip

/** Clips with the time that is shown, in seconds of the capture. */
class Timeline {
  pieces = [];
  #connected = 0;  // time from which on no clip is missing

  add(view) {
    const { startTime, frames, rate } = view.clip.info, start = startTime, end = startTime + frames / rate;
    if (!this.last || start > this.last.end + 0.5 / rate)
      this.#connected = start;
    this.pieces.push({ view, start, end });
    const wanted = end - BEHIND * (end - start), late = this.time === undefined ? 0 : LATE * (end - start);
    if (this.#connected <= wanted && !(this.time >= wanted - late))
      this.time = wanted;
  }

  get last() {
    return this.pieces.at(-1);
  }

  /** Goes on by so many seconds, as far as there are clips, and gives the one to show. */
  advance(seconds) {
    if (this.time === undefined)
      return undefined;
    this.time = Math.min(this.time + seconds, this.last.end);
    while (this.pieces.length > 1 && this.pieces[1].start <= this.time)
      this.pieces.shift().view.dispose();
    return this.pieces[0];
  }
}

/** Messages as a stream of bytes; those that are text go to onText. */
function bytesOf(socket, onText) {
  socket.binaryType = 'arraybuffer';
  return new ReadableStream({
    start(controller) {
      socket.onmessage = ({ data }) => (typeof data === 'string' ? onText(JSON.parse(data)) : controller.enqueue(new Uint8Array(data)));
      socket.onclose = () => controller.close();
    },
  });
}

const output = document.querySelector('output'), canvas = document.querySelector('canvas');
const surface = new SurfaceView(canvas), orbit = new Orbit(), timeline = new Timeline();
let begin, before = performance.now(), told = 0;
/** State for programs that look at the page: seconds between capture and picture, pictures shown, losses by Anicodec.live(). */
const state = window.live = { delay: undefined, pictures: 0, losses: [], ended: false };

function report() {
  const losses = state.losses.map(({ from, to }) => `lost: ${from?.toFixed(2)} s to ${to?.toFixed(2) ?? 'the end'}`);
  output.textContent = [`${timeline.time.toFixed(2)} s, ${state.delay.toFixed(2)} s behind the capture`, ...losses].join('\n');
  console.info(output.textContent);
}

function show(now) {
  const piece = timeline.advance((now - before) / 1000);
  before = now;
  if (piece) {
    const { clip } = piece.view;
    state.delay = (Date.now() - begin) / 1000 - timeline.time;
    piece.view.seek(Math.min(timeline.time - piece.start, clip.duration));
    surface.draw([piece.view], orbit, { background: [0.11, 0.12, 0.14] });
    ++state.pictures;
    if (now - told > 1000) {
      told = now;
      report();
    }
  }
  requestAnimationFrame(show);
}

requestAnimationFrame(show);
const socket = new WebSocket(`ws://${location.host}/live`);
// A page that joins late gets an old file with the meshes first: nothing is lost behind it.
const onLoss = (loss) => timeline.time !== undefined && state.losses.push(loss);
const clips = Anicodec.live(bytesOf(socket, (text) => ({ begin } = text)), { bounds: true, onLoss });
for await (const clip of clips) {
  if (!timeline.last)
    orbit.show(clip.bounds, clip.info.up === 'z');
  timeline.add(new ClipView(surface, clip));
}
state.ended = true;
