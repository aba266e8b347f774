#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace grove {

/// A file that appears whole or not at all: it is written under a temporary name beside `path`, which `commit` renames. What already
/// exists at `path` stays until then. A symbolic link is followed; a device or a pipe is written to directly. One thread at a time.
class OutputFile {
 public:
  /// Makes the temporary file. Throws OutputError when it cannot be made, or `path` is a directory or write-protected.
  explicit OutputFile(const std::filesystem::path& path);
  /// Removes the temporary file unless it was committed.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes. Throws OutputError when they cannot be written (a full disk).
  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Waits until what was written is on the disk, so that not even a power cut can leave less under the final name. Throws OutputError.
  void sync();

  /// Where the bytes go until `commit`, for writers that want a name: they may open and overwrite it, if `write` is not used.
  [[nodiscard]] const std::filesystem::path& working_path() const { return working_path_; }

  /// Closes the file and gives it its name. Throws OutputError when that fails.
  void commit();

 private:
  [[noreturn]] void fail(int error_number) const;
  void discard() noexcept;

  std::filesystem::path path_;          // as the caller named it, for messages
  std::filesystem::path final_path_;    // after links
  std::filesystem::path working_path_;  // equal to final_path_ for what is not a regular file
  std::FILE* file_ = nullptr;
};

/// Throws OutputError unless a file can be made at `path` now. Leaves no trace.
void check_writable(const std::filesystem::path& path);

/// Writes `text` to a file as OutputFile does.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace grove
