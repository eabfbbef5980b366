// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// info, verify, dump and decode on good and damaged files.
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"
#include "tools/listing/listing.h"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A folder with an encoded clip, a.anic.
class InspectCommand : public testing::Test {
 protected:
  InspectCommand() {
    write_sequence(folder_ / "a.pc2", corpus::make_clip("nonmanifold"));
    Outcome outcome =
        anicodec({"encode", folder_ / "a.pc2", "-o", folder_ / "a.anic", "--basis", "keyframes"});
    EXPECT_EQ(outcome.status, 0) << outcome;
    bytes_ = folder_.read("a.anic");
  }

  std::vector<ListedField> fields(const std::string& bytes) {
    return list_fields({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  }

  TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(InspectCommand, InfoAccountsForTheWholeFile) {
  Outcome outcome = anicodec({"info", folder_ / "a.anic", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  nlohmann::json info = outcome.json();
  MeshSequence clip = corpus::make_clip("nonmanifold");
  EXPECT_EQ(info["bytes"], bytes_.size());
  EXPECT_EQ(info["vertices"], clip.vertex_count);
  EXPECT_EQ(info["frames"], clip.frame_count);
  EXPECT_EQ(info["faces"], clip.polygons.size());
  EXPECT_EQ(info["order"], "vertices");
  EXPECT_GT(info["resident_bytes"], 0);
  EXPECT_GT(info["opening_bytes"], info["resident_bytes"]);
  EXPECT_GT(info["context_bytes"], 0);
  EXPECT_EQ(info["segments"][0]["basis"], "keyframes");
  EXPECT_EQ(info["segments"][0]["coder"], "native");
  EXPECT_TRUE(info["features"].empty());
  size_t end = info["chunks"][0]["offset"];
  for (const nlohmann::json& chunk : info["chunks"]) {
    EXPECT_EQ(chunk["offset"], end);
    end = size_t(chunk["offset"]) + size_t(chunk["size"]);
  }
  EXPECT_EQ(end, bytes_.size());
}

TEST_F(InspectCommand, InfoMatchesCompare) {
  nlohmann::json info = anicodec({"info", folder_ / "a.anic", "--json"}).json();
  nlohmann::json compared =
      anicodec({"compare", folder_ / "a.pc2", folder_ / "a.anic", "--json"}).json();
  for (const char* key : {"kg", "rmse", "max_error", "max_error_percent", "diagonal", "bpfv"})
    EXPECT_NEAR(info[key], compared[key], 1e-9 * double(compared[key])) << key;
}

TEST_F(InspectCommand, InfoIsReadable) {
  Outcome outcome = anicodec({"info", folder_ / "a.anic"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("asked      max error of at most"), HasSubstr("LIMI"),
                                 HasSubstr("24 fps (assumed)")));
}

TEST_F(InspectCommand, VerifySaysOk) {
  Outcome outcome = anicodec({"verify", folder_ / "a.anic"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("a.anic: ok"));
  EXPECT_EQ(anicodec({"verify", folder_ / "a.anic", "-q"}).out, "");
}

/// Offsets without gaps from 0 to the end, and no byte whose meaning is unknown.
void expect_complete(const std::vector<ListedField>& fields, size_t size) {
  uint64_t end = 0;
  for (const ListedField& field : fields) {
    EXPECT_EQ(field.offset, end) << field.name;
    EXPECT_THAT(field.value, testing::Not(HasSubstr("missing"))) << field.name;
    EXPECT_THAT(field.name, testing::Not(HasSubstr("not understood")));
    if (field.name.ends_with(" data")) {
      EXPECT_THAT(field.name, AnyOf(StartsWith("VMAP"), StartsWith("FMAP"), StartsWith("BASI"),
                                    StartsWith("CORR")));
    }
    end = field.offset + field.size;
  }
  EXPECT_EQ(end, size);
}

TEST_F(InspectCommand, DumpListsEveryByteOnce) {
  expect_complete(fields(bytes_), bytes_.size());
  for (const char* basis : {"eigenshapes", "eigentrajectories"}) {
    ASSERT_EQ(anicodec({"encode", folder_ / "a.pc2", "-o", folder_ / "b.anic", "-f", "--basis",
                        basis, "--order", "all"})
                  .status,
              0);
    std::string bytes = folder_.read("b.anic");
    expect_complete(fields(bytes), bytes.size());
  }
  Outcome outcome = anicodec({"dump", folder_ / "a.anic"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, AllOf(StartsWith("00000000         8  magic"), HasSubstr("(LIMI)"),
                                 HasSubstr("CLIP name"), HasSubstr("\"a\"")));
}

TEST_F(InspectCommand, DumpGoesAsFarAsItCan) {
  for (size_t size = 0; size <= bytes_.size(); ++size) {
    uint64_t end = 0;
    for (const ListedField& field : fields(bytes_.substr(0, size))) {
      ASSERT_EQ(field.offset, end) << size;
      end = field.offset + field.size;
    }
    ASSERT_EQ(end, size);
  }
  folder_.write("cut.anic", bytes_.substr(0, bytes_.size() / 2));
  Outcome outcome = anicodec({"dump", folder_ / "cut.anic"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("magic"));
}

TEST_F(InspectCommand, ATruncatedFileIsCorrupt) {
  for (size_t size : {size_t{0}, size_t{5}, size_t{8}, size_t{39}, size_t{41}, bytes_.size() / 2,
                      bytes_.size() - 1}) {
    folder_.write("cut.anic", bytes_.substr(0, size));
    for (const char* command : {"info", "verify"}) {
      Outcome outcome = anicodec({command, folder_ / "cut.anic"});
      EXPECT_EQ(outcome.status, 3) << size << outcome;
      EXPECT_THAT(outcome.err, StartsWith("anicodec: " + (folder_ / "cut.anic") + ": "));
    }
    Outcome outcome = anicodec({"decode", folder_ / "cut.anic", "-o", folder_ / "new/out.pc2"});
    EXPECT_EQ(outcome.status, 3) << size << outcome;
    EXPECT_THAT(folder_.files(), ElementsAre("a.anic", "a.obj", "a.pc2", "cut.anic"));
  }
}

TEST_F(InspectCommand, ADamagedByteIsFoundAndLocated) {
  std::string damaged = bytes_;
  damaged[damaged.size() - 3] ^= 0x10;
  folder_.write("bad.anic", damaged);
  for (const char* command : {"verify", "info"}) {
    Outcome outcome = anicodec({command, folder_ / "bad.anic"});
    EXPECT_EQ(outcome.status, 3) << outcome;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("offset 0x"), HasSubstr("chunk "),
                                   HasSubstr("chunk checksum mismatch")));
  }
}

TEST_F(InspectCommand, AnotherMajorVersionIsUnsupported) {
  for (const auto& [major, what] :
       {std::pair{'\2', "a later major version"}, {'\0', "a draft of the format, 0.x"}}) {
    std::string other = bytes_;
    other[8] = major;
    folder_.write("other.anic", other);
    Outcome outcome = anicodec({"verify", folder_ / "other.anic"});
    EXPECT_EQ(outcome.status, 4) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr(what));
  }
}

TEST_F(InspectCommand, AnotherFormatIsNamed) {
  for (const char* command : {"verify", "info", "dump"}) {
    const Outcome outcome = anicodec({command, folder_ / "a.obj"});
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("is no .anic file; encode makes one of a scene")) << command;
  }
  folder_.write("b.anic", "no clip at all");
  const Outcome outcome = anicodec({"verify", folder_ / "b.anic"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("not an anicodec file"));
}

TEST_F(InspectCommand, DecodeRefusesWhatItCannotWrite) {
  auto decode = [&](const std::string& output) {
    return anicodec({"decode", folder_ / "a.anic", "-o", folder_ / output});
  };
  EXPECT_EQ(decode("x.fbx").status, 1);
  EXPECT_EQ(decode("x.obj").status, 1);
  EXPECT_EQ(decode("a.pc2").status, 1);
  EXPECT_EQ(
      anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "x.pc2", "--quality", "2"}).status,
      1);
  EXPECT_THAT(folder_.files(), ElementsAre("a.anic", "a.obj", "a.pc2"));
}

TEST_F(InspectCommand, SeveralFilesEachHaveTheirSay) {
  folder_.write("b.anic", bytes_);
  folder_.write("bad.anic", bytes_.substr(0, bytes_.size() / 2));
  const std::vector<std::string> files = {folder_ / "a.anic", folder_ / "bad.anic",
                                          folder_ / "b.anic"};
  for (const char* command : {"info", "verify"}) {
    const Outcome outcome = anicodec({command, files[0], files[1], files[2], "--json"});
    EXPECT_EQ(outcome.status, 3) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("1 of 3 files failed, the first is " + files[1]));
    std::vector<nlohmann::json> lines;
    std::istringstream text(outcome.out);
    for (std::string line; std::getline(text, line);)
      lines.push_back(nlohmann::json::parse(line));
    ASSERT_EQ(lines.size(), 4U) << outcome.out;
    EXPECT_EQ(lines[0]["file"], files[0]);
    EXPECT_EQ(lines[1]["status"], 3);
    EXPECT_EQ(lines[2]["file"], files[2]);
  }
}

TEST_F(InspectCommand, SeveralFilesAreDecodedToAFolder) {
  folder_.write("b.anic", bytes_);
  const std::string a = folder_ / "a.anic", b = folder_ / "b.anic", out = folder_ / "out";
  EXPECT_EQ(anicodec({"decode", a, b, "-o", out}).status, 1);
  const Outcome caches = anicodec({"decode", a, b, "-o", out, "--format", "pc2"});
  ASSERT_EQ(caches.status, 0) << caches;
  EXPECT_EQ(folder_.read("out/a.pc2"), folder_.read("out/b.pc2"));
  EXPECT_FALSE(folder_.read("out/b.obj").empty());
  ASSERT_EQ(anicodec({"decode", a, "-o", out, "--format", "ply"}).status, 0);
  EXPECT_THAT(folder_.read("out/a/frame_0000.ply"), StartsWith("ply"));
  EXPECT_THAT(anicodec({"decode", a, a, "-o", out, "--format", "glb"}).err,
              HasSubstr("and so would"));
}

TEST_F(InspectCommand, DecodeGivesACoarserClipAtLowerQuality) {
  ASSERT_EQ(
      anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b.pc2", "--quality", "0.4"}).status,
      0);
  nlohmann::json full =
      anicodec({"compare", folder_ / "a.pc2", folder_ / "a.anic", "--json"}).json();
  nlohmann::json coarse =
      anicodec({"compare", folder_ / "a.pc2", folder_ / "b.pc2", "--json"}).json();
  EXPECT_GE(double(coarse["kg"]), double(full["kg"]));
}

TEST(AnalyzeCommand, ErrorsFallWithTheNumberOfComponents) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_clip("limb"));
  Outcome outcome = anicodec({"analyze", folder / "a.pc2", "--counts", "2,4,8", "--csv"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.out, StartsWith("method,k,kg,rmse\n"));
  std::vector<double> pca;
  for (size_t at = 0; (at = outcome.out.find("\npca,", at)) != std::string::npos; ++at)
    pca.push_back(std::stod(outcome.out.substr(outcome.out.find(',', at + 5) + 1)));
  ASSERT_EQ(pca.size(), 3U);
  EXPECT_GT(pca[0], pca[1]);
  EXPECT_GT(pca[1], pca[2]);
  Outcome table = anicodec({"analyze", folder / "a.pc2", "--counts", "2,4,8"});
  EXPECT_THAT(table.out, AllOf(HasSubstr("gas"), HasSubstr("pivot"), HasSubstr("uniform")));
  Outcome spaces = anicodec({"analyze", folder / "a.pc2", "--counts", "2,4", "--csv", "--spaces"});
  EXPECT_THAT(spaces.out, StartsWith("space,k,kg,numbers,bytes,residual_percent\nvertices,2,"));
  EXPECT_THAT(spaces.out, AllOf(HasSubstr("\nedges,4,"), HasSubstr("\ngradients,4,")));
}

}  // namespace
}  // namespace anicodec::tools
