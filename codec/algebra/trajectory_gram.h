// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_TRAJECTORY_GRAM_H_
#define ANICODEC_CODEC_ALGEBRA_TRAJECTORY_GRAM_H_

#include "codec/sequence/frame_view.h"

#include <cstddef>
#include <functional>

#include <Eigen/Core>

namespace anicodec {

/// Coordinates of vertices first .. first + count - 1 relative to an origin, in double: row i,
/// column 3f + c is coordinate c of vertex first + i in frame f, so that a row is a trajectory.
void trajectory_panel(const FrameView& clip, const Eigen::Vector3d& origin, size_t first,
                      size_t count, Eigen::MatrixXd* panel);

/// The same with a column per frame: row 3i + c is coordinate c of vertex first + i.
void frame_panel(const FrameView& clip, const Eigen::Vector3d& origin, size_t first, size_t count,
                 Eigen::MatrixXd* panel);

/// Products of all pairs of coordinate rows (3 frames x 3 frames): entry (3f + c, 3g + d) is the
/// sum over the vertices of coordinate c in frame f times coordinate d in frame g, relative to the
/// origin. Cost O(vertices frames^2), memory 9 frames^2 doubles and a few megabytes. Same bits for
/// any number of threads.
Eigen::MatrixXd trajectory_gram(const FrameView& clip, const Eigen::Vector3d& origin);

/// The same of the vertices: entry (3i + c, 3j + d) is the sum over the frames of coordinate c of vertex i times
/// coordinate d of vertex j, relative to the origin. Cost O(frames vertices^2), memory 9 vertices^2 doubles and
/// a few megabytes. Same bits for any number of threads.
Eigen::MatrixXd vertex_gram(const FrameView& clip, const Eigen::Vector3d& origin);

/// Sum of its three axis blocks, vertices x vertices: products of trajectories. Cost a third of all blocks'.
Eigen::MatrixXd vertex_gram_of_axes(const FrameView& clip, const Eigen::Vector3d& origin);

/// The product of the coordinate rows' Gram matrix, which is not made, and some columns (3 frames x any). One
/// pass over the clip, memory a few megabytes. Same bits for any number of threads.
Eigen::MatrixXd times_trajectory_gram(const FrameView& clip, const Eigen::Vector3d& origin,
                                      const Eigen::MatrixXd& columns);

/// Coordinate rows times functions of the vertices (vertices x any): 3 frames x any. One pass over
/// the clip. Same bits for any number of threads.
Eigen::MatrixXd project_on_functions(const FrameView& clip, const Eigen::Vector3d& origin,
                                     const Eigen::MatrixXd& functions);

/// Whole frames times vector fields on the vertices (3 vertices x any; row 3v + c is coordinate c
/// of vertex v): frames x any. One pass over the clip. Same bits for any number of threads.
Eigen::MatrixXd project_on_fields(const FrameView& clip, const Eigen::Vector3d& origin,
                                  const Eigen::MatrixXd& fields);

/// Combinations of the coordinate rows: weights is 3 frames x k, or frames x k for combinations of
/// whole frames. Calls take(first vertex, block) for blocks of vertices, from several threads; a
/// block has a row per vertex (of whole frames: three rows, x, y, z) and k columns. One pass over
/// the clip; memory a few megabytes per thread.
void combine_rows(const FrameView& clip, const Eigen::Vector3d& origin,
                  const Eigen::MatrixXd& weights,
                  const std::function<void(size_t first, const Eigen::MatrixXd& block)>& take);

/// Sum of the three axis blocks: frames x frames products of whole frames.
Eigen::MatrixXd sum_of_axes(const Eigen::MatrixXd& trajectory_products);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_TRAJECTORY_GRAM_H_
