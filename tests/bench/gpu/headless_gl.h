// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_GPU_HEADLESS_GL_H_
#define ANICODEC_TESTS_BENCH_GPU_HEADLESS_GL_H_

#include <string>

namespace anicodec::bench {

/// Makes OpenGL 3.3 without a window by EGL, which is loaded when the program runs: of the first device that has it, else of
/// Mesa's software. It draws into a picture of width x height. With `vulkan`, Mesa's zink translates OpenGL to Vulkan.
/// Returns why there is none; empty: there is.
std::string start_headless_gl(bool vulkan, int width, int height);

/// Renderer and version, as the driver names them.
std::string describe_gl();

/// Whether the processor draws.
bool is_software_gl();

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_GPU_HEADLESS_GL_H_
