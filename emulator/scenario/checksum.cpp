#include "emulator/scenario/checksum.h"

namespace echoloop {
namespace {

struct Row {
    std::string_view model, family;
};
constexpr Row rows[] = {{"norbit-wbms", "norbit"}, {"nmea-echosounder", "nmea"}, {"omniscan450", "cerulean"},
                        {"ping1d", "ping"},        {"ping360", "ping"},          {"reson-7k", "reson7k"},
                        {"s500", "cerulean"},      {"sonar-3d-15", "sonar3d"},   {"surveyor240", "cerulean"}};

}  // namespace

std::string_view checksum_family(std::string_view model) {
    for (const Row& row : rows)
        if (row.model == model) return row.family;
    return {};
}

}  // namespace echoloop
