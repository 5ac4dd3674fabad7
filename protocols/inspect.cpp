#include "protocols/inspect.h"

#include <algorithm>
#include <array>

#include "protocols/altimeter/inspect.h"
#include "protocols/aris/inspect.h"
#include "protocols/cerulean/inspect.h"
#include "protocols/oculus/inspect.h"
#include "protocols/imagenex/delta_t_inspect.h"
#include "protocols/imagenex/inspect.h"
#include "protocols/kmall/inspect.h"
#include "protocols/nmea/inspect.h"
#include "protocols/norbit/inspect.h"
#include "protocols/ping/inspect.h"
#include "protocols/r2sonic/inspect.h"
#include "protocols/reson7k/inspect.h"
#include "protocols/seanet/inspect.h"
#include "protocols/sonar3d/inspect.h"

namespace echoloop::inspect {

namespace {

/// The explicit table of families. Datagram families first: their names at byte 0 are the surer sign.
constexpr std::array table = {
    Family{"r2sonic", "R2Sonic 20xx, UDP", Framing::datagram, r2sonic::decode, r2sonic::recognise,
           r2sonic::tables},
    Family{"deltat", "Imagenex 837 Delta T, UDP and .83P files", Framing::stream, imagenex::decode_delta_t,
           imagenex::recognise_delta_t, imagenex::delta_t_tables},
    Family{"kmall", "Kongsberg KMALL, UDP", Framing::datagram, kmall::decode, kmall::recognise,
           kmall::tables},
    Family{"seanet", "Tritech SeaNet, serial", Framing::stream, seanet::decode, seanet::recognise,
           seanet::tables},
    Family{"oculus", "Blueprint Subsea Oculus, TCP and UDP", Framing::stream, oculus::decode,
           oculus::recognise, oculus::tables, std::size_t{9} << 20},
    Family{"sonar3d", "Water Linked Sonar 3D-15, UDP and files", Framing::stream, sonar3d::decode,
           sonar3d::recognise, sonar3d::tables},
    Family{"reson7k", "Teledyne Reson 7k, TCP, UDP and files", Framing::stream, reson7k::decode,
           reson7k::recognise, reson7k::tables, std::size_t{64} << 20},
    Family{"norbit", "Norbit WBMS, TCP", Framing::stream, norbit::decode, norbit::recognise, norbit::tables,
           std::size_t{2} << 20},
    // Before ping: it wants a message that no Ping device has, while a ping frame is any whole one.
    Family{"cerulean", "Cerulean sonars, TCP and UDP", Framing::stream, cerulean::decode, cerulean::recognise,
           cerulean::tables},
    Family{"ping", "Blue Robotics Ping, serial and UDP", Framing::stream, ping::decode, ping::recognise,
           ping::tables},
    Family{"imagenex", "Imagenex 881A and 852, serial and files", Framing::stream, imagenex::decode,
           imagenex::recognise, imagenex::tables},
    Family{"nmea", "NMEA 0183 sentences, serial and UDP", Framing::stream, nmea::decode, nmea::recognise,
           nmea::tables},
    Family{"altimeter", "Tritech Micron Echosounder, serial", Framing::stream, altimeter::decode,
           altimeter::recognise, altimeter::tables},
    // The last: protobuf has no mark of its own.
    Family{"aris", "Sound Metrics ARIS, UDP and TCP", Framing::stream, aris::decode, aris::recognise,
           aris::tables},
};

std::optional<double> number_of(const wire::Value& value) {
    if (const auto* u = std::get_if<std::uint64_t>(&value)) return static_cast<double>(*u);
    if (const auto* i = std::get_if<std::int64_t>(&value)) return static_cast<double>(*i);
    if (const auto* d = std::get_if<double>(&value)) return *d;
    return std::nullopt;
}

}  // namespace

std::span<const Family> families() { return table; }

const Family* find_family(std::string_view name) {
    const auto* row =
        std::find_if(table.begin(), table.end(), [&](const Family& f) { return f.name == name; });
    return row == table.end() ? nullptr : row;
}

const Family* guess_family(wire::ByteView bytes) {
    const auto* row =
        std::find_if(table.begin(), table.end(), [&](const Family& f) { return f.recognise(bytes); });
    return row == table.end() ? nullptr : row;
}

std::string markdown_tables(const Family& family) {
    std::string out = "## " + std::string(family.title) + "\n";
    for (const wire::Table& one : family.tables()) out += '\n' + markdown(one);
    return out;
}

Field to_field(const wire::FieldView& view, std::size_t start) {
    const auto* numbers = std::get_if<std::vector<double>>(&view.value);
    return {.name = view.name,
            .text = value_text(view),
            .unit = std::string(view.unit),
            .offset = start + view.offset,
            .size = view.size,
            .number = number_of(view.value),
            .numbers = numbers != nullptr ? *numbers : std::vector<double>{}};
}

}  // namespace echoloop::inspect
