#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/scene/gltf/json_cursor.h"

namespace grove {

/// A glTF file in memory: its JSON and the bytes that it refers to. Checks the container, the version and the required extensions when
/// made; reads a buffer the first time that it is asked for. Not for use by several threads.
class GltfDocument {
 public:
  /// Throws InputError when the file is not a glTF 2.x that can be read.
  explicit GltfDocument(const std::filesystem::path& file);
  ~GltfDocument();
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] JsonCursor root() const { return root_; }
  /// `root()[name]`, kept: the arrays that the parts of the file index.
  [[nodiscard]] JsonCursor array(std::string_view name) const { return root_[name]; }

  /// The bytes of buffer view `id`. Throws InputError when it, its buffer or its range is not there.
  [[nodiscard]] std::span<const std::byte> view(std::uint32_t id);
  /// What a `uri` at `place` names: a data URI's bytes, or a file's beside this one.
  [[nodiscard]] std::vector<std::byte> read_uri(const JsonCursor& place);

  /// Counts bytes that a part of the file grows to in memory. Throws InputError at `place` when all of them together are out of
  /// proportion to what the file holds, as when a thousand meshes share one array.
  void charge(std::uint64_t bytes, const JsonCursor& place);
  /// Bytes of the file and of all buffers read so far.
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }

  /// True the first time that it is asked for this kind of trouble.
  [[nodiscard]] bool is_first(const std::string& kind) { return seen_.insert(kind).second; }

 private:
  const std::vector<std::byte>& buffer(std::uint32_t id);
  void check_asset() const;
  void check_extensions() const;

  std::string file_;
  std::unique_ptr<nlohmann::json> json_;
  JsonCursor root_;
  /// The binary chunk of a .glb.
  std::optional<std::vector<std::byte>> binary_;
  std::vector<std::optional<std::vector<std::byte>>> buffers_;
  std::uint64_t bytes_read_ = 0;
  std::uint64_t charged_ = 0;
  std::set<std::string> seen_;
};

/// The optional extensions that `document` uses and Grove does not know, in the file's order.
[[nodiscard]] std::vector<std::string> ignored_extensions(const GltfDocument& document);

}  // namespace grove
