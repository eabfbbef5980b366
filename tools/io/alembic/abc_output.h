// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_OUTPUT_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_OUTPUT_H_

#include "tools/io/alembic/abc_hash.h"
#include "tools/io/alembic/abc_property.h"
#include "tools/io/alembic/abc_time.h"
#include "tools/io/alembic/ogawa_output.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Data that the whole archive shares: data by its digest, so that equal samples are stored once; texts
/// of metadata; time samplings.
class AbcShared {
 public:
  explicit AbcShared(AbcSink sink);

  OgawaOutput& file() { return file_; }

  /// A sample with its digest, stored or found. No bytes are empty data without one.
  OgawaChild sample(std::string_view bytes, const AbcHash& digest);

  /// The number of a text, 255 for one that goes with its header.
  uint32_t metadata(const std::string& text);

  /// The number of a time sampling, which is added where there is none like it.
  uint32_t sampling(const AbcTime& time);

  const AbcTime& time(uint32_t sampling) const { return samplings_[sampling].time; }

  /// Notes how many samples a property has.
  void count_samples(uint32_t sampling, uint32_t samples);

  OgawaChild write_samplings();
  OgawaChild write_metadata();

 private:
  struct Sampling {
    AbcTime time;
    uint32_t most = 0;
  };

  OgawaOutput file_;
  std::map<std::pair<AbcHash, uint64_t>, OgawaChild> samples_;  ///< by digest and size
  std::map<std::string, uint32_t> numbers_;
  std::vector<std::string> texts_;
  std::vector<Sampling> samplings_;
};

/// A property with its samples: those that repeat the one before take no bytes at the start and at
/// the end.
class AbcPropertyOutput {
 public:
  AbcPropertyOutput(AbcShared& shared, AbcProperty header);

  /// Adds a sample of whole elements.
  void add(std::string_view bytes);

  template <typename T>
  void add(std::span<const T> numbers) {
    add({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
  }

  template <typename T>
  void add_one(const T& number) {
    add(std::span<const T>(&number, 1));
  }

  /// Adds a sample that is the one before.
  void repeat();

  uint32_t samples() const { return header_.samples; }

  /// Writes the group of samples and appends the header; gives the hash of the property.
  AbcHash finish(OgawaChild& group, std::string& headers);

 private:
  void store();
  AbcHash digest_with_size() const;

  AbcShared& shared_;
  AbcProperty header_;
  std::vector<OgawaChild> children_;
  bool is_scalar_like_ = true, is_homogeneous_ = true;
  OgawaChild last_ = 0;
  AbcHash last_digest_ = {};
  uint64_t last_size_ = 0;
  AbcHash gathered_ = {};
};

/// Properties below an object or a property, in the order of their creation.
class AbcCompoundOutput {
 public:
  AbcCompoundOutput(AbcShared& shared, std::string name, std::string metadata);

  AbcPropertyOutput& scalar(std::string name, std::string metadata, AbcType type, uint32_t extent,
                            uint32_t sampling);
  AbcPropertyOutput& array(std::string name, std::string metadata, AbcType type, uint32_t extent,
                           uint32_t sampling);
  AbcCompoundOutput& compound(std::string name, std::string metadata);

  /// Writes all; gives the hash of each, one after the other.
  std::string finish(OgawaChild& group);

  /// The same as a property of another compound: appends its header, gives its hash.
  AbcHash finish(OgawaChild& group, std::string& headers);

 private:
  struct Member {
    std::unique_ptr<AbcPropertyOutput> property;
    std::unique_ptr<AbcCompoundOutput> compound;
  };

  AbcPropertyOutput& add(AbcProperty header);

  AbcShared& shared_;
  AbcProperty header_;
  std::vector<Member> members_;
};

/// An object of the hierarchy.
class AbcObjectOutput {
 public:
  AbcObjectOutput(AbcShared& shared, std::string name, std::string metadata);

  const std::string& name() const { return name_; }

  AbcCompoundOutput& properties() { return properties_; }

  AbcObjectOutput& child(std::string name, std::string metadata);

  /// The child of a name, null if there is none.
  AbcObjectOutput* find(std::string_view name) const;

  /// Writes the object and all below; gives its hash.
  AbcHash finish(OgawaChild& group);

 private:
  AbcShared& shared_;
  std::string name_, metadata_;
  AbcCompoundOutput properties_;
  std::vector<std::unique_ptr<AbcObjectOutput>> children_;
};

/// An archive as the reference library writes it, with the same hashes. Memory: 16 bytes for each
/// sample, 48 for each different one.
class AbcArchiveOutput {
 public:
  /// `metadata`: "key=value;...", ascending keys.
  AbcArchiveOutput(AbcSink sink, std::string metadata);

  AbcShared& shared() { return shared_; }

  AbcObjectOutput& top() { return top_; }

  /// Completes the file.
  void finish();

 private:
  AbcShared shared_;
  std::string metadata_;
  AbcObjectOutput top_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_OUTPUT_H_
