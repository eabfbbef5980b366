/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Frames that a graphics card makes: bases and textures, and the numbers that a shader needs for an
 * instance.
 */
#ifndef ANICODEC_GPU_H_
#define ANICODEC_GPU_H_

#include <anicodec/play.h>

#ifndef __cplusplus
typedef int32_t anic_basis_kind, anic_target, anic_reconstruction, anic_texture;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- GPU ------------------------------------------------------------------------------------- */

/** How the basis of a segment was found. */
enum anic_basis_kind ANIC_INT32 {
  ANIC_BASIS_KEYFRAMES = 0,
  ANIC_BASIS_EIGENSHAPES = 1,
  ANIC_BASIS_EIGENTRAJECTORIES = 2
};

/** Vertices or values that a basis moves. */
enum anic_target ANIC_INT32 {
  ANIC_TARGET_POSITIONS = 0, /**< the positions of a mesh */
  ANIC_TARGET_ATTRIBUTE = 1  /**< three components of an attribute, or fewer, of its elements in
                                  place of vertices */
};

/** How positions come from a basis. */
enum anic_reconstruction ANIC_INT32 {
  ANIC_RECONSTRUCTION_LINEAR = 0, /**< a linear combination */
  ANIC_RECONSTRUCTION_MSGI = 1    /**< multi-scale geometry interpolation between key-frames, see
                                     anic_part.shape. Spec: 09c */
};

/** Vertices of a block: blocks store the same coefficient of all their vertices side by side. */
#define ANIC_BLOCK_VERTICES 16

/** The surface of a segment has at most this many regions. */
#define ANIC_MAX_REGIONS 8

/**
 * The basis of a segment, to be uploaded once. The arrays belong to the asset. With b = v / 16 and
 * i = v % 16:
 * - pose(v)[c] = pose[(b * 3 + c) * 16 + i]
 * - basis(j, v)[c] = wide[((b * wide_components + j) * channels + c) * 16 + i] for j below
 *   wide_components
 * - basis(j, v)[c] = narrow[((b * n + j - wide_components) * channels + c) * 16 + i] for the other
 *   j, with n = components - wide_components
 *
 * Zeros fill the last block behind the last vertex. Spec: 09a, sections 1 and 5.
 */
typedef struct anic_basis {
  size_t struct_size;
  anic_basis_kind kind;
  anic_reconstruction reconstruction;
  anic_target target;
  uint32_t mesh;
  uint32_t attribute; /**< for ANIC_TARGET_ATTRIBUTE: its number. The x of anic_part is to be added
                         to anic_attribute.values */
  uint32_t first_component; /**< for ANIC_TARGET_ATTRIBUTE: the basis moves this component and the
                               two after it, if the attribute has them */
  uint32_t first_frame;
  uint32_t frame_count;
  uint32_t vertex_count;
  uint32_t components;
  uint32_t wide_components;
  uint32_t channels; /**< 3: basis(j, v) is a vector, with one weight; 1: it is a number, with
                        a weight for each of x, y, z */
  uint32_t weight_channels; /**< weights of a component: 1 for vectors, 3 for numbers */
  float origin[3];   /**< for ANIC_BASIS_KEYFRAMES: added to every vertex before the motion */
  const float* pose; /**< NULL: none */
  const int32_t* wide;
  const int16_t* narrow;
  size_t pose_count; /**< elements of the arrays */
  size_t wide_count;
  size_t narrow_count;
  const uint32_t* vertex_shape; /**< with ANIC_RECONSTRUCTION_MSGI: the point of the shape that each
                                   vertex is; NULL: vertex v is point v */
  uint32_t regions; /**< regions of the surface, each with its weights and pose_map; 1: none. At
                       most ANIC_MAX_REGIONS */
  const uint8_t* vertex_region; /**< region of each vertex, below `regions`; NULL: all are of
                                   region 0 */
} anic_basis;

/** - Errors: ANIC_E_ARGUMENT: there is no such segment; ANIC_E_STATE: it has not arrived yet */
ANIC_API anic_status anic_get_basis(const anic_asset* asset, uint32_t segment, anic_basis* out);

/** Moves one vertex in one frame, after everything else. */
typedef struct anic_correction {
  uint32_t vertex;
  float delta[3];
} anic_correction;

/**
 * Data that a shader needs for one time, beside the basis of a segment:
 * - x = pose_map * (pose(v), 1) + sum over j of weights[j * weight_channels + c] * basis(j, v)[c]
 * - x = motion * (x + origin, 1)
 * - x = x + delta of the corrections of v, which are few and ascending by vertex
 *
 * With one channel, basis(j, v) is multiplied by each of the three weights. If the basis has
 * regions, r = vertex_region[v] has the pose_map at anic_parts.pose_maps + 12 r and the weights
 * from weights + r * anic_basis.components * weight_channels on. With ANIC_RECONSTRUCTION_MSGI the
 * first line and the origin give way to x = shape(vertex_shape(v)), three floats for each point,
 * which the seek has made.
 *
 * Matrices are 3 x 4, row-major. Pointers are good until the next but one seek of the context.
 */
typedef struct anic_part {
  uint32_t segment;
  float share;          /**< the position is the sum of share * x over the parts */
  const float* weights; /**< weights of region 0, then of the others */
  const float* shape;   /**< NULL with ANIC_RECONSTRUCTION_LINEAR */
  float pose_map[12];   /**< map of region 0 */
  float motion[12];
  const anic_correction* corrections;
  uint32_t correction_count;
} anic_part;

/** A time has at most this many parts; one, unless it lies between two segments. */
#define ANIC_MAX_PARTS 4

/** The parts of one time. */
typedef struct anic_parts {
  size_t struct_size;
  uint32_t count;
  anic_part parts[ANIC_MAX_PARTS];
  uint32_t
      components[ANIC_MAX_PARTS]; /**< for each part: how many weights are to be used, all unless
                                          anic_set_quality() said otherwise */
  const float*
      pose_maps[ANIC_MAX_PARTS]; /**< for each part: pose_map of each region, 12 numbers each;
                                             NULL: the basis has no pose */
} anic_parts;

/**
 * Gives the parts of a mesh at the time chosen, for the GPU.
 *
 * - Errors: as anic_write_positions()
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_parts(const anic_context* context, uint32_t mesh, anic_when when,
                                    anic_parts* out);

/**
 * Gives the parts of three components of an attribute at the time chosen: the value of components
 * first_component .. first_component + 2 is the value in frame 0 (anic_attribute.values) and the
 * sum of share * x over the parts. No parts: the value is that of frame 0.
 *
 * - Params: first_component: a multiple of 3
 * - Errors: as anic_write_attribute()
 * - Cost: O(log segments)
 */
ANIC_API anic_status anic_get_attribute_parts(const anic_context* context, uint32_t mesh,
                                              uint32_t attribute, uint32_t first_component,
                                              anic_when when, anic_parts* out);

/** Textures that hold the basis of a segment for shaders, of four numbers a texel. */
enum anic_texture ANIC_INT32 {
  ANIC_TEXTURE_POSE = 0,  /**< float32: x, y, z, region */
  ANIC_TEXTURE_WIDE = 1,  /**< int32 */
  ANIC_TEXTURE_NARROW = 2 /**< int16 */
};

/**
 * How a basis lies in textures: a layer is `rows` rows of `width` texels, a texel for each vertex;
 * layers lie below one another. Vertex v is texel v % width of row v / width of a layer. Components
 * come in groups of four, filled up with zeros, first the wide ones, in a texture of their own:
 * - with one channel a group is a layer: its texel holds four numbers, one for each component;
 * - with three it is three layers: the twelve numbers x, y, z of component 0, x, y, z of component
 *   1 and so on.
 */
typedef struct anic_texture_layout {
  size_t struct_size;
  uint32_t width; /**< texels of a row */
  uint32_t rows;  /**< rows of a layer: 1 unless a row has fewer texels than the mesh vertices */
  uint32_t pose_height;   /**< rows of the texture; 0: there is none */
  uint32_t wide_height;   /**< as above */
  uint32_t narrow_height; /**< as above */
  uint32_t state_floats;  /**< that anic_write_state() writes */
  uint32_t regions;       /**< states of so many regions follow one another in them */
} anic_texture_layout;

/**
 * Finds the layout that wastes least.
 *
 * - Params: max_size: texels that a texture may have in width and height
 * - Errors: ANIC_E_LIMIT: no texture of this size holds it; ANIC_E_STATE: the segment has not arrived
 *   yet, or is of ANIC_RECONSTRUCTION_MSGI; ANIC_E_ARGUMENT
 */
ANIC_API anic_status anic_get_texture_layout(const anic_asset* asset, uint32_t segment,
                                             uint32_t max_size, anic_texture_layout* out);

/**
 * Writes a texture, ready to be uploaded, once and in order: the memory may be write-combined.
 *
 * - Params: layout: by anic_get_texture_layout(), for this segment; row_bytes: from a row to the
 *   next, as the graphics interface wants it; 0: packed. Bytes between rows stay untouched
 * - Errors: ANIC_E_BUFFER_SIZE: `size` bytes do not hold it; others as anic_get_texture_layout()
 * - Cost: O(size)
 */
ANIC_API anic_status anic_write_texture(const anic_asset* asset, uint32_t segment,
                                        anic_texture texture, const anic_texture_layout* layout,
                                        size_t row_bytes, void* out, size_t size);

/** Floats of anic_write_state() before the weights of a region. */
#define ANIC_STATE_FLOATS 28

/**
 * Writes what a shader needs of one part (anic_get_parts()), seven texels of four floats and the
 * weights, ready to be uploaded for each instance:
 * - texels 0 to 2: the rows of pose_map, with the origin of the basis added
 * - texels 3 to 5: the rows of motion
 * - texel 6: how many groups of components are to be summed, wide and narrow; share; how many
 *   corrections there are, which are not written
 * - texels 7 on: weights of the wide components, then of the narrow ones, each filled up with zeros
 *   to whole groups of four: one texel a group for vectors, three for numbers
 *
 * So a vertex is motion * (pose_map * (pose, 1) + sum over groups). For vectors, with the texels a, b,
 * c of a group and its weights w, the group is
 * w.x a.xyz + w.y (a.w, b.xy) + w.z (b.zw, c.x) + w.w c.yzw;
 * for numbers, with the texel a and the weights u, v, w,
 * a.x u.xyz + a.y (u.w, v.xy) + a.z (v.zw, w.x) + a.w w.yzw.
 *
 * If the segment has regions, the state is written for each of them: the state of the region that
 * the fourth number of a vertex' pose names begins at texel region * state_floats / (4 * regions).
 *
 * Components that anic_set_quality() leaves out have weight 0.
 *
 * - Params: part: below anic_parts.count; size: bytes at out, state_floats x 4 or more
 * - Errors: ANIC_E_BUFFER_SIZE; ANIC_E_STATE: a segment of ANIC_RECONSTRUCTION_MSGI, too; others as
 *   anic_write_positions()
 * - Cost: O(components)
 */
ANIC_API anic_status anic_write_state(const anic_context* context, uint32_t mesh, anic_when when,
                                      uint32_t part, float* out, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_GPU_H_ */
