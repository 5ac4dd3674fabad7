#include "protocols/seanet/codec.h"

#include <algorithm>
#include <optional>

#include "protocols/seanet/framer.h"
#include "protocols/seanet/layouts.h"
#include "protocols/wire/print.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::seanet {

namespace {

template <class M>
Result<Message> parse_as(ByteView payload) {
    auto message = wire::parse<M>(payload);
    if (!message) return message.error();
    return Message(*std::move(message));
}

/// Whose messages share an id: those of all nodes but the profiler's, or of the profiler's alone.
enum class Whose { any, imaging, profiler };

/// The table of messages: one row per alternative of Message, in its order.
struct Row {
    Id id;
    std::optional<HeadCommandType> type;  ///< first byte of the payload, where the id alone does not tell
    bool from_host;
    Result<Message> (*parse)(ByteView);
    Whose whose = Whose::any;
};
constexpr Row rows[] = {
    {Id::reboot, {}, true, parse_as<ReBoot>},
    {Id::send_version, {}, true, parse_as<SendVersion>},
    {Id::send_bb_user, {}, true, parse_as<SendBBUser>},
    {Id::stop_alives, {}, true, parse_as<StopAlives>},
    {Id::send_data, {}, true, parse_as<SendData>},
    {Id::head_command, HeadCommandType::normal, true, parse_as<HeadCommand>, Whose::imaging},
    {Id::head_command, HeadCommandType::dual, true, parse_as<HeadCommandDual>, Whose::imaging},
    {Id::head_command, HeadCommandType::reverse, true, parse_as<HeadCommandReverse>},
    {Id::head_command, HeadCommandType::gain, true, parse_as<HeadCommandGain>, Whose::imaging},
    {Id::alive, {}, false, parse_as<Alive>},
    {Id::version_data, {}, false, parse_as<VersionData>},
    {Id::bb_user_data, {}, false, parse_as<BBUserData>},
    {Id::fpga_cal_data, {}, false, parse_as<FpgaCalData>},
    {Id::fpga_version_data, {}, false, parse_as<FpgaVersionData>},
    {Id::head_data, {}, false, parse_as<HeadData>, Whose::imaging},
    {Id::aux_data, {}, false, parse_as<AuxData>},
    {Id::head_command, HeadCommandType::dual, true, parse_as<ProfilerCommand>, Whose::profiler},
    {Id::head_command, HeadCommandType::gain, true, parse_as<ProfilerGainCommand>, Whose::profiler},
    {Id::head_data, {}, false, parse_as<ProfilerData>, Whose::profiler},
};
static_assert(std::size(rows) == std::variant_size_v<Message>);

bool is_of(const Row& row, const Frame& frame) {
    if (row.id != frame.header.id) return false;
    const std::uint8_t node = row.from_host ? frame.header.rx_node : frame.header.tx_node;
    if (row.whose == (node == nodes::profiler ? Whose::imaging : Whose::profiler)) return false;
    return !row.type || (!frame.payload.empty() && frame.payload[0] == static_cast<std::uint8_t>(*row.type));
}

/// Byte 9: length - 5, cut to 8 bits where it does not fit.
std::uint8_t remaining(const Message& message, std::size_t payload, const EncodeOptions& options) {
    const bool zero =
        id_of(message) == Id::head_data && options.head_data_remaining == HeadDataRemaining::zero;
    return zero ? 0 : static_cast<std::uint8_t>(payload + 3);
}

}  // namespace

wire::Result<Message> parse(const Frame& frame) {
    for (const Row& row : rows) {
        if (is_of(row, frame)) return row.parse(frame.payload);
    }
    const bool no_type = frame.header.id == Id::head_command;
    if (no_type && frame.payload.empty()) return Error{"HeadCommand", "type", 13, Reason::truncated};
    return Error{no_type ? "HeadCommand" : "Frame", no_type ? "type" : "id", no_type ? 13U : 10U,
                 Reason::unknown_message};
}

Id id_of(const Message& message) { return rows[message.index()].id; }

bool from_host(const Message& message) { return rows[message.index()].from_host; }

bool is_profiler(const Message& message) { return rows[message.index()].whose == Whose::profiler; }

Frame make_frame(const Message& message, const EncodeOptions& options) {
    Frame frame;
    frame.payload = std::visit([](const auto& m) { return wire::serialise(m); }, message);
    const bool command = from_host(message);
    const std::uint8_t sonar = is_profiler(message) ? nodes::profiler : options.sonar_node;
    frame.header.id = id_of(message);
    frame.header.tx_node = command ? nodes::host : sonar;
    frame.header.rx_node = command ? sonar : nodes::host;
    frame.header.node = sonar;
    frame.header.remaining = remaining(message, frame.payload.size(), options);
    return frame;
}

wire::Bytes encode(const Frame& frame) { return wire::serialise(frame); }

wire::Bytes encode(const Message& message, const EncodeOptions& options) {
    return encode(make_frame(message, options));
}

std::string name_of(Id id) {
    const auto* row = std::find_if(std::begin(id_names), std::end(id_names), [&](const NamedValue& name) {
        return name.value == static_cast<std::uint8_t>(id);
    });
    if (row != std::end(id_names)) return std::string(row->name);
    return "id " + std::to_string(static_cast<int>(id));
}

std::string describe(const Frame& frame) {
    const Header& header = frame.header;
    std::string line = name_of(header.id) + ' ' + std::to_string(header.tx_node) + "->" +
                       std::to_string(header.rx_node) + ", " +
                       std::to_string(frame.payload.size() + min_frame_bytes) + " bytes: ";
    const auto message = parse(frame);
    if (!message) return line + message.error().what();
    return line + std::visit([](const auto& m) { return wire::print_line(m); }, *message);
}

}  // namespace echoloop::seanet
