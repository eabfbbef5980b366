// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Positions of a clip in a vertex shader, from the textures of anic_write_texture() and the states of anic_write_state().
// GLSL 3.30, GLSL ES 3.00 with precision highp float and int, and, with ANIC_HLSL defined, HLSL 5.0. Put it behind a
// macro ANIC_STATE(i) of yours: the vec4 at texel i of your states. The rest of the formula is here:
//
//   position = sum over anic_parts.count parts of anic_part(narrow, wide, pose, segment, vertex, at)
//
// `vertex` is the vertex of the clip, `at` the texel at which the state of the part begins. Corrections are left out.
#ifdef ANIC_HLSL
#define vec3 float3
#define vec4 float4
#define ivec2 int2
#define sampler2D Texture2D<float4>
#define isampler2D Texture2D<int4>
#define highp
#define texelFetch(from, place, level) (from).Load(int3(place, level))
#endif

// A segment in the textures, in which segments and meshes may lie below one another.
struct AnicSegment {
  int narrow, wide, pose;  // first rows; of the pose below 0: it has none
  int width, rows;         // of a layer: anic_texture_layout
  bool vectors;            // anic_basis.channels is 3
  int wide_weights;        // texels of the weights of wide components: a group has one, without vectors three
  int region;              // texels of the state of a region: anic_texture_layout.state_floats / (4 regions)
};

// Applies the map whose rows are the texels i, i + 1 and i + 2.
vec3 anic_moved(int i, vec3 p) {
  vec4 q = vec4(p, 1.0);
  return vec3(dot(ANIC_STATE(i), q), dot(ANIC_STATE(i + 1), q), dot(ANIC_STATE(i + 2), q));
}

// Twelve numbers of three texels are four vectors, or three weights for each of four numbers.
vec3 anic_group(vec4 a, vec4 b, vec4 c, vec4 w) {
  return w.x * a.xyz + w.y * vec3(a.w, b.xy) + w.z * vec3(b.zw, c.x) + w.w * c.yzw;
}

// Sums `groups` groups of four components from row `first` on, whose weights begin at texel w.
vec3 anic_sum(highp isampler2D basis, AnicSegment s, ivec2 v, int first, int groups, int w) {
  vec3 x = vec3(0.0, 0.0, 0.0);
  for (int g = 0; g < groups; ++g) {
    if (s.vectors) {
      ivec2 at = ivec2(v.x, first + 3 * g * s.rows + v.y);
      x += anic_group(vec4(texelFetch(basis, at, 0)), vec4(texelFetch(basis, at + ivec2(0, s.rows), 0)),
                      vec4(texelFetch(basis, at + ivec2(0, 2 * s.rows), 0)), ANIC_STATE(w + g));
    } else {
      x += anic_group(ANIC_STATE(w + 3 * g), ANIC_STATE(w + 3 * g + 1), ANIC_STATE(w + 3 * g + 2),
                      vec4(texelFetch(basis, ivec2(v.x, first + g * s.rows + v.y), 0)));
    }
  }
  return x;
}

// The share of a part in the position of a vertex.
vec3 anic_part(highp isampler2D narrow, highp isampler2D wide, highp sampler2D pose, AnicSegment s, int vertex, int at) {
  ivec2 v = ivec2(vertex % s.width, vertex / s.width);
  vec4 still = vec4(0.0, 0.0, 0.0, 0.0);  // the last number is the region
  if (s.pose >= 0)
    still = texelFetch(pose, ivec2(v.x, s.pose + v.y), 0);
  int own = at + int(still.w) * s.region, w = own + 7;  // the state of the region
  vec4 counts = ANIC_STATE(own + 6);
  vec3 x = anic_sum(wide, s, v, s.wide, int(counts.x), w);
  x += anic_sum(narrow, s, v, s.narrow, int(counts.y), w + s.wide_weights);
  return counts.z * anic_moved(own + 3, x + anic_moved(own, still.xyz));
}
