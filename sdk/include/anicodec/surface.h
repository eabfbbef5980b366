/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Surfaces that a clip shows: points and rays, normals, vertices for rendering, and meshes of the host
 * that morph.
 */
#ifndef ANICODEC_SURFACE_H_
#define ANICODEC_SURFACE_H_

#include <anicodec/play.h>

#ifndef __cplusplus
typedef int32_t anic_side;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- points of the surface ------------------------------------------------------------------- */

/** A point of a mesh's surface: vertices of a triangle, and barycentric coordinates in it. */
typedef struct anic_surface_point {
  uint32_t vertices[3]; /**< in the order of the triangle, counter-clockwise seen from its front */
  float weights[3];     /**< weights of the vertices; their sum is 1 */
} anic_surface_point;

/** Axes at a point of the surface, of length 1; the third one is normal x tangent. */
typedef struct anic_surface_frame {
  float position[3];
  float normal[3];  /**< normal of the triangle, on its front */
  float tangent[3]; /**< from the triangle's first vertex to the second one */
} anic_surface_frame;

/**
 * Computes the axes at a point of the surface at the time chosen: for what is attached to it, such as
 * a sword in a hand. A triangle without an area gets axes of length 1, too: perpendicular to its longest
 * edge, or those of space. Weights outside of [0, 1] give points of the triangle's plane.
 *
 * - Errors: as anic_write_positions(); ANIC_E_ARGUMENT: no such vertex, a weight that is not finite
 * - Cost: that of three vertices; nothing is allocated
 */
ANIC_API anic_status anic_get_surface_frame(const anic_context* context, uint32_t mesh,
                                            anic_when when, const anic_surface_point* point,
                                            anic_surface_frame* out);

/** A side of triangles. */
enum anic_side ANIC_INT32 {
  ANIC_SIDE_ANY = 0,
  ANIC_SIDE_FRONT = 1, /**< its corners run counter-clockwise */
  ANIC_SIDE_BACK = 2
};

/** A ray, in the space of the positions. */
typedef struct anic_ray {
  size_t struct_size;
  float origin[3];
  float direction[3]; /**< any length but 0 */
  float farthest;     /**< distance that still counts, in lengths of `direction`; 0: any */
  anic_side side;     /**< side of triangles that counts */
} anic_ray;

/** The first point of the surface on a ray. */
typedef struct anic_hit {
  anic_surface_point point;
  float distance; /**< from the origin, in lengths of the ray's direction; infinite: none was hit */
  uint32_t triangle; /**< its number in the list; UINT32_MAX: none was hit */
  anic_side side;    /**< that the ray meets: ANIC_SIDE_FRONT or ANIC_SIDE_BACK */
} anic_hit;

/**
 * Finds the first point on a ray of a mesh's triangles at the time chosen. A ray through an edge or a
 * vertex hits one of the triangles around it; edge-on, a triangle is not hit. Among triangles at the
 * same distance the first in the list counts. No hit is no error: see anic_hit.
 *
 * With ANIC_OPEN_BOUNDS, a ray that misses the boxes of the frames shown costs no positions, unless
 * positions between these may leave the boxes (anic_get_clip_bounds()).
 *
 * - Params: triangles: of vertices, 3 x triangle_count, as anic_write_indices() gives them;
 *   work: room for 3 x vertices floats, `work_size` bytes; its content afterwards is unspecified
 * - Errors: as anic_write_positions(); ANIC_E_ARGUMENT: no such vertex, a ray without a direction or
 *   one that is not finite; ANIC_E_BUFFER_SIZE
 * - Cost: that of anic_write_positions() of the mesh, and O(triangles); nothing is allocated
 * - Source: watertight intersection, Woop, Benthin, Wald 2013
 */
ANIC_API anic_status anic_intersect_ray(const anic_context* context, uint32_t mesh, anic_when when,
                                        const anic_ray* ray, const uint32_t* triangles,
                                        uint32_t triangle_count, float* work, size_t work_size,
                                        anic_hit* out);

/* ---- normals --------------------------------------------------------------------------------- */

/** How to make normals of a mesh: which corners a normal is averaged over. Immutable, shared. */
typedef struct anic_normal_plan anic_normal_plan;

/** A NULL pointer, or 0 in every field: everything by default. */
typedef struct anic_normal_plan_options {
  size_t struct_size;
  double crease_angle;      /**< degrees; an edge is hard if the normals of its polygons are further
                               apart. 0: no edge is hard. A small angle, such as 0.001, gives flat
                               shading wherever polygons are not coplanar */
  uint32_t reference_frame; /**< the frame in which the angles are measured, for all frames */
  uint8_t per_corner;       /**< normals for each corner (anic_polygons) instead of each vertex */
  uint8_t source_edges; /**< edges are hard that are hard in the source, whatever the angle, if the
                           file tells (ANIC_ATTRIBUTE_NORMAL without components); else by
                           crease_angle */
} anic_normal_plan_options;

/**
 * Prepares normals that are recomputed from positions. Normals that a file holds are an attribute
 * instead: ANIC_ATTRIBUTE_NORMAL. Copies of a vertex (anic_get_coded_vertices()) share a normal, so
 * that seams of the source do not show unless they are creases.
 *
 * A normal is the sum of the cross products of the edges at the corners it is averaged over,
 * scaled to length one, so that larger faces count more; it is (0, 0, 1) if that sum is 0. It
 * points to the side from which the corners run counter-clockwise. With per_corner = 0 all corners
 * of a vertex share one normal, even across hard edges.
 *
 * - Params: options may be NULL; allocator may be NULL: the asset's
 * - Memory: 4 bytes for each element and 8 to 20 for each corner; 40 more while it is made. The
 *   plan does not refer to the asset
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_FRAME_RANGE, ANIC_E_MEMORY; ANIC_E_ABSENT: the mesh is not
 *   there in the reference frame
 */
ANIC_API anic_status anic_create_normal_plan(const anic_asset* asset, uint32_t mesh,
                                             const anic_normal_plan_options* options,
                                             const anic_allocator* allocator,
                                             anic_normal_plan** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_normal_plan(anic_normal_plan* plan);

/** How many normals there are: one for each vertex, or one for each corner. */
ANIC_API uint32_t anic_get_normal_count(const anic_normal_plan* plan);

/**
 * Writes the normals first .. first + count - 1 of a mesh in a pose. ANIC_FORMAT_SNORM16X4 with
 * offset 0 and scale 1 suits them. Allocates nothing.
 *
 * - Shapes: positions: vertex_count x 3 float32, as anic_write_positions() writes them; `stride`:
 *   bytes from a vertex to the next, a multiple of four (0: 12)
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_BUFFER_SIZE
 * - Cost: O(corners averaged over)
 */
ANIC_API anic_status anic_write_normals(const anic_normal_plan* plan, const float* positions,
                                        size_t stride, uint32_t first, uint32_t count,
                                        const anic_output* out);

/* ---- render vertices ------------------------------------------------------------------------- */

/**
 * The vertices that a graphics card needs, where a mesh has numbers at its corners or hard edges:
 * one for each distinct pair of a vertex and what its corners carry, that is, the values of all
 * attributes of ANIC_DOMAIN_CORNERS and the normal. Immutable, shared.
 */
typedef struct anic_render_plan anic_render_plan;

/** A NULL pointer, or 0 in every field: normals smooth everywhere. */
typedef struct anic_render_plan_options {
  size_t struct_size;
  double crease_angle;      /**< as in anic_normal_plan_options */
  uint32_t reference_frame; /**< as in anic_normal_plan_options */
  uint8_t source_edges;     /**< as in anic_normal_plan_options */
} anic_render_plan_options;

/**
 * Makes the render vertices of a mesh, and index buffers over them. Vertices that no polygon uses
 * are left out; a mesh without polygons has its vertices as they are, to be drawn as points.
 *
 * - Params: options may be NULL; allocator may be NULL: the asset's
 * - Memory: 8 bytes for each render vertex, 16 for each triangle, and a normal plan; 60 for each
 *   corner more while it is made. The plan does not refer to the asset
 * - Errors: as anic_create_normal_plan()
 * - Cost: O(corners log corners)
 */
ANIC_API anic_status anic_create_render_plan(const anic_asset* asset, uint32_t mesh,
                                             const anic_render_plan_options* options,
                                             const anic_allocator* allocator,
                                             anic_render_plan** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_render_plan(anic_render_plan* plan);

/** Contents of a plan. The arrays belong to it. */
typedef struct anic_render_info {
  size_t struct_size;
  const uint32_t* vertices; /**< vertex of each render vertex, ascending: every value of a vertex is
                               found by it */
  const uint32_t* corners;  /**< a corner of each render vertex: every value of a corner is found by
                               it. NULL in a mesh without corners */
  const uint32_t* indices;  /**< triangle_count x 3 render vertices; polygons are cut as by
                               anic_write_indices(), in the reference frame, ordered by material */
  const uint32_t* triangle_polygons; /**< polygon of each triangle */
  const uint32_t*
      group_materials;         /**< for each group the label of its polygons' material, ascending:
                                      0 for none, or one more than the number of a name */
  const uint32_t* group_begin; /**< group g has the triangles begin[g] .. begin[g + 1] - 1; the
                                  groups follow one another and hold all triangles */
  uint32_t mesh;
  uint32_t vertex_count; /**< number of render vertices */
  uint32_t triangle_count;
  uint32_t group_count; /**< one for each material that has a triangle */

  /* For normals on a graphics card: a normal is the sum of the cross products (next - centre) x
   * (previous - centre) over the corners of a group, scaled to length one; (0, 0, 1) if that is 0. */
  uint32_t normal_group_count;
  const uint32_t* normal_groups;  /**< group of each render vertex */
  const uint32_t* normal_centres; /**< a render vertex of each group */
  const uint32_t* normal_begin;   /**< group g has the corners begin[g] .. begin[g + 1] - 1 */
  const uint32_t* normal_corners; /**< render vertices after and before each corner */
} anic_render_info;

/** - Errors: ANIC_E_ARGUMENT */
ANIC_API anic_status anic_get_render_info(const anic_render_plan* plan, anic_render_info* out);

/**
 * Writes positions of the render vertices first .. first + count - 1, as anic_write_positions()
 * does those of vertices. The context may be of any asset of the same file.
 *
 * - Errors: as anic_write_positions(); ANIC_E_ARGUMENT: the plan is of another mesh
 * - Cost: that of anic_write_positions() for the vertices, and a copy
 */
ANIC_API anic_status anic_write_render_positions(const anic_render_plan* plan,
                                                 const anic_context* context, anic_when when,
                                                 uint32_t first, uint32_t count,
                                                 const anic_output* out);

/**
 * Writes normals of the render vertices first .. first + count - 1 from positions of all render
 * vertices, as anic_write_normals() does.
 *
 * - Shapes: positions: render vertices x 3 float32; `stride`: bytes from one to the next, a multiple
 *   of four (0: 12)
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_BUFFER_SIZE
 */
ANIC_API anic_status anic_write_render_normals(const anic_render_plan* plan, const float* positions,
                                               size_t stride, uint32_t first, uint32_t count,
                                               const anic_output* out);

/**
 * Writes values of an attribute of vertices or corners at the time chosen, as
 * anic_write_attribute() does, of the render vertices first .. first + count - 1.
 *
 * - Errors: as anic_write_attribute(); ANIC_E_ARGUMENT: the plan is of another mesh, or the
 *   attribute is one of polygons or has no components
 */
ANIC_API anic_status anic_write_render_attribute(const anic_render_plan* plan,
                                                 const anic_context* context, uint32_t attribute,
                                                 anic_when when, uint32_t first, uint32_t count,
                                                 const anic_value_output* out);

/* ---- morphing meshes of the host ------------------------------------------------------------- */

/**
 * Blends meshes of one connectivity that the host gives, without a file, by multi-scale geometry
 * interpolation (MSGI): lengths, angles and volume keep even if limbs turn far. Immutable, shared
 * by threads. Spec: 09c.
 */
typedef struct anic_morpher anic_morpher;

/** A NULL pointer, or 0 in every field: everything by default. */
typedef struct anic_morpher_options {
  size_t struct_size;
  uint64_t max_bytes;   /**< ANIC_E_LIMIT when more would be held; 0 means 2^32 */
  const uint32_t* pins; /**< vertices whose positions anic_morph() is given; each at most once */
  uint32_t pin_count;
  uint32_t leaf_faces; /**< faces of the smallest patches, 1 to 255; 0 means 8 */
  uint32_t sweeps;     /**< rounds that adapt the patches' rotations to their neighbours. 0 is plain
                          MSGI; 1 or 2 may help far outside the meshes, 5 to 20 with pins */
} anic_morpher_options;

/**
 * Prepares a morpher. It keeps nothing of what it is given.
 *
 * Any triangles will do: holes, several parts, duplicate and degenerate faces, edges of many faces.
 * Parts that share no vertex move independently; vertices of no triangle move on straight lines.
 *
 * - Shapes: triangles: triangle_count x 3; meshes: mesh_count (2 or more) pointers to vertex_count
 *   x 3
 * - Params: options may be NULL; allocator may be NULL: malloc() and free()
 * - Errors: ANIC_E_ARGUMENT; ANIC_E_INDEX_RANGE: a corner is no vertex; ANIC_E_NON_FINITE: a
 *   coordinate; ANIC_E_LIMIT; ANIC_E_MEMORY; ANIC_E_FEATURE: a build without MSGI
 * - Cost: O(vertices x log vertices + vertices x meshes) and factoring a sparse matrix,
 *   O(vertices^1.5)
 */
ANIC_API anic_status anic_create_morpher(const uint32_t* triangles, uint32_t triangle_count,
                                         uint32_t vertex_count, const float* const* meshes,
                                         uint32_t mesh_count, const anic_morpher_options* options,
                                         const anic_allocator* allocator, anic_morpher** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_morpher(anic_morpher* morpher);

typedef struct anic_morpher_info {
  size_t struct_size;
  uint64_t resident_bytes;
  uint64_t scratch_bytes; /**< that anic_morph() works in */
  double largest_turn;    /**< radians between neighbouring patches, in any mesh against the first.
                             Above a right angle, smaller patches may do better */
  uint32_t vertex_count;
  uint32_t mesh_count;
} anic_morpher_info;

/** - Errors: ANIC_E_ARGUMENT */
ANIC_API anic_status anic_get_morpher_info(const anic_morpher* morpher, anic_morpher_info* out);

/**
 * Writes the mesh at some weights, which sum to one; weights outside [0, 1] extrapolate. At the
 * weights of one mesh it is that mesh, up to rounding. Allocates nothing.
 *
 * - Shapes: weights: mesh_count; pin_positions: pin_count x 3, may be NULL without pins; out:
 *   vertex_count x 3; scratch: scratch_bytes at a multiple of 8
 * - Params: threads may be NULL
 * - Errors: ANIC_E_ARGUMENT: weights that are not finite or do not sum to one within 1e-5, pins
 *   missing; ANIC_E_BUFFER_SIZE: scratch too small
 * - Cost: O(vertices x (log vertices + meshes of a weight other than 0))
 */
ANIC_API anic_status anic_morph(const anic_morpher* morpher, const double* weights,
                                const float* pin_positions, const anic_threads* threads,
                                void* scratch, size_t scratch_size, float* out);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_SURFACE_H_ */
