#include "tools/poses/common/say.h"

#include <cstdio>

namespace echoloop::poses {
namespace {

std::string& program() {
    static std::string name = "echoloop-pose";
    return name;
}

}  // namespace

void name_program(const std::string& name) { program() = name; }

void say(const std::string& line) { std::fprintf(stderr, "%s: %s\n", program().c_str(), line.c_str()); }

std::string harmless(std::string_view text) {
    constexpr std::size_t most = 200;
    std::string shown;
    for (const char c : text.substr(0, most)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > most ? "..." : "");
}

}  // namespace echoloop::poses
