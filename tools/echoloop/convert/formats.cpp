#include <algorithm>
#include <array>
#include <cctype>

#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

constexpr std::array formats{
    Format{".kmall", "kmall", "KMALL datagrams", make_kmall},
    Format{".kmwcd", "kmall", "KMALL datagrams", make_kmall},
    Format{".s7k", "reson7k", "7k records", make_s7k},
    Format{".svlog", "cerulean", "frames of a Cerulean sonar", make_svlog},
    Format{".bin", "ping", "frames of a Ping sonar", make_ping_viewer_log},
    Format{".aris", "aris", "frames of an ARIS", make_aris},
    Format{".jsf", "edgetech", "data of an EdgeTech side-scan", make_jsf, "SonarData"},
    Format{".xtf", "edgetech", "data of an EdgeTech side-scan", make_xtf, "SonarData"},
};

}  // namespace

const Format* format_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto found = std::ranges::find(formats, ending, &Format::ending);
    return found == formats.end() ? nullptr : &*found;
}

std::string endings() {
    std::string out;
    for (const Format& format : formats)
        out += std::string(out.empty() ? "" : ", ") + std::string(format.ending);
    return out;
}

}  // namespace echoloop::convert
