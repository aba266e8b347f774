#include "grove/base/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "grove/base/error.h"

namespace grove {
namespace {

/// How many other writers may be at the same file in one process.
constexpr int kMostTemporaryNames = 1000;

std::filesystem::path temporary_name(const std::filesystem::path& path, int attempt) {
  std::filesystem::path name = path;
  name += "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
  return name;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path), final_path_(path) {
  std::error_code error;
  if (path.empty()) fail(ENOENT);
  // Renaming onto a link would replace the link, so the name at its end is used.
  // A file that is not there yet sets `error` as well, which is no failure.
  if (std::filesystem::is_symlink(path, error)) {
    final_path_ = std::filesystem::weakly_canonical(path, error);
    if (error) fail(error.value());
  }
  const std::filesystem::file_status status = std::filesystem::status(final_path_, error);
  if (std::filesystem::is_directory(status)) fail(EISDIR);
  if (std::filesystem::exists(status) && ::access(final_path_.c_str(), W_OK) != 0) fail(errno);

  int descriptor = -1;
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    working_path_ = final_path_;
    descriptor = ::open(working_path_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    for (int attempt = 0; attempt < kMostTemporaryNames; ++attempt) {
      working_path_ = temporary_name(final_path_, attempt);
      descriptor = ::open(working_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0 || errno != EEXIST) break;
    }
  }
  if (descriptor < 0) fail(errno);
  file_ = ::fdopen(descriptor, "wb");
  if (file_ == nullptr) {
    const int error_number = errno;
    ::close(descriptor);
    discard();
    fail(error_number);
  }
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) {
    std::fclose(file_);
    discard();
  }
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (size > 0 && std::fwrite(bytes, 1, size, file_) != size) fail(errno);
}

void OutputFile::sync() {
  // Pipes and devices have no disk to wait for.
  if (std::fflush(file_) != 0 || (::fsync(::fileno(file_)) != 0 && errno != EINVAL && errno != ENOTSUP)) fail(errno);
}

void OutputFile::commit() {
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || (working_path_ != final_path_ && std::rename(working_path_.c_str(), final_path_.c_str()) != 0)) {
    const int error_number = errno;
    discard();
    fail(error_number);
  }
}

void OutputFile::discard() noexcept {
  if (working_path_ != final_path_) ::unlink(working_path_.c_str());
}

void OutputFile::fail(int error_number) const {
  throw OutputError(path_.string() + ": cannot be written (" + std::generic_category().message(error_number) + ")");
}

void check_writable(const std::filesystem::path& path) {
  const OutputFile probe(path);
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace grove
