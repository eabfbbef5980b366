/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 */
#include "gl_window.h"

#include "gl_sample.h"

#include <stdio.h>

SDL_Window* open_window(const char* name, int embedded, int width, int height) {
  sample = name;
  SDL_Window* window = NULL;
  if (SDL_Init(SDL_INIT_VIDEO) == 0) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, embedded ? 0 : 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK,
                        embedded ? SDL_GL_CONTEXT_PROFILE_ES : SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
    window = SDL_CreateWindow(name, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, width, height,
                              SDL_WINDOW_OPENGL);
  }
  if (window != NULL && SDL_GL_CreateContext(window) == NULL) {
    SDL_DestroyWindow(window);
    window = NULL;
  }
  if (window == NULL) {
    fprintf(stderr, "%s: no OpenGL %s: %s\n", name, embedded ? "ES 3" : "3.3", SDL_GetError());
    return NULL;
  }
  start_gl(SDL_GL_GetProcAddress, width, height);
  return window;
}

double milliseconds(Uint64* since) {
  const Uint64 now = SDL_GetPerformanceCounter();
  const double passed = 1000 * (double)(now - *since) / (double)SDL_GetPerformanceFrequency();
  *since = now;
  return passed;
}
