// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_ENGINES_OGRE_OGRE_SHADER_H_
#define ANICODEC_SDK_ENGINES_OGRE_OGRE_SHADER_H_

namespace anicodec::ogre {

/// Texels of an instance's row before its parts, and of a part before anic_write_state().
inline constexpr unsigned kRowTexels = 1, kPartTexels = 2;

/// Positions of a clip from the textures of its basis (anic_write_texture()) and a row of states. uv1 is the vertex of
/// the clip. Needs GLSL 3.30.
inline constexpr char kVertexShader[] = R"(#version 330 core
uniform isampler2D narrow, wide;
uniform sampler2D pose, state;
uniform int width, rows;
uniform vec4 instance;
uniform mat4 world, worldViewProjection;
in vec2 uv0;
in float uv1;
out vec3 place;
out vec2 uv;
int row;
vec4 of(int i) { return texelFetch(state, ivec2(i, row), 0); }
vec3 moved(int i, vec3 p) {
  vec4 q = vec4(p, 1.0);
  return vec3(dot(of(i), q), dot(of(i + 1), q), dot(of(i + 2), q));
}
vec3 group(vec4 a, vec4 b, vec4 c, vec4 w) {
  return w.x * a.xyz + w.y * vec3(a.w, b.xy) + w.z * vec3(b.zw, c.x) + w.w * c.yzw;
}
vec3 sum(isampler2D basis, ivec2 v, int first, int groups, bool vectors, int w) {
  vec3 x = vec3(0.0);
  for (int g = 0; g < groups; ++g) {
    if (vectors) {
      ivec2 at = ivec2(v.x, first + 3 * g * rows + v.y);
      x += group(vec4(texelFetch(basis, at, 0)), vec4(texelFetch(basis, at + ivec2(0, rows), 0)),
                 vec4(texelFetch(basis, at + ivec2(0, 2 * rows), 0)), of(w + g));
    } else {
      x += group(of(w + 3 * g), of(w + 3 * g + 1), of(w + 3 * g + 2),
                 vec4(texelFetch(basis, ivec2(v.x, first + g * rows + v.y), 0)));
    }
  }
  return x;
}
void main() {
  row = int(instance.x);
  int vertex = int(uv1);
  ivec2 v = ivec2(vertex % width, vertex / width);
  vec3 x = vec3(0.0);
  int at = 1, parts = int(of(0).x);
  for (int p = 0; p < parts; ++p) {
    vec4 head = of(at), kind = of(at + 1);
    vec4 still = head.z < 0.0 ? vec4(0.0) : texelFetch(pose, ivec2(v.x, int(head.z) + v.y), 0);
    int region = at + 2 + int(still.w) * int(kind.z);
    vec4 counts = of(region + 6);
    bool vectors = kind.x > 0.5;
    int w = region + 7;
    vec3 s = sum(wide, v, int(head.y), int(counts.x), vectors, w) +
             sum(narrow, v, int(head.x), int(counts.y), vectors, w + int(kind.y));
    x += counts.z * moved(region + 3, s + moved(region, still.xyz));
    at += int(head.w);
  }
  place = (world * vec4(x, 1.0)).xyz;
  uv = uv0;
  gl_Position = worldViewProjection * vec4(x, 1.0);
}
)";

/// Light from one lamp, in the colour of the entity; facets, as there are no normals.
inline constexpr char kFragmentShader[] = R"(#version 330 core
uniform vec4 colour, ambient, lampColour, lamp;
in vec3 place;
in vec2 uv;
out vec4 result;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  vec3 to = normalize(lamp.xyz - place * lamp.w);
  result = vec4(colour.rgb * (ambient.rgb + lampColour.rgb * max(dot(normal, to), 0.0)), colour.a);
}
)";

/// For vertex buffers of the CPU, where the scene has no material.
inline constexpr char kPlainVertexShader[] = R"(#version 330 core
uniform mat4 world, worldViewProjection;
in vec4 vertex;
in vec3 normal;
out vec3 place, direction;
void main() {
  place = (world * vertex).xyz;
  direction = mat3(world) * normal;
  gl_Position = worldViewProjection * vertex;
}
)";

inline constexpr char kPlainFragmentShader[] = R"(#version 330 core
uniform vec4 colour, ambient, lampColour, lamp;
in vec3 place, direction;
out vec4 result;
void main() {
  vec3 to = normalize(lamp.xyz - place * lamp.w);
  float light = max(dot(normalize(direction), to), 0.0);
  result = vec4(colour.rgb * (ambient.rgb + lampColour.rgb * light), colour.a);
}
)";

/// Depth, for texture shadows.
inline constexpr char kCasterShader[] = R"(#version 330 core
in vec3 place;
in vec2 uv;
out vec4 result;
void main() { result = vec4(gl_FragCoord.z, gl_FragCoord.z, gl_FragCoord.z, 1.0); }
)";

}  // namespace anicodec::ogre

#endif  // ANICODEC_SDK_ENGINES_OGRE_OGRE_SHADER_H_
