// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// three.js (WebGLRenderer): plays what `anicodec export-vat --form basis` writes.
import { Box3, MeshDepthMaterial, NearestFilter, NoColorSpace, RGBADepthPacking, Sphere, Vector3, Vector4 } from 'three';

const DECLARED = `
#ifndef USE_UV1
in vec2 uv1;
#endif
uniform highp sampler2D anicBasis, anicWeights;
uniform highp int anicRows, anicPositionLayers, anicNormalLayers;
uniform highp vec4 anicDecoding;
uniform highp vec4 anicClip;  // first frame, frames, frames a second, 1 for a loop
uniform highp float anicSeconds;
#ifdef USE_INSTANCING
in float anicDelay;
#endif

// Rows of textures of EXRLoader count from the bottom.
vec4 anicFetch(highp sampler2D from, int x, int y) {
  return texelFetch(from, ivec2(x, textureSize(from, 0).y - 1 - y), 0);
}

vec3 anicWeight(int column, ivec2 frames, float share) {
  int rows = textureSize(anicWeights, 0).y, columns = 2 + 4 * (anicPositionLayers + anicNormalLayers);
  vec3 a = anicFetch(anicWeights, column + frames.x / rows * columns, frames.x % rows).xyz;
  vec3 b = anicFetch(anicWeights, column + frames.y / rows * columns, frames.y % rows).xyz;
  return mix(a, b, share) * anicDecoding.z + anicDecoding.w;
}

vec3 anicSum(int firstLayer, int layers, int column, ivec2 frames, float share) {
  ivec2 place = ivec2(uv1 * vec2(float(textureSize(anicBasis, 0).x), float(anicRows)));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < layers; ++i) {
    vec4 b = anicFetch(anicBasis, place.x, place.y + (firstLayer + i) * anicRows) * anicDecoding.x + anicDecoding.y;
    for (int k = 0; k < 4; ++k)
      sum += b[k] * anicWeight(column + 4 * i + k, frames, share);
  }
  return sum;
}

void anicFrames(out ivec2 frames, out float share) {
  float seconds = anicSeconds;
#ifdef USE_INSTANCING
  seconds += anicDelay;
#endif
  int count = int(anicClip.y);
  bool loop = anicClip.w > 0.5;
  float at = max(seconds, 0.0) * anicClip.z;
  at = loop ? mod(at, anicClip.y) : min(at, anicClip.y - 1.0);
  int frame = min(int(at), count - 1);
  int next = loop ? (frame + 1) % count : min(frame + 1, count - 1);
  frames = ivec2(anicClip.x) + ivec2(frame, next);
  share = fract(at);
}

vec3 anicOffset() {
  ivec2 frames;
  float share;
  anicFrames(frames, share);
  return anicWeight(0, frames, share) + anicWeight(1, frames, share) + anicSum(0, anicPositionLayers, 2, frames, share);
}

vec3 anicNormal(vec3 rest) {
  if (anicNormalLayers == 0)
    return rest;
  ivec2 frames;
  float share;
  anicFrames(frames, share);
  return normalize(anicSum(anicPositionLayers, anicNormalLayers, 2 + 4 * anicPositionLayers, frames, share));
}
`;

/** Replaces parts of a shader of three.js; one that is not there is an error. */
function replaced(shader, chunk, text) {
  if (!shader.includes(chunk))
    throw new Error(`this version of three.js has no ${chunk}`);
  return shader.replace(chunk, text);
}

/**
 * A clip of basis textures on a mesh of three.js, that of NAME.glb. `basis`, `weights`: textures of EXRLoader;
 * `description`: NAME_basis.json. Set `seconds` each frame; `clip` chooses one by its number.
 * An InstancedMesh may have an InstancedBufferAttribute `anicDelay`, seconds that each instance adds.
 */
export class AnicBasis {
  #clips;

  constructor(mesh, { basis, weights, description }) {
    for (const texture of [basis, weights])
      Object.assign(texture, { magFilter: NearestFilter, minFilter: NearestFilter, generateMipmaps: false, colorSpace: NoColorSpace, needsUpdate: true });
    this.#clips = description.clips;
    this.uniforms = {
      anicBasis: { value: basis }, anicWeights: { value: weights }, anicRows: { value: description.rows },
      anicPositionLayers: { value: description.position_layers }, anicNormalLayers: { value: description.normal_layers },
      anicDecoding: { value: new Vector4(description.basis_scale, description.basis_bias, description.weight_scale, description.weight_bias) },
      anicClip: { value: new Vector4() }, anicSeconds: { value: 0 },
    };
    this.clip = 0;
    // The mesh rests in a box that it leaves.
    const { min, max } = description.box;
    mesh.geometry.boundingBox = new Box3(new Vector3(...min), new Vector3(...max));
    mesh.geometry.boundingSphere = mesh.geometry.boundingBox.getBoundingSphere(new Sphere());
    mesh.customDepthMaterial ??= new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
    for (const material of [mesh.material, mesh.customDepthMaterial].flat())
      this.#take(material);
  }

  #take(material) {
    const before = material.onBeforeCompile;
    material.onBeforeCompile = (shader, renderer) => {
      before.call(material, shader, renderer);
      Object.assign(shader.uniforms, this.uniforms);
      let code = replaced(shader.vertexShader, '#include <common>', `#include <common>\n${DECLARED}`);
      code = replaced(code, '#include <begin_vertex>', '#include <begin_vertex>\ntransformed += anicOffset();');
      if (code.includes('#include <beginnormal_vertex>'))
        code = code.replace('#include <beginnormal_vertex>', '#include <beginnormal_vertex>\nobjectNormal = anicNormal(objectNormal);');
      shader.vertexShader = code;
    };
    material.customProgramCacheKey = () => 'anicodec basis';
    material.needsUpdate = true;
  }

  get seconds() { return this.uniforms.anicSeconds.value; }

  set seconds(value) { this.uniforms.anicSeconds.value = value; }

  /** Number of the clip in the description. */
  set clip(number) {
    const { first_frame: first, frame_count: count, rate, loop } = this.#clips[number];
    this.uniforms.anicClip.value.set(first, count, rate, loop ? 1 : 0);
  }
}
