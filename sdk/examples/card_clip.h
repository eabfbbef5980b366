/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * A clip on the graphics card, for samples that draw: the basis of a mesh lies in textures that all
 * instances share; an instance is a row of a texture of states, uploaded each frame; a mesh is one
 * draw call. Corrections of single vertices are left out: they lie within the bound that the clip
 * was encoded to. Clips of geometry interpolation are refused.
 */
#ifndef ANICODEC_SDK_EXAMPLES_CARD_CLIP_H_
#define ANICODEC_SDK_EXAMPLES_CARD_CLIP_H_

#include "gl_sample.h"

/* A mesh of a file, with its basis in textures. */
typedef struct {
  anic_asset* asset;
  anic_asset_info info;
  uint32_t mesh, vertices, triangles;
  uint32_t width, rows;    /* of a layer of a texture */
  uint32_t (*first)[3];    /* by segment: row of narrow, wide and pose */
  unsigned char* has_pose; /* by segment */
  uint32_t state_texels;   /* of an instance */
  GLuint narrow, wide, pose, state, indices;
  uint64_t texture_bytes, vertex_animation_bytes;
  float* staged;         /* the texture of states */
  uint32_t staged_count; /* instances in it */
  anic_box box;
} Model;

/* The shaders of all clips; captures "shown", positions before the instance's map. */
GLuint make_clip_program(int embedded);
/* The same light on a vertex shader of yours, which gives vec3 "shown" and "place", flat float
 * "level". */
GLuint make_lit_program(int embedded, const char* vertex);
/* For at most so many instances. */
void load_model(Model* model, anic_asset* asset, uint32_t mesh, uint32_t instances);
/* Adds the instance that a context shows, with a map to the world (3 x 4) and a level of detail
 * (0, 1 or 2), to the states. Returns 0 if the mesh is not there, else 1. *corrected grows by the
 * parts whose corrections are left out. */
int stage_instance(Model* model, const anic_context* context, const float map[12], int level,
                   uint32_t* corrected);
void upload_states(const Model* model);
void bind_model(GLuint program, const Model* model);
/* All staged instances. */
void draw_model(GLuint program, const Model* model, const float colour[3]);
void close_model(Model* model);

#endif
