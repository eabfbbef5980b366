// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_STOPWATCH_H_
#define ANICODEC_TESTS_BENCH_STOPWATCH_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <utility>
#include <vector>

#include <sys/resource.h>

namespace anicodec::bench {

/// Seconds of a POSIX clock since the start.
class Stopwatch {
 public:
  explicit Stopwatch(clockid_t clock) : clock_(clock), start_(now()) {}

  double seconds() const { return now() - start_; }

 private:
  double now() const {
    timespec t{};
    clock_gettime(clock_, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }

  clockid_t clock_;
  double start_;
};

/// The middle value, of an even number the mean of the two in the middle; 0 of none.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/// Processor time of one thread, which other programs disturb least; median of `runs` calls.
template <class Work>
double median_thread_seconds(int runs, Work work) {
  std::vector<double> seconds;
  for (int i = 0; i < runs; ++i) {
    Stopwatch watch(CLOCK_THREAD_CPUTIME_ID);
    work();
    seconds.push_back(watch.seconds());
  }
  return median(std::move(seconds));
}

/// Processor time of several works that take turns `runs` times: for each, the median; and the median ratio of
/// one to another, which a machine that changes its speed from one second to the next disturbs least.
class Turns {
 public:
  template <class... Work>
  explicit Turns(int runs, Work... works) : seconds_(sizeof...(works)) {
    for (int i = 0; i < runs; ++i) {
      size_t k = 0;
      (seconds_[k++].push_back(median_thread_seconds(1, works)), ...);
    }
  }

  double seconds(size_t work) const { return median(seconds_[work]); }

  double ratio(size_t a, size_t b) const {
    std::vector<double> ratios;
    for (size_t i = 0; i < seconds_[a].size(); ++i)
      ratios.push_back(seconds_[a][i] / seconds_[b][i]);
    return median(std::move(ratios));
  }

 private:
  std::vector<std::vector<double>> seconds_;  ///< works x runs
};

/// Largest resident memory of the process so far, in bytes.
inline uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return uint64_t{1024} * static_cast<uint64_t>(usage.ru_maxrss);
}

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_STOPWATCH_H_
