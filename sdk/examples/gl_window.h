/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * A window with OpenGL by SDL2, for samples that draw, and its clock.
 */
#ifndef ANICODEC_SDK_EXAMPLES_GL_WINDOW_H_
#define ANICODEC_SDK_EXAMPLES_GL_WINDOW_H_

#include <SDL2/SDL.h>

enum { NO_DISPLAY = 3 }; /* exit status of a sample without OpenGL */

/* NULL, and a line is printed, without OpenGL 3.3 (or ES 3, if embedded). */
SDL_Window* open_window(const char* name, int embedded, int width, int height);
/* Time that passed, which is then taken from *since. */
double milliseconds(Uint64* since);

#endif
