// libFuzzer: any text as the first line of a client at a control place by TCP. Only the token lets it in.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "emulator/run/token.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string token = "0123456789abcdef0123456789abcdef";
    const std::string_view line(reinterpret_cast<const char*>(data), size);
    const bool escaped = line.find('\\') != line.npos;
    if (echoloop::tells_token(line, token) && !escaped && line.find(token) == line.npos) std::abort();
    if (!echoloop::tells_token(R"({"token": ")" + token + "\"}", token)) std::abort();
    return 0;
}
