#include "render/scene/container.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "render/scene/fault.h"
#include "render/scene/limits.h"

namespace echoloop {
namespace {

std::uint32_t word(std::span<const unsigned char> bytes, std::size_t at) {
    return bytes[at] | bytes[at + 1] << 8U | bytes[at + 2] << 16U |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24U;
}

/// The payload of the chunk at `at`, which moves behind it.
std::span<const unsigned char> chunk(std::span<const unsigned char> file, std::size_t& at, std::uint32_t kind,
                                     const char* name) {
    if (file.size() - at < 8 || word(file, at) > file.size() - at - 8)
        scene_fault(name, "the file ends inside this chunk", "copy or export the file again");
    if (word(file, at + 4) != kind) scene_fault(name, "the chunk has another type", export_again);
    const auto payload = file.subspan(at + 8, word(file, at));
    at += 8 + payload.size();
    return payload;
}

std::string_view as_text(std::span<const unsigned char> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

SceneContainer open_container(std::span<const unsigned char> file) {
    constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    if (file.size() < 4 || word(file, 0) != magic) return {as_text(file), {}, false};
    if (file.size() < 12 || word(file, 4) != 2) scene_fault("glb", "not a version 2 container", export_again);
    if (word(file, 8) < 12 || word(file, 8) > file.size())
        scene_fault("glb", "the header's length does not fit the file", "copy or export the file again");
    file = file.first(word(file, 8));
    std::size_t at = 12;
    SceneContainer out;
    out.json = as_text(chunk(file, at, json_chunk, "glb.JSON"));
    out.has_binary = at < file.size();
    if (out.has_binary) out.binary = chunk(file, at, binary_chunk, "glb.BIN");
    return out;
}

void check_json_shape(std::string_view json) {
    if (json.size() > scene_limits::json_bytes)
        scene_fault("", "the JSON text is longer than " + std::to_string(scene_limits::json_bytes) + " bytes",
                    "move embedded data into a .bin file");
    std::size_t depth = 0, values = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
            continue;
        }
        quoted = c == '"';
        if (c == '[' || c == '{') ++depth, ++values;
        if (c == ',') ++values;
        if ((c == ']' || c == '}') && depth > 0) --depth;
        if (depth > scene_limits::json_depth)
            scene_fault("", "the JSON is nested deeper than " + std::to_string(scene_limits::json_depth),
                        export_again);
        if (values > scene_limits::json_values)
            scene_fault("",
                        "the JSON holds more than " + std::to_string(scene_limits::json_values) + " values",
                        "move data into a .bin file or split the scene");
    }
}

}  // namespace echoloop
