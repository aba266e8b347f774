#include "grove/scene/read_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>

#include "grove/base/error.h"

namespace grove {

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(file.string(), "", "no such file");
  if (error) throw InputError(file.string(), "", "cannot be read: " + error.message());
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(status)) throw InputError(file.string(), "", "is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file.string(), "", "cannot be read: " + error.message());

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (stream == nullptr) throw InputError(file.string(), "", "cannot be read: " + std::generic_category().message(errno));
  std::vector<std::byte> bytes(size);
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stream.get()));
  if (bytes.size() != size) throw InputError(file.string(), "", "ended while it was read; try again");
  return bytes;
}

}  // namespace grove
