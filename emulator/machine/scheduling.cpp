#include "emulator/machine/scheduling.h"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

/// Of sched_setattr(2), for which the C library has neither a function nor a type.
struct SchedulingAttributes {
    std::uint32_t size = sizeof(SchedulingAttributes);
    std::uint32_t policy = SCHED_OTHER;
    std::uint64_t flags = 0;
    std::int32_t nice = 0;
    std::uint32_t priority = 0;
    std::uint64_t runtime = 0, deadline = 0, period = 0;  ///< ns
};

/// Of the calling thread, in ns, in place of the system's own of some milliseconds.
void set_slice(std::uint64_t slice) {
    SchedulingAttributes attributes;
    if (::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
    if (attributes.policy != SCHED_OTHER) return;  // a user who chose another policy has reasons
    attributes.runtime = slice;
    ::syscall(SYS_sched_setattr, 0, &attributes, 0);
}

/// With a limit, memory that is locked as it comes would run out in the middle of a run.
bool may_lock_all() {
    rlimit limit{};
    return ::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
    const bool denied = errno == EPERM || errno == ENOMEM;
    throw StartError(denied ? Exit::no_permission : Exit::unavailable,
                     "--realtime: " + what + ": " + std::strerror(errno) + "; " + remedy);
}

}  // namespace

void claim_real_time(Priority priority) {
    sched_param parameters{};
    parameters.sched_priority = static_cast<int>(priority);
    const int policy = priority == Priority::wires ? SCHED_FIFO | SCHED_RESET_ON_FORK : SCHED_FIFO;
    if (::sched_setscheduler(0, policy, &parameters) != 0)
        refuse("the scheduler", "allow it with `ulimit -r 10`, or `setcap cap_sys_nice+ep` on the program");
}

void lock_memory() {
    if (::mlockall(may_lock_all() ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) != 0)
        refuse(
            "locking memory",
            "allow it with `ulimit -l unlimited`, or `setcap cap_sys_nice,cap_ipc_lock+ep` on the program");
}

void wake_on_time() {
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    set_slice(100'000);
}

void give_way(int nice) {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice);
    set_slice(static_cast<std::uint64_t>(nice) * 500'000);
}

void keep_rasterisers_on_their_threads() { ::setenv("LP_NUM_THREADS", "0", 0); }

void keep_freed_memory() {
#ifdef M_TRIM_THRESHOLD
    ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

void return_freed_memory() {
#ifdef M_TRIM_THRESHOLD
    ::malloc_trim(0);
#endif
}

}  // namespace echoloop
