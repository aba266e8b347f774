#pragma once

#ifdef __linux__
#include <sched.h>
#endif

namespace grove {

/// Keeps the calling thread on one core for as long as it lives.
class Pinned {
 public:
  Pinned() {
#ifdef __linux__
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int core = 0; core < CPU_SETSIZE; ++core) {
      if (!CPU_ISSET(core, &before_)) continue;
      CPU_SET(core, &one);
      break;
    }
    sched_setaffinity(0, sizeof one, &one);
#endif
  }
  ~Pinned() {
#ifdef __linux__
    sched_setaffinity(0, sizeof before_, &before_);
#endif
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;

 private:
#ifdef __linux__
  cpu_set_t before_{};
#endif
};

}  // namespace grove
