// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Editors keep chunks that they do not know, or name those that they leave out.
#include "codec/file/left_out.h"

#include "codec/encode.h"
#include "codec/file/edit_clips.h"
#include "codec/file/join_clips.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "tests/codec/edited_file.h"

#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr bool kCopied = true;

Bytes encoded(const char* name, const FrameRun& part) {
  MeshSequence clip = corpus::make_scaled("limb", 100, 12);
  clip.name = name;
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.effort = Effort::kFast;
  options.part = part;
  return encode(clip, options).file;
}

/// The file with a chunk more, whose bytes are its type and `what`.
Bytes with_chunk(const Bytes& file, const char (&type)[5], bool copied, uint16_t mesh,
                 uint32_t segment, const std::string& what = "") {
  EditedFile edited(file);
  Chunk chunk;
  chunk.type = chunk_type(type);
  chunk.copied = copied;
  chunk.mesh = mesh;
  chunk.segment = segment;
  const std::string text = type + what;
  edited.parts.push_back({chunk, Bytes(text.begin(), text.end())});
  return edited.bytes();
}

/// Type, mesh and segment of each chunk marked as copied that no version knows.
std::vector<std::string> copied_chunks(const Bytes& file) {
  ContainerReader reader;
  EXPECT_TRUE(reader.open(file).ok());
  std::vector<std::string> found;
  for (const Chunk& chunk : reader.chunks()) {
    const std::string name = chunk_name(chunk.type);
    if (!chunk.copied || name[0] != 'x')
      continue;
    const ByteView payload = reader.unchecked(chunk);
    found.push_back(std::string(payload.data, payload.data + payload.size) + " " +
                    std::to_string(chunk.mesh) + " " + std::to_string(chunk.segment));
  }
  return found;
}

std::string refusal_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

class LeftOut : public testing::Test {
 protected:
  LeftOut() {
    for (Bytes* file : {&walk_, &run_}) {
      *file = with_chunk(*file, "xall", kCopied, kNoMesh, kNoSegment);
      *file = with_chunk(*file, "xmsh", kCopied, 0, kNoSegment);
      *file = with_chunk(*file, "xseg", kCopied, 0, 0);
      *file = with_chunk(*file, "xseg", kCopied, 0, 0, " more");
    }
  }

  std::vector<std::string> lines(const Bytes& made) const {
    return list_left_out({{"run", run_}, {"walk", walk_}}, made);
  }

  Bytes walk_ = encoded("walk", {0, 6}), run_ = encoded("run", {6, 6});
};

const std::string kWhole = "xall 65535 4294967295", kMesh = "xmsh 0 4294967295";

TEST_F(LeftOut, EditsKeepCopiedChunksUnderNewNumbers) {
  const auto expected =
      ElementsAre(kWhole, kMesh, "xseg 0 0", "xseg more 0 0", "xseg 0 1", "xseg more 0 1");
  const Bytes joined = join_clips({{"run", run_}, {"walk", walk_}});
  EXPECT_THAT(copied_chunks(joined), expected);
  EXPECT_THAT(lines(joined), IsEmpty());
  const Bytes both = add_clips({"walk", walk_}, {"run", run_});
  EXPECT_THAT(copied_chunks(both), expected);
  EXPECT_THAT(copied_chunks(remove_clips({"both", both}, {"walk"})),
              ElementsAre(kWhole, kMesh, "xseg 0 0", "xseg more 0 0"));
  EXPECT_THAT(lines(both), IsEmpty());
}

TEST_F(LeftOut, EditsSayWhatTheyLeaveOut) {
  walk_ = with_chunk(walk_, "xaaa", !kCopied, kNoMesh, kNoSegment);
  run_ = with_chunk(run_, "xbbb", !kCopied, 0, 0);
  run_ = with_chunk(run_, "xccc", kCopied, kNoMesh, kNoSegment);
  run_ = with_chunk(run_, "META", kCopied, kNoMesh, kNoSegment, "{}");
  const Bytes made[] = {join_clips({{"run", run_}, {"walk", walk_}}),
                        add_clips({"walk", walk_}, {"run", run_})};
  for (const Bytes& file : made) {
    EXPECT_THAT(copied_chunks(file), SizeIs(6));
    EXPECT_THAT(lines(file),
                ElementsAre("run: leaves out chunk xbbb, which this version does not know",
                            "run: leaves out chunk xccc: only that of the first file is kept",
                            "run: leaves out chunk META: only that of the first file is kept",
                            "walk: leaves out chunk xaaa, which this version does not know"));
  }
}

TEST_F(LeftOut, EditsSayWhichRecordsTheyWriteWithoutFields) {
  EditedFile edited(walk_);
  for (Bytes* payload : {&edited.part("LIMI").payload, &edited.part("CLIP").payload})
    payload->insert(payload->end(), {77, 1, 0});
  walk_ = edited.bytes();
  const auto expected =
      ElementsAre("walk: leaves out fields of chunk LIMI that this version does not know",
                  "walk: leaves out fields of chunk CLIP that this version does not know");
  EXPECT_THAT(lines(join_clips({{"run", run_}, {"walk", walk_}})), expected);
  EXPECT_THAT(lines(add_clips({"walk", walk_}, {"run", run_})), expected);
}

TEST_F(LeftOut, EditsRefuseRequiredChunksThatTheyDoNotKnow) {
  EditedFile edited(run_);
  edited.parts.back().chunk.required = true;
  const Bytes needs = edited.bytes();
  const std::vector<std::function<void()>> edits = {[&] {
                                                      join_clips({{"walk", walk_}, {"run", needs}});
                                                    },
                                                    [&] {
                                                      add_clips({"walk", walk_}, {"run", needs});
                                                    },
                                                    [&] {
                                                      add_clips({"run", needs}, {"walk", walk_});
                                                    },
                                                    [&] {
                                                      remove_clips({"run", needs}, {"run"});
                                                    }};
  for (const auto& edit : edits)
    EXPECT_THAT(refusal_of(edit),
                HasSubstr("run: has a chunk xseg that this version does not know"));
}

}  // namespace
}  // namespace anicodec
