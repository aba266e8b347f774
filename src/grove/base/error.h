#pragma once

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grove {

/// Base of every exception that the library throws. `what()` is one line for a person: what is wrong, where, what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or an input that cannot be used: unreadable, broken, over a limit. The command exits with 1.
class InputError : public Error {
 public:
  using Error::Error;

  /// Reads "file: problem", or "file:place: problem" when `place` (a line, a byte offset, a JSON path) is not empty.
  InputError(std::string_view file, std::string_view place, std::string_view problem);
};

/// A file that cannot be written. The command exits with 1.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// A wrong request: an unknown structure, key, value or option. The command exits with 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// What to tell a person who goes on without what threw: "out of memory" for std::bad_alloc, else its text.
[[nodiscard]] std::string reason_of(const std::exception& exception);

}  // namespace grove
