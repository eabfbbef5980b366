// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PARALLEL_PARALLEL_H_
#define ANICODEC_CODEC_PARALLEL_PARALLEL_H_

#include <cstddef>
#include <exception>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

namespace anicodec {

/// Leaves a loop because a body elsewhere has thrown. No caller sees it: the loop around both
/// rethrows the exception of that body. Not an Error, so that nobody takes it for one about the
/// input.
class ParallelCancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "other work has failed"; }
};

namespace detail {

/// Calls work(context), and throws if it came back because a group around it was cancelled.
template <class Work>
void run_all(const Work& work) {
  tbb::task_group_context context;
  work(context);
  if (context.is_group_execution_cancelled())
    throw ParallelCancelled();
}

}  // namespace detail

/// Calls body(i) once for every i of first .. last-1, in any order and from any thread. Returns when all calls
/// have; throws what one of them throws, after which others may not have been made.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
  detail::run_all(
      [&](tbb::task_group_context& context) { tbb::parallel_for(first, last, body, context); });
}

/// The same for 0 .. count-1, for few bodies that take long: each is taken by itself.
template <class Body>
void parallel_tasks(size_t count, const Body& body) {
  detail::run_all([&](tbb::task_group_context& context) {
    tbb::parallel_for(size_t{0}, count, body, tbb::simple_partitioner(), context);
  });
}

/// Calls both, as parallel_for() does its bodies.
template <class One, class Other>
void parallel_invoke(const One& one, const Other& other) {
  detail::run_all(
      [&](tbb::task_group_context& context) { tbb::parallel_invoke(one, other, context); });
}

/// Calls work(). A thread that waits for others in it takes no task from outside meanwhile.
template <class Work>
void isolated(const Work& work) {
  tbb::this_task_arena::isolate(work);
}

/// An object for each thread that asks for one.
template <class T>
using PerThread = tbb::enumerable_thread_specific<T>;

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PARALLEL_PARALLEL_H_
