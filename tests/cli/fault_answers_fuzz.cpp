// libFuzzer: any bytes as what answers `echoloop fault`. Shown is an error, or lines without control
// characters.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "emulator/contract/error.h"
#include "tools/echoloop/fault_answer.h"

namespace {

bool is_shown(char c) { return c == '\n' || (static_cast<unsigned char>(c) >= ' ' && c != 127); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop;
    const std::string_view line(reinterpret_cast<const char*>(data), size);
    cli::is_welcome(line);
    try {
        if (!std::ranges::all_of(cli::text_of_answer(line), is_shown) || !cli::is_answer(line)) std::abort();
    } catch (const StartError& error) {
        if (!std::ranges::all_of(std::string(error.what()), is_shown)) std::abort();
    }
    return 0;
}
