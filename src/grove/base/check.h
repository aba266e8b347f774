#pragma once

namespace grove {

/// Ends the process with the broken condition and its place: a bug in Grove or in the calling program, never bad input.
[[noreturn]] void fail_check(const char* condition, const char* file, int line);

}  // namespace grove

/// Always on. For bugs whose cost would be silent corruption.
#define GROVE_CHECK(condition) ((condition) ? static_cast<void>(0) : ::grove::fail_check(#condition, __FILE__, __LINE__))

/// On in builds without NDEBUG. For invariants in hot code.
#ifdef NDEBUG
#define GROVE_ASSERT(condition) static_cast<void>(0)
#else
#define GROVE_ASSERT(condition) GROVE_CHECK(condition)
#endif
