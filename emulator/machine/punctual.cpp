#include "emulator/machine/punctual.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
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

void wake_on_time() {
    constexpr std::uint64_t shortest_turn = 100'000;
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    SchedulingAttributes attributes;
    if (::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
    if (attributes.policy != SCHED_OTHER) return;
    attributes.runtime = shortest_turn;
    ::syscall(SYS_sched_setattr, 0, &attributes, 0);
}

void claim_real_time(Turn turn) {
    sched_param priority{};
    priority.sched_priority = static_cast<int>(turn);
    const int policy = turn == Turn::wires ? SCHED_FIFO | SCHED_RESET_ON_FORK : SCHED_FIFO;
    if (::sched_setscheduler(0, policy, &priority) != 0)
        refuse("the scheduler", "allow it with `ulimit -r 10`, or `setcap cap_sys_nice+ep` on the program");
}

void give_turn(pthread_t thread, Turn turn) {
    sched_param priority{};
    priority.sched_priority = static_cast<int>(turn);
    ::pthread_setschedparam(thread, turn == Turn::ordinary ? SCHED_OTHER : SCHED_FIFO, &priority);
}

void lock_memory() {
    if (::mlockall(may_lock_all() ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) != 0)
        refuse(
            "locking memory",
            "allow it with `ulimit -l unlimited`, or `setcap cap_sys_nice,cap_ipc_lock+ep` on the program");
}

}  // namespace echoloop
