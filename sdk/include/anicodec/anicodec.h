/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * anicodec: plays compressed animated meshes (.anic files). This header is all a host needs; it is
 * C99.
 *
 *   anic_asset* asset;
 *   anic_context* context;
 *   anic_open_asset(bytes, size, NULL, &asset, NULL);        an opened clip: immutable, shared
 *   anic_create_context(asset, NULL, &context);              an instance of it: small
 *   anic_seek_time(context, seconds, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP);
 *   anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, vertex_count, &output);
 *
 * Conventions of all functions
 *   Status   every function that can fail returns an anic_status. What it was to fill is then
 * unspecified, handles are set to NULL, and every object stays usable. Files    any bytes may be
 * given as a file: damaged and hostile ones are refused with a status. Threads  the library starts
 * none and has no global state. An asset may be used by any number of threads. Functions that take
 * a const anic_context may run at the same time; one that takes a context that is not const needs
 * it to itself. Different contexts are independent. Memory   all comes from the allocator of
 * anic_options. Functions that take a context, other than creating and destroying it, allocate
 * nothing. Floats   the functions compute in the caller's floating-point environment, except while
 * opening. Units    positions are in the units and axes of the clip's source (anic_asset_info says
 * what is known of them); times are in seconds. Spec     sections refer to the folder spec/ of the
 * project.
 */
#ifndef ANICODEC_ANICODEC_H_
#define ANICODEC_ANICODEC_H_

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(ANIC_SHARED)
#if defined(ANIC_BUILDING)
#define ANIC_API __declspec(dllexport)
#else
#define ANIC_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define ANIC_API __attribute__((visibility("default")))
#else
#define ANIC_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * version */

#define ANIC_VERSION_MAJOR 0
#define ANIC_VERSION_MINOR 1
#define ANIC_VERSION_PATCH 0

/** Version of the library that is linked: major << 16 | minor << 8 | patch. */
ANIC_API uint32_t anic_get_version(void);

/* -------------------------------------------------------------------------------------------------
 * status */

/** Numbers are fixed for good: none is ever given another meaning. Spec: 12. */
typedef enum anic_status {
  ANIC_OK = 0,

  /* the caller's */
  ANIC_E_ARGUMENT = 1, /**< an argument makes no sense */
  ANIC_E_STATE = 2,    /**< the call is not possible now: nothing sampled, not enough of a stream */
  ANIC_E_BUFFER_SIZE = 3, /**< a buffer of the caller is too small */
  ANIC_E_FRAME_RANGE = 4, /**< there is no such frame */

  /* not this format, version or feature */
  ANIC_E_MAGIC = 10,
  ANIC_E_VERSION = 11,
  ANIC_E_FEATURE = 12,
  ANIC_E_CODER = 13, /**< a coder that this build does not have */

  /* container */
  ANIC_E_TRUNCATED = 20,
  ANIC_E_HEADER = 21,
  ANIC_E_HEADER_CHECKSUM = 22,
  ANIC_E_CHUNK_BOUNDS = 23,
  ANIC_E_CHUNK_CHECKSUM = 24,
  ANIC_E_CHUNK_DUPLICATE = 25,
  ANIC_E_CHUNK_MISSING = 26,
  ANIC_E_CHUNK_UNKNOWN = 27,
  ANIC_E_PADDING = 28,
  ANIC_E_TRAILING_BYTES = 29,
  ANIC_E_FILE_SIZE = 30,

  /* payloads */
  ANIC_E_RECORD = 40,
  ANIC_E_ENTROPY = 41,
  ANIC_E_ZSTD = 42,
  ANIC_E_TOPOLOGY = 43,
  ANIC_E_INDEX_RANGE = 44,
  ANIC_E_QUANTIZER = 45,
  ANIC_E_NON_FINITE = 46,
  ANIC_E_DRACO = 47,
  ANIC_E_SEGMENT =
      48, /**< of a segment; from a sampling function: the mesh is not there at that time */
  ANIC_E_HASH = 49,

  ANIC_E_LIMIT = 60, /**< more than anic_limits allow */

  ANIC_E_MEMORY = 70, /**< the allocator had no memory */
  ANIC_E_READ = 71,   /**< the read callback failed */

  ANIC_E_INTERNAL = 90,        /**< a defect of the library */
  ANIC_STATUS_MAX = 0x7FFFFFFF /**< none: any number may be given */
} anic_status;

/** English text of a status without a full stop. Static; never NULL, for any number. */
ANIC_API const char* anic_get_status_text(anic_status status);

/** What was wrong with a file, and where. */
typedef struct anic_failure {
  anic_status status;
  char chunk[8];      /**< type of the chunk, four characters and a 0; empty outside any chunk */
  uint64_t offset;    /**< byte offset in the file, as exact as is known */
  const char* detail; /**< static English text; may be empty, never NULL */
} anic_failure;

/* -------------------------------------------------------------------------------------------------
 * memory */

/**
 * Where memory comes from. All zero: malloc() and free().
 *
 * allocate() returns `size` bytes (never 0) at a multiple of `alignment` (a power of two, at most
 * 16), or NULL; then the call that needed it fails with ANIC_E_MEMORY and gives back what it had.
 * release() gets what allocate() returned and the size it was asked for. Both are called only by
 * functions that open, create, push, destroy or close, on their thread, and must return.
 */
typedef struct anic_allocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* memory, size_t size);
} anic_allocator;

/**
 * Makes an allocator that serves from one block of the host's and from nowhere else.
 *
 * The block belongs to the allocator until everything made with it is destroyed; then the block may
 * simply be dropped. Best fit, neighbours joined when released; sizes are rounded up to 16 bytes;
 * O(free pieces) for each allocation. One thread at a time.
 *
 * Errors  ANIC_E_ARGUMENT: a pointer is NULL; ANIC_E_BUFFER_SIZE: less than 256 bytes.
 */
ANIC_API anic_status anic_init_block_allocator(void* block, size_t size, anic_allocator* out);

/* ------------------------------------------------------------------------------------------------
 * opening */

/**
 * What a file may ask for, checked before anything that depends on a count is allocated:
 * ANIC_E_LIMIT. A field of 0 has the default in brackets.
 */
typedef struct anic_limits {
  uint64_t vertices;   /**< of a mesh [2^31 - 1] */
  uint64_t frames;     /**< [2^24 - 1] */
  uint64_t components; /**< of a segment [2^20] */
  uint64_t bytes; /**< anic_requirements.opening_bytes [2^28 + 2^14 for each byte of the file] */
} anic_limits;

enum {
  /** Computes the box of every frame while opening: anic_get_frame_bounds(),
   * anic_get_clip_bounds(). Costs playing the clip once, and 24 bytes for each frame and mesh. */
  ANIC_OPEN_BOUNDS = 1u
};

/** How to open a file. All zero, or a NULL pointer to it: everything by default. */
typedef struct anic_options {
  anic_limits limits;
  anic_allocator allocator; /**< copied; `user` must outlive what is made with it */
  double quality; /**< share of the components to open, in (0, 1]; 0 means 1. Less is coarser,
                     smaller, and faster to open and to play. Spec: 09a, section 4 */
  uint32_t flags; /**< ANIC_OPEN_... */
} anic_options;

/** What a file takes, known from its first bytes. Spec: 11, section 3. */
typedef struct anic_requirements {
  uint64_t head_bytes;     /**< first bytes of the file that anic_get_requirements() has to see */
  uint64_t file_bytes;     /**< the whole file; 0 while its header is not seen */
  uint64_t resident_bytes; /**< held while the asset is open; within 5 % or 4096 bytes */
  uint64_t
      opening_bytes; /**< held at most while it opens, resident ones included, the file excluded */
  uint64_t draco_bytes; /**< of those, what Draco may take from the global heap at most */
  uint64_t
      block_bytes; /**< a block for anic_init_block_allocator() in which the asset can be opened */
  uint64_t context_bytes; /**< of one context, at most */
  uint32_t mesh_count;
  uint32_t segment_count;
  uint32_t frame_count;
  uint32_t max_vertices;   /**< of the largest mesh */
  uint32_t max_components; /**< of the largest segment, as the file has it */
} anic_requirements;

/**
 * Tells what a file will take, from its first bytes.
 *
 * `head` holds the first `size` bytes of the file: header, chunk table and the first chunk; a few
 * hundred bytes for most files. If they do not suffice, head_bytes says how many will (or how many
 * will tell).
 *
 * Errors   ANIC_E_TRUNCATED: head_bytes are needed; others: anic_open_asset() refuses the file too
 * Memory   32 bytes per chunk, mesh and segment for a moment, from options->allocator. Cost
 * O(them). Spec     05, section 7
 */
ANIC_API anic_status anic_get_requirements(const void* head, size_t size,
                                           const anic_options* options, anic_requirements* out);

/** An opened file. Immutable, so threads and contexts may share it. Destroy the contexts first. */
typedef struct anic_asset anic_asset;

/**
 * Opens a whole file in memory. The bytes are not needed afterwards.
 *
 * Params   options and failure may be NULL. `failure` is written in any case.
 * Errors   any that concern the file (spec/12); ANIC_E_LIMIT, ANIC_E_MEMORY, ANIC_E_ARGUMENT
 * Memory   anic_requirements; less than opening_bytes at any time
 * Cost     decodes all coefficients once: microseconds per vertex (spec/10)
 */
ANIC_API anic_status anic_open_asset(const void* file, size_t size, const anic_options* options,
                                     anic_asset** out, anic_failure* failure);

/**
 * Reads a file. read() puts `size` bytes from `offset` on to `to` and returns 0, or anything else
 * when it cannot: the opening then fails with ANIC_E_READ.
 */
typedef struct anic_reader {
  void* user;
  int (*read)(void* user, uint64_t offset, void* to, size_t size);
} anic_reader;

/**
 * Opens a file through a callback. Reads its head, checks the limits, then reads the rest.
 *
 * file_size is the length of the file. Memory: file_size more than anic_open_asset() while it
 * opens.
 */
ANIC_API anic_status anic_open_asset_from_reader(const anic_reader* reader, uint64_t file_size,
                                                 const anic_options* options, anic_asset** out,
                                                 anic_failure* failure);

/** Gives everything back. NULL is allowed. */
ANIC_API void anic_close_asset(anic_asset* asset);

/**
 * Compares the hashes in the file with what was decoded: ANIC_E_HASH if this library decodes other
 * integers than the encoder meant. ANIC_E_STATE for an asset that is not complete or of lower
 * quality.
 */
ANIC_API anic_status anic_verify_asset(const anic_asset* asset);

/* ------------------------------------------------------------------------------------------- what
 * is in it */

typedef enum anic_up_axis { ANIC_UP_UNKNOWN = 0, ANIC_UP_Y = 1, ANIC_UP_Z = 2 } anic_up_axis;

/** What of the source's order came back. Every source vertex is there in any case. Spec: 06,
 * section 5. */
typedef enum anic_order {
  ANIC_ORDER_VERTICES = 0, /**< vertices are numbered as in the source */
  ANIC_ORDER_FREE = 1,     /**< vertices and polygons are in an order of the encoder's */
  ANIC_ORDER_ALL = 2       /**< vertices, polygons and their first corners as in the source */
} anic_order;

/** Spec: 04 (time, coordinates, promise), 06 section 3. Strings belong to the asset. */
typedef struct anic_asset_info {
  uint32_t mesh_count;
  uint32_t segment_count;
  uint32_t frame_count;
  uint32_t rate_numerator; /**< frames per second = numerator / denominator; a hint if `uneven` */
  uint32_t rate_denominator;
  uint8_t rate_assumed; /**< the source told no rate */
  uint8_t uneven;       /**< frames have a table of times: anic_get_frame_time() */
  uint8_t loop;         /**< meant to be played with ANIC_WRAP_LOOP */
  uint8_t closed;       /**< the last frame repeats the first */
  uint8_t massaged;     /**< the mesh was changed before coding: surface_error */
  uint8_t partial;      /**< a stream that was not complete: some of it is missing, or coarser */
  anic_up_axis up;
  anic_order order;
  double start_time;      /**< of frame 0, seconds */
  double end_time;        /**< of the last frame */
  double loop_duration;   /**< of one turn of ANIC_WRAP_LOOP, seconds */
  double metres_per_unit; /**< 0: unknown */
  double diagonal;        /**< of the box around all frames of the source */
  double max_error;       /**< errors that the encoder measured, at full quality, scene units */
  double rmse;
  double kg; /**< per cent */
  double surface_error;
  double surface_error_mean;
  const char* name;
  const char* encoder;
  uint64_t resident_bytes; /**< held by this asset */
  uint64_t context_bytes;  /**< held by each context */
} anic_asset_info;

ANIC_API void anic_get_asset_info(const anic_asset* asset, anic_asset_info* out);

typedef struct anic_mesh {
  const char* name;
  uint32_t vertex_count;       /**< of the source, each once */
  uint32_t coded_vertex_count; /**< distinct among them: the others are copies that move along */
  uint32_t polygon_count;
  uint32_t corner_count;    /**< of all polygons */
  uint32_t triangle_count;  /**< when polygons are cut into fans: anic_write_indices() */
  uint32_t attribute_count; /**< anic_get_attribute() */
} anic_mesh;

/** Errors: ANIC_E_ARGUMENT, no such mesh. */
ANIC_API anic_status anic_get_mesh(const anic_asset* asset, uint32_t mesh, anic_mesh* out);

/** Polygons as in the source; the arrays belong to the asset. */
typedef struct anic_polygons {
  uint32_t polygon_count;
  const uint32_t* offsets; /**< polygon p has corners offsets[p] .. offsets[p + 1] - 1 */
  const uint32_t* corners; /**< vertex of each corner */
} anic_polygons;

ANIC_API anic_status anic_get_polygons(const anic_asset* asset, uint32_t mesh, anic_polygons* out);

/**
 * Writes an index buffer: every polygon as a fan from its first corner, in order; polygons with
 * fewer than three corners have none. Counter-clockwise as in the source.
 *
 * Shapes   out: triangle_count x 3 indices of index_bytes (2 or 4) each; size: bytes at out
 * Errors   ANIC_E_ARGUMENT: no such mesh, or more than 65536 vertices for 2 bytes;
 * ANIC_E_BUFFER_SIZE
 */
ANIC_API anic_status anic_write_indices(const anic_asset* asset, uint32_t mesh,
                                        uint32_t index_bytes, void* out, size_t size);

/**
 * Which coded vertex each vertex is a copy of: vertices with the same number have the same position
 * in every frame. vertex_count numbers below coded_vertex_count, in *out; they belong to the asset.
 * Spec: 07.
 */
ANIC_API anic_status anic_get_coded_vertices(const anic_asset* asset, uint32_t mesh,
                                             const uint32_t** out);

/** What an attribute means. Numbers are fixed. Spec: 06, section 10. */
typedef enum anic_attribute_kind {
  ANIC_ATTRIBUTE_UV =
      0, /**< v upwards: (0, 0) is the lower left corner of an image; some APIs want 1 - v */
  ANIC_ATTRIBUTE_NORMAL = 1, /**< of the first frame; without components: which corners share one,
                      that is, hard edges */
  ANIC_ATTRIBUTE_TANGENT = 2,
  ANIC_ATTRIBUTE_COLOUR = 3, /**< RGB or RGBA, 0 to 1 */
  ANIC_ATTRIBUTE_CUSTOM = 4,
  ANIC_ATTRIBUTE_MATERIAL = 5, /**< of polygons: names of materials */
  ANIC_ATTRIBUTE_PART = 6      /**< of polygons: names of the meshes or objects of the source */
} anic_attribute_kind;

/** What has a value each: vertices, corners or polygons, as anic_get_polygons() numbers them. */
typedef enum anic_domain {
  ANIC_DOMAIN_VERTICES = 0,
  ANIC_DOMAIN_CORNERS = 1,
  ANIC_DOMAIN_POLYGONS = 2
} anic_domain;

/** An attribute, as in frame 0. Strings and arrays belong to the asset. */
typedef struct anic_attribute {
  const char* name; /**< as in the source, may be empty */
  anic_attribute_kind kind;
  anic_domain domain;
  uint32_t count;         /**< elements: vertices, corners or polygons */
  uint32_t components;    /**< numbers of an element; 0: it has `labels` */
  uint32_t label_count;   /**< ANIC_DOMAIN_POLYGONS: names, anic_get_label_name() */
  const float* values;    /**< count x components; NULL without components */
  const uint32_t* labels; /**< count; of polygons 0 for none, else one more than the number of a
                             name; of corners, those at a vertex with the same number share a value.
                             NULL with components */
  uint8_t
      moves; /**< of ANIC_DOMAIN_VERTICES: other frames have other values, anic_write_attribute() */
} anic_attribute;

/** Errors: ANIC_E_ARGUMENT, no such mesh or attribute. O(1). */
ANIC_API anic_status anic_get_attribute(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                        anic_attribute* out);

/** Name of a label, 0 .. label_count - 1; NULL if there is none. It belongs to the asset. */
ANIC_API const char* anic_get_label_name(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                         uint32_t label);

/** Time of a frame in seconds; frames behind the last count as the last. Spec: 04, section 2. */
ANIC_API double anic_get_frame_time(const anic_asset* asset, uint32_t frame);

/* ------------------------------------------------------------------------------------------------
 * sampling */

/** An instance of an asset: what is shown now, and what was shown before. */
typedef struct anic_context anic_context;

/**
 * Makes a context; allocates context_bytes at once and nothing afterwards. `allocator` may be NULL:
 * the asset's. Many contexts may share an asset.
 */
ANIC_API anic_status anic_create_context(const anic_asset* asset, const anic_allocator* allocator,
                                         anic_context** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_context(anic_context* context);

/** What is shown between two frames. Spec: 10, section 2. */
typedef enum anic_sampling {
  ANIC_SAMPLE_STEP = 0,   /**< the frame before */
  ANIC_SAMPLE_LINEAR = 1, /**< between the frames before and after */
  ANIC_SAMPLE_CUBIC =
      2, /**< a smooth curve through four frames (Catmull-Rom, for uneven times too) */
  ANIC_SAMPLE_MAX_ENUM = 0x7FFFFFFF /**< none: any number may be given */
} anic_sampling;

/** What is shown outside the clip. Any speed, and backwards, is a matter of the time asked for. */
typedef enum anic_wrap {
  ANIC_WRAP_CLAMP = 0,       /**< the first and the last frame stay */
  ANIC_WRAP_LOOP = 1,        /**< frame 0 follows the last frame; if info.closed, they are one */
  ANIC_WRAP_PING_PONG = 2,   /**< backwards after the last frame, forwards after the first */
  ANIC_WRAP_MAX = 0x7FFFFFFF /**< none: any number may be given */
} anic_wrap;

/**
 * Chooses a frame. What was chosen before becomes ANIC_WHEN_PREVIOUS.
 *
 * Errors   ANIC_E_FRAME_RANGE
 * Cost     O(log segments), the same for every frame. Spec: 10. In segments of
 * ANIC_RECONSTRUCTION_MSGI the shape is made here: O(vertices x log vertices)
 */
ANIC_API anic_status anic_seek_frame(anic_context* context, uint32_t frame);

/**
 * Chooses a time in seconds; frame 0 is at info.start_time. What was chosen before becomes
 * ANIC_WHEN_PREVIOUS.
 *
 * Weights and maps are interpolated, not positions, so that a frame in between costs what a whole
 * one does; rigid motions turn the shorter way. Where the frames are in different segments, each is
 * made and their positions are interpolated: twice the cost. Corrections of single vertices are
 * applied at whole frames only; a time within 1/1024 of the way from a frame to the next is that
 * frame.
 *
 * Errors   ANIC_E_ARGUMENT: a time that is not finite
 * Cost     O(components + log segments); with a table of times + O(log frames). In segments of
 *          ANIC_RECONSTRUCTION_MSGI the shape is made here
 */
ANIC_API anic_status anic_seek_time(anic_context* context, double seconds, anic_sampling sampling,
                                    anic_wrap wrap);

/**
 * Makes ANIC_WHEN_PREVIOUS the same as ANIC_WHEN_CURRENT: no motion, after a cut.
 * Errors: ANIC_E_STATE, nothing is chosen yet.
 */
ANIC_API anic_status anic_forget_previous(anic_context* context);

/** Which of the two times that a context knows. */
typedef enum anic_when {
  ANIC_WHEN_CURRENT = 0, /**< what the last seek chose */
  ANIC_WHEN_PREVIOUS =
      1, /**< what the one before chose, for motion vectors; the same after the first seek */
  ANIC_WHEN_MAX = 0x7FFFFFFF /**< none: any number may be given */
} anic_when;

/**
 * How a position or normal is stored, in the machine's byte order. The formats of four components
 * write 1 as the last one. The 16-bit formats store t = (x - offset) / scale: as IEEE binary16,
 * rounded to nearest; as round(65535 t), clamped to t = 0 .. 1; as round(32767 t), clamped to t =
 * -1 .. 1.
 */
typedef enum anic_format {
  ANIC_FORMAT_FLOAT32X3 = 0,
  ANIC_FORMAT_FLOAT32X4 = 1,
  ANIC_FORMAT_FLOAT16X3 = 2,
  ANIC_FORMAT_FLOAT16X4 = 3,
  ANIC_FORMAT_UNORM16X3 = 4,
  ANIC_FORMAT_UNORM16X4 = 5,
  ANIC_FORMAT_SNORM16X3 = 6,
  ANIC_FORMAT_SNORM16X4 = 7,
  ANIC_FORMAT_MAX = 0x7FFFFFFF /**< none: any number may be given */
} anic_format;

/**
 * Where to write positions or normals. Every component is written once, at ascending addresses, and
 * nothing is read: the memory may be write-combined. Bytes between elements stay untouched.
 */
typedef struct anic_output {
  void* data;    /**< of the first element asked for; any alignment */
  size_t size;   /**< bytes that may be written from data on */
  size_t stride; /**< bytes from an element to the next; 0: packed */
  anic_format format;
  float offset[3]; /**< of the 16-bit formats; anic_get_clip_bounds() gives fitting ones */
  float scale[3];  /**< of the 16-bit formats; 0 counts as 1 */
} anic_output;

/**
 * Writes positions of the vertices first .. first + count - 1 of a mesh. Threads may write disjoint
 * ranges at the same time; the result does not depend on how a mesh is cut into ranges.
 *
 * Errors   ANIC_E_STATE: nothing chosen yet; ANIC_E_ARGUMENT; ANIC_E_BUFFER_SIZE; ANIC_E_SEGMENT:
 * the mesh is not there at that time Cost     O(count x components), the same for every frame;
 * ranges that begin at multiples of 16 are best Spec     09a, section 1; tolerance: 09a, section 7
 */
ANIC_API anic_status anic_write_positions(const anic_context* context, uint32_t mesh,
                                          anic_when when, uint32_t first, uint32_t count,
                                          const anic_output* out);

/** How a value of an attribute is stored, in the machine's byte order. */
typedef enum anic_value_format {
  ANIC_VALUE_FLOAT32 = 0,
  ANIC_VALUE_FLOAT16 = 1,            /**< IEEE binary16, rounded to nearest */
  ANIC_VALUE_UNORM8 = 2,             /**< round(255 x), clamped to x = 0 .. 1 */
  ANIC_VALUE_UNORM16 = 3,            /**< round(65535 x), clamped to x = 0 .. 1 */
  ANIC_VALUE_FORMAT_MAX = 0x7FFFFFFF /**< none: any number may be given */
} anic_value_format;

/** Where to write values of an attribute; written as anic_output is. */
typedef struct anic_value_output {
  void* data;    /**< of the first element asked for; any alignment */
  size_t size;   /**< bytes that may be written from data on */
  size_t stride; /**< bytes from an element to the next; 0: packed */
  anic_value_format format;
  uint32_t components; /**< to be written of each element, at most 16; 0: as many as the attribute
                          has. Those that it does not have are 0, the fourth 1 */
} anic_value_output;

/**
 * Writes values of an attribute of vertices, moving or not, at the time chosen: of the vertices
 * first .. first + count - 1 of a mesh. Between frames they are interpolated as the seek said,
 * positions and values alike.
 *
 * Errors   ANIC_E_ARGUMENT: no such attribute, or not one of ANIC_DOMAIN_VERTICES with components;
 * others as anic_write_positions() Cost     O(count x components of its segments), the same for
 * every frame Spec 09a, section 8
 */
ANIC_API anic_status anic_write_attribute(const anic_context* context, uint32_t mesh,
                                          uint32_t attribute, anic_when when, uint32_t first,
                                          uint32_t count, const anic_value_output* out);

/** Most frames of one call of anic_write_frames(). */
#define ANIC_MAX_FRAMES 16

/**
 * Writes positions in several whole frames, without a context: to outputs[i] those of frames[i].
 * Consecutive frames, four and four, take about half the time of one by one, and come out the same.
 *
 * Shapes   frames, outputs: frame_count, at most ANIC_MAX_FRAMES; outputs must not overlap
 * Errors   ANIC_E_ARGUMENT, ANIC_E_BUFFER_SIZE, ANIC_E_FRAME_RANGE, ANIC_E_SEGMENT; ANIC_E_STATE: a
 *          segment of ANIC_RECONSTRUCTION_MSGI, which needs the memory of a context
 */
ANIC_API anic_status anic_write_frames(const anic_asset* asset, uint32_t mesh,
                                       const uint32_t* frames, uint32_t frame_count, uint32_t first,
                                       uint32_t count, const anic_output* outputs);

/* --------------------------------------------------------------------------------------------------
 * bounds */

typedef struct anic_box {
  float min[3], max[3];
} anic_box;

/** The exact box of what is chosen. Costs what anic_write_positions() does. Errors as there. */
ANIC_API anic_status anic_compute_bounds(const anic_context* context, uint32_t mesh, anic_when when,
                                         anic_box* out);

/**
 * The exact box of a whole frame, from a table: O(1).
 * Errors: ANIC_E_STATE: opened without ANIC_OPEN_BOUNDS; ANIC_E_ARGUMENT; ANIC_E_FRAME_RANGE;
 * ANIC_E_SEGMENT: the mesh is not there in this frame.
 */
ANIC_API anic_status anic_get_frame_bounds(const anic_asset* asset, uint32_t mesh, uint32_t frame,
                                           anic_box* out);

/**
 * The box around all frames. Positions between frames may leave it a little with ANIC_SAMPLE_CUBIC,
 * or where a segment turns; step and linear interpolation of clips without rigid motions never do,
 * but for rounding.
 */
ANIC_API anic_status anic_get_clip_bounds(const anic_asset* asset, uint32_t mesh, anic_box* out);

/* -------------------------------------------------------------------------------------------------
 * normals */

/** How to make normals of a mesh: which corners a normal is averaged over. Immutable, shared. */
typedef struct anic_normal_plan anic_normal_plan;

typedef struct anic_normal_options {
  double crease_angle; /**< degrees; edges whose polygons' normals are further apart are hard. 0:
                          none is; a small one, such as 0.001, shades flat what is not coplanar */
  uint32_t reference_frame; /**< the frame in which the angles are looked at, for all frames */
  uint8_t per_corner;       /**< normals for each corner (anic_polygons) instead of each vertex */
  uint8_t source_edges; /**< edges are hard where they are in the source, whatever the angle, if the
                           file tells (ANIC_ATTRIBUTE_NORMAL without components); else by
                           crease_angle */
} anic_normal_options;

/**
 * Prepares normals that are recomputed from positions; normals that a file holds are an attribute,
 * ANIC_ATTRIBUTE_NORMAL. They are smooth across copies of a vertex (anic_get_coded_vertices()), so
 * that seams of the source do not show unless they are creases.
 *
 * A normal is the sum of the cross products of the edges at the corners it is averaged over, so
 * that larger faces count more, of length one; (0, 0, 1) where that sum is 0. With per_corner = 0,
 * all corners of a vertex share one, hard edges between them or not.
 *
 * Params   options may be NULL; allocator may be NULL: the asset's
 * Memory   4 bytes for each element and 8 to 20 for each corner; 40 more while it is made. Does not
 * refer to the asset. Errors   ANIC_E_ARGUMENT, ANIC_E_FRAME_RANGE, ANIC_E_SEGMENT, ANIC_E_MEMORY
 */
ANIC_API anic_status anic_create_normal_plan(const anic_asset* asset, uint32_t mesh,
                                             const anic_normal_options* options,
                                             const anic_allocator* allocator,
                                             anic_normal_plan** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_normal_plan(anic_normal_plan* normals);

/** Vertices, or corners: how many normals there are. */
ANIC_API uint32_t anic_get_normal_count(const anic_normal_plan* normals);

/**
 * Writes the normals first .. first + count - 1 of a mesh in a pose. ANIC_FORMAT_SNORM16X4 with no
 * offset and no scale suits them.
 *
 * Shapes   positions: vertex_count x 3 float32, `stride` bytes from a vertex to the next (0: 12),
 * as anic_write_positions() writes; multiples of four bytes Errors   ANIC_E_ARGUMENT,
 * ANIC_E_BUFFER_SIZE. Cost  O(corners averaged over).   Allocates nothing.
 */
ANIC_API anic_status anic_write_normals(const anic_normal_plan* normals, const float* positions,
                                        size_t stride, uint32_t first, uint32_t count,
                                        const anic_output* out);

/* -------------------------------------------------------------------------------------------
 * interpolation */

/**
 * Interpolates between meshes of one connectivity, without a file: lengths, angles and volume keep
 * where limbs turn far (multi-scale geometry interpolation; spec: 09d says how). Immutable, shared
 * by threads.
 */
typedef struct anic_morpher anic_morpher;

/** All zero, or a NULL pointer to it: everything by default. */
typedef struct anic_morpher_options {
  uint32_t leaf_faces; /**< faces of the smallest patches, 1 to 255; 0 means 8 */
  uint32_t
      sweeps; /**< rounds that adapt the patches' rotations to what they are pulled to: none for
                 plain interpolation; 1 or 2 may help far outside the meshes, 5 to 20 with pins */
  const uint32_t* pins; /**< vertices whose positions anic_morph() is given; each at most once */
  uint32_t pin_count;
  uint64_t bytes; /**< ANIC_E_LIMIT when more would be held; 0 means 2^32 */
} anic_morpher_options;

/**
 * Prepares the interpolation. Nothing that is given is kept.
 *
 * Any triangles will do: holes, several parts, duplicate and degenerate faces, edges of many faces.
 * Parts that share no vertex are interpolated apart; vertices of no triangle move on straight
 * lines.
 *
 * Shapes   triangles: triangle_count x 3; meshes: mesh_count (2 or more) pointers to vertex_count x
 * 3 Errors   ANIC_E_ARGUMENT; ANIC_E_INDEX_RANGE: a corner is no vertex; ANIC_E_NON_FINITE: a
 * coordinate; ANIC_E_LIMIT; ANIC_E_MEMORY; ANIC_E_FEATURE: a build without it Cost     O(vertices x
 * log vertices + vertices x meshes) and factoring a sparse matrix, O(vertices^1.5)
 */
ANIC_API anic_status anic_create_morpher(const uint32_t* triangles, uint32_t triangle_count,
                                         uint32_t vertex_count, const float* const* meshes,
                                         uint32_t mesh_count, const anic_morpher_options* options,
                                         const anic_allocator* allocator, anic_morpher** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_morpher(anic_morpher* morpher);

typedef struct anic_morpher_info {
  uint32_t vertex_count;
  uint32_t mesh_count;
  uint64_t resident_bytes;
  uint64_t scratch_bytes; /**< that anic_morph() works in */
  double largest_turn;    /**< radians between neighbouring patches, in any mesh against the first:
                             above a    right angle, smaller patches may do better */
} anic_morpher_info;

ANIC_API void anic_get_morpher_info(const anic_morpher* morpher, anic_morpher_info* out);

/**
 * Threads of the host. run() calls body(context, i) once for every i below count, in any order and
 * from any thread, and returns when all calls have.
 */
typedef struct anic_threads {
  void (*run)(void* host, size_t count, void (*body)(void* context, size_t i), void* context);
  void* host;
} anic_threads;

/**
 * Writes the mesh at some weights, which sum to one; outside [0, 1] they extrapolate. At the
 * weights of one mesh it is that mesh, to rounding.
 *
 * Shapes   weights: mesh_count; pin_positions: pin_count x 3, may be NULL without pins; out:
 * vertex_count x 3; scratch: scratch_bytes at a multiple of 8. threads may be NULL; the result does
 * not depend on them Errors   ANIC_E_ARGUMENT: weights that are not finite or do not sum to one
 * within 1e-5, pins missing; ANIC_E_BUFFER_SIZE: scratch too small Cost     O(vertices x (log
 * vertices + meshes of a weight other than 0)). Allocates nothing.
 */
ANIC_API anic_status anic_morph(const anic_morpher* morpher, const double* weights,
                                const float* pin_positions, const anic_threads* threads,
                                void* scratch, size_t scratch_size, float* out);

/* -----------------------------------------------------------------------------------------------------
 * GPU */

typedef enum anic_basis_kind {
  ANIC_BASIS_KEYFRAMES = 0,
  ANIC_BASIS_EIGENSHAPES = 1,
  ANIC_BASIS_EIGENTRAJECTORIES = 2
} anic_basis_kind;

/** In place of the number of an attribute: the positions. */
#define ANIC_POSITIONS UINT32_MAX

/** How positions come from a basis. */
typedef enum anic_reconstruction {
  ANIC_RECONSTRUCTION_LINEAR = 0, /**< a linear combination */
  ANIC_RECONSTRUCTION_MSGI =
      1 /**< multi-scale geometry interpolation between key-frames: anic_part.shape. Spec: 09d */
} anic_reconstruction;

/** Vertices are stored in blocks of this many: one number of all of them lies together. */
#define ANIC_BLOCK_VERTICES 16

/**
 * The basis of a segment, to be uploaded once. The arrays belong to the asset. With b = v / 16, i =
 * v % 16:
 *
 *   pose(v)[c]     = pose[(b * 3 + c) * 16 + i]
 *   basis(j, v)[c] = wide[((b * wide_components + j) * channels + c) * 16 + i]           j <
 * wide_components narrow[((b * (components - wide_components) + j - wide_components)
 *                            * channels + c) * 16 + i]                                    otherwise
 *
 * Vertices behind the last one fill the last block with zeros. Spec: 09a, sections 1 and 5.
 */
typedef struct anic_basis {
  anic_basis_kind kind;
  uint32_t mesh;
  uint32_t first_frame;
  uint32_t frame_count;
  uint32_t vertex_count;
  uint32_t components;
  uint32_t wide_components;
  uint32_t channels; /**< 3: a vector, one weight; 1: a number, a weight for each of x, y, z */
  uint32_t weight_channels; /**< weights of a component: 1 for vectors, 3 for numbers */
  const float* pose;        /**< NULL: none */
  const int32_t* wide;
  const int16_t* narrow;
  size_t pose_count; /**< elements of the arrays */
  size_t wide_count;
  size_t narrow_count;
  float origin[3]; /**< of kind 0: added to every vertex before the motion */
  anic_reconstruction reconstruction;
  const uint32_t* vertex_shape; /**< of ANIC_RECONSTRUCTION_MSGI: point of the shape that each
                                   vertex is; NULL: its own */
  uint32_t attribute; /**< ANIC_POSITIONS, or the attribute of the mesh that it moves: x of
                         anic_part is then to be added to anic_attribute.values, */
  uint32_t
      first_component; /**< three components of it, or as many as there are, from this one on */
} anic_basis;

/** Errors: ANIC_E_ARGUMENT: no such segment; ANIC_E_SEGMENT: it has not arrived yet. */
ANIC_API anic_status anic_get_basis(const anic_asset* asset, uint32_t segment, anic_basis* out);

/** Moves one vertex in one frame, after everything else. */
typedef struct anic_correction {
  uint32_t vertex;
  float delta[3];
} anic_correction;

/**
 * What a shader needs for one time beside the basis of a segment:
 *
 *   x = pose_map * (pose(v), 1) + sum over j of weights[j * weight_channels + c] * basis(j, v)[c]
 *       (channels 1: basis(j, v) times each of the three weights)
 *   x = motion * (x + origin, 1)            then the corrections, which are few: ascending by
 * vertex
 *
 * With ANIC_RECONSTRUCTION_MSGI, the first line and the origin are replaced: x =
 * shape(vertex_shape(v)), three floats for each point, which the seek has made.
 *
 * Matrices are 3 x 4, row-major. Pointers are good until the next but one seek of the context.
 */
typedef struct anic_part {
  uint32_t segment;
  float share; /**< the position is the sum of share * x over the parts */
  const float* weights;
  const float* shape; /**< NULL with ANIC_RECONSTRUCTION_LINEAR */
  float pose_map[12];
  float motion[12];
  const anic_correction* corrections;
  uint32_t correction_count;
} anic_part;

/** A time has at most this many parts; one, unless it lies between two segments. */
#define ANIC_MAX_PARTS 4

/** What is chosen, for the GPU. *count receives the number of parts. Errors as
 * anic_write_positions(). O(1). */
ANIC_API anic_status anic_get_parts(const anic_context* context, uint32_t mesh, anic_when when,
                                    anic_part out[ANIC_MAX_PARTS], uint32_t* count);

/**
 * The same for an attribute: the value of components first_component .. first_component + 2 (a
 * multiple of 3) is that of frame 0 (anic_attribute.values) and the sum of share * x over the
 * parts. No parts: it is as in frame 0. Errors: as anic_write_attribute().
 */
ANIC_API anic_status anic_get_attribute_parts(const anic_context* context, uint32_t mesh,
                                              uint32_t attribute, uint32_t first_component,
                                              anic_when when, anic_part out[ANIC_MAX_PARTS],
                                              uint32_t* count);

/* -------------------------------------------------------------------------------------------------
 * streams */

/** A file that arrives from the front, piece by piece. Spec: 05, section 7. */
typedef struct anic_stream anic_stream;

/** options: as for anic_open_asset(), kept for the assets that are made. */
ANIC_API anic_status anic_create_stream(const anic_options* options, anic_stream** out);

/** NULL is allowed. Assets made from the stream live on. */
ANIC_API void anic_destroy_stream(anic_stream* stream);

typedef struct anic_stream_info {
  uint64_t received_bytes;
  uint64_t file_bytes;        /**< 0 while the header is not there */
  uint32_t segment_count;     /**< 0 while the head is not there */
  uint32_t playable_segments; /**< those that can be opened, coarsely at least */
  uint32_t layers;            /**< of all segments: chunks with components of their bases */
  uint32_t arrived_layers;
  uint8_t playable; /**< anic_open_asset_from_stream() gives an asset that plays at least one
                       segment of positions */
  uint8_t complete;
} anic_stream_info;

/**
 * Takes the next bytes of the file. Checks what can be checked as soon as it is there: a stream
 * that cannot become a good file, or that breaks the limits, fails at once and stays failed.
 *
 * Errors   those of anic_open_asset() that concern header, table, limits and checksums;
 *          ANIC_E_TRAILING_BYTES: more than the file has
 * Memory   file_bytes, once its head is there. Cost O(size), checksums included.
 */
ANIC_API anic_status anic_push_bytes(anic_stream* stream, const void* bytes, size_t size);

ANIC_API void anic_get_stream_info(const anic_stream* stream, anic_stream_info* out);

/** What went wrong, as for anic_open_asset(). */
ANIC_API void anic_get_stream_failure(const anic_stream* stream, anic_failure* out);

/**
 * Opens what has arrived: segments of which everything needed for their first layer is there, with
 * all layers that follow without a gap. info.partial tells whether anything is missing. An asset of
 * a complete stream is the same, bit for bit, as one of the whole file. Assets that were made
 * before stay as they are: replace them when their contexts can be replaced.
 *
 * Errors   ANIC_E_STATE: nothing playable yet; others as anic_open_asset()
 * Cost     that of opening what is there, from the beginning: do it when it is worth it, not at
 * every push
 */
ANIC_API anic_status anic_open_asset_from_stream(anic_stream* stream, anic_asset** out,
                                                 anic_failure* failure);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_ANICODEC_H_ */
