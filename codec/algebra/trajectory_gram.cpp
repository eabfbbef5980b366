// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/trajectory_gram.h"

#include "codec/algebra/blocked_product.h"
#include "codec/parallel/parallel.h"

#include <algorithm>

namespace anicodec {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

void trajectory_panel(const FrameView& clip, const Vector3d& origin, size_t first, size_t count,
                      MatrixXd* panel) {
  panel->resize(static_cast<Index>(count), static_cast<Index>(3 * clip.frame_count));
  const double x = origin[0], y = origin[1], z = origin[2];
  for (size_t f = 0; f < clip.frame_count; ++f) {
    const float* p = clip.frame(f) + 3 * first;
    double* to = panel->col(static_cast<Index>(3 * f)).data();
    for (size_t i = 0; i < count; ++i) {
      to[i] = double{p[3 * i]} - x;
      to[count + i] = double{p[3 * i + 1]} - y;
      to[2 * count + i] = double{p[3 * i + 2]} - z;
    }
  }
}

void frame_panel(const FrameView& clip, const Vector3d& origin, size_t first, size_t count,
                 MatrixXd* panel) {
  panel->resize(static_cast<Index>(3 * count), static_cast<Index>(clip.frame_count));
  for (size_t f = 0; f < clip.frame_count; ++f) {
    const float* p = clip.frame(f) + 3 * first;
    double* to = panel->col(static_cast<Index>(f)).data();
    for (size_t i = 0; i < 3 * count; ++i)
      to[i] = double{p[i]} - origin[static_cast<Index>(i % 3)];
  }
}

namespace {

/// Calls visit(first frame, those frames) for a panel's worth of frames at a time, in order: panels of long clips
/// would be large.
template <class Visit>
void by_frames(const FrameView& clip, const Visit& visit) {
  constexpr size_t kFrames = 1040;  // three times as many numbers are a multiple of kProductDepth
  for (size_t first = 0; first < clip.frame_count; first += kFrames)
    visit(static_cast<Index>(first),
          clip.frames(first, std::min(kFrames, clip.frame_count - first)));
}

/// The same for vertices, as many as the depth of a panel of so many columns.
template <class Visit>
void by_vertices(const FrameView& clip, Index columns, const Visit& visit) {
  const auto block = static_cast<size_t>(panel_depth(columns));
  for (size_t first = 0; first < clip.vertex_count; first += block)
    visit(first, std::min(block, clip.vertex_count - first));
}

}  // namespace

MatrixXd trajectory_gram(const FrameView& clip, const Vector3d& origin) {
  const auto rows = static_cast<Index>(3 * clip.frame_count);
  MatrixXd gram = MatrixXd::Zero(rows, rows), panel;
  const auto block = static_cast<size_t>(panel_depth(rows));
  for (size_t first = 0; first < clip.vertex_count; first += block) {
    trajectory_panel(clip, origin, first, std::min(block, clip.vertex_count - first), &panel);
    add_self_products(panel, gram);
  }
  mirror_upper(gram);
  return gram;
}

MatrixXd vertex_gram(const FrameView& clip, const Vector3d& origin) {
  const auto rows = static_cast<Index>(3 * clip.vertex_count);
  MatrixXd gram = MatrixXd::Zero(rows, rows), panel;
  const auto block = static_cast<size_t>(panel_depth(rows));
  for (size_t first = 0; first < clip.frame_count; first += block) {
    const FrameView some = clip.frames(first, std::min(block, clip.frame_count - first));
    panel.resize(static_cast<Index>(some.frame_count), rows);
    for (size_t f = 0; f < some.frame_count; ++f) {
      const float* p = some.frame(f);
      for (Index i = 0; i < rows; ++i)
        panel(static_cast<Index>(f), i) = double{p[i]} - origin[i % 3];
    }
    add_self_products(panel, gram);
  }
  mirror_upper(gram);
  return gram;
}

MatrixXd vertex_gram_of_axes(const FrameView& clip, const Vector3d& origin) {
  const auto rows = static_cast<Index>(clip.vertex_count);
  MatrixXd gram = MatrixXd::Zero(rows, rows), panel;
  const auto block = static_cast<size_t>(panel_depth(rows)) / 3;
  for (size_t first = 0; first < clip.frame_count; first += block) {
    const FrameView some = clip.frames(first, std::min(block, clip.frame_count - first));
    panel.resize(static_cast<Index>(3 * some.frame_count), rows);
    for (size_t f = 0; f < some.frame_count; ++f) {
      const float* p = some.frame(f);
      for (Index i = 0; i < rows; ++i, p += 3) {
        for (Index c = 0; c < 3; ++c)
          panel(static_cast<Index>(3 * f) + c, i) = double{p[c]} - origin[c];
      }
    }
    add_self_products(panel, gram);
  }
  mirror_upper(gram);
  return gram;
}

MatrixXd times_trajectory_gram(const FrameView& clip, const Vector3d& origin,
                               const MatrixXd& columns) {
  MatrixXd out = MatrixXd::Zero(columns.rows(), columns.cols()), panel;
  by_vertices(clip, columns.rows(), [&](size_t first, size_t count) {
    MatrixXd combined = MatrixXd::Zero(static_cast<Index>(count), columns.cols());
    by_frames(clip, [&](Index frame, const FrameView& some) {
      trajectory_panel(some, origin, first, count, &panel);
      combined += product(panel, columns.middleRows(3 * frame, panel.cols()));
    });
    by_frames(clip, [&](Index frame, const FrameView& some) {
      if (some.frame_count < clip.frame_count)
        trajectory_panel(some, origin, first, count, &panel);
      out.middleRows(3 * frame, panel.cols()) += inner_products(panel, combined);
    });
  });
  return out;
}

MatrixXd project_on_functions(const FrameView& clip, const Vector3d& origin,
                              const MatrixXd& functions) {
  MatrixXd out(static_cast<Index>(3 * clip.frame_count), functions.cols()), panel;
  by_frames(clip, [&](Index frame, const FrameView& some) {
    MatrixXd sums = MatrixXd::Zero(static_cast<Index>(3 * some.frame_count), functions.cols());
    by_vertices(clip, sums.rows(), [&](size_t first, size_t count) {
      trajectory_panel(some, origin, first, count, &panel);
      add_products(panel, functions.middleRows(static_cast<Index>(first), panel.rows()), sums);
    });
    out.middleRows(3 * frame, sums.rows()) = sums;
  });
  return out;
}

MatrixXd project_on_fields(const FrameView& clip, const Vector3d& origin, const MatrixXd& fields) {
  MatrixXd out(static_cast<Index>(clip.frame_count), fields.cols()), panel;
  by_frames(clip, [&](Index frame, const FrameView& some) {
    MatrixXd sums = MatrixXd::Zero(static_cast<Index>(some.frame_count), fields.cols());
    by_vertices(clip, sums.rows(), [&](size_t first, size_t count) {
      frame_panel(some, origin, first, count, &panel);
      add_products(panel, fields.middleRows(static_cast<Index>(3 * first), panel.rows()), sums);
    });
    out.middleRows(frame, sums.rows()) = sums;
  });
  return out;
}

void combine_rows(const FrameView& clip, const Vector3d& origin, const MatrixXd& weights,
                  const std::function<void(size_t first, const MatrixXd& block)>& take) {
  // A panel of 200 frames takes half of a cache of a megabyte: `encode --effort fast` of dance, 1 to 3 % less time than with 192.
  constexpr size_t kVertices = 96;
  const bool frames = weights.rows() == static_cast<Index>(clip.frame_count);
  const size_t blocks = (clip.vertex_count + kVertices - 1) / kVertices;
  parallel_for(size_t{0}, blocks, [&](size_t b) {
    const size_t first = b * kVertices, count = std::min(kVertices, clip.vertex_count - first);
    MatrixXd panel, combined;
    by_frames(clip, [&](Index frame, const FrameView& some) {
      if (frames)
        frame_panel(some, origin, first, count, &panel);
      else
        trajectory_panel(some, origin, first, count, &panel);
      const Index row = frames ? frame : 3 * frame;
      const MatrixXd part = product(panel, weights.middleRows(row, panel.cols()));
      combined = frame == 0 ? part : MatrixXd(combined + part);
    });
    take(first, combined);
  });
}

MatrixXd sum_of_axes(const MatrixXd& trajectory_products) {
  const Index frames = trajectory_products.rows() / 3;
  MatrixXd sum(frames, frames);
  for (Index g = 0; g < frames; ++g)
    for (Index f = 0; f < frames; ++f)
      sum(f, g) = trajectory_products(3 * f, 3 * g) + trajectory_products(3 * f + 1, 3 * g + 1) +
                  trajectory_products(3 * f + 2, 3 * g + 2);
  return sum;
}

}  // namespace anicodec
