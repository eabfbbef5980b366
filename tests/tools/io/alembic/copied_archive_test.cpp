// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Archives of the reference library, copied property by property: the copies have its hashes.
#include "tests/real_data.h"
#include "tests/tools/io/alembic/alembic_testing.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

/// The last 32 bytes of every object, and the size of what comes before them.
void add_hashes(const OgawaFile& file, OgawaChild object, std::vector<std::string>& out) {
  const std::vector<OgawaChild> group = file.group(object, "test");
  const std::string headers = file.read(file.data(group.back(), "test"));
  out.push_back(headers.substr(headers.size() - 32) + std::to_string(headers.size()));
  for (size_t c = 1; c + 1 < group.size(); ++c)
    add_hashes(file, group[c], out);
}

std::vector<std::string> hashes_of(const ByteSource& source) {
  const OgawaFile file(source);
  std::vector<std::string> out;
  add_hashes(file, file.group(file.root(), "test")[2], out);
  return out;
}

TEST(RealDataAlembicCopy, HasTheHashesOfTheReferenceLibrary) {
  const fs::path folder = fs::path(real_data_folder()) / "other/abc";
  if (!fs::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".abc" || entry.path().stem() == "hdf5")
      continue;
    SCOPED_TRACE(entry.path());
    const ByteSource source = file_source(entry.path().string());
    const AbcArchive from(source);
    std::string bytes;
    AbcArchiveOutput to(sink_to(bytes), from.metadata);
    for (uint32_t s = 0; s < from.samplings.size(); ++s)
      EXPECT_EQ(to.shared().sampling(from.samplings[s]), s);
    copy_object(from, 0, to.top());
    to.finish();
    EXPECT_EQ(hashes_of(memory_source(bytes, "copy")), hashes_of(source));
    EXPECT_EQ(bytes.size(), source.size);
  }
}

}  // namespace
}  // namespace anicodec::tools
