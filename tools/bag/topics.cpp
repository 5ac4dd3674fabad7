#include "tools/bag/topics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "emulator/truth/truth.h"
#include "protocols/http/inspect.h"
#include "tools/bag/topic_types.h"

namespace echoloop::bag {
namespace {

constexpr std::uint64_t between_pictures = 100'000'000;  // ns
bool is_fan(const Shot& shot) { return shot.sides.empty() && shot.bearings.size() > 1; }

/// The loudest bin of each beam, where it stands out of the noise.
Soundings loudest_of(const Echogram& echo) {
    constexpr double stands_out = 20;  // times the noise's mean power: 13 dB
    Soundings all = empty_soundings(echo);
    for (std::size_t i = 0; i < all.beams.size(); ++i) {
        const auto beam = echo.beam(i);
        const auto best = std::ranges::max_element(beam);
        if (best == beam.end() || !(*best > 0) || *best < stands_out * echo.noise_power) continue;
        all.beams[i].range =
            static_cast<float>(echo.bin_range(static_cast<std::size_t>(best - beam.begin())));
        all.beams[i].intensity = level_db(*best);
    }
    return all;
}

Soundings true_ranges(const Echogram& echo) {
    Soundings all = empty_soundings(echo);
    for (std::size_t i = 0; i < std::min(all.beams.size(), echo.truth.size()); ++i)
        all.beams[i].range = echo.truth[i].axis_range;
    return all;
}

/// The line of docs/truth.md, and the names of the objects in it.
std::string truth_of(const Ping& ping, const std::vector<std::string>& objects) {
    PingTruth truth;
    truth.device = ping.device;
    truth.transmitted = ping.transmitted;
    truth.due = ping.transmitted + ping.due;
    truth.unix_time = ping.unix_time;
    truth.movers = ping.movers;
    truth.world_from_body = ping.world_from_body;
    truth.sonar = ping.sonar;
    truth.faults = ping.faults;
    truth.echo.shot = ping.echogram.shot;
    truth.echo.world_from_sonar = ping.echogram.world_from_sonar;
    truth.echo.sound_speed = ping.echogram.sound_speed;
    truth.echo.noise_power = ping.echogram.noise_power;
    truth.echo.truth = ping.echogram.truth;
    truth.echo.objects = ping.echogram.objects;
    std::string line;
    append_truth_line(truth, line);
    nlohmann::ordered_json names = nlohmann::ordered_json::object();
    for (const std::uint16_t number : std::set(ping.echogram.objects.begin(), ping.echogram.objects.end()))
        if (number > 0 && number <= objects.size()) names[std::to_string(number)] = objects[number - 1U];
    line.pop_back();  // the brace
    return line + ",\"names\":" + names.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "}";
}

/// Turns a sonar's own frame into that of its fan.
Pose sonar_from_fan() {
    const double half = std::sqrt(0.5);
    return {{}, {0, half, 0, half}};
}

/// ns since 1970.
std::uint64_t said_at(const Ping& ping) {
    return nanoseconds(ping.unix_time + to_seconds(ping.due + ping.late));
}

/// As JSON has them, each as short as it can be.
std::string list_of(const std::vector<double>& numbers) {
    std::string text = "[";
    char digits[32];
    for (const double number : numbers) {
        if (text.size() > 1) text += ',';
        if (std::isfinite(number))
            text.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
        else
            text += "null";
    }
    return text + "]";
}

std::string value_of(const inspect::Field& field) {
    constexpr std::size_t most = 4096;
    std::string text = field.text;
    if (!field.numbers.empty() && field.numbers.size() <= most) text = list_of(field.numbers);
    return field.unit.empty() ? text : text + " " + field.unit;
}

std::string hexadecimal(ByteView bytes) {
    constexpr std::size_t most = 64;
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), most)))
        text += {digits[byte >> 4], digits[byte & 15]};
    return text + (bytes.size() > most ? "..." : "");
}

}  // namespace

void Topics::draw(const std::string& topic, const Stamped& head, std::uint64_t said, Levels levels) {
    if (levels.bins == 0) return;
    Drawn& drawn = drawn_[topic];
    drawn.picture.take(std::move(levels));
    if (drawn.time != 0 && said < drawn.time + between_pictures) return;
    drawn.time = said;
    take_({topic, image_type, said},
          [&] { return picture(head, SonarPicture::width, SonarPicture::height, drawn.picture.draw()); });
}

/// "/side/at_410_kHz" of a sonar whose pings of two frequencies come in turn, since each is a picture of its
/// own: of EdgeTech's always, of others from the third such ping on. Else "/head": another frequency is the
/// driver's change.
std::string Topics::topic_of(const Ping& ping) {
    const std::string topic = "/" + ros_name(ping.device);
    const auto family = about_.families.find(ping.device);
    const long khz = std::lround(ping.echogram.shot.frequency / 1000);
    Frequencies& known = frequencies_[ping.device];
    if (khz == known.before && khz != known.last) known.in_turn.insert({khz, known.last});
    known.before = std::exchange(known.last, khz);
    const bool in_turn =
        known.in_turn.contains(khz) || (family != about_.families.end() && family->second == "edgetech");
    return in_turn ? topic + "/at_" + std::to_string(khz) + "_kHz" : topic;
}

void Topics::ping(const Ping& ping) {
    const Echogram& echo = ping.echogram;
    const std::string name = ros_name(ping.device), topic = topic_of(ping);
    const Stamped head{nanoseconds(ping.unix_time), name};
    const std::uint64_t said = said_at(ping);
    if (echo.shot.rows() == 1) {
        if (is_fan(echo.shot))
            take_({topic + "/image", projected_type, said}, [&] {
                return projected_image({head.time, name + "_fan"}, echo);
            });
        else
            take_({topic + "/raw", raw_type, said}, [&] {
                return raw_image({head.time, name + "_fan"}, echo);
            });
    }
    draw(topic + "/picture", head, said, bag::levels_of(echo));
    take_({topic + "/points", points_type, said}, [&] { return point_cloud(head, loudest_of(echo)); });
    offer_truth(ping, "/" + name, head, said);
    course(ping);
}

void Topics::offer_truth(const Ping& ping, const std::string& topic, const Stamped& head,
                         std::uint64_t said) {
    take_({topic + "/truth", "std_msgs/msg/String", said},
          [&] { return text_message(truth_of(ping, about_.objects)); });
    take_({topic + "/truth/ranges", ranges_type, said}, [&] {
        return sonar_ranges({head.time, head.frame + "_fan"}, true_ranges(ping.echogram));
    });
}

void Topics::course(const Ping& ping) {
    const std::string name = ros_name(ping.device);
    const Stamped head{nanoseconds(ping.unix_time), name};
    const std::uint64_t said = said_at(ping);
    take_({"/tf", "tf2_msgs/msg/TFMessage", said}, [&] {
        std::vector<Transform> all{
            {"world", "base_link", ping.world_from_body},
            {"base_link", head.frame, inverse(ping.world_from_body) * ping.echogram.world_from_sonar},
            {head.frame, head.frame + "_fan", sonar_from_fan()}};
        for (std::size_t i = 0; i < std::min(ping.movers.size(), about_.movers.size()); ++i)
            all.push_back({"world", ros_name(about_.movers[i]), ping.movers[i]});
        return transforms(head.time, all);
    });
    take_({"/odom", "nav_msgs/msg/Odometry", said},
          [&] { return odometry(head.time, ping.world_from_body, ping.body); });
    constexpr Time late(1'000'000);
    if (ping.late > late)
        take_({"/rosout", log_type, said}, [&] {
            return log_line(said, Severity::warning, name,
                            "ping " + std::to_string(ping.number) + " was " +
                                std::to_string(ping.late.count() / 1'000'000) + " ms late");
        });
}

void Topics::fault(const Fault& fault) {
    const std::uint64_t said = nanoseconds(fault.unix_time);
    take_({"/rosout", log_type, said}, [&] {
        return log_line(said, Severity::warning, ros_name(fault.device),
                        "fault" + (fault.port.empty() ? "" : " on " + fault.port) + ": " + fault.text);
    });
}

void Topics::bytes(const Wire& wire) {
    const auto known = about_.families.find(wire.device);
    const inspect::Family* family =
        known == about_.families.end() ? nullptr : inspect::find_family(known->second);
    if (wire.left_out > 0) return message(wire, family, {.name = "a long message"}, wire.bytes);
    const bool datagrams = family != nullptr && family->framing == inspect::Framing::datagram;
    const bool flows = streams_.contains({wire.device + "\n" + wire.port, wire.sent});
    if (wire.packets || (datagrams && !flows && !http::begins(wire.bytes))) {
        if (family == nullptr) family = inspect::guess_family(wire.bytes);
        if (family == nullptr) return message(wire, nullptr, {.name = "bytes"}, wire.bytes);
        for (const auto& one : family->decode(wire.bytes))
            message(wire, family, one, wire.bytes.subspan(one.offset, one.size));
        return;
    }
    Stream& stream = streams_[{wire.device + "\n" + wire.port, wire.sent}];
    if (!stream.decoder) stream.decoder = std::make_unique<inspect::StreamDecoder>(family);
    if (wire.gap) end(stream);
    stream.last = wire;
    stream.last.bytes = {};
    stream.decoder->add(wire.bytes, [&](const inspect::Family* of, const inspect::Message& one,
                                        ByteView part) { message(wire, of, one, part); });
}

void Topics::finish() {
    for (auto& [key, stream] : streams_) end(stream);
}

void Topics::end(Stream& stream) {
    stream.decoder->finish([&](const inspect::Family* of, const inspect::Message& one, ByteView part) {
        message(stream.last, of, one, part);
    });
}

void Topics::message(const Wire& wire, const inspect::Family* family, const inspect::Message& one,
                     ByteView bytes) {
    const std::string name = ros_name(wire.device);
    const std::uint64_t said = nanoseconds(wire.unix_time);
    take_({"/" + name + "/wire", "diagnostic_msgs/msg/DiagnosticArray", said}, [&] {
        Status status{
            .error = !one.reason.empty(),
            .name = wire.port + (wire.sent ? " > " : " < ") + (one.name.empty() ? "noise" : one.name),
            .message = one.reason,
            .hardware = wire.device,
            .values = {{"direction", wire.sent ? "sent" : "received"},
                       {"size", std::to_string(bytes.size() + wire.left_out)},
                       {"bytes", hexadecimal(bytes)}}};
        for (const auto& field : one.fields) status.values.emplace_back(field.name, value_of(field));
        return diagnostics({said, name}, status);
    });
    if (family == nullptr || !one.reason.empty()) return;
    auto& maker = makers_[wire.device];
    if (!maker) maker = said::maker_of(family->name);
    if (!maker) return;
    for (auto picture = maker->take(one, bytes, wire.sent); picture; picture = maker->also())
        say(wire, *picture);
}

}  // namespace echoloop::bag
