// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The shaders of bindings/shaders as vertex shaders of WebGL 2: each gives `position` and `direction` of a vertex, by names
// of uniforms that `set` tells. HLSL is compiled by glslang, and by DXC where there is one, and turned back by SPIRV-Cross.
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const read = (name) => readFileSync(new URL(`../../bindings/shaders/${name}`, import.meta.url), 'utf8');
export const has = (program) => spawnSync('which', [program]).status === 0;

const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv1;
out vec3 shown, shownNormal;
`;

/** GLSL of the vertex function of the shader for Godot, whose own names stand before it. */
export function godot() {
  const code = read('anicodec_basis.gdshader').replace(/^shader_type .*$/m, '')
    .replace(/^(uniform [^;:=]+)(:[^;=]*)?(=[^;]*)?;/gm, '$1;').replace(/void fragment\(\) \{[^]*$/, '');
  return `${HEAD}
const float TIME = 1e9;
const vec4 INSTANCE_CUSTOM = vec4(0.0);
vec3 VERTEX, NORMAL;
vec2 UV2;
${code}
void main() {
  VERTEX = position;
  NORMAL = normal;
  UV2 = uv1;
  vertex();
  shown = VERTEX;
  shownNormal = NORMAL;
}`;
}

/** That of the code that three.js gets. */
export function three() {
  const [, code] = /const DECLARED = `([^]*?)`;/.exec(read('anicodec_basis.js'));
  return `${HEAD.replace('layout(location = 2) in vec2 uv1;\n', '')}
${code.replace('in vec2 uv1;', 'layout(location = 2) in vec2 uv1;')}
void main() {
  shown = position + anicOffset();
  shownNormal = anicNormal(normal);
}`;
}

const DECLARED = `
cbuffer Params : register(b2) { float4 sizes; float4 decoding; float4 clip; float4 seconds; };
Texture2D<float4> Basis : register(t0);
Texture2D<float4> Weights : register(t1);
struct In { float3 position : POSITION; float3 normal : NORMAL; float2 uv : TEXCOORD0; };
struct Out { float4 place : SV_Position; float3 shown : TEXCOORD0; float3 shownNormal : TEXCOORD1; };
Out main(In i)
{
    Out o;
    o.place = float4(0, 0, 0, 1);
    BODY
    return o;
}
`;

/** HLSL of Unity's file, as a vertex shader calls it. */
export function unity() {
  return read('AnicodecBasis.hlsl') + DECLARED.replace('BODY',
    'AnicodecBasis(Basis, Weights, i.position, i.normal, i.uv, sizes.xyz, decoding, clip, seconds.x, o.shown, o.shownNormal);');
}

/**
 * HLSL of Unreal's Custom node, in the function that Unreal makes of it. Its structure goes before it for glslang, which
 * takes calls of a structure within a function for calls of itself.
 */
export function unreal({ hoisted = true } = {}) {
  const text = read('AnicodecBasis.ush'), at = text.indexOf('\n};\n') + 4;
  const [structure, body] = hoisted ? [text.slice(0, at), text.slice(at)] : ['', text];
  return `${structure}
float3 Custom(Texture2D<float4> Basis, Texture2D<float4> Weights, float2 UV1, float3 Layout, float4 Decoding, float4 Clip,
              float Seconds, out float3 ShownNormal)
{
${body}
}
${DECLARED.replace('BODY', 'o.shown = i.position + Custom(Basis, Weights, i.uv, sizes.xyz, decoding, clip, seconds.x, o.shownNormal);')}`;
}

/** Compiles GLSL ES; throws with glslang's words. */
export function check(glsl, folder) {
  const file = join(folder, 'shader.vert');
  writeFileSync(file, glsl);
  execFileSync('glslangValidator', [file], { encoding: 'utf8' });
}

/** GLSL ES of HLSL. */
export function translated(hlsl, folder) {
  const file = join(folder, 'shader.hlsl'), binary = join(folder, 'shader.spv');
  writeFileSync(file, hlsl);
  execFileSync('glslangValidator', ['-D', '-S', 'vert', '-e', 'main', '-V', '-o', binary, file], { encoding: 'utf8' });
  return has('spirv-cross') ? execFileSync('spirv-cross', [binary, '--es', '--version', '300', '--flatten-ubo'], { encoding: 'utf8' }) : undefined;
}

/** Compiles HLSL by DXC. */
export function checkByDxc(hlsl, folder) {
  const file = join(folder, 'dxc.hlsl');
  writeFileSync(file, hlsl);
  execFileSync('dxc', ['-T', 'vs_6_0', '-E', 'main', '-Fo', join(folder, 'dxc.bin'), file], { encoding: 'utf8' });
}
