#include "emulator/clock/asio.h"

#include <spdlog/spdlog.h>

namespace echoloop {

void Serving::operator()(std::exception_ptr error) const {
    if (!error) return;
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& e) {
        spdlog::critical("{}: stopped by a bug in this program: {}; please report it", what_, e.what());
    }
}

}  // namespace echoloop
