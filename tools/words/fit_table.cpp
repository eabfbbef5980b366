// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/fit_table.h"

#include <cstdint>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

nlohmann::ordered_json json_of(const HausdorffDistance& distance, double diagonal,
                               const RadiusRatio& ratio, uint32_t turned) {
  return {{"hausdorff", distance.max()},
          {"hausdorff_percent", 100 * distance.max() / diagonal},
          {"hausdorff_mean", distance.mean()},
          {"hausdorff_mean_percent", 100 * distance.mean() / diagonal},
          {"radius_ratio", ratio.mean},
          {"turned", turned}};
}

void print_row(const char* name, const HausdorffDistance& distance, double diagonal,
               const RadiusRatio& ratio, uint32_t turned) {
  fmt::print("{:<10} {:>12.5f} {:>12.5f} {:>13.4f} {:>8}\n", name, 100 * distance.mean() / diagonal,
             100 * distance.max() / diagonal, ratio.mean, turned);
}

}  // namespace

void add_fit(const RemeshFit& fit, nlohmann::ordered_json* json) {
  (*json)["improved"] = fit.improved;
  if (fit.opening > 0)
    (*json)["opening_percent"] = 100 * fit.opening;
  (*json)["before"] = json_of(fit.before, fit.diagonal, fit.ratio_before, fit.turned_before);
  (*json)["after"] = json_of(fit.after, fit.diagonal, fit.ratio_after, fit.turned_after);
}

void print_fit(const RemeshFit& fit) {
  if (fit.opening > 0)
    fmt::print(
        "one is closed, and the other has an opening of {:.2g} % of the diagonal: fitted across "
        "it\n",
        100 * fit.opening);
  fmt::print("{:<10} {:>12} {:>12} {:>13} {:>8}\n", "", "mean %", "max %", "radius ratio",
             "turned");
  print_row("before", fit.before, fit.diagonal, fit.ratio_before, fit.turned_before);
  print_row("after", fit.after, fit.diagonal, fit.ratio_after, fit.turned_after);
}

}  // namespace anicodec::tools
