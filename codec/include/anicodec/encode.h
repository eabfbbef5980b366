/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * anicodec encodes animated meshes to .anic files. This is the interface of libanicodec_encoder, in
 * C99 and C++11. The grammar is that of anicodec.h: names, struct_size and ANIC_INIT(), statuses,
 * strides.
 *
 *   anic_encoder* encoder;
 *   anic_source_clip clip = ANIC_INIT(anic_source_clip);
 *   anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
 *   anic_encoding result = ANIC_INIT(anic_encoding);
 *   anic_create_encoder(&encoder);
 *   clip.frame_count = 120;
 *   anic_set_source_clip(encoder, &clip);
 *   mesh.vertex_count = 5980;
 *   mesh.corners = triangles;
 *   mesh.polygon_count = 11960;
 *   mesh.positions = points;                                   frame after frame
 *   anic_add_source_mesh(encoder, &mesh, NULL);
 *   anic_encode(encoder, NULL, &result);                       0.05 % of the size, for any vertex
 *   fwrite(result.file, 1, result.size, file);
 *   anic_destroy_encoder(encoder);
 *
 * Conventions
 * - Threads: an encoder is used by one thread at a time; different encoders are independent. One
 *   thread may push frames of a live stream while another takes its files.
 *   anic_encode() starts threads unless anic_encode_options say 1. The bytes of the
 *   file do not depend on their number.
 * - Memory: malloc(). While anic_encode() runs it holds all positions as float32, and about twice
 *   as much again. Positions beyond a sixth of the machine's memory lie in a file without a name, in
 *   TMPDIR or /var/tmp.
 * - Errors: nothing is thrown at the host. anic_get_encoder_text() tells in a line of English what
 *   was wrong and where. After a failure the encoder stays usable.
 * - Callbacks must return. They run on the thread that called anic_encode().
 */
#ifndef ANICODEC_ENCODE_H_
#define ANICODEC_ENCODE_H_

#include <anicodec/anicodec.h>

#ifndef __cplusplus
typedef int32_t anic_scalar, anic_bound, anic_goal, anic_basis_choice, anic_selection,
    anic_interpolation, anic_keyframe_coder, anic_massage, anic_effort;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Version of the library that is linked: major << 16 | minor << 8 | patch. */
ANIC_API uint32_t anic_get_encoder_version(void);

/** A clip to be encoded, and how it went. */
typedef struct anic_encoder anic_encoder;

/** - Errors: ANIC_E_ARGUMENT, ANIC_E_MEMORY */
ANIC_API anic_status anic_create_encoder(anic_encoder** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_encoder(anic_encoder* encoder);

/**
 * The fault of the last call: one line of English without a full stop; empty if there was none.
 * The text belongs to the encoder and is good until the next call. Never NULL.
 */
ANIC_API const char* anic_get_encoder_text(const anic_encoder* encoder);

/* ---- what is encoded ------------------------------------------------------------------------- */

/** A clip: what all meshes share. Spec: 04. */
typedef struct anic_source_clip {
  size_t struct_size;
  const char* name;          /**< UTF-8; NULL: none */
  uint32_t frame_count;      /**< 0: a live clip, whose frames are pushed: anic_begin_live() */
  uint32_t rate_numerator;   /**< frames per second = numerator / denominator. 0: nobody knows; 24
                                is stored, and that it is assumed */
  uint32_t rate_denominator; /**< 0 counts as 1 */
  anic_up_axis up;
  uint8_t loop;           /**< meant to be repeated */
  double start_time;      /**< time of frame 0 on the clock of the source, seconds */
  double metres_per_unit; /**< 0: unknown */
  const double* times; /**< frame_count ascending seconds from frame 0; NULL: evenly by the rate */
  const char* const* event_names; /**< UTF-8, of events: named times */
  const double* event_seconds;    /**< time of each event, from frame 0 on, within the clip */
  uint32_t event_count;
  double
      origin[3]; /**< finite: taken in double from positions at addresses before they are rounded to
                       float32; those that read() gives count from it */
  uint8_t
      find_origin; /**< if meshes at addresses alone are small and far from zero, the origin is a
                          point amid them instead, and the positions are read twice */
} anic_source_clip;

/**
 * Sets the clip, and forgets all meshes. Strings and times are copied.
 *
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_MEMORY
 */
ANIC_API anic_status anic_set_source_clip(anic_encoder* encoder, const anic_source_clip* clip);

/**
 * Adds a clip to a file of several: its frames come behind those that are there, and every mesh has the
 * frames of all clips, one after the other. Names differ; axis, unit and origin are those of the first clip. To
 * be called before meshes are added, of which such a file has one, shown in all frames.
 *
 * - Errors: ANIC_E_STATE: anic_set_source_clip() comes first, meshes later; ANIC_E_ARGUMENT;
 *   ANIC_E_MEMORY
 */
ANIC_API anic_status anic_add_source_clip(anic_encoder* encoder, const anic_source_clip* clip);

/** How a coordinate of the host is stored. */
enum anic_scalar ANIC_INT32 {
  ANIC_SCALAR_FLOAT32 = 0,
  ANIC_SCALAR_FLOAT64 = 1 /**< rounded to the nearest float32, which is what the codec keeps */
};

/** Frames that follow one another. */
typedef struct anic_frame_run {
  uint32_t first;
  uint32_t count;
} anic_frame_run;

/**
 * A mesh: polygons over vertices, and the positions of all frames, by address or by callback.
 *
 * Positions stay the host's: anic_encode() reads them, so they must be there until then. Everything
 * else is copied.
 */
typedef struct anic_source_mesh {
  size_t struct_size;
  const char* name; /**< UTF-8; NULL: none. Names tell several meshes apart */
  uint32_t vertex_count;
  uint32_t polygon_count;
  const uint32_t* offsets; /**< polygon p has the corners offsets[p] .. offsets[p + 1] - 1;
                              polygon_count + 1 numbers. NULL: all polygons are triangles */
  const uint32_t* corners; /**< vertex of each corner; NULL without polygons */
  const void* positions;   /**< x of vertex 0 in frame 0, any alignment; NULL: read() gives them. A
                              live clip has neither */
  ptrdiff_t vertex_stride; /**< bytes from a vertex to the next; 0: packed */
  ptrdiff_t frame_stride;  /**< bytes from a frame to the next; 0: the frames follow one another */
  anic_scalar scalar;      /**< type of positions */
  uint32_t run_count;
  const anic_frame_run* runs; /**< frames that show the mesh, ascending; NULL: all. Positions and
                                 attributes that change have a frame for each of them */
  void* user;
  /** Fills vertex_count x 3 float32 with the positions of a frame; frames come in order, each once
   * for every anic_encode(). Anything but 0 ends it with ANIC_E_READ. */
  int (*read)(void* user, uint32_t frame, float* positions);
} anic_source_mesh;

/**
 * Adds a mesh. *number, if not NULL, is its number: 0, 1 ...
 *
 * - Errors: ANIC_E_STATE: anic_set_source_clip() comes first; ANIC_E_ARGUMENT: counts, strides,
 *   runs or pointers make no sense; ANIC_E_INDEX_RANGE: a corner is no vertex; ANIC_E_MEMORY
 */
ANIC_API anic_status anic_add_source_mesh(anic_encoder* encoder, const anic_source_mesh* mesh,
                                          uint32_t* number);

/** The largest error of the numbers of an attribute. */
enum anic_bound ANIC_INT32 {
  /** If it moves, attribute_error of anic_encode_options; if it rests, steps of uv_bits, of
   * colour_bits, or of a 4095th of its range. */
  ANIC_BOUND_USUAL = 0,
  ANIC_BOUND_UNITS = 1, /**< `error`, in units of its values */
  /** `error`, in per cent of its range: of the component with the largest, over all frames. */
  ANIC_BOUND_PERCENT = 2,
  /** None once values are rounded: they are whole, up to 2^24, up to 2^18 of one that moves. The
   * metadata's "fields" say "whole": true of its name. */
  ANIC_BOUND_EXACT = 3
};

/** Values beside the positions, or names of polygons: see anic_attribute. */
typedef struct anic_source_attribute {
  size_t struct_size;
  const char* name; /**< UTF-8; NULL: none */
  anic_attribute_kind kind;
  anic_domain domain;
  uint32_t components;    /**< numbers of an element; 0: it has `labels` */
  uint32_t frames;        /**< frames that `values` has, 1 or all of the mesh; 0 counts as 1 */
  const float* values;    /**< frames x elements x components; NULL in a live clip: it moves, each
                             frame has its values */
  const uint32_t* labels; /**< for each corner: corners of a vertex with the same label share a
                                     normal (ANIC_ATTRIBUTE_NORMAL). For each polygon: 0 for none, or
                                     one more than the number of a name (ANIC_ATTRIBUTE_MATERIAL,
                                     ANIC_ATTRIBUTE_PART) */
  const char* const* label_names; /**< label_count; UTF-8 */
  uint32_t label_count;
  /** Looks of ANIC_ATTRIBUTE_MATERIAL: label_count pointers, NULL where one is unknown; NULL: all are.
   * Their names do not matter, NULL is no texture. */
  const anic_material* const* materials;
  const char*
      unit; /**< UTF-8, of the values, as "K"; NULL: none. Kept in the metadata: its object "fields"
                          has an object for the name, and that a text "unit" */
  double error; /**< in what `bound` says */
  anic_bound bound;
} anic_source_attribute;

/**
 * Adds an attribute to a mesh. Everything is copied.
 *
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_MEMORY
 */
ANIC_API anic_status anic_add_source_attribute(anic_encoder* encoder, uint32_t mesh,
                                               const anic_source_attribute* attribute);

/* ---- encoding -------------------------------------------------------------------------------- */

/** The promise that the file keeps. Spec: 04, section 4. */
enum anic_goal ANIC_INT32 {
  ANIC_GOAL_DEFAULT = 0,      /**< with `keyframes` none, else a largest error of 0.05 % */
  ANIC_GOAL_MAX_ERROR = 1,    /**< largest distance of any vertex of any frame from its place */
  ANIC_GOAL_KG = 2,           /**< KG error in per cent */
  ANIC_GOAL_RMSE = 3,         /**< root of the mean squared error */
  ANIC_GOAL_SIZE = 4,         /**< bytes, with the smallest error; of one mesh alone */
  ANIC_GOAL_BPFV = 5,         /**< bits per frame and vertex, with the smallest error */
  ANIC_GOAL_DISPLACEMENT = 6, /**< largest error of any vertex's move from frame to frame */
  ANIC_GOAL_STED = 7          /**< STED, an error as viewers see it; of every mesh and clip */
};

/** Kind of basis. */
enum anic_basis_choice ANIC_INT32 {
  ANIC_CHOOSE_SMALLEST = 0,
  ANIC_CHOOSE_KEYFRAMES = 1,
  ANIC_CHOOSE_EIGENSHAPES = 2,
  ANIC_CHOOSE_EIGENTRAJECTORIES = 3
};

/** How key-frames are chosen. */
enum anic_selection ANIC_INT32 {
  ANIC_SELECT_PIVOT = 0,
  ANIC_SELECT_GAS = 1,
  ANIC_SELECT_UNIFORM = 2
};

/** How frames come from key-frames. */
enum anic_interpolation ANIC_INT32 {
  /** Between key-frames that were asked for linear; else best, where a file by geometry
   * interpolation is a tenth smaller. */
  ANIC_INTERPOLATE_USUAL = 0,
  ANIC_INTERPOLATE_LINEAR = 1, /**< any decoder plays the file */
  /** Geometry interpolation, which decoders may lack: of key-frames alone. */
  ANIC_INTERPOLATE_MSGI = 2,
  ANIC_INTERPOLATE_BEST = 3
};

/** The coder of the poses of key-frames. */
enum anic_keyframe_coder ANIC_INT32 {
  ANIC_KEYFRAMES_NATIVE = 0, /**< the coder of poses: any decoder plays the file */
  ANIC_KEYFRAMES_DRACO = 1,  /**< Draco, which decoders may lack */
  ANIC_KEYFRAMES_SMALLEST = 2
};

/** Whether vertices are moved along their surface first, of one mesh alone. */
enum anic_massage ANIC_INT32 {
  ANIC_MASSAGE_OFF = 0,
  ANIC_MASSAGE_ON = 1,
  ANIC_MASSAGE_AUTO = 2 /**< if the file becomes smaller */
};

/** How long to search for a small file. Means of five clips at KG 0.1 %, of which README has more. */
enum anic_effort ANIC_INT32 {
  ANIC_EFFORT_NORMAL = 0,
  ANIC_EFFORT_FAST = 1, /**< a third of the time, for 29 % more bytes */
  ANIC_EFFORT_BEST = 2  /**< 1.8 times the time, for 2 % fewer; the file may take longer to open */
};

enum {
  ANIC_ENCODE_PERCENT = 1,       /**< goal_value is a length in per cent of the diagonal of the box
                                      around all frames, of several clips each of its own, not in
                                      units of the clip */
  ANIC_ENCODE_CAP_PERCENT = 2,   /**< the same of max_error */
  ANIC_ENCODE_ERROR_PERCENT = 4, /**< attribute_error is in per cent of the range of its values */
  ANIC_ENCODE_NO_ATTRIBUTES = 8, /**< positions and polygons alone */
  ANIC_ENCODE_ROOT_MOTION = 16,  /**< the motion of the whole apart, of one mesh alone:
                                      anic_root_motion */
  ANIC_ENCODE_LOSSLESS = 32,     /**< the positions come back bit for bit; instead of a goal, of
                                      max_error and of massage */
  ANIC_ENCODE_SMALLEST = 64 /**< the smallest file that the search finds, however long it takes to
                                      open; else bytes and the time of opening are in balance */
};

/** Follows and stops an encoding. All zero: nobody does. report() gets the name of the stage and the
 * share of the stage that is done, 0 to 1; a stage may come again, as for every mesh. Anything but 0
 * ends the encoding with ANIC_E_CANCELLED. */
typedef struct anic_encode_progress {
  void* user;
  int (*report)(void* user, const char* stage, double done);
} anic_encode_progress;

/** Takes a file in pieces, in order. write() returns 0, or anything else to end the encoding with
 * ANIC_E_READ. */
typedef struct anic_writer {
  void* user;
  int (*write)(void* user, const void* bytes, size_t size);
} anic_writer;

/** A NULL pointer, or 0 in every field: everything by default. */
typedef struct anic_encode_options {
  size_t struct_size;
  anic_goal goal;
  anic_order order;
  double goal_value;
  double max_error;   /**< a largest error beside another goal; 0: none */
  uint64_t flags;     /**< ANIC_ENCODE_... */
  uint64_t max_bytes; /**< refuse, with ANIC_E_LIMIT, what would hold more memory; 0: no limit */
  uint32_t threads;   /**< 0: as many as the machine has */
  anic_effort effort;
  anic_basis_choice basis;
  uint32_t keyframes; /**< exact number of key-frames; 0: as few as do */
  anic_selection selection;
  anic_interpolation interpolation;
  anic_keyframe_coder keyframe_coder;
  anic_massage massage;
  uint32_t uv_bits;         /**< texture coordinates in steps of 2^-uv_bits; 0 means 12 */
  uint32_t colour_bits;     /**< bits of a component of a colour; 0 means 8 */
  double massage_strength;  /**< weight of shape against distance, between 0 and 1; 0 means 0.5 */
  double massage_tolerance; /**< how far the surface may move, units of the clip; 0: any */
  double
      attribute_error; /**< largest error of attributes that change and have no bound of their own; 0: half a step of
                               colour_bits for colours, 0.1 % of their range for others */
  double normal_error; /**< degrees: normals and tangents of frame 0 as numbers that are not
                               further off; 0: hard edges alone */
  anic_encode_progress progress;
  anic_writer writer; /**< gets the file instead of anic_encoding */
  const char*
      metadata; /**< a JSON object in UTF-8 that the file keeps, at most 2^20 bytes; NULL: none */
} anic_encode_options;

/** The file, and what was measured of it by decoding it. Lengths are in units of the clip. */
typedef struct anic_encoding {
  size_t struct_size;
  const void* file; /**< belongs to the encoder, until the next anic_encode(); NULL with a writer */
  size_t size;
  double max_error;
  double rmse;
  double kg;             /**< per cent */
  double diagonal;       /**< diagonal of the box around all frames of all clips */
  double surface_error;  /**< how far massage moved the surface at most */
  uint32_t components;   /**< components of the largest basis */
  anic_basis_kind basis; /**< basis of the first mesh */
  uint8_t massaged;
  double max_displacement_error; /**< error of a vertex's move from frame to frame */
} anic_encoding;

/**
 * Encodes the meshes to one file, decodes it, and checks that it keeps what was asked. The same
 * input and options give the same bytes, which are those of the command `anicodec encode`.
 *
 * - Params: options may be NULL
 * - Errors: ANIC_E_STATE: there is no mesh; ANIC_E_ARGUMENT: options that make no sense, a goal
 *   that cannot be reached, input that cannot be encoded; ANIC_E_NON_FINITE: a position is not
 *   finite; ANIC_E_LIMIT, ANIC_E_MEMORY, ANIC_E_READ, ANIC_E_CANCELLED; ANIC_E_INTERNAL: the file
 *   does not keep what was asked, which is a defect
 */
ANIC_API anic_status anic_encode(anic_encoder* encoder, const anic_encode_options* options,
                                 anic_encoding* out);

/* ---- live streams ---------------------------------------------------------------------------- */

/** A capture that is encoded while it goes on: frames in, files of a live stream out, each with a second of
 * them as a rule (anic_advance_stream() plays one after the other). A thread of its own encodes. One thread
 * may push while another takes; other calls at the same time are undefined. */
typedef struct anic_live anic_live;

/** A NULL pointer, or 0 in every field: everything by default. */
typedef struct anic_live_options {
  size_t struct_size;
  double piece_seconds; /**< length of a file; 0: 1 */
  double
      key_seconds; /**< a file begins anew so many seconds after the last that did; whoever joins late, or
                         has lost a file, goes on there. 0: 4; below 0: every file does */
  double
      box; /**< diagonal that a goal in per cent is of, in units of the clip; 0: that of the first file's
                 frames, which is smaller than the clip's */
  uint64_t
      most_waiting_frames; /**< that wait for being encoded, at least those of a file; 0: any number,
                                   whatever memory they take */
} anic_live_options;

/**
 * Begins a stream of the encoder's clip, whose frame_count is 0, and its mesh, of which there is one. Both
 * are copied: the encoder may go.
 *
 * - Params: options as of anic_encode(), without what needs all frames: sizes, key-frames, lossless,
 *   massage, root motion; nor progress and writer. ANIC_EFFORT_FAST takes the first file that
 *   keeps the goal, fast enough for 10,000 vertices at 30 frames a second; others search as one less does for a whole clip. attribute_error in per cent is of the range in the first file. Both may be NULL
 * - Errors: ANIC_E_STATE: the clip has frames, or there is not one mesh; ANIC_E_ARGUMENT; ANIC_E_MEMORY:
 *   anic_get_encoder_text() tells more
 */
ANIC_API anic_status anic_begin_live(anic_encoder* encoder, const anic_encode_options* options,
                                     const anic_live_options* live, anic_live** out);

/** Ends the encoding of what is there, and drops it. NULL is allowed. */
ANIC_API void anic_destroy_live(anic_live* live);

/** The fault of this thread's last call of a function of live streams, as anic_get_encoder_text(). */
ANIC_API const char* anic_get_live_text(void);

/** A frame. */
typedef struct anic_live_frame {
  size_t struct_size;
  const void* positions;   /**< x of vertex 0, any alignment */
  ptrdiff_t vertex_stride; /**< bytes from a vertex to the next; 0: packed */
  anic_scalar scalar;      /**< type of positions */
  uint32_t value_count;    /**< attributes that move: those without `values` */
  const float* const*
      values; /**< values of each of them, in the order in which they were added: elements x
                                 components */
} anic_live_frame;

/**
 * Copies a frame. Waits at most `wait` seconds for room, INFINITY for ever.
 *
 * - Errors: ANIC_E_LIMIT: there is no room, nothing was taken; ANIC_E_ARGUMENT: counts or pointers make no
 *   sense, a number is not finite, anic_end_live() was called: nothing was taken; what ended the encoding
 */
ANIC_API anic_status anic_push_live_frame(anic_live* live, const anic_live_frame* frame,
                                          double wait);

/** No frame follows: the last file gets those that are there. */
ANIC_API anic_status anic_end_live(anic_live* live);

/** A file of the stream, and what was measured of it. */
typedef struct anic_live_piece {
  size_t struct_size;
  const void* file; /**< belongs to the stream, until the next anic_take_live_piece() */
  size_t size;
  uint64_t first_frame; /**< first of the frames that were pushed */
  double start_time;    /**< time of that frame, on the clock of the clip */
  double encode_seconds;
  double max_error;
  double rmse;
  double kg; /**< per cent */
  uint32_t frame_count;
  uint8_t key; /**< it begins anew: whoever has lost a file goes on here */
  uint8_t
      has_mesh; /**< it is no continuation: whoever joins needs the last of these, and then a key */
} anic_live_piece;

/**
 * Takes the next file, once it is made. Waits at most `wait` seconds, INFINITY for ever.
 *
 * - Errors: ANIC_E_ABSENT: none was made in time, or all are taken (anic_live_info.ended); what ended the
 *   encoding, when all files before are taken: the codes of anic_encode()
 */
ANIC_API anic_status anic_take_live_piece(anic_live* live, double wait, anic_live_piece* out);

/** How far a stream is. */
typedef struct anic_live_info {
  size_t struct_size;
  uint64_t pushed_frames;
  uint64_t waiting_frames; /**< frames of which no file is made yet */
  uint64_t
      late_frames; /**< the waiting frames of full files that are not begun: 0 while the encoder keeps
                              up, else how far it is behind */
  uint64_t waiting_pieces; /**< files made, and not taken */
  double encode_seconds;   /**< that the last file took */
  uint32_t piece_frames;   /**< frames of a file, but for the last */
  uint8_t ended;           /**< all files are taken */
} anic_live_info;

/** - Errors: ANIC_E_ARGUMENT */
ANIC_API anic_status anic_get_live_info(const anic_live* live, anic_live_info* out);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_ENCODE_H_ */
