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
#define ANIC_STATE(i) of(i)
)"
#include "anicodec_play.inc"  // sdk/shaders/anicodec_play.glsl
                                        R"(
void main() {
  row = int(instance.x);
  vec3 x = vec3(0.0);
  int at = 1, parts = int(of(0).x);
  for (int p = 0; p < parts; ++p) {
    vec4 head = of(at), kind = of(at + 1);
    AnicSegment s = AnicSegment(int(head.x), int(head.y), int(head.z), width, rows, kind.x > 0.5, int(kind.y), int(kind.z));
    x += anic_part(narrow, wide, pose, s, int(uv1), at + 2);
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
