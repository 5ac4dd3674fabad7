#include "tools/echoloop/diff/side.h"

#include <algorithm>
#include <cmath>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "tools/capture/message_time.h"
#include "tools/capture/open.h"
#include "tools/capture/ports.h"
#include "tools/capture/stream_windows.h"
#include "tools/echoloop/common.h"

namespace echoloop::diff {
namespace {

using capture::Way;

/// "points[3].angle" without the number of the element; empty if there is none.
std::string folded(const std::string& name) {
    const std::size_t open = name.find('['), close = name.find(']');
    if (open == std::string::npos || close == std::string::npos || close < open) return {};
    return name.substr(0, open + 1) + name.substr(close);
}

Value value_of(const inspect::Field& field) {
    if (field.number) return *field.number;
    if (!field.numbers.empty() || (!field.text.empty() && field.text[0] == '[')) return field.numbers;
    return field.text;
}

/// Appends the field, or its numbers to the array of the list that it is an element of.
void add_field(std::vector<NamedValue>& fields, const inspect::Field& field) {
    const std::string list = folded(field.name);
    if (list.empty() || (!field.number && field.numbers.empty())) {
        const std::size_t width = field.size / std::max<std::size_t>(1, field.numbers.size());
        fields.push_back({field.name, field.unit, value_of(field), width});
        return;
    }
    auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == list; });
    if (found == fields.end())
        found = fields.insert(fields.end(), {list, field.unit, std::vector<double>(),
                                             field.size / std::max<std::size_t>(1, field.numbers.size())});
    auto& numbers = *std::get_if<std::vector<double>>(&found->value);
    if (field.number) numbers.push_back(*field.number);
    numbers.insert(numbers.end(), field.numbers.begin(), field.numbers.end());
}

std::size_t memory_of(const Message& message) {
    std::size_t sum = sizeof(Message);
    for (const NamedValue& one : message.fields) {
        sum += sizeof(NamedValue) + one.name.capacity();
        if (const auto* text = std::get_if<std::string>(&one.value)) sum += text->capacity();
        if (const auto* numbers = std::get_if<std::vector<double>>(&one.value))
            sum += 8 * numbers->capacity();
    }
    return sum;
}

/// A driver that came back speaks from another port of the same machine.
bool continues(const Way& one, const Way& other) {
    if (one == other) return true;
    if (one.is_serial() || other.is_serial()) return false;
    return (one.from == other.from && one.to.ip == other.to.ip) ||
           (one.to == other.to && one.from.ip == other.from.ip);
}

class Loader {
  public:
    Loader(Side& side, const SideSettings& settings) : side_(side), settings_(settings) {}

    bool full() const { return full_ || used_ > settings_.most_bytes; }

    void add(const capture::MessageOrigin& origin, const inspect::Message& message) {
        if (full() || !fits(origin.way, settings_.port)) return;
        if (!start_) start_ = origin.time;
        Direction* const found = direction_of(origin);
        full_ = found == nullptr;
        if (full_) return;
        Direction& direction = *found;
        if (message.name.empty()) {
            direction.undecoded_bytes += message.size;
            side_.undecoded_bytes += message.size;
            return;
        }
        const std::string name = message.name + (message.reason.empty() ? "" : " (broken)");
        // Seconds since 1970 have no finer resolution in a double.
        const double time = std::round((origin.time - *start_) * 1e6) / 1e6;
        Message out{{origin.packet, time, ++side_.messages}, {}, capture::message_time(message)};
        out.fields = named_values(message);
        used_ += memory_of(out) + sizeof(double) + name.size();
        direction.spoken.emplace_back(out.place.time, name);
        direction.types[name].push_back(std::move(out));
    }

  private:
    // Each direction is compared with each of the other side, and each of its ways with theirs.
    static constexpr std::size_t most_directions = 500, most_ways = 2000;

    /// nullptr if there are too many.
    Direction* direction_of(const capture::MessageOrigin& origin) {
        const auto is_it = [&](const Direction& one) {
            return one.family == origin.family &&
                   std::any_of(one.ways.begin(), one.ways.end(),
                               [&](const Way& way) { return continues(way, origin.way); });
        };
        auto found = std::find_if(side_.directions.begin(), side_.directions.end(), is_it);
        if (found == side_.directions.end()) {
            if (side_.directions.size() >= most_directions) return nullptr;
            side_.directions.emplace_back();
            found = side_.directions.end() - 1;
            found->family = origin.family;
        }
        const bool known = std::find(found->ways.begin(), found->ways.end(), origin.way) != found->ways.end();
        if (!known && (found->ways.empty() || ways_ < most_ways)) {
            found->ways.push_back(origin.way);
            ++ways_;
        }
        return &*found;
    }

    Side& side_;
    const SideSettings& settings_;
    std::optional<double> start_;
    std::size_t used_ = 0, ways_ = 0;
    bool full_ = false;  ///< of directions
};

/// A file of bytes is one direction, and has no times.
void read_bytes(capture::Input& input, const SideSettings& settings, Side& side) {
    Loader loader(side, settings);
    side.has_times = false;
    const auto* family = settings.family;
    if (family == nullptr) family = inspect::guess_family(input.peek(std::size_t{64} << 10));
    if (family == nullptr) return;
    capture::decode_windows(input, *family, [&](const auto& message) {
        loader.add({{}, family, 0, 0}, message);
        side.is_cut = loader.full();
    });
}

}  // namespace

std::vector<NamedValue> named_values(const inspect::Message& message) {
    std::vector<NamedValue> fields;
    for (const inspect::Field& field : message.fields) add_field(fields, field);
    return fields;
}

bool fits(const Way& way, const std::string& port) {
    if (port.empty()) return true;
    capture::PortKey key{capture::PortKind::serial, way.line, {}, {}};
    if (!way.is_serial()) key = {capture::PortKind::udp, "", way.from, way.to};
    return capture::PortFilter(port).fits(key);
}

void read_events(capture::CaptureReader& capture, const SideSettings& settings, Side& side) {
    Loader loader(side, settings);
    capture::MessageSorter messages(
        settings.family, [&](const auto& origin, const auto& message) { loader.add(origin, message); });
    while (const auto event = loader.full() ? std::nullopt : capture.next()) messages.add(*event);
    side.is_cut = loader.full();
    messages.finish();
    side.troubles = capture::troubles(capture.counts());
}

const NamedValue* Message::find(const std::string& name, std::size_t hint) const {
    if (hint < fields.size() && fields[hint].name == name) return &fields[hint];
    const auto found = std::ranges::find(fields, name, &NamedValue::name);
    return found == fields.end() ? nullptr : &*found;
}

std::string Direction::text() const {
    const Way& way = ways.front();
    if (way.is_serial())
        return (way.line.empty() ? "bytes" : way.line) + (way.line.empty() ? ""
                                                          : way.sent       ? ", sent"
                                                                           : ", received");
    const std::string more = ways.size() > 1 ? " and " + std::to_string(ways.size() - 1) + " more" : "";
    return cli::text_of(way.from) + " -> " + cli::text_of(way.to) + more;
}

bool Direction::answers(const Direction& other) const {
    if (family != other.family) return false;
    const auto is_reverse = [](const Way& one, const Way& way) {
        if (one.is_serial() || way.is_serial()) return one.line == way.line && one.sent != way.sent;
        return one.from == way.to && one.to.ip == way.from.ip;
    };
    return std::any_of(ways.begin(), ways.end(), [&](const Way& one) {
        return std::any_of(other.ways.begin(), other.ways.end(),
                           [&](const Way& way) { return is_reverse(one, way) || is_reverse(way, one); });
    });
}

Side read_side(const std::string& file, const SideSettings& settings) {
    Side side;
    side.file = file;
    capture::Input input(file);
    if (const auto log = capture::open_if_log(input)) {
        read_events(*log, settings, side);
    } else {
        read_bytes(input, settings, side);
        if (!input.fault().empty()) side.troubles.push_back("the file ends early: " + input.fault());
    }
    if (side.messages > 0) return side;
    const std::string where = settings.port.empty()
                                  ? ""
                                  : " at " + scenario::in_quotes(settings.port) + " (`echoloop replay " +
                                        file + " --list` shows its ports)";
    throw StartError(Exit::data, scenario::in_quotes(file) + ": no message of a known protocol" + where +
                                     (side.troubles.empty() ? "" : " (" + side.troubles.front() + ")") +
                                     "; --family names the protocol to try");
}

}  // namespace echoloop::diff
