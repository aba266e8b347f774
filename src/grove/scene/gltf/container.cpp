#include "grove/scene/gltf/container.h"

#include <cstdint>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;  // "BIN"
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

std::uint32_t read_u32(std::span<const std::byte> data, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(data[offset + i]) << (8 * i);
  return value;
}

std::string_view as_text(std::span<const std::byte> data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

/// Takes the chunks of a .glb one by one: length, type, that many bytes.
class ChunkReader {
 public:
  ChunkReader(std::span<const std::byte> data, const std::string& file) : data_(data), file_(file) {}

  struct Chunk {
    std::uint32_t type;
    std::span<const std::byte> bytes;
  };

  std::optional<Chunk> next() {
    if (offset_ == data_.size()) return std::nullopt;
    const std::size_t left = data_.size() - offset_;
    const std::string place = "byte " + std::to_string(offset_);
    if (left < kChunkHeaderSize) throw InputError(file_, place, "a chunk header that is cut short");
    const std::uint32_t length = read_u32(data_, offset_);
    if (length > left - kChunkHeaderSize) {
      throw InputError(file_, place,
                       "a chunk of " + std::to_string(length) + " bytes where " + std::to_string(left - kChunkHeaderSize) + " are left");
    }
    const Chunk chunk{read_u32(data_, offset_ + 4), data_.subspan(offset_ + kChunkHeaderSize, length)};
    offset_ += kChunkHeaderSize + length;
    return chunk;
  }

 private:
  std::span<const std::byte> data_;
  const std::string& file_;
  std::size_t offset_ = kHeaderSize;
};

}  // namespace

GltfContainer split_container(std::span<const std::byte> data, const std::string& file) {
  if (data.size() < 4 || read_u32(data, 0) != kMagic) return {as_text(data), std::nullopt};
  if (data.size() < kHeaderSize) throw InputError(file, "", "a GLB header that is cut short");
  const std::uint32_t version = read_u32(data, 4);
  if (version != 2) throw InputError(file, "byte 4", "GLB version " + std::to_string(version) + "; version 2 is read");
  const std::uint32_t length = read_u32(data, 8);
  if (length > data.size() || length < kHeaderSize) {
    throw InputError(file, "byte 8",
                     "a GLB of " + std::to_string(length) + " bytes by its header, " + std::to_string(data.size()) + " by its size");
  }

  // Bytes after the length that the header gives belong to nobody.
  ChunkReader chunks(data.first(length), file);
  const auto first = chunks.next();
  if (!first || first->type != kJsonChunk) throw InputError(file, "byte 12", "the first chunk of a GLB must be JSON");
  GltfContainer container{as_text(first->bytes), std::nullopt};
  // Further chunks are for extensions; their lengths are checked all the same.
  while (const auto chunk = chunks.next()) {
    if (chunk->type == kBinaryChunk && !container.binary) container.binary = chunk->bytes;
  }
  return container;
}

}  // namespace grove
