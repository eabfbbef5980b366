// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Draws the meshes of clips by WebGL2: shaded, as wires, or in colours of numbers.

const VERTEX = `#version 300 es
in vec3 position, normal, colour;
uniform mat4 view, projection;
uniform float size;
out vec3 vNormal, vColour;
void main() {
  vec4 p = view * vec4(position, 1.0);
  vNormal = mat3(view) * normal;
  vColour = colour;
  gl_Position = projection * p;
  gl_PointSize = size;
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 vNormal, vColour;
uniform float lit;
out vec4 pixel;
void main() {
  vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
  float light = 0.35 + 0.25 * (0.5 + 0.5 * n.y) + 0.5 * max(dot(n, normalize(vec3(0.4, 0.6, 0.8))), 0.0);
  pixel = vec4(pow(vColour * mix(1.0, light, lit), vec3(1.0 / 2.2)), 1.0);
}`;

function compile(gl) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(`WebGL: ${gl.getProgramInfoLog(program)}`);
  return program;
}

/** Each edge of the triangles once, as pairs of vertices. */
function edgesOf(indices, vertexCount) {
  const seen = new Set(), edges = [];
  for (let i = 0; i < indices.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = indices[i + k], b = indices[i + (k + 1) % 3], key = a < b ? a * vertexCount + b : b * vertexCount + a;
      if (!seen.has(key)) {
        seen.add(key);
        edges.push(a, b);
      }
    }
  }
  return new Uint32Array(edges);
}

/** One mesh on the graphics card. */
class Surface {
  constructor(gl, program, mesh) {
    Object.assign(this, { gl, mesh, arrays: gl.createVertexArray(), buffers: {} });
    gl.bindVertexArray(this.arrays);
    const n = mesh.vertexCount;
    this.positions = new Float32Array(3 * n);
    this.normals = new Float32Array(3 * n);
    this.plain = new Float32Array(3 * n).fill(0.6);
    this.colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3);
    this.takeColours(0);
    for (const [name, data] of [['position', this.positions], ['normal', this.normals], ['colour', this.plain]]) {
      const at = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name] = gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    }
    this.triangles = this.elements(mesh.indices);
    gl.bindVertexArray(null);
  }

  takeColours(time, options) {
    if (!this.colour || !this.mesh.isPresent(time, options))
      return;
    const { index, components } = this.colour, values = this.mesh.attribute(index, time, undefined, options);
    for (let v = 0; v < this.mesh.vertexCount; ++v)
      this.plain.set(values.subarray(v * components, v * components + 3), 3 * v);
  }

  elements(indices) {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ELEMENT_ARRAY_BUFFER, buffer);
    this.gl.bufferData(this.gl.ELEMENT_ARRAY_BUFFER, indices, this.gl.STATIC_DRAW);
    return { buffer, count: indices.length };
  }

  fill(name, data) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferSubData(this.gl.ARRAY_BUFFER, 0, data);
  }

  /** Takes the shape at a time; false when the mesh is not there. */
  seek(time, options) {
    this.present = this.mesh.isPresent(time, options);
    if (!this.present)
      return false;
    this.mesh.surfaceAt(time, this.positions, this.normals, options);
    this.fill('position', this.positions);
    this.fill('normal', this.normals);
    if (this.colour?.moves) {
      this.takeColours(time, options);
      this.fill('colour', this.plain);
    }
    return true;
  }

  draw(wires) {
    const { gl } = this;
    if (!this.present)
      return;
    gl.bindVertexArray(this.arrays);
    if (this.triangles.count === 0) {
      gl.drawArrays(gl.POINTS, 0, this.mesh.vertexCount);
      return;
    }
    if (wires)
      this.wires ??= this.elements(edgesOf(this.mesh.indices, this.mesh.vertexCount));
    const { buffer, count } = wires ? this.wires : this.triangles;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
    gl.drawElements(wires ? gl.LINES : gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
  }

  dispose() {
    const { gl } = this;
    for (const buffer of [...Object.values(this.buffers), this.triangles.buffer, this.wires?.buffer])
      gl.deleteBuffer(buffer ?? null);
    gl.deleteVertexArray(this.arrays);
  }
}

/** Everything of one clip. */
export class ClipView {
  constructor(view, clip) {
    this.clip = clip;
    this.surfaces = clip.meshes.map((mesh) => new Surface(view.gl, view.program, mesh));
  }

  seek(time, options) {
    for (const surface of this.surfaces)
      surface.seek(time, options);
  }

  /** Colours of numbers: of each surface, a share of each vertex, from 0 to 1; undefined: its own colours. */
  colour(shares, colourOf) {
    if (!shares && !this.shares)
      return;
    this.shares = shares;
    this.surfaces.forEach((surface, m) => {
      const of = shares?.[m];
      if (!of) {
        surface.fill('colour', surface.plain);
        return;
      }
      const colours = new Float32Array(3 * of.length);
      of.forEach((share, v) => colours.set(colourOf(share), 3 * v));
      surface.fill('colour', colours);
    });
  }

  dispose() {
    for (const surface of this.surfaces)
      surface.dispose();
    this.clip.close();
  }
}

/** From grey over yellow and red to black, as `anicodec render` colours errors. */
export function errorColour(share) {
  const stops = [[0.6, 0.6, 0.6], [0.9, 0.8, 0.1], [0.8, 0.1, 0.05], [0, 0, 0]];
  const at = Math.min(Math.max(share, 0), 1) * 3, i = Math.min(Math.floor(at), 2), t = at - i;
  return stops[i].map((a, c) => a + (stops[i + 1][c] - a) * t);
}

function multiply(a, b) {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; ++c) {
    for (let r = 0; r < 4; ++r) {
      for (let k = 0; k < 4; ++k)
        out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    }
  }
  return out;
}

/** Looks at a box from around it. Angles in radians. */
export class Orbit {
  constructor() {
    Object.assign(this, { azimuth: 0.5, elevation: 0.25, distance: 3, shift: [0, 0], centre: [0, 0, 0], radius: 1, zUp: false });
  }

  show({ min, max }, zUp) {
    this.centre = min.map((v, i) => (v + max[i]) / 2);
    this.radius = Math.max(Math.hypot(...min.map((v, i) => max[i] - v)) / 2, 1e-20);
    this.zUp = zUp;
  }

  turn(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.min(Math.max(this.elevation + dy, -1.55), 1.55);
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 0.05), 100);
  }

  pan(dx, dy) {
    this.shift = [this.shift[0] + dx * this.distance * 0.5, this.shift[1] + dy * this.distance * 0.5];
  }

  /** View and projection, column by column. */
  matrices(aspect) {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const s = 1 / this.radius, [x, y, z] = this.centre;
    const place = new Float32Array([s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, -x * s, -y * s, -z * s, 1]);
    const up = this.zUp ? new Float32Array([1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1])
      : new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    const turn = new Float32Array([ca, se * sa, ce * sa, 0, 0, ce, -se, 0, -sa, se * ca, ce * ca, 0,
      this.shift[0], this.shift[1], -this.distance, 1]);
    const near = Math.max(this.distance - 3, this.distance / 100), far = this.distance + 3, f = 1 / Math.tan(0.35);
    // The ball around the clip fits into the shorter side.
    const projection = new Float32Array([f / Math.max(aspect, 1), 0, 0, 0, 0, f * Math.min(aspect, 1), 0, 0, 0, 0, (far + near) / (near - far), -1,
      0, 0, 2 * far * near / (near - far), 0]);
    return { view: multiply(turn, multiply(up, place)), projection };
  }
}

export class SurfaceView {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
    if (!this.gl)
      throw new Error('this browser has no WebGL2');
    this.program = compile(this.gl);
    const uniform = (name) => this.gl.getUniformLocation(this.program, name);
    this.uniforms = { view: uniform('view'), projection: uniform('projection'), size: uniform('size'), lit: uniform('lit') };
  }

  /** Draws the clips side by side. background: three numbers. */
  draw(clips, orbit, { wires, unlit, background }) {
    const { gl, canvas, uniforms } = this, ratio = devicePixelRatio || 1;
    const width = Math.max(Math.round(canvas.clientWidth * ratio), 1), height = Math.max(Math.round(canvas.clientHeight * ratio), 1);
    if (canvas.width !== width || canvas.height !== height)
      Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    const each = Math.floor(width / Math.max(clips.length, 1)), { view, projection } = orbit.matrices(each / height);
    gl.uniformMatrix4fv(uniforms.view, false, view);
    gl.uniformMatrix4fv(uniforms.projection, false, projection);
    gl.uniform1f(uniforms.size, 3 * ratio);
    gl.uniform1f(uniforms.lit, wires || unlit ? 0 : 1);
    clips.forEach((clip, i) => {
      gl.viewport(i * each, 0, each, height);
      for (const surface of clip.surfaces)
        surface.draw(wires);
    });
  }
}
