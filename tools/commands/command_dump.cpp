// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/container.h"
#include "tools/inputs/clip_input.h"
#include "tools/listing/listing.h"
#include "tools/program/command.h"
#include "tools/program/print.h"

#include <memory>
#include <string>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kDumpFooter =
    R"(A line for every field: offset in hexadecimal, size in bytes, name, value. Streams are listed by
their size alone. A damaged file is listed as far as it can be read; the fault and the exit status
are those of verify.

--json prints an object for every field: offset, size, name, value.)";

void run(const std::string& path, const CommonOptions& common) {
  std::string bytes = read_bytes(path);
  if (bytes.empty())
    fail_clip(path, {Status::kTruncated, 0, 0, "the file is empty"});
  for (const ListedField& field : list_fields(view_of(bytes))) {
    if (common.json)
      print_json({{"offset", field.offset},
                  {"size", field.size},
                  {"name", field.name},
                  {"value", field.value}});
    else
      print_line("{:08x} {:>9}  {:<28} {}", field.offset, field.size, field.name, field.value);
  }
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
