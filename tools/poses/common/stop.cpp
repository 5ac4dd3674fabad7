#include "tools/poses/common/stop.h"

#include <atomic>
#include <csignal>

namespace echoloop::poses {
namespace {

std::atomic<bool> raised = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // or a signal must not touch it

void raise_flag(int) { raised = true; }

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = raise_flag;  // without SA_RESTART: waits end at once
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
}

bool stopped() { return raised; }

}  // namespace echoloop::poses
