/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Shared by samples that draw: functions of OpenGL 3.3 or ES 3, programs, textures, a camera,
 * pictures, files, a clock.
 */
#ifndef ANICODEC_SDK_EXAMPLES_GL_SAMPLE_H_
#define ANICODEC_SDK_EXAMPLES_GL_SAMPLE_H_

#include <anicodec/anicodec.h>

#include <GL/glcorearb.h>
#include <stddef.h>
#include <time.h>

#define GL_FUNCTIONS(F)                                            \
  F(PFNGLGETSTRINGPROC, GetString)                                 \
  F(PFNGLGETERRORPROC, GetError)                                   \
  F(PFNGLGETINTEGERVPROC, GetIntegerv)                             \
  F(PFNGLENABLEPROC, Enable)                                       \
  F(PFNGLDISABLEPROC, Disable)                                     \
  F(PFNGLVIEWPORTPROC, Viewport)                                   \
  F(PFNGLCLEARCOLORPROC, ClearColor)                               \
  F(PFNGLCLEARPROC, Clear)                                         \
  F(PFNGLFINISHPROC, Finish)                                       \
  F(PFNGLREADPIXELSPROC, ReadPixels)                               \
  F(PFNGLPIXELSTOREIPROC, PixelStorei)                             \
  F(PFNGLGENTEXTURESPROC, GenTextures)                             \
  F(PFNGLBINDTEXTUREPROC, BindTexture)                             \
  F(PFNGLACTIVETEXTUREPROC, ActiveTexture)                         \
  F(PFNGLTEXIMAGE2DPROC, TexImage2D)                               \
  F(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                         \
  F(PFNGLTEXPARAMETERIPROC, TexParameteri)                         \
  F(PFNGLGENBUFFERSPROC, GenBuffers)                               \
  F(PFNGLBINDBUFFERPROC, BindBuffer)                               \
  F(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                       \
  F(PFNGLBUFFERDATAPROC, BufferData)                               \
  F(PFNGLMAPBUFFERRANGEPROC, MapBufferRange)                       \
  F(PFNGLUNMAPBUFFERPROC, UnmapBuffer)                             \
  F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                     \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                     \
  F(PFNGLCREATESHADERPROC, CreateShader)                           \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                           \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                         \
  F(PFNGLGETSHADERIVPROC, GetShaderiv)                             \
  F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                   \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                         \
  F(PFNGLATTACHSHADERPROC, AttachShader)                           \
  F(PFNGLTRANSFORMFEEDBACKVARYINGSPROC, TransformFeedbackVaryings) \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                             \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                           \
  F(PFNGLUSEPROGRAMPROC, UseProgram)                               \
  F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)               \
  F(PFNGLUNIFORM1IPROC, Uniform1i)                                 \
  F(PFNGLUNIFORM3FPROC, Uniform3f)                                 \
  F(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                   \
  F(PFNGLBEGINTRANSFORMFEEDBACKPROC, BeginTransformFeedback)       \
  F(PFNGLENDTRANSFORMFEEDBACKPROC, EndTransformFeedback)           \
  F(PFNGLDRAWARRAYSPROC, DrawArrays)                               \
  F(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)

#define GL_MEMBER(type, name) type name;

struct gl_functions {
  GL_FUNCTIONS(GL_MEMBER)
};

/* Set by start_gl(). */
extern struct gl_functions gl;

/* That fail() names. */
extern const char* sample;
/* Ends the program. */
void fail(const char* what, const char* why);
void check(anic_status status, const char* what);
/* Memory of zeros. */
void* room(size_t size);
/* The file must be there. Bounds of its frames are kept. Adds the time to *seconds. */
anic_asset* open_file(const char* path, double* seconds);

/* Finds the functions of the current context, and prepares it for pictures of this size. */
void start_gl(void* (*find)(const char* name), int width, int height);
/* `captured`: an output of the vertex shader for transform feedback. */
GLuint make_program(int embedded, const char* vertex, const char* fragment, const char* captured);
/* A texture without filters. */
GLuint make_texture(GLint format, GLsizei width, GLsizei height, GLenum layout, GLenum type,
                    const void* data);
/* Column-major: a camera at `eye` that looks at `at`. */
void look(const float* eye, const float* at, float aspect, float* out);
/* PPM, of what was drawn last. */
void save_picture(const char* path, int width, int height);

/* Time that this program has had on the processor, whatever else runs, which is then taken from
 * *since. */
double processor_milliseconds(clock_t* since);

#endif
