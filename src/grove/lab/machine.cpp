#include "grove/lab/machine.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/utsname.h>

#include <fstream>

#include "grove_commit.h"

namespace grove {
namespace {

/// The first "model name" of /proc/cpuinfo; other systems and some processors have none.
std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t first = line.find_first_not_of(" \t", line.find(':') + 1);
    if (first != std::string::npos) return line.substr(first);
  }
  return "unknown";
}

std::string system_name() {
  utsname names{};
  if (::uname(&names) != 0) return "unknown";
  return std::string(names.sysname) + " " + names.release + " " + names.machine;
}

std::string compiler_name() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

Machine describe_machine() {
  Machine machine;
  machine.cpu = cpu_name();
  machine.cores = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
  machine.threads = static_cast<unsigned>(oneapi::tbb::this_task_arena::max_concurrency());
  machine.compiler = compiler_name();
  machine.commit = kBuiltCommit;
  machine.os = system_name();
  return machine;
}

}  // namespace grove
