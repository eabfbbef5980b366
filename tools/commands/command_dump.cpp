// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/live_stream.h"
#include "format/container.h"
#include "tools/inputs/clip_input.h"
#include "tools/listing/listing.h"
#include "tools/program/command.h"
#include "tools/program/print.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kDumpFooter =
    R"(A line for every field: offset in hexadecimal, size in bytes, name, value. Streams are listed by
their size alone. A damaged file is listed as far as it can be read; the fault and the exit status
are those of verify. Files of a live stream are listed one after the other, as they stand there.

--json prints an object for every field: offset, size, name, value.)";

void print_fields(const std::vector<ListedField>& fields, uint64_t offset,
                  const CommonOptions& common) {
  for (const ListedField& field : fields) {
    if (common.json)
      print_json({{"offset", offset + field.offset},
                  {"size", field.size},
                  {"name", field.name},
                  {"value", field.value}});
    else
      print_line("{:08x} {:>9}  {:<28} {}", offset + field.offset, field.size, field.name,
                 field.value);
  }
}

/// Lists the files of a live stream as they are, continuations without their meshes.
void dump_stream(const std::string& path, ByteView bytes, const CommonOptions& common) {
  uint64_t offset = 0;
  for (size_t number = 1; offset < bytes.size; ++number) {
    const ByteView rest{bytes.data + offset, bytes.size - static_cast<size_t>(offset)};
    ContainerReader reader;
    const Failure failure = reader.open_of_stream(rest);
    const uint64_t size =
        failure.ok() ? std::min<uint64_t>(reader.file_size(), rest.size) : rest.size;
    const std::string what = !failure.ok() || size < reader.file_size() ? "not complete"
                             : reader.is_continuation()                 ? "a continuation"
                                                                        : "with meshes";
    print_fields({{0, size, fmt::format("file {}", number), what}}, offset, common);
    print_fields(list_fields({rest.data, static_cast<size_t>(size)}), offset, common);
    if (!failure.ok() && failure.status != Status::kTruncated)
      fail_clip(fmt::format("{}, file {} (at byte {})", path, number, offset), failure);
    offset += size;
  }
  read_live_stream({path, bytes});  // whether files continue one another
}

void run(const std::string& path, const CommonOptions& common) {
  std::string bytes = read_clip_bytes(path);
  if (bytes.empty())
    fail_clip(path, {Status::kTruncated, 0, 0, "the file is empty"});
  if (is_live_stream(view_of(bytes)))
    return dump_stream(path, view_of(bytes), common);
  print_fields(list_fields(view_of(bytes)), 0, common);
  ContainerReader reader;
  if (Failure failure = reader.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
}

}  // namespace

void add_dump(Commands& commands, CommonOptions& common) {
  auto input = std::make_shared<std::string>();
  Options& options =
      add_command(commands, common, kJson,
                  {"dump", "FILE.anic", "List an .anic file field by field", kDumpFooter},
                  [input, &common] { run(*input, common); });
  options.argument("FILE", *input, "The .anic file to list").required();
}

}  // namespace anicodec::tools
