// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/studies/basis_error.h"

#include <utility>

#include <Eigen/Eigenvalues>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::pair<KeyframeMethod, const char*> kMethods[] = {
    {KeyframeMethod::kGas, "gas"},
    {KeyframeMethod::kPivot, "pivot"},
    {KeyframeMethod::kUniform, "uniform"},
};

constexpr std::pair<KeyframeWeights, const char*> kKinds[] = {
    {KeyframeWeights::kLinear, "linear"},
    {KeyframeWeights::kSumToOne, "sum-to-one"},
    {KeyframeWeights::kRigid, "rigid"},
};

std::string name_of(const char* method, const char* kind) {
  return std::string(method) + "-" + kind;
}

}  // namespace

std::vector<BasisError> basis_errors(KeyframeFitter& fitter, std::span<const size_t> counts,
                                     bool with_rigid) {
  const FrameView& clip = fitter.clip();
  const double reference = fitter.gram().kg_reference();
  std::vector<BasisError> rows;
  const auto add = [&](const std::string& name, size_t k, double squared_error) {
    rows.push_back({name, k, kg_error(squared_error, reference),
                    rmse(squared_error, clip.vertex_count, clip.frame_count)});
  };
  for (const auto& [method, method_name] : kMethods) {
    for (const auto& [kind, kind_name] : kKinds) {
      if (kind == KeyframeWeights::kRigid && !with_rigid) {
        continue;
      }
      for (size_t k : counts) {
        if (k >= 1 && k <= clip.frame_count) {
          add(name_of(method_name, kind_name), k, fitter.fit(k, method, kind).squared_error());
        }
      }
    }
  }
  const auto add_principal = [&](const char* name, const MatrixXd& gram) {
    const std::vector<double> errors = principal_errors(gram);
    for (size_t k : counts) {
      if (k >= 1 && k <= clip.frame_count) {
        add(name, k, errors[k]);
      }
    }
  };
  add_principal("pca", fitter.products(KeyframeWeights::kLinear));
  add_principal("pca-mean", about_mean(fitter.products(KeyframeWeights::kLinear)));
  if (with_rigid) {
    add_principal("pca-mean-rigid", about_mean(fitter.products(KeyframeWeights::kRigid)));
  }
  return rows;
}

}  // namespace anicodec
