#include "protocols/inspect.h"

#include <algorithm>
#include <array>

#include "protocols/altimeter/inspect.h"
#include "protocols/aris/inspect.h"
#include "protocols/cerulean/inspect.h"
#include "protocols/edgetech/inspect.h"
#include "protocols/imagenex/delta_t_inspect.h"
#include "protocols/imagenex/inspect.h"
#include "protocols/kmall/inspect.h"
#include "protocols/motion/inspect.h"
#include "protocols/nmea/inspect.h"
#include "protocols/norbit/inspect.h"
#include "protocols/nortek/inspect.h"
#include "protocols/oculus/inspect.h"
#include "protocols/ping/inspect.h"
#include "protocols/r2sonic/inspect.h"
#include "protocols/reson7k/inspect.h"
#include "protocols/seanet/inspect.h"
#include "protocols/sonar3d/inspect.h"
#include "protocols/teledyne/inspect.h"
#include "protocols/waterlinked/inspect.h"
#include "protocols/wayfinder/inspect.h"

namespace echoloop::inspect {

namespace {

/// The explicit table of families. Datagram families first: their names at byte 0 are the surer sign.
constexpr std::array table = {
    Family{.name = "r2sonic",
           .title = "R2Sonic 20xx, UDP",
           .places = {.udp = "65400-65412,65500-65512"},
           .framing = Framing::datagram,
           .decode = r2sonic::decode,
           .recognise = r2sonic::recognise,
           .tables = r2sonic::tables,
           .rewritten = r2sonic::rewritten},
    Family{.name = "deltat",
           .title = "Imagenex 837 Delta T, UDP and .83P files",
           .places = {.udp = "4040"},
           .framing = Framing::stream,
           .decode = imagenex::decode_delta_t,
           .recognise = imagenex::recognise_delta_t,
           .tables = imagenex::delta_t_tables,
           .rewritten = imagenex::rewritten_delta_t},
    Family{.name = "kmall",
           .title = "Kongsberg KMALL, UDP",
           .places = {.udp = "4002,6020,14002"},
           .framing = Framing::datagram,
           .decode = kmall::decode,
           .recognise = kmall::recognise,
           .tables = kmall::tables,
           .rewritten = kmall::rewritten,
           .join = kmall::join},
    Family{.name = "seanet",
           .title = "Tritech SeaNet, serial",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = seanet::decode,
           .recognise = seanet::recognise,
           .tables = seanet::tables,
           .rewritten = seanet::rewritten},
    Family{.name = "oculus",
           .title = "Blueprint Subsea Oculus, TCP and UDP",
           .places = {.tcp = "52100", .udp = "52102"},
           .framing = Framing::stream,
           .decode = oculus::decode,
           .recognise = oculus::recognise,
           .tables = oculus::tables,
           .rewritten = oculus::rewritten,
           .longest_frame = std::size_t{9} << 20},
    Family{.name = "sonar3d",
           .title = "Water Linked Sonar 3D-15, UDP and files",
           .places = {.udp = "4747"},
           .framing = Framing::stream,
           .decode = sonar3d::decode,
           .recognise = sonar3d::recognise,
           .tables = sonar3d::tables,
           .rewritten = sonar3d::rewritten,
           .checksums = sonar3d::checksums},
    Family{.name = "reson7k",
           .title = "Teledyne Reson 7k, TCP, UDP and files",
           .places = {.tcp = "7000", .udp = "7000"},
           .framing = Framing::stream,
           .decode = reson7k::decode,
           .recognise = reson7k::recognise,
           .tables = reson7k::tables,
           .rewritten = reson7k::rewritten,
           .checksums = reson7k::checksums,
           .longest_frame = std::size_t{64} << 20},
    Family{.name = "norbit",
           .title = "Norbit WBMS, TCP",
           .places = {.tcp = "2210-2211"},
           .framing = Framing::stream,
           .decode = norbit::decode,
           .recognise = norbit::recognise,
           .tables = norbit::tables,
           .rewritten = norbit::rewritten,
           .checksums = norbit::checksums,
           .longest_frame = std::size_t{2} << 20},
    Family{.name = "edgetech",
           .title = "EdgeTech side-scans, TCP and .jsf files",
           .places = {.tcp = "1700-1701"},
           .framing = Framing::stream,
           .decode = edgetech::decode,
           .recognise = edgetech::recognise,
           .tables = edgetech::tables,
           .rewritten = edgetech::rewritten,
           .longest_frame = std::size_t{256} << 10},
    // Before ping: its objects and sentences say what they are.
    Family{.name = "waterlinked",
           .title = "Water Linked DVL A50 and A125, TCP and serial",
           .places = {.tcp = "16171,1037-1038", .serial = true},
           .framing = Framing::stream,
           .decode = waterlinked::decode,
           .recognise = waterlinked::recognise,
           .tables = waterlinked::tables,
           .rewritten = waterlinked::rewritten,
           .checksums = waterlinked::checksums},
    // Behind waterlinked, whose PD4 is the same block; before ping: a sum tells an ensemble.
    Family{.name = "teledyne",
           .title = "Teledyne Doppler logs, PD0, PD4, PD5, PD6 and PD13, serial",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = teledyne::decode,
           .recognise = teledyne::recognise,
           .tables = teledyne::tables,
           .rewritten = teledyne::rewritten,
           .checksums = teledyne::checksums},
    // Before ping: sizes that agree and a sum tell a packet.
    Family{.name = "wayfinder",
           .title = "Teledyne Wayfinder, serial",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = wayfinder::decode,
           .recognise = wayfinder::recognise,
           .tables = wayfinder::tables,
           .rewritten = wayfinder::rewritten,
           .checksums = wayfinder::checksums},
    // Before ping: two sums tell a frame.
    Family{.name = "nortek",
           .title = "Nortek Nucleus, DVL500 and DVL1000, TCP, UDP and serial",
           .places = {.tcp = "9000-9002,9004", .udp = "9005", .serial = true},
           .framing = Framing::stream,
           .decode = nortek::decode,
           .recognise = nortek::recognise,
           .tables = nortek::tables,
           .rewritten = nortek::rewritten,
           .checksums = nortek::checksums},
    // Before ping: it wants a message that no Ping device has, while a ping frame is any whole one.
    Family{.name = "cerulean",
           .title = "Cerulean sonars, TCP and UDP",
           .places = {.tcp = "51200,51210,62312", .udp = "51200,51210,62312", .serial = true},
           .framing = Framing::stream,
           .decode = cerulean::decode,
           .recognise = cerulean::recognise,
           .tables = cerulean::tables,
           .rewritten = cerulean::rewritten,
           .checksums = ping::checksums},
    Family{.name = "ping",
           .title = "Blue Robotics Ping, serial and UDP",
           .places = {.udp = "1234", .serial = true},
           .framing = Framing::stream,
           .decode = ping::decode,
           .recognise = ping::recognise,
           .tables = ping::tables,
           .rewritten = ping::rewritten,
           .checksums = ping::checksums},
    Family{.name = "imagenex",
           .title = "Imagenex 881A, 852, 872 and 831L, serial, TCP and files",
           .places = {.tcp = "4040", .serial = true},
           .framing = Framing::stream,
           .decode = imagenex::decode,
           .recognise = imagenex::recognise,
           .tables = imagenex::tables,
           .rewritten = imagenex::rewritten},
    Family{.name = "nmea",
           .title = "NMEA 0183 sentences, serial and UDP",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = nmea::decode,
           .recognise = nmea::recognise,
           .tables = nmea::tables,
           .rewritten = nmea::rewritten,
           .checksums = nmea::checksums},
    Family{.name = "motion",
           .title = "TSS1 and EM Attitude 3000 of motion sensors, serial and UDP",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = motion::decode,
           .recognise = motion::recognise,
           .tables = motion::tables,
           .rewritten = motion::rewritten},
    Family{.name = "altimeter",
           .title = "Altimeters of Tritech, Benthos, Echologger and Imagenex, serial",
           .places = {.serial = true},
           .framing = Framing::stream,
           .decode = altimeter::decode,
           .recognise = altimeter::recognise,
           .tables = altimeter::tables,
           .rewritten = altimeter::rewritten},
    // The last: protobuf has no mark of its own.
    Family{.name = "aris",
           .title = "Sound Metrics ARIS, UDP and TCP",
           .places = {.tcp = "56888", .udp = "56124"},
           .framing = Framing::stream,
           .decode = aris::decode,
           .recognise = aris::recognise,
           .tables = aris::tables,
           .rewritten = aris::rewritten},
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
