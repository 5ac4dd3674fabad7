#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

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
    Format{".xtf", "imagenex", "replies of an Imagenex 872", make_xtf_872, "IGX"},
};

}  // namespace

std::vector<Format> formats_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::vector<Format> found;
    std::ranges::copy_if(formats, std::back_inserter(found),
                         [&](const Format& format) { return format.ending == ending; });
    return found;
}

std::string endings() {
    std::string out;
    std::string_view last;
    for (const Format& format : formats) {
        if (format.ending == last) continue;
        last = format.ending;
        out += std::string(out.empty() ? "" : ", ") + std::string(last);
    }
    return out;
}

}  // namespace echoloop::convert
