#include "grove/scene/formats/byte_stream.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "grove/base/check.h"
#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::size_t kBufferBytes = 4 * ByteStream::kMaxTake;
// Deflate cannot do better than 1032:1 (zlib's technical notes, "Maximum Compression Factor").
constexpr std::uint64_t kBestDeflateRatio = 1032;

bool is_space(std::byte b) {
  const char c = static_cast<char>(b);
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

void ByteStream::Close::operator()(gzFile_s* file) const {
  gzclose_r(file);
}

ByteStream::ByteStream(const std::filesystem::path& file) : name_(file.string()) {
  std::error_code error;
  file_bytes_ = std::filesystem::file_size(file, error);
  if (error) throw InputError(name_, "", "cannot be read: " + error.message());
  errno = 0;
  file_.reset(gzopen(file.c_str(), "rb"));
  if (file_ == nullptr) throw InputError(name_, "", "cannot be read: " + std::generic_category().message(errno));
  gzbuffer(file_.get(), 1U << 17);
  buffer_.resize(kBufferBytes);
  read_more();
  compressed_ = gzdirect(file_.get()) == 0;
}

bool ByteStream::read_more() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  buffer_position_ += begin_;
  end_ -= begin_;
  begin_ = 0;
  const int got = gzread(file_.get(), buffer_.data() + end_, static_cast<unsigned>(buffer_.size() - end_));
  int code = Z_OK;
  const char* const message = gzerror(file_.get(), &code);
  if (got < 0 || (code != Z_OK && code != Z_STREAM_END)) {
    if (code == Z_BUF_ERROR) fail_at_byte("the compressed file is cut short");
    fail_at_byte(std::string("cannot be read: ") + (code == Z_ERRNO ? std::generic_category().message(errno) : message));
  }
  end_ += static_cast<std::size_t>(got);
  return got > 0;
}

void ByteStream::refill(std::size_t count) {
  GROVE_CHECK(count <= kMaxTake);
  while (end_ - begin_ < count) {
    if (!read_more()) {
      begin_ = end_;
      fail_at_byte("the file ends here, but more was announced; it is cut short");
    }
  }
}

void ByteStream::skip(std::uint64_t count) {
  while (count > 0) {
    const std::size_t piece = static_cast<std::size_t>(std::min<std::uint64_t>(count, kMaxTake));
    take(piece);
    count -= piece;
  }
}

std::string_view ByteStream::line() {
  std::size_t length = 0;
  for (;;) {
    const auto* const first = reinterpret_cast<const char*>(buffer_.data() + begin_);
    const void* const newline = std::memchr(first + length, '\n', end_ - begin_ - length);
    if (newline != nullptr) {
      std::string_view text(first, static_cast<std::size_t>(static_cast<const char*>(newline) - first));
      begin_ += text.size() + 1;
      ++line_;
      if (text.ends_with('\r')) text.remove_suffix(1);
      return text;
    }
    length = end_ - begin_;
    if (length > kMaxTake) fail_at_line("the line is longer than 65536 characters");
    if (!read_more()) fail_at_line("the file ends inside the header; it is cut short");
  }
}

std::string_view ByteStream::word() {
  for (;;) {
    while (begin_ < end_ && is_space(buffer_[begin_])) {
      if (static_cast<char>(buffer_[begin_]) == '\n') ++line_;
      ++begin_;
    }
    if (begin_ < end_) break;
    if (!read_more()) fail_at_line("the file ends here, but more was announced; it is cut short");
  }
  std::size_t length = 0;
  for (;;) {
    while (begin_ + length < end_ && !is_space(buffer_[begin_ + length])) ++length;
    if (begin_ + length < end_) break;
    if (length > 256) fail_at_line("a word of more than 256 characters where a number should be");
    if (!read_more()) break;
  }
  const std::string_view text(reinterpret_cast<const char*>(buffer_.data() + begin_), length);
  begin_ += length;
  return text;
}

std::uint64_t ByteStream::remaining_at_most() const {
  const std::uint64_t inflated_at_most = compressed_ ? file_bytes_ * kBestDeflateRatio : file_bytes_;
  return inflated_at_most - std::min(inflated_at_most, position());
}

void ByteStream::fail_at_line(std::string_view problem) const {
  throw InputError(name_, "line " + std::to_string(line_), problem);
}

void ByteStream::fail_at_byte(std::string_view problem) const {
  throw InputError(name_, "byte " + std::to_string(position()), problem);
}

}  // namespace grove
