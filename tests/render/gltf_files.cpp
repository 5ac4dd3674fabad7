#include "tests/render/gltf_files.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace echoloop::test {
namespace {

template <typename T>
void append(std::string& out, T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
}

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t j = 0; j < 3; ++j)
            word = word << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            out += i + j > bytes.size() ? '=' : digits[word >> (18 - 6 * j) & 63U];
    }
    return out;
}

void append_chunk(std::string& out, std::string payload, const char* kind, char padding) {
    payload.resize((payload.size() + 3) / 4 * 4, padding);
    append(out, static_cast<std::uint32_t>(payload.size()));
    out.append(kind, 4);
    out += payload;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "echoloop-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, const std::string& bytes) const {
    const auto path = path_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string rectangle_bytes() {
    std::string out;
    for (const float v : {-1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, -1.0F, 1.0F, 0.0F})
        append(out, v);
    for (const int i : {0, 1, 2, 0, 2, 3}) append(out, static_cast<std::uint16_t>(i));
    return out;
}

nlohmann::json rectangle_document() {
    return nlohmann::json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "panel", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "Steel.001"}],
        "buffers": [{"uri": "mesh.bin", "byteLength": 60}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})");
}

std::string as_glb(nlohmann::json document, const std::string& bytes) {
    document["buffers"][0].erase("uri");
    std::string chunks;
    append_chunk(chunks, document.dump(), "JSON", ' ');
    append_chunk(chunks, bytes, "BIN\0", '\0');
    std::string out = "glTF";
    append(out, std::uint32_t{2});
    append(out, static_cast<std::uint32_t>(12 + chunks.size()));
    return out + chunks;
}

nlohmann::json embedded(nlohmann::json document, const std::string& bytes) {
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
    return document;
}

}  // namespace echoloop::test
