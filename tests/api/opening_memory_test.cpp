// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// How much memory opening touches: at the peak, and of a block that the host mapped before.
#include "tests/api/opened.h"

#include <algorithm>
#include <cstdint>
#include <string>

#if defined(__linux__)
#include <sys/mman.h>
#include <sys/resource.h>
#endif

namespace anicodec {
namespace {

const Bytes& many_components(BasisChoice basis) {
  static std::map<BasisChoice, Bytes> files;
  Bytes& file = files[basis];
  if (file.empty()) {
    EncodeOptions options;
    options.target = {ErrorMetric::kKg, 0.02, false};
    options.basis = basis;
    options.effort = Effort::kFast;
    options.order = OrderMode::kFree;
    file = encode(corpus::make_scaled("waves", 2000, 64), options).file;
  }
  return file;
}

TEST(OpeningMemory, IsEightBytesForACoefficientAndAFewForAVertex) {
  constexpr size_t kModels = 1 << 20;
  for (const BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    const Asset asset = open(many_components(basis), &options);
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    anic_basis parts = ANIC_INIT(anic_basis);
    ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
    ASSERT_EQ(anic_get_basis(asset.get(), 0, &parts), ANIC_OK);
    const size_t n = mesh.vertex_count;
    const size_t coefficients = n * parts.components * parts.channels;
    EXPECT_GT(coefficients, 20 * n);
    EXPECT_LE(memory.peak, 8 * coefficients + 150 * n + kModels);
  }
}

#if defined(__linux__)
TEST(OpeningMemory, OfABlockThatIsMappedTakesNoPageFault) {
  for (const BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    const Bytes& file = many_components(basis);
    anic_requirements needs = ANIC_INIT(anic_requirements);
    ASSERT_EQ(anic_get_requirements(file.data(), file.size(), nullptr, &needs), ANIC_OK);
    const size_t size = static_cast<size_t>(needs.block_bytes);
    void* block = mmap(nullptr, size, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
    ASSERT_NE(block, MAP_FAILED);
    anic_options options = ANIC_INIT(anic_options);
    ASSERT_EQ(anic_init_block_allocator(block, size, &options.allocator), ANIC_OK);
    // The first opening maps code and stack; the machine may take a page back at any time.
    int64_t least = INT64_MAX;
    for (int round = 0; round < 6; ++round) {
      rusage before, after;
      getrusage(RUSAGE_THREAD, &before);
      anic_asset* asset = nullptr;
      const anic_status status =
          anic_open_asset(file.data(), file.size(), &options, &asset, nullptr);
      getrusage(RUSAGE_THREAD, &after);
      ASSERT_EQ(status, ANIC_OK);
      anic_close_asset(asset);
      least = std::min<int64_t>(least, after.ru_minflt - before.ru_minflt);
    }
    EXPECT_EQ(least, 0);
    munmap(block, size);
  }
}
#endif

}  // namespace
}  // namespace anicodec
