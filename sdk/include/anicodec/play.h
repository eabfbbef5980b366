/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * anicodec plays compressed animated meshes (.anic files). A host that opens files, seeks and writes
 * frames needs this header alone. surface.h has points of the surface, normals, vertices for rendering
 * and morphing, gpu.h what a graphics card needs to play, stream.h files that arrive in pieces;
 * anicodec.h has them all. They are C99 and C++11.
 *
 *   anic_asset* asset;
 *   anic_context* context;
 *   anic_output output = ANIC_INIT(anic_output);
 *   anic_open_asset(bytes, size, NULL, &asset, NULL);       an opened file: immutable, shared
 *   anic_create_context(asset, NULL, &context);             an instance of it: small
 *   anic_seek_time(context, seconds, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP);      0 is the first frame
 *   output.data = points;
 *   output.size = sizeof points;
 *   anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, vertex_count, &output);
 *
 * Names
 * - Functions begin with a verb, types are nouns. anic_get_...() looks something up and is cheap;
 *   anic_write_...() computes and fills a buffer of the host.
 * - The constants of an enumeration share a prefix. Enumerations are 32-bit integers: a number that
 *   is not in the list is refused with ANIC_E_ARGUMENT.
 *
 * Structs and versions
 * - A struct that begins with struct_size may get more fields at its end in later versions. The
 *   host sets struct_size to the size that its header gives: ANIC_INIT(type) does, and sets
 *   everything else to 0. The library touches no byte behind struct_size.
 * - A host with an older header has smaller structs: the library leaves out the fields that the
 *   host does not know, and takes those that the host does not give as 0.
 * - A host with a newer header has larger structs: the library sets the fields that it does not
 *   know to 0, and refuses those that the host gives, unless they are 0, with ANIC_E_ARGUMENT.
 * - ANIC_E_ARGUMENT also answers a struct_size below sizeof(size_t) or above 4096: it was not set.
 * - All other structs are fixed for good.
 *
 * Conventions
 * - Status: every function that can fail returns an anic_status. After a failure the content of
 *   what it was to fill is unspecified, handles are NULL, and every object stays usable.
 * - Files: any bytes may be given as a file. A damaged or hostile file is refused with a status.
 * - Threads: the library starts none and has no global state. Any number of threads may use an
 *   asset. Functions that take a const anic_context may run at the same time; a function that takes
 *   a context that is not const needs it to itself. Different contexts are independent.
 * - Memory: all of it comes from the allocator in anic_options. Functions that take a context,
 *   apart from creating and destroying it, allocate nothing.
 * - Floats: functions compute in the caller's floating-point environment, except while opening.
 * - Space: positions are in the axes and the unit of the clip's source; anic_asset_info tells what
 *   is known of them. Axes are right-handed, and a polygon shows its front to a viewer who sees its
 *   corners run counter-clockwise. A host with the y axis up takes (x, z, -y) of a clip with the z
 *   axis up; a host with z up takes (x, -z, y) of a clip with y up. A left-handed host negates one
 *   axis and either swaps two corners of each triangle or culls the other side. Multiplying by
 *   metres_per_unit gives metres.
 * - Frames: numbered through the file, over all its clips. Time: seconds, and 0 is the first frame of
 *   a clip.
 * - "Spec" names a section in the folder spec/ of the project.
 */
#ifndef ANICODEC_PLAY_H_
#define ANICODEC_PLAY_H_

#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
#include <string.h>
#endif

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

/* Enumerations are int32_t in C; in C++ they are types of 32 bits that take any number. */
#ifdef __cplusplus
#define ANIC_INT32 : int32_t
#else
#define ANIC_INT32
typedef int32_t anic_status, anic_up_axis, anic_order, anic_attribute_kind, anic_alpha, anic_domain,
    anic_sampling, anic_wrap, anic_when, anic_format, anic_value_format;
#endif

/* ANIC_INIT(type): a struct with its struct_size, and 0 in every other field. */
#ifdef __cplusplus
template <class Struct>
inline Struct anic_init() {
  Struct result;
  memset(&result, 0, sizeof result);
  result.struct_size = sizeof(Struct);
  return result;
}

#define ANIC_INIT(type) anic_init<type>()
#else
#define ANIC_INIT(type) ((type){.struct_size = sizeof(type)})
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version --------------------------------------------------------------------------------- */

#define ANIC_VERSION_MAJOR 1
#define ANIC_VERSION_MINOR 0
#define ANIC_VERSION_PATCH 0

/** Version of the library that is linked: major << 16 | minor << 8 | patch. */
ANIC_API uint32_t anic_get_version(void);

/* ---- status ---------------------------------------------------------------------------------- */

/** A number keeps its meaning for good. Spec: 12. */
enum anic_status ANIC_INT32 {
  ANIC_OK = 0,

  /* the caller's */
  ANIC_E_ARGUMENT = 1,    /**< an argument makes no sense */
  ANIC_E_STATE = 2,       /**< the call is not possible now */
  ANIC_E_BUFFER_SIZE = 3, /**< a buffer of the caller is too small */
  ANIC_E_FRAME_RANGE = 4, /**< there is no such frame */
  ANIC_E_ABSENT = 5,      /**< the mesh is not there at this time */

  /* not this format, version or feature */
  ANIC_E_MAGIC = 10,
  ANIC_E_VERSION = 11,
  ANIC_E_FEATURE = 12,

  /* container */
  ANIC_E_TRUNCATED = 20,
  ANIC_E_HEADER = 21,
  ANIC_E_HEADER_CHECKSUM = 22,
  ANIC_E_CHUNK_BOUNDS = 23,
  ANIC_E_CHUNK_CHECKSUM = 24,
  ANIC_E_CHUNK_DUPLICATE = 25,
  ANIC_E_CHUNK_MISSING = 26,
  ANIC_E_CHUNK_UNKNOWN = 27,
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
  ANIC_E_SEGMENT = 48, /**< a segment contradicts its counts or its mesh */
  ANIC_E_HASH = 49,
  ANIC_E_MESHES = 50, /**< a continuation of a live stream follows a file with other meshes */
  /** A file of a live stream continues one that was lost, or not opened in full. */
  ANIC_E_SEGMENT_MISSING = 51,

  ANIC_E_LIMIT = 60, /**< more than anic_options allow */

  /* the host's callbacks */
  ANIC_E_MEMORY = 70,    /**< the allocator had no memory */
  ANIC_E_READ = 71,      /**< the read callback failed */
  ANIC_E_CANCELLED = 72, /**< the progress callback stopped the call */

  ANIC_E_INTERNAL = 90 /**< a defect of the library */
};

/** English text of a status without a full stop. Static; never NULL, for any number. */
ANIC_API const char* anic_get_status_text(anic_status status);

/** Tells what was wrong with a file, and where. */
typedef struct anic_failure {
  size_t struct_size;
  anic_status status;
  char chunk[8];      /**< type of the chunk: four characters and a 0; empty outside any chunk */
  uint64_t offset;    /**< byte offset in the file, as exact as is known */
  const char* detail; /**< static English text; may be empty, never NULL */
} anic_failure;

/* ---- the host's memory and threads ----------------------------------------------------------- */

/**
 * The source of memory. All zero: malloc() and free().
 *
 * allocate() returns `size` bytes (never 0) at a multiple of `alignment` (a power of two, at most
 * 16), or NULL. After NULL the call that needed the memory gives back what it had and fails with
 * ANIC_E_MEMORY. release() gets what allocate() returned and the size that was asked for. Functions
 * that open, create, push, destroy or close call both, on the thread that called them; no other
 * function does. Both must return.
 */
typedef struct anic_allocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* memory, size_t size);
} anic_allocator;

/**
 * Makes an allocator that serves from one block of the host and from nowhere else.
 *
 * The block belongs to the allocator until everything made with it is destroyed; then the host may
 * simply drop the block. The search is best fit, neighbours are joined when they are released, and
 * sizes are rounded up to 16 bytes. An allocation costs O(free pieces). One thread at a time.
 *
 * - Errors: ANIC_E_ARGUMENT: a pointer is NULL; ANIC_E_BUFFER_SIZE: less than 256 bytes
 */
ANIC_API anic_status anic_init_block_allocator(void* block, size_t size, anic_allocator* out);

/**
 * Threads of the host. All zero: the calling thread alone.
 *
 * run() calls body(context, i) once for every i below count, in any order and from any thread, and
 * returns when all calls have returned. No result depends on the number of threads.
 */
typedef struct anic_threads {
  void* user;
  void (*run)(void* user, size_t count, void (*body)(void* context, size_t i), void* context);
} anic_threads;

/**
 * Follows and stops an opening. All zero: nobody does.
 *
 * report() gets the share of the work that is done, from 0 to 1 and never less than before, on the
 * thread that opens. The calls come at least after every mesh, segment and component that was
 * decoded. Anything but 0 from report() stops the opening, which gives everything back and fails
 * with ANIC_E_CANCELLED.
 */
typedef struct anic_progress {
  void* user;
  int (*report)(void* user, double done);
} anic_progress;

/* ---- opening --------------------------------------------------------------------------------- */

enum {
  /** Computes the box of every frame while opening, for anic_get_frame_bounds() and
   * anic_get_clip_bounds(). This costs what playing all frames once does, and 24 bytes for each
   * frame and mesh. */
  ANIC_OPEN_BOUNDS = 1,
  /** Leaves the order of the source's vertices and polygons alone: they come as in a file of
   * ANIC_ORDER_FREE. Opening is faster by what decoding the order takes, a microsecond or more for
   * each vertex; for hosts that take faces and attributes from the asset too. */
  ANIC_OPEN_ANY_ORDER = 2,
  /** Leaves the motion of the whole out of positions, parts and boxes, in clips that have it apart,
   * for hosts that move the character themselves: anic_get_root_motion(). Nothing changes in
   * others. Spec: 06, section 11. */
  ANIC_OPEN_IN_PLACE = 4,
  /** Leaves the positions of a lossless file closed and plays all frames from its basis, at the
   * memory and the time of opening of other files; anic_clip then states errors of 0 that do not
   * hold. Nothing changes in other files. A quality below 1 does the same. Spec: 09d. */
  ANIC_OPEN_INEXACT = 8
};

/**
 * How to open a file. A NULL pointer, or 0 in every field: everything by default.
 *
 * A file that asks for more than a limit is refused with ANIC_E_LIMIT, before anything that depends
 * on a count is allocated. A limit of 0 stands for the default in brackets.
 */
typedef struct anic_options {
  size_t struct_size;
  uint64_t max_vertices;   /**< most of one mesh [2^31 - 1] */
  uint64_t max_frames;     /**< [2^24 - 1] */
  uint64_t max_components; /**< most of one segment [2^20] */
  uint64_t max_bytes; /**< opening_bytes of anic_requirements [2^28, and 2^14 for each byte of the
                         file] */
  anic_allocator allocator; /**< copied; `user` must outlive what is made with it */
  anic_threads threads;     /**< coefficients are predicted, and the boxes of ANIC_OPEN_BOUNDS
                               computed, on them; everything else runs on the thread that opens */
  anic_progress progress;
  double quality; /**< share of the components to open, in (0, 1]; 0 means 1. Fewer components are
                     coarser, smaller, and faster to open and to play. Spec: 09a, section 4 */
  uint64_t flags; /**< ANIC_OPEN_... */
  const char* const* clips; /**< names of the clips to open, clip_count of them; read while the call
                               lasts, and by a stream until it is destroyed */
  uint32_t clip_count;      /**< 0: all clips. Frames of others are ANIC_E_ABSENT, and take memory
                               only while a segment opens that clips share */
} anic_options;

/** Memory that opening a file takes, known from its first bytes. Spec: 11, section 3. */
typedef struct anic_requirements {
  size_t struct_size;
  uint64_t head_bytes; /**< first bytes of the file that anic_get_requirements() has to see */
  uint64_t file_bytes; /**< the whole file; 0 while its header is not seen */
  uint64_t
      resident_bytes; /**< held while the asset is open; within 5 % or 4096 bytes, but for geometry
                              interpolation: a bound of up to three times it */
  uint64_t opening_bytes; /**< held at most while the file opens, resident bytes included, the
                              bytes of the file excluded */
  uint64_t draco_bytes;   /**< part of opening_bytes that Draco may take from the global heap */
  uint64_t block_bytes; /**< a block for anic_init_block_allocator() in which the asset can open */
  uint64_t context_bytes; /**< bytes of one context, at most */
  uint32_t mesh_count;
  uint32_t segment_count;
  uint32_t frame_count;
  uint32_t max_vertices;   /**< vertices of the largest mesh */
  uint32_t max_components; /**< components of the largest segment, as the file has it */
} anic_requirements;

/**
 * Tells what a file will take.
 *
 * `head` holds the first `size` bytes of the file: header, chunk table and first chunk, which are a
 * few hundred bytes in most files. If they do not suffice, head_bytes says how many will, or how
 * many will tell. It tells what all clips take, whichever the options name.
 *
 * - Errors: ANIC_E_TRUNCATED: head_bytes are needed; others: anic_open_asset() refuses the file too
 * - Memory: 32 bytes for each chunk, mesh and segment for a moment, from options->allocator
 * - Cost: O(chunks + meshes + segments)
 * - Spec: 05, section 7
 */
ANIC_API anic_status anic_get_requirements(const void* head, size_t size,
                                           const anic_options* options, anic_requirements* out);

/**
 * Finds the metadata of a file: a JSON object in UTF-8, not ended by a NUL. `file` holds the first `size` bytes of
 * the file; *text points into them.
 *
 * - Errors: ANIC_E_ABSENT: the file has none; ANIC_E_TRUNCATED: it has not arrived; ANIC_E_RECORD: it is longer than
 *   2^20 bytes, nested deeper than 32, or no UTF-8; others: the file is none
 * - Memory: 32 bytes for each chunk for a moment
 * - Cost: O(chunks + bytes of the metadata)
 * - Spec: 06, section 14
 */
ANIC_API anic_status anic_read_metadata(const void* file, size_t size, const char** text,
                                        size_t* text_bytes);

/** An axis-aligned box. */
typedef struct anic_box {
  float min[3], max[3];
} anic_box;

/**
 * Reads a box around frames of a mesh from a file that is not opened, to cull it before it is decoded. `file` holds
 * the first `size` bytes of the file. The box contains all positions of these frames, the motion of the whole
 * included, up to rounding, and is larger than they are: it is kept for 64 frames as a rule. Between frames see
 * anic_get_clip_bounds().
 *
 * - Params: frame_count 0: all frames from first_frame on
 * - Errors: ANIC_E_ABSENT: the mesh is in none of these frames, or the file has no boxes of them; ANIC_E_TRUNCATED:
 *   the boxes have not arrived; ANIC_E_FRAME_RANGE; ANIC_E_ARGUMENT: there is no such mesh; others: the file is none
 * - Memory: 32 bytes for each chunk, mesh and segment for a moment
 * - Cost: O(chunks + segments + frames / 64)
 * - Spec: 06, section 13
 */
ANIC_API anic_status anic_read_bounds(const void* file, size_t size, uint32_t mesh,
                                      uint32_t first_frame, uint32_t frame_count, anic_box* out);

/** An opened file. Immutable, so threads and contexts may share it. Destroy the contexts first. */
typedef struct anic_asset anic_asset;

/**
 * Opens a whole file in memory. The bytes are not needed afterwards.
 *
 * - Params: options and failure may be NULL. `failure` is written in any case
 * - Errors: any that concern the file (spec/12); ANIC_E_LIMIT, ANIC_E_MEMORY, ANIC_E_CANCELLED,
 *   ANIC_E_ARGUMENT
 * - Memory: less than opening_bytes of anic_requirements at any time
 * - Cost: decodes all coefficients once: microseconds per vertex (spec/10)
 */
ANIC_API anic_status anic_open_asset(const void* file, size_t size, const anic_options* options,
                                     anic_asset** out, anic_failure* failure);

/**
 * Reads a file. read() copies the `size` bytes at `offset` to `to` and returns 0. It returns
 * anything else when it cannot, or when opening is to stop: opening then fails with ANIC_E_READ.
 */
typedef struct anic_reader {
  void* user;
  int (*read)(void* user, uint64_t offset, void* to, size_t size);
} anic_reader;

/**
 * Opens a file of file_size bytes through a callback: reads its head, checks the limits, then reads
 * the rest.
 *
 * - Errors: as anic_open_asset(), and ANIC_E_READ
 * - Memory: file_size more than anic_open_asset() while it opens
 */
ANIC_API anic_status anic_open_asset_from_reader(const anic_reader* reader, uint64_t file_size,
                                                 const anic_options* options, anic_asset** out,
                                                 anic_failure* failure);

/**
 * Makes another asset of an opened file, which shares its resident memory: for parts of a program
 * that open and close the same file each for itself, with clips or a quality of their own. Either may
 * be closed first; the file's memory goes, to the allocator that the file was opened with, when the
 * last of them is closed.
 *
 * - Params: options: allocator is for the memory of the asset itself (default: the file's); clips
 *   names clips that are open in `asset`; quality is, as in opening, a share of the file's
 *   components, at most as many as `asset` plays, and 0 as many; flags must equal the flags that the
 *   file was opened with; the rest means nothing. NULL: all as in `asset`
 * - Result: resident_bytes of its anic_asset_info are those that it takes itself, a few hundred;
 *   boxes, anic_get_basis() and textures are the file's, the same addresses for all
 * - Errors: ANIC_E_ABSENT: a clip is not in the file, or not open in `asset`; ANIC_E_MEMORY;
 *   ANIC_E_ARGUMENT
 * - Cost: O(clips); nothing is decoded
 * - Threads: any, while `asset` is open. Assets of one file may be used and closed on different
 *   threads at once; the file's allocator must work on the thread that closes the last one
 */
ANIC_API anic_status anic_share_asset(const anic_asset* asset, const anic_options* options,
                                      anic_asset** out);

/** Gives everything back that no other asset of the file needs. NULL is allowed. */
ANIC_API void anic_close_asset(anic_asset* asset);

/**
 * Compares the hashes in the file with what was decoded.
 *
 * - Errors: ANIC_E_HASH: this library decodes other integers than the encoder meant; ANIC_E_STATE:
 *   the asset is not complete or was opened at lower quality; ANIC_E_ARGUMENT
 */
ANIC_API anic_status anic_verify_asset(const anic_asset* asset);

/* ---- what is in an asset --------------------------------------------------------------------- */

/** The axis that points up. */
enum anic_up_axis ANIC_INT32 { ANIC_UP_UNKNOWN = 0, ANIC_UP_Y = 1, ANIC_UP_Z = 2 };

/** How much of the source's order the file keeps. It has every source vertex in any case. Spec: 06,
 * section 5. */
enum anic_order ANIC_INT32 {
  ANIC_ORDER_VERTICES = 0, /**< vertices are numbered as in the source */
  ANIC_ORDER_FREE = 1,     /**< the encoder chose the order of vertices and polygons */
  ANIC_ORDER_ALL = 2       /**< vertices, polygons and their first corners as in the source */
};

/** Name, clock and promise are those of clip 0: anic_get_clip() has those of each clip. Spec: 04
 * (time, coordinates, promise), 06 section 3. Strings belong to the asset. */
typedef struct anic_asset_info {
  size_t struct_size;
  const char* name;
  const char* encoder;
  uint32_t mesh_count;
  uint32_t segment_count;
  uint32_t frame_count;    /**< frames of all clips */
  uint32_t rate_numerator; /**< frames per second = numerator / denominator; a hint if `uneven` */
  uint32_t rate_denominator;
  anic_up_axis up;
  anic_order order;
  uint8_t rate_assumed;   /**< the source told no rate */
  uint8_t uneven;         /**< frames have a table of times: anic_get_frame_time() */
  uint8_t loop;           /**< meant to be played with ANIC_WRAP_LOOP */
  uint8_t closed;         /**< the last frame repeats the first */
  uint8_t massaged;       /**< the mesh was changed before coding: see surface_error */
  uint8_t partial;        /**< made from a stream that was not complete: parts are missing or
                             coarser */
  double start_time;      /**< time of frame 0 on the source's clock, seconds: for tools alone.
                             Times in this interface count from frame 0 */
  double duration;        /**< from frame 0 to the last frame, seconds */
  double loop_duration;   /**< one turn of ANIC_WRAP_LOOP, seconds */
  double metres_per_unit; /**< 0: unknown */
  double diagonal;        /**< diagonal of the box around all frames of the source */
  double max_error;       /**< largest distance of a vertex from its place in the source, at full
                             quality, as the encoder measured it; in units of the clip */
  double rmse;            /**< root of the mean squared error, in units of the clip */
  double kg;              /**< KG error, per cent */
  double surface_error;   /**< largest distance from the source's surface, in units of the clip */
  double surface_error_mean;     /**< mean distance from it */
  uint64_t resident_bytes;       /**< held by this asset */
  uint64_t context_bytes;        /**< held by each context */
  double max_displacement_error; /**< largest error of a vertex's move from frame to frame */
  double origin
      [3]; /**< origin of the positions of this interface, as the source has it: added in double, it
                       gives the source's coordinates, which may be too far from zero for float32 */
} anic_asset_info;

/** - Errors: ANIC_E_ARGUMENT */
ANIC_API anic_status anic_get_asset_info(const anic_asset* asset, anic_asset_info* out);

/** A clip: frames first_frame .. first_frame + frame_count - 1 of the file, with a clock and a promise of
 * their own. The string belongs to the asset. Spec: 04, 06 section 3. */
typedef struct anic_clip {
  size_t struct_size;
  const char* name;
  uint32_t first_frame;
  uint32_t frame_count;
  uint32_t rate_numerator; /**< as in anic_asset_info, and so are those that follow */
  uint32_t rate_denominator;
  uint8_t rate_assumed;
  uint8_t uneven;
  uint8_t loop;
  uint8_t closed;
  uint8_t massaged;
  uint8_t open; /**< the host asked for it: see anic_options.clips */
  double start_time;
  double duration;
  double loop_duration;
  double diagonal; /**< diagonal of the box around its frames of the source */
  double max_error;
  double rmse;
  double kg;
  double surface_error;
  double surface_error_mean;
  double max_displacement_error;
} anic_clip;

/** How many clips the file has; 0 for NULL. */
ANIC_API uint32_t anic_get_clip_count(const anic_asset* asset);

/** - Errors: ANIC_E_ARGUMENT: there is no such clip, too */
ANIC_API anic_status anic_get_clip(const anic_asset* asset, uint32_t clip, anic_clip* out);

/**
 * Finds a clip by its name.
 *
 * - Errors: ANIC_E_ABSENT: no clip has this name; ANIC_E_ARGUMENT
 * - Cost: O(clips)
 */
ANIC_API anic_status anic_find_clip(const anic_asset* asset, const char* name, uint32_t* out);

/** A named time of a clip. The string belongs to the asset. */
typedef struct anic_event {
  size_t struct_size;
  const char* name;
  double seconds; /**< from the clip's first frame on, 0 or more */
} anic_event;

/** How many events a clip has; 0 for NULL and for clips that are not there. */
ANIC_API uint32_t anic_get_event_count(const anic_asset* asset, uint32_t clip);

/**
 * An event of a clip, open or not; they ascend by time.
 *
 * - Errors: ANIC_E_ARGUMENT: there is no such clip or event, too
 */
ANIC_API anic_status anic_get_event(const anic_asset* asset, uint32_t clip, uint32_t event,
                                    anic_event* out);

/** A mesh. The string belongs to the asset. */
typedef struct anic_mesh {
  size_t struct_size;
  const char* name;
  uint32_t vertex_count;       /**< vertices of the source, each once */
  uint32_t coded_vertex_count; /**< distinct vertices: the others are copies that move along */
  uint32_t polygon_count;
  uint32_t corner_count;    /**< corners of all polygons */
  uint32_t triangle_count;  /**< after anic_write_indices() has cut the polygons */
  uint32_t attribute_count; /**< anic_get_attribute() */
} anic_mesh;

/** - Errors: ANIC_E_ARGUMENT: there is no such mesh */
ANIC_API anic_status anic_get_mesh(const anic_asset* asset, uint32_t mesh, anic_mesh* out);

/** Polygons as in the source. The arrays belong to the asset. */
typedef struct anic_polygons {
  size_t struct_size;
  const uint32_t* offsets; /**< polygon p has the corners offsets[p] .. offsets[p + 1] - 1 */
  const uint32_t* corners; /**< vertex of each corner */
  uint32_t polygon_count;
} anic_polygons;

/** - Errors: ANIC_E_ARGUMENT: there is no such mesh */
ANIC_API anic_status anic_get_polygons(const anic_asset* asset, uint32_t mesh, anic_polygons* out);

/**
 * Writes an index buffer: every polygon in order, as a fan from its first corner or, where it is
 * concave in the first frame that shows the mesh, as triangles that cover it once. Polygons with
 * fewer than three corners give no triangle. Triangles run as the polygons do: counter-clockwise
 * seen from the front.
 *
 * - Shapes: out: triangle_count x 3 indices of index_bytes (2 or 4) each; size: bytes at out
 * - Memory: for a moment 12 bytes for each vertex of a mesh that has more than triangles
 * - Errors: ANIC_E_ARGUMENT: no such mesh, or more than 65536 vertices for 2 bytes;
 *   ANIC_E_BUFFER_SIZE; ANIC_E_MEMORY
 * - Cost: O(corners), and a frame of the mesh
 */
ANIC_API anic_status anic_write_indices(const anic_asset* asset, uint32_t mesh,
                                        uint32_t index_bytes, void* out, size_t size);

/**
 * Tells which coded vertex each vertex is a copy of: vertices with the same number have the same
 * position in every frame. *out receives vertex_count numbers below coded_vertex_count, which
 * belong to the asset. Spec: 07.
 *
 * - Errors: ANIC_E_ARGUMENT: there is no such mesh
 */
ANIC_API anic_status anic_get_coded_vertices(const anic_asset* asset, uint32_t mesh,
                                             const uint32_t** out);

/** The meaning of an attribute. Numbers are fixed. Spec: 06, section 10. */
enum anic_attribute_kind ANIC_INT32 {
  ANIC_ATTRIBUTE_UV = 0,     /**< v upwards: (0, 0) is the lower left corner of an image; some
                                  graphics interfaces want 1 - v */
  ANIC_ATTRIBUTE_NORMAL = 1, /**< first frame's normals. Without components: labels that say which
                                corners share a normal, that is, which edges are hard */
  ANIC_ATTRIBUTE_TANGENT = 2,
  ANIC_ATTRIBUTE_COLOUR = 3, /**< RGB or RGBA, 0 to 1 */
  ANIC_ATTRIBUTE_CUSTOM = 4,
  ANIC_ATTRIBUTE_MATERIAL = 5, /**< names of the polygons' materials */
  ANIC_ATTRIBUTE_PART = 6      /**< names of the source's meshes or objects, for polygons */
};

/** The elements that have a value each, as anic_get_polygons() numbers them. */
enum anic_domain ANIC_INT32 {
  ANIC_DOMAIN_VERTICES = 0,
  ANIC_DOMAIN_CORNERS = 1,
  ANIC_DOMAIN_POLYGONS = 2
};

/** An attribute, as in frame 0. Strings and arrays belong to the asset. */
typedef struct anic_attribute {
  size_t struct_size;
  const char* name; /**< as in the source, may be empty */
  anic_attribute_kind kind;
  anic_domain domain;
  uint32_t count;         /**< elements: vertices, corners or polygons */
  uint32_t components;    /**< numbers of an element; 0: it has `labels` */
  const float* values;    /**< count x components; NULL without components */
  const uint32_t* labels; /**< count; NULL with components. A polygon has 0 for none, or one more
                             than the number of a name. Corners at a vertex with the same label
                             share a value */
  uint32_t label_count;   /**< names of labels: anic_get_label_name() */
  uint8_t moves; /**< other frames have other values, for which there is anic_write_attribute() */
} anic_attribute;

/**
 * - Errors: ANIC_E_ARGUMENT: there is no such mesh or attribute
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_attribute(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                        anic_attribute* out);

/** Name of a label, 0 .. label_count - 1; NULL if there is none. It belongs to the asset. */
ANIC_API const char* anic_get_label_name(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                         uint32_t label);

/** How a surface lets light through. */
enum anic_alpha ANIC_INT32 {
  ANIC_ALPHA_OPAQUE = 0,
  ANIC_ALPHA_MASK = 1, /**< all where the base colour's alpha is below alpha_cutoff, else nothing */
  ANIC_ALPHA_BLEND = 2
};

/**
 * The look of a material, in the terms of glTF 2.0 (metallic and roughness). Textures are paths or
 * names as in the source, never NULL, empty if there is none: images are not in the file. Strings
 * belong to the asset. Spec: 06, section 10.
 */
typedef struct anic_material {
  size_t struct_size;
  const char* name;
  float base_colour[4]; /**< linear RGBA; a texture's colour is multiplied by it */
  float metallic;       /**< 0 to 1 */
  float roughness;      /**< 0 to 1 */
  float emissive[3];    /**< linear RGB, 0 and more */
  anic_alpha alpha;
  float alpha_cutoff;
  uint8_t double_sided;
  const char* base_colour_texture;
  const char* metallic_roughness_texture; /**< roughness in green, metallic in blue */
  const char* normal_texture;
  const char* occlusion_texture;
  const char* emissive_texture;
} anic_material;

/**
 * The look of the material that a label names.
 *
 * - Errors: ANIC_E_ARGUMENT: there is no such label of an attribute ANIC_ATTRIBUTE_MATERIAL;
 *   ANIC_E_ABSENT: the file has its name and nothing else
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_material(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                       uint32_t label, anic_material* out);

/** Time of a frame in seconds, from the first frame of its clip on. Frames behind the last count as
 * the last. Spec: 04, section 2. */
ANIC_API double anic_get_frame_time(const anic_asset* asset, uint32_t frame);

/* ---- sampling -------------------------------------------------------------------------------- */

/** An instance of an asset: it knows what is shown now, and what was shown before. */
typedef struct anic_context anic_context;

/**
 * Makes a context; allocates context_bytes at once and nothing afterwards. Many contexts may share
 * an asset.
 *
 * - Params: allocator may be NULL: the asset's
 * - Errors: ANIC_E_MEMORY, ANIC_E_ARGUMENT
 */
ANIC_API anic_status anic_create_context(const anic_asset* asset, const anic_allocator* allocator,
                                         anic_context** out);

/** NULL is allowed. */
ANIC_API void anic_destroy_context(anic_context* context);

/** The picture between two frames. Spec: 10, section 2. */
enum anic_sampling ANIC_INT32 {
  ANIC_SAMPLE_STEP = 0,   /**< the frame before */
  ANIC_SAMPLE_LINEAR = 1, /**< a straight line from the frame before to the frame after */
  ANIC_SAMPLE_CUBIC = 2 /**< a smooth curve through four frames (Catmull-Rom; knows uneven times) */
};

/** The picture before the first frame and after the last one. */
enum anic_wrap ANIC_INT32 {
  ANIC_WRAP_CLAMP = 0,    /**< the first and the last frame stay */
  ANIC_WRAP_LOOP = 1,     /**< frame 0 follows the last frame; if info.closed, they are one */
  ANIC_WRAP_PING_PONG = 2 /**< backwards after the last frame, forwards after the first */
};

/**
 * Chooses the clip whose times anic_seek_time() means; that of a new context is the first one that is
 * open. Shows nothing new by itself.
 *
 * - Errors: ANIC_E_ARGUMENT; ANIC_E_ABSENT: the clip was not opened
 * - Cost: O(1), and nothing is allocated
 */
ANIC_API anic_status anic_set_clip(anic_context* context, uint32_t clip);

/**
 * Chooses the share of the asset's components that a context plays, in (0, 1], from the next seek or
 * blend on: coarser, and as much faster, for instances that are small on the screen. Whichever it is,
 * the asset stays as it is; the picture is that of an asset opened at this anic_options.quality.
 * Key-frames are played all.
 *
 * - Errors: ANIC_E_ARGUMENT: not in (0, 1]
 * - Cost: O(1), and nothing is allocated
 */
ANIC_API anic_status anic_set_quality(anic_context* context, double quality);

/**
 * Chooses a frame of the file, whatever the clip. The frame or time chosen before becomes
 * ANIC_WHEN_PREVIOUS.
 *
 * - Errors: ANIC_E_FRAME_RANGE, ANIC_E_ARGUMENT
 * - Cost: O(log segments), the same for every frame. In segments of ANIC_RECONSTRUCTION_MSGI the
 *   shape is made here: O(vertices x log vertices). Spec: 10
 */
ANIC_API anic_status anic_seek_frame(anic_context* context, uint32_t frame);

/**
 * Chooses a time of the context's clip in seconds; 0 is its first frame. The frame or time chosen
 * before becomes ANIC_WHEN_PREVIOUS. To play at another speed or backwards, ask for other times.
 *
 * Weights and maps are interpolated, not positions: a time between frames costs what a whole frame
 * does, and rigid motions turn the shorter way. Frames in different segments are each made and
 * their positions interpolated, at twice the cost. Corrections of single vertices are applied at
 * whole frames only; a time within 1/1024 of the way from one frame to the next is a whole frame.
 *
 * - Errors: ANIC_E_ARGUMENT: a time that is not finite, an enumerator that does not exist
 * - Cost: O(components + log segments); with a table of times O(log frames) more. In segments of
 *   ANIC_RECONSTRUCTION_MSGI the shape is made here: O(vertices x log vertices)
 */
ANIC_API anic_status anic_seek_time(anic_context* context, double seconds, anic_sampling sampling,
                                    anic_wrap wrap);

/**
 * Cross-fades what is shown with a moment of a clip, open and the same or another one: weight 0 changes
 * nothing, 1 shows the moment alone. May be called again: each time what is shown then counts as one.
 * ANIC_WHEN_PREVIOUS stays the moment shown before the last seek.
 *
 * If the moments share a basis, weights are mixed, at the cost of one moment, and rigid motions
 * turn the shorter way; otherwise positions are mixed. Corrections are applied at a single whole
 * frame only. A blend of equal moments is that moment to the last bit.
 *
 * - Errors: ANIC_E_STATE: nothing is chosen yet; ANIC_E_ABSENT: the clip was not opened; ANIC_E_LIMIT:
 *   more than 16 frames, or frames of more than ANIC_MAX_PARTS segments of a mesh; ANIC_E_ARGUMENT: no
 *   such clip, a weight not from 0 to 1, and as anic_seek_time(). The context is then as before
 * - Cost: as anic_seek_time()
 */
ANIC_API anic_status anic_blend(anic_context* context, uint32_t clip, double seconds,
                                anic_sampling sampling, anic_wrap wrap, double weight);

/**
 * Makes ANIC_WHEN_PREVIOUS the same as ANIC_WHEN_CURRENT: no motion, after a cut.
 *
 * - Errors: ANIC_E_STATE: nothing is chosen yet
 */
ANIC_API anic_status anic_forget_previous(anic_context* context);

/** One of the two times that a context knows. */
enum anic_when ANIC_INT32 {
  ANIC_WHEN_CURRENT = 0, /**< chosen by the last seek */
  ANIC_WHEN_PREVIOUS = 1 /**< chosen by the seek before, for motion vectors; the same as the
                            current time after the first seek */
};

/**
 * The motion of the whole at a time: a turn about the up axis through the pivot, then a move along
 * the ground, both from where the clip was before. No motion where the clip has none apart.
 * Spec: 06, section 11.
 */
typedef struct anic_root_motion {
  size_t struct_size;
  uint8_t moves; /**< the clip holds moves, or a blended clip does */
  uint8_t turns; /**< the same of turns */
  double turn;   /**< radians, counter-clockwise seen from above; whole turns count */
  double move[3];
  double pivot[3];
  float matrix[12]; /**< the same as one map, 3 x 4, row-major: from positions without root
                       motion (ANIC_OPEN_IN_PLACE) to positions with it */
} anic_root_motion;

/**
 * Tells the motion of the whole at any time of a clip, part of the positions or not. A loop begins
 * again where it began: anic_get_root_step() is for characters that go on.
 *
 * - Errors: ANIC_E_ABSENT: the clip was not opened; ANIC_E_ARGUMENT: no such clip, and as
 *   anic_seek_time()
 * - Cost: as anic_seek_time(), without components
 */
ANIC_API anic_status anic_get_root_motion(const anic_asset* asset, uint32_t clip, double seconds,
                                          anic_sampling sampling, anic_wrap wrap,
                                          anic_root_motion* out);

/**
 * Tells what moves a character on from one time of a clip to another, for hosts that count seconds on
 * and on: out->turn, and out->move in the axes that the character has at `from`; the pivot is 0, and
 * the matrix, multiplied to the right of the character's, makes the step. A loop goes on at its end
 * from where it is, any number of times, and keeps its pace between its last frame and the next first
 * one. For a cross-fade, add up turns and moves of the clips by their weights.
 *
 * - Params: from, to: seconds, either may be the earlier one
 * - Errors: ANIC_E_ABSENT: the clip was not opened; ANIC_E_ARGUMENT: no such clip, times more than
 *   2^51 turns away, and as anic_seek_time()
 * - Cost: as anic_get_root_motion(), some times over, and the logarithm of the turns
 */
ANIC_API anic_status anic_get_root_step(const anic_asset* asset, uint32_t clip, double from,
                                        double to, anic_sampling sampling, anic_wrap wrap,
                                        anic_root_motion* out);

/**
 * Tells the motion of the whole of what a context shows, blends included: moves and pivots are
 * mixed, and turns go the shorter way.
 *
 * - Errors: ANIC_E_STATE: nothing is chosen yet; ANIC_E_ARGUMENT
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_shown_root_motion(const anic_context* context, anic_when when,
                                                anic_root_motion* out);

/**
 * How a position or normal is stored, in the machine's byte order. Formats of four components have
 * 1 as the last one. The 16-bit formats store t = (x - offset) / scale: FLOAT16 as IEEE binary16,
 * rounded to nearest; UNORM16 as round(65535 t), t clamped to 0 .. 1; SNORM16 as round(32767 t), t
 * clamped to -1 .. 1.
 */
enum anic_format ANIC_INT32 {
  ANIC_FORMAT_FLOAT32X3 = 0,
  ANIC_FORMAT_FLOAT32X4 = 1,
  ANIC_FORMAT_FLOAT16X3 = 2,
  ANIC_FORMAT_FLOAT16X4 = 3,
  ANIC_FORMAT_UNORM16X3 = 4,
  ANIC_FORMAT_UNORM16X4 = 5,
  ANIC_FORMAT_SNORM16X3 = 6,
  ANIC_FORMAT_SNORM16X4 = 7
};

/**
 * The place for positions or normals. Every component is written once, at ascending addresses, and
 * nothing is read: the memory may be write-combined. Bytes between elements stay untouched.
 */
typedef struct anic_output {
  size_t struct_size;
  void* data;    /**< address of the first element asked for; any alignment */
  size_t size;   /**< bytes that may be written from data on */
  size_t stride; /**< bytes from an element to the next; 0: packed */
  anic_format format;
  float offset[3]; /**< offset of the 16-bit formats; anic_get_clip_bounds() gives fitting ones */
  float scale[3];  /**< scale of the 16-bit formats; 0 counts as 1 */
} anic_output;

/**
 * Writes positions of the vertices first .. first + count - 1 of a mesh. Threads may write disjoint
 * ranges at the same time; the result does not depend on how a mesh is cut into ranges.
 *
 * - Errors: ANIC_E_STATE: nothing is chosen yet; ANIC_E_ABSENT: the mesh is not there at this time;
 *   ANIC_E_ARGUMENT; ANIC_E_BUFFER_SIZE
 * - Cost: O(count x components), the same for every frame. Begin ranges at multiples of 16
 * - Spec: 09a, section 1; tolerance: 09a, section 7
 */
ANIC_API anic_status anic_write_positions(const anic_context* context, uint32_t mesh,
                                          anic_when when, uint32_t first, uint32_t count,
                                          const anic_output* out);

/** How a value of an attribute is stored, in the machine's byte order. */
enum anic_value_format ANIC_INT32 {
  ANIC_VALUE_FLOAT32 = 0,
  ANIC_VALUE_FLOAT16 = 1, /**< IEEE binary16, rounded to nearest */
  ANIC_VALUE_UNORM8 = 2,  /**< round(255 x), x clamped to 0 .. 1 */
  ANIC_VALUE_UNORM16 = 3  /**< round(65535 x), x clamped to 0 .. 1 */
};

/** The place for values of an attribute; written as anic_output is. */
typedef struct anic_value_output {
  size_t struct_size;
  void* data;    /**< address of the first element asked for; any alignment */
  size_t size;   /**< bytes that may be written from data on */
  size_t stride; /**< bytes from an element to the next; 0: packed */
  anic_value_format format;
  uint32_t components; /**< to be written of each element, at most 16; 0: as many as the attribute
                          has. A component that it does not have is 0, or 1 if it is the fourth */
} anic_value_output;

/**
 * Writes values of an attribute at the time chosen, of the elements first .. first + count - 1 of
 * its domain: vertices, corners or polygons; the attribute need not move. Between frames values are
 * interpolated as positions are.
 *
 * - Errors: ANIC_E_ARGUMENT: no such attribute, or one without components; others as
 *   anic_write_positions()
 * - Cost: O(count x components of its segments), the same for every frame
 * - Spec: 09a, section 8
 */
ANIC_API anic_status anic_write_attribute(const anic_context* context, uint32_t mesh,
                                          uint32_t attribute, anic_when when, uint32_t first,
                                          uint32_t count, const anic_value_output* out);

/** Most frames of one call of anic_write_frames(). */
#define ANIC_MAX_FRAMES 16

/**
 * Writes positions in several whole frames, without a context: those of frames[i] to outputs[i].
 * Consecutive frames, four at a time, take about half the time of single ones, and come out the
 * same.
 *
 * - Shapes: frames, outputs: frame_count, at most ANIC_MAX_FRAMES; the outputs have one struct_size
 *   and must not overlap
 * - Errors: ANIC_E_ARGUMENT, ANIC_E_BUFFER_SIZE, ANIC_E_FRAME_RANGE, ANIC_E_ABSENT; ANIC_E_STATE: a
 *   segment of ANIC_RECONSTRUCTION_MSGI, which needs the memory of a context
 */
ANIC_API anic_status anic_write_frames(const anic_asset* asset, uint32_t mesh,
                                       const uint32_t* frames, uint32_t frame_count, uint32_t first,
                                       uint32_t count, const anic_output* outputs);

/* ---- bounds ---------------------------------------------------------------------------------- */

/**
 * Computes the exact box of a mesh at the time chosen.
 *
 * - Errors: as anic_write_positions()
 * - Cost: that of anic_write_positions()
 */
ANIC_API anic_status anic_compute_bounds(const anic_context* context, uint32_t mesh, anic_when when,
                                         anic_box* out);

/**
 * Looks up the exact box of a whole frame.
 *
 * - Errors: ANIC_E_STATE: opened without ANIC_OPEN_BOUNDS; ANIC_E_ABSENT: the mesh is not there in
 *   this frame; ANIC_E_ARGUMENT; ANIC_E_FRAME_RANGE
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_frame_bounds(const anic_asset* asset, uint32_t mesh, uint32_t frame,
                                           anic_box* out);

/**
 * Looks up the box around all frames. Between frames, positions may leave it a little with
 * ANIC_SAMPLE_CUBIC, and in segments with rigid motions; with ANIC_SAMPLE_STEP and
 * ANIC_SAMPLE_LINEAR all other positions stay inside, up to rounding.
 *
 * - Errors: ANIC_E_STATE: opened without ANIC_OPEN_BOUNDS; ANIC_E_ABSENT: the mesh is in no frame;
 *   ANIC_E_ARGUMENT
 * - Cost: O(1)
 */
ANIC_API anic_status anic_get_clip_bounds(const anic_asset* asset, uint32_t mesh, anic_box* out);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_PLAY_H_ */
