/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Draws one clip by its shader: the smallest use of card_clip.c. A step of time is a seek, a few
 * hundred bytes of state, and a draw call.
 */
#include "card_clip.h"
#include "gl_window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 960, HEIGHT = 540 };

int main(int argc, char** argv) {
  if (argc < 2)
    return fprintf(stderr, "usage: draw CLIP.anic [FRAMES PICTURE.ppm]\n"), 1;
  const unsigned long frames = argc > 3 ? strtoul(argv[2], NULL, 10) : 0;
  SDL_Window* window = open_window("draw", 0, WIDTH, HEIGHT);
  if (window == NULL)
    return NO_DISPLAY;
  const GLuint program = make_clip_program(0);
  gl.UseProgram(program);

  double seconds = 0;
  Model model = {0};
  anic_context* context = NULL;
  load_model(&model, open_file(argv[1], &seconds), 0, 1);
  check(anic_create_context(model.asset, NULL, &context), "context");

  /* The largest side of the box becomes 1, and its middle the origin, at which the camera looks. */
  float map[12] = {0}, view[16], size = 0;
  for (int c = 0; c < 3; ++c)
    size = fmaxf(size, model.box.max[c] - model.box.min[c]);
  for (int c = 0; c < 3; ++c) {
    map[5 * c] = size > 0 ? 1 / size : 1;
    map[4 * c + 3] = -map[5 * c] * (model.box.min[c] + model.box.max[c]) / 2;
  }
  const float eye[3] = {1, 0.8f, 2}, origin[3] = {0, 0, 0}, colour[3] = {0.9f, 0.6f, 0.4f};
  look(eye, origin, (float)WIDTH / HEIGHT, view);

  unsigned long drawn = 0;
  for (int open = 1; open && (frames == 0 || drawn < frames); ++drawn) {
    uint32_t corrected = 0;
    for (SDL_Event event; SDL_PollEvent(&event);)
      open &= event.type != SDL_QUIT;
    const double time = frames == 0 ? SDL_GetTicks() / 1000.0 : (double)drawn / 30.0;
    check(anic_seek_time(context, time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), "time");
    model.staged_count = 0;
    stage_instance(&model, context, map, 0, &corrected);
    upload_states(&model);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.UniformMatrix4fv(gl.GetUniformLocation(program, "view"), 1, GL_FALSE, view);
    draw_model(program, &model, colour);
    if (drawn + 1 == frames)
      save_picture(argv[3], WIDTH, HEIGHT);
    SDL_GL_SwapWindow(window);
  }
  printf("%u vertices, %lu frames, opened in %.1f ms\n", model.vertices, drawn, 1000 * seconds);
  anic_destroy_context(context);
  close_model(&model);
  SDL_Quit();
  return 0;
}
