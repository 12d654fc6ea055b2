// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/parsing/container.h"

#include <cstring>
#include <limits>
#include <utility>

namespace gloam::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004e4942;   // "BIN"
constexpr std::uint64_t kHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;

Error container_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

/// Little-endian word at a byte offset, which must be in range.
std::uint32_t word(const std::vector<std::uint8_t>& bytes, std::uint64_t offset) {
  std::uint32_t value = 0;
  for (std::uint64_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

Status read_chunks(Container& file) {
  const std::vector<std::uint8_t>& bytes = file.bytes;
  if (bytes.size() < kHeaderSize + kChunkHeaderSize) return container_fault("is a .glb of less than 20 bytes");
  const std::uint32_t version = word(bytes, 4);
  if (version != 2)
    return container_fault("is a .glb of version " + std::to_string(version) + ", only version 2 is read");
  const std::uint64_t length = word(bytes, 8);
  if (length > bytes.size())
    return container_fault("is cut short: its header says " + std::to_string(length) + " bytes, there are " +
                           std::to_string(bytes.size()));
  file.length = length;
  file.json_offset = kHeaderSize + kChunkHeaderSize;
  file.json_size = word(bytes, kHeaderSize);
  const std::uint64_t json_end = file.json_offset + file.json_size;
  if (word(bytes, kHeaderSize + 4) != kJsonChunk) return container_fault("is a .glb whose first chunk is not JSON");
  if (file.json_size == 0 || json_end > length)
    return container_fault("is a .glb whose JSON chunk does not fit its length");
  if (json_end == length) return {};
  if (json_end + kChunkHeaderSize > length) return container_fault("is a .glb that ends within a chunk's header");
  const std::uint64_t bin_size = word(bytes, json_end);
  if (word(bytes, json_end + 4) != kBinChunk) return container_fault("is a .glb whose second chunk is not BIN");
  if (bin_size == 0 || bin_size % 4 != 0 || json_end + kChunkHeaderSize + bin_size > length)
    return container_fault("is a .glb whose BIN chunk of " + std::to_string(bin_size) +
                           " bytes does not fit its length");
  file.has_binary_chunk = true;
  return {};
}

}  // namespace

Result<Container> open_container(std::vector<std::uint8_t> bytes) {
  Container file;
  file.bytes = std::move(bytes);
  if (file.bytes.size() >= std::numeric_limits<std::uint32_t>::max()) return container_fault("is larger than 4 GiB");
  if (file.bytes.empty()) return container_fault("is empty");
  file.binary = file.bytes.size() >= 4 && word(file.bytes, 0) == kMagic;
  file.json_size = file.length = file.bytes.size();
  if (file.binary) GLOAM_TRY(read_chunks(file));
  return file;
}

}  // namespace gloam::gltf
