#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct gzFile_s;

namespace grove {

/// A file read once from front to back through a small buffer; gzip-compressed files (told from the content) are inflated on the way, never
/// further than they are asked for. Every failure is an InputError naming the file and the place.
class ByteStream {
 public:
  /// The longest piece that `take` gives, and longer than any line or word that is accepted.
  static constexpr std::size_t kMaxTake = 1U << 16;

  explicit ByteStream(const std::filesystem::path& file);

  /// The next `count` <= kMaxTake bytes, valid until the next call of anything.
  const std::byte* take(std::size_t count) {
    if (end_ - begin_ < count) refill(count);
    const std::byte* const data = buffer_.data() + begin_;
    begin_ += count;
    return data;
  }

  void skip(std::uint64_t count);

  /// The next line without its end ("\n" or "\r\n"), valid until the next call.
  std::string_view line();

  /// The next word between white space, valid until the next call. Counts the lines it passes.
  std::string_view word();

  /// Bytes taken so far, after inflating.
  [[nodiscard]] std::uint64_t position() const { return buffer_position_ + begin_; }
  /// No more bytes than this can follow: exact for plain files, from deflate's best ratio for compressed ones.
  [[nodiscard]] std::uint64_t remaining_at_most() const;
  [[nodiscard]] bool is_compressed() const { return compressed_; }
  [[nodiscard]] bool is_empty() const { return file_bytes_ == 0; }

  /// Throws InputError at the current line.
  [[noreturn]] void fail_at_line(std::string_view problem) const;
  /// Throws InputError at the current byte.
  [[noreturn]] void fail_at_byte(std::string_view problem) const;

 private:
  struct Close {
    void operator()(gzFile_s* file) const;
  };

  // Makes `count` bytes available or throws.
  void refill(std::size_t count);
  // Reads once more into the buffer, keeping what is not taken yet; false at the end of the file.
  bool read_more();

  std::string name_;
  std::unique_ptr<gzFile_s, Close> file_;
  std::uint64_t file_bytes_ = 0;
  bool compressed_ = false;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t buffer_position_ = 0;  // of buffer_[0] in the inflated file
  std::uint64_t line_ = 1;
};

}  // namespace grove
