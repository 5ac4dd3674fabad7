#include "tools/poses/truth/messages.h"

#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace echoloop::poses {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t point_size = 16;

void put(std::string& bytes, const void* value, std::size_t size) {
    static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");
    bytes.append(static_cast<const char*>(value), size);
}

Json header(const TruthWords& words, double unix_time, const std::string& frame) {
    const double whole = std::floor(unix_time);
    const auto seconds = static_cast<std::int64_t>(whole);
    const auto rest = static_cast<std::int64_t>((unix_time - whole) * 1e9);
    if (words.ros == 1)
        return {{"seq", 0}, {"stamp", {{"secs", seconds}, {"nsecs", rest}}}, {"frame_id", frame}};
    return {{"stamp", {{"sec", seconds}, {"nanosec", rest}}}, {"frame_id", frame}};
}

Json field(const char* name, std::size_t offset, int type) {
    return {{"name", name}, {"offset", offset}, {"datatype", type}, {"count", 1}};
}

std::string publish(const std::string& topic, Json message) {
    return Json{{"op", "publish"}, {"topic", topic}, {"msg", std::move(message)}}.dump(
        -1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0U);
        for (int shift = 18; shift >= 0; shift -= 6) text += letters[bits >> shift & 63U];
    }
    for (std::size_t i = 0; i < (3 - bytes.size() % 3) % 3; ++i) text[text.size() - 1 - i] = '=';
    return text;
}

std::string truth_points(const TruthPing& ping) {
    std::string bytes;
    for (std::size_t i = 0; i < ping.beams.size(); ++i) {
        const TruthBeam& beam = ping.beams[i];
        if (!beam.range) continue;
        const Vec3 at = ping.world_from_sonar * (*beam.range * beam.axis);
        for (const double value : {at.x, at.y, at.z}) {
            const auto narrow = static_cast<float>(value);
            put(bytes, &narrow, sizeof narrow);
        }
        for (const std::size_t value : {std::size_t{object_at(ping, beam, *beam.range)}, i}) {
            const auto narrow = static_cast<std::uint16_t>(value);
            put(bytes, &narrow, sizeof narrow);
        }
    }
    return bytes;
}

std::string advertise_request(const TruthWords& words, const std::string& topic, const std::string& type) {
    const auto slash = type.find('/');
    const std::string full = words.ros == 1 ? type : type.substr(0, slash) + "/msg" + type.substr(slash);
    return Json{{"op", "advertise"}, {"topic", topic}, {"type", full}}.dump(-1, ' ', true,
                                                                            Json::error_handler_t::replace);
}

std::string image_message(const TruthWords& words, const std::string& topic, double unix_time,
                          const std::string& frame, const RgbPicture& picture) {
    const std::string_view bytes(reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size());
    return publish(topic, {{"header", header(words, unix_time, frame)},
                           {"height", picture.height},
                           {"width", picture.width},
                           {"encoding", "rgb8"},
                           {"is_bigendian", 0},
                           {"step", 3 * picture.width},
                           {"data", base64(bytes)}});
}

std::string points_message(const TruthWords& words, const std::string& topic, const TruthPing& ping) {
    constexpr int uint16 = 4, float32 = 7;  // of sensor_msgs/PointField
    const std::string bytes = truth_points(ping);
    const Json fields = Json::array({field("x", 0, float32), field("y", 4, float32), field("z", 8, float32),
                                     field("object", 12, uint16), field("beam", 14, uint16)});
    return publish(topic, {{"header", header(words, ping.unix_time, words.world)},
                           {"height", 1},
                           {"width", bytes.size() / point_size},
                           {"fields", fields},
                           {"is_bigendian", false},
                           {"point_step", point_size},
                           {"row_step", bytes.size()},
                           {"data", base64(bytes)},
                           {"is_dense", true}});
}

std::string pose_message(const TruthWords& words, const std::string& topic, const TruthPing& ping) {
    const Vec3 p = ping.world_from_sonar.position;
    const Quat q = ping.world_from_sonar.orientation;
    return publish(topic, {{"header", header(words, ping.unix_time, words.world)},
                           {"pose",
                            {{"position", {{"x", p.x}, {"y", p.y}, {"z", p.z}}},
                             {"orientation", {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}}}}}});
}

}  // namespace echoloop::poses
