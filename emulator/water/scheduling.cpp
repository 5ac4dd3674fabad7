#include "emulator/water/scheduling.h"

#include <linux/sched/types.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace echoloop {
namespace {

/// A slice in ns for the calling thread, in place of the system's own of some milliseconds.
void set_slice(std::uint64_t slice) {
    sched_attr attributes{};
    attributes.size = sizeof attributes;
    if (::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
    constexpr std::uint32_t normal = 0;  // SCHED_OTHER; a user who chose another policy has reasons
    if (attributes.sched_policy != normal) return;
    attributes.sched_runtime = slice;
    ::syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace

void give_way(int nice) {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), nice);
    set_slice(static_cast<std::uint64_t>(nice) * 500'000);
}

void keep_rasterisers_on_their_threads() { ::setenv("LP_NUM_THREADS", "0", 0); }

void keep_freed_memory() {
#ifdef M_TRIM_THRESHOLD
    ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

}  // namespace echoloop
