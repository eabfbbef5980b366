// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Changes files of the format, one or several end to end, by what they consist of: fields and blocks of records, streams,
// chunks, whole files. Sizes, checksums and hashes of meshes and segments are made right again, so that decoding does not
// end at them. Linked with targets whose inputs are files: libFuzzer and replay.cpp call it.
#include "format/continuation.h"
#include "tests/fuzz/fuzz_file.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <random>
#include <utility>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace anicodec {
namespace {

constexpr size_t kMostFiles = 8, kMostParts = 64;

/// An input of the targets: files, and bytes that decide what is done with them.
struct Input {
  std::vector<FuzzParts> files;
  Bytes rest;
};

Input input_of(ByteView bytes) {
  Input input;
  FuzzParts file;
  while (input.files.size() < kMostFiles && bytes.size >= kHeaderBytes &&
         std::equal(std::begin(kMagic), std::end(kMagic), bytes.data) && file.read(bytes)) {
    bytes = {bytes.data + file.taken, bytes.size - file.taken};
    input.files.push_back(std::exchange(file, {}));
  }
  input.rest.assign(bytes.data, bytes.data + bytes.size);
  return input;
}

/// Value of the optional field 1 of 8 bytes that ends a record: hashes of what a file or segment continues.
void set_continued(Bytes* record, uint64_t value) {
  constexpr size_t kField = 10;
  if (record->size() < kField || (*record)[record->size() - kField] != 1 ||
      (*record)[record->size() - kField + 1] != 8)
    return;
  ByteWriter w;
  w.u64(value);
  std::copy(w.bytes().begin(), w.bytes().end(), record->end() - 8);
}

FuzzPart* find(FuzzParts* file, const char (&type)[5], uint16_t mesh, uint32_t segment) {
  for (FuzzPart& part : file->parts) {
    if (chunk_key(part.chunk) == std::tuple(chunk_type(type), mesh, segment))
      return &part;
  }
  return nullptr;
}

/// Lets segments continue the one before them, or that of the file before with their number, as it is now.
void mend_segments(FuzzParts* file, FuzzParts* before) {
  for (FuzzPart& part : file->parts) {
    if (part.chunk.type != chunk_type("SEGM"))
      continue;
    const uint32_t number = part.chunk.segment;
    for (auto [from, at] : {std::pair(file, number - 1), {before, number}, {before, number - 1}}) {
      const FuzzPart* record = from ? find(from, "SEGM", part.chunk.mesh, at) : nullptr;
      if (!record)
        continue;
      Vector<ByteView> layers;
      for (const FuzzPart& layer : from->parts) {
        if (layer.chunk.type == chunk_type("BASI") && layer.chunk.segment == at)
          layers.push_back(layer.payload);
      }
      set_continued(&part.payload, segment_identity(record->payload, layers));
      break;
    }
  }
}

Bytes written(Input* input) {
  Bytes all;
  Bytes meshes;  // the last file that has some
  for (size_t i = 0; i < input->files.size(); ++i) {
    FuzzParts& file = input->files[i];
    ContainerReader before;
    FuzzPart* limits = find(&file, "LIMI", kNoMesh, kNoSegment);
    if (limits && (file.features & kContinuation) && before.open(meshes).ok())
      set_continued(&limits->payload, mesh_hash(before));
    if (file.features & kLearningFeature)
      mend_segments(&file, i > 0 ? &input->files[i - 1] : nullptr);
    const Bytes bytes = file.write();
    all.insert(all.end(), bytes.begin(), bytes.end());
    if (!(file.features & kContinuation))
      meshes = bytes;
  }
  all.insert(all.end(), input->rest.begin(), input->rest.end());
  return all;
}

class FileMutator {
  uint32_t below(size_t limit) { return static_cast<uint32_t>(random_() % limit); }

  template <typename List>
  auto& any(List& list) {
    return list[below(std::size(list))];
  }

 public:
  FileMutator(Input* input, size_t room, unsigned seed)
      : input_(*input), room_(room), random_(seed) {}

  void change() {
    FuzzParts& file = any(input_.files);
    const uint32_t kind = below(32);
    if (kind < 4 || file.parts.empty())
      change_files();
    else if (kind < 8)
      change_chunks(&file);
    else if (kind < 10)
      mutate(&input_.rest);
    else
      change_payload(&any(file.parts));
  }

  /// Puts chunks of another input in the place of those of their type, or behind them.
  void cross(Input* other) {
    if (below(4) == 0) {
      append_file(any(other->files));
      return;
    }
    FuzzParts& file = any(input_.files);
    const FuzzParts& from = any(other->files);
    const FuzzPart* part = from.parts.empty() ? nullptr : &any(from.parts);
    if (!part)
      return;
    std::vector<FuzzPart*> same;
    for (FuzzPart& own : file.parts) {
      if (own.chunk.type == part->chunk.type)
        same.push_back(&own);
    }
    if (!same.empty() && below(8) != 0)
      any(same)->payload = part->payload;
    else if (file.parts.size() < kMostParts)
      file.parts.push_back(*part);
  }

 private:
  /// Lets libFuzzer change bytes, their number, too.
  void mutate(Bytes* bytes) {
    const size_t size = bytes->size(), most = size + 1 + std::min<size_t>(room_, 64 + size / 4);
    bytes->resize(most);
    bytes->resize(LLVMFuzzerMutate(bytes->data(), size, most));
  }

  static std::ptrdiff_t at(size_t offset) { return static_cast<std::ptrdiff_t>(offset); }

  static void replace(Bytes* bytes, size_t from, size_t size, const Bytes& by) {
    bytes->erase(bytes->begin() + at(from), bytes->begin() + at(from + size));
    bytes->insert(bytes->begin() + at(from), by.begin(), by.end());
  }

  void append_file(const FuzzParts& file) {
    if (input_.files.size() < kMostFiles)
      input_.files.push_back(file);
  }

  void change_files() {
    std::vector<FuzzParts>& files = input_.files;
    FuzzParts& file = any(files);
    switch (below(5)) {
      case 0:
        file.features ^= uint64_t{1} << below(5);
        break;
      case 1:
        append_file(FuzzParts(file));
        break;
      case 2:
        std::swap(file, any(files));
        break;
      case 3:
        if (files.size() > 1)
          files.erase(files.begin() + at(below(files.size())));
        break;
      default:
        append_continuation(file);
    }
  }

  /// Appends `file` as a continuation of itself.
  void append_continuation(const FuzzParts& file) {
    FuzzParts next = file;
    next.parts.erase(std::remove_if(next.parts.begin(), next.parts.end(),
                                    [](const FuzzPart& part) { return is_of_mesh(part.chunk); }),
                     next.parts.end());
    next.features |= kContinuation;
    FuzzPart* limits = find(&next, "LIMI", kNoMesh, kNoSegment);
    if (limits && !(file.features & kContinuation))
      limits->payload.insert(limits->payload.end(), {1, 8, 0, 0, 0, 0, 0, 0, 0, 0});
    append_file(next);
  }

  void change_chunks(FuzzParts* file) {
    std::vector<FuzzPart>& parts = file->parts;
    const uint32_t which = below(parts.size());
    FuzzPart& part = parts[which];
    switch (below(8)) {
      case 0:
        parts.erase(parts.begin() + which);
        break;
      case 1:
        if (parts.size() < kMostParts)
          parts.insert(parts.begin() + which, FuzzPart(part));
        break;
      case 2:
        std::swap(part, any(parts));
        break;
      case 3:
        part.payload = any(parts).payload;
        break;
      case 4:
        part.chunk.mesh = below(4) == 0 ? kNoMesh : static_cast<uint16_t>(below(3));
        break;
      case 5:
        part.chunk.segment = below(4) == 0 ? kNoSegment : below(6);
        break;
      case 6:
        (below(2) == 0 ? part.chunk.copied : part.chunk.required) ^= true;
        break;
      default:
        part.chunk.type = any(parts).chunk.type;
    }
  }

  void change_payload(FuzzPart* part) {
    Bytes& payload = part->payload;
    switch (below(6)) {
      case 0:
      case 1:
        change_number(&payload);
        break;
      case 2:
        change_float(&payload);
        break;
      case 3:
        change_block(*part);
        break;
      default:
        mutate(&payload);
    }
  }

  /// Writes another number in the place of a varint, mostly of those at the front.
  void change_number(Bytes* payload) {
    if (payload->empty())
      return;
    const size_t front = below(4) == 0 ? payload->size() : std::min<size_t>(payload->size(), 48);
    const uint32_t from = below(front);
    ByteReader reader({payload->data() + from, payload->size() - from});
    const uint64_t old = reader.varint();
    if (!reader.ok())
      return;
    constexpr uint64_t kTelling[] = {0,
                                     1,
                                     2,
                                     3,
                                     8,
                                     127,
                                     128,
                                     255,
                                     256,
                                     512,
                                     1024,
                                     16383,
                                     16384,
                                     65535,
                                     1 << 20,
                                     (1 << 24) - 1,
                                     UINT32_MAX / 3,
                                     INT32_MAX,
                                     UINT32_MAX,
                                     uint64_t{1} << 46,
                                     UINT64_MAX};
    const uint64_t values[] = {old + 1,          old - 1,       2 * old,      old / 2,
                               old + below(256), any(kTelling), any(kTelling)};
    ByteWriter w;
    w.varint(any(values));
    replace(payload, from, reader.position(), w.bytes());
  }

  void change_float(Bytes* payload) {
    constexpr double kTelling[] = {0.0,
                                   -0.0,
                                   1,
                                   -1,
                                   1e-300,
                                   5e-324,
                                   1e300,
                                   3.4e38,
                                   3.5e38,
                                   1e10,
                                   1e-10,
                                   16777216,
                                   std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()};
    ByteWriter w;
    if (below(4) == 0)
      w.f32(static_cast<float>(any(kTelling)));
    else
      w.f64(any(kTelling));
    const Bytes& value = w.bytes();
    if (payload->size() >= value.size())
      std::copy(value.begin(), value.end(),
                payload->begin() + below(std::min<size_t>(payload->size() - value.size() + 1, 64)));
  }

  /// Changes what is in a block, or a text, and its length with it.
  void change_block(FuzzPart& part) {
    ByteReader reader({part.payload.data(), part.payload.size()});
    uint32_t before = 0;  // blocks that are left alone
    if (part.chunk.type == chunk_type("SEGM")) {
      reader.u64();
      before = below(4);
    } else if (part.chunk.type == chunk_type("BASI")) {
      reader.varint();
    }
    for (; before > 0; --before)
      reader.raw(reader.varint());
    const size_t from = reader.position();
    const ByteView block = reader.raw(reader.varint());
    if (!reader.ok())
      return mutate(&part.payload);
    Bytes bytes(block.data, block.data + block.size);
    if (below(3) == 0)
      change_float(&bytes);
    else if (below(2) == 0)
      change_number(&bytes);
    else
      mutate(&bytes);
    ByteWriter w;
    w.varint(bytes.size());
    w.raw(bytes);
    replace(&part.payload, from, reader.position() - from, w.bytes());
  }

  Input& input_;
  size_t room_;
  std::minstd_rand random_;
};

/// Writes the input where it fits; else `size` bytes stay as they are.
size_t put(Input* input, uint8_t* data, size_t size, size_t max_size) {
  const Bytes bytes = written(input);
  if (bytes.size() > max_size)
    return size;
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

}  // namespace
}  // namespace anicodec

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  using namespace anicodec;
  Input input = input_of({data, size});
  constexpr unsigned kPlain = 16;  // one in so many is any bytes
  if (input.files.empty() || seed % kPlain == 0)
    return LLVMFuzzerMutate(data, size, max_size);
  FileMutator mutator(&input, max_size - std::min(size, max_size), seed / kPlain);
  mutator.change();
  if (seed / kPlain % 4 == 0)
    mutator.change();
  return put(&input, data, size, max_size);
}

extern "C" size_t LLVMFuzzerCustomCrossOver(const uint8_t* data, size_t size, const uint8_t* other,
                                            size_t other_size, uint8_t* out, size_t max_size,
                                            unsigned seed) {
  using namespace anicodec;
  Input input = input_of({data, size}), second = input_of({other, other_size});
  if (input.files.empty() || second.files.empty())
    return 0;
  FileMutator(&input, max_size, seed).cross(&second);
  return put(&input, out, 0, max_size);
}
