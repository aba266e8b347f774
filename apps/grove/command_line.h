#pragma once

#include <string>

namespace grove::app {

/// Keeps the command for `command_line`. Once, before any other thread is started.
void keep_command_line(int argument_count, const char* const* arguments);

/// The command as it was given, as a shell would take it again: "grove" and the arguments, in quotes where they need it.
[[nodiscard]] const std::string& command_line();

}  // namespace grove::app
