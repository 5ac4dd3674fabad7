#include "emulator/dataset/zarr.h"

#include <nlohmann/json.hpp>

#include "emulator/dataset/bytes.h"

namespace echoloop::zarr {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(1) + "\n"; }

}  // namespace

void put_group(DatasetPlace& place, const std::string& name) {
    place.put(name + "/.zgroup", text_of({{"zarr_format", 2}}));
}

void Array::add(DatasetPlace& place, std::string_view numbers) {
    std::string chunk = name_ + "/" + std::to_string(pings_++);
    for (std::size_t i = 0; i < shape_.size(); ++i) chunk += ".0";
    place.put(chunk, squeezed(type_ == Type::float32 ? shuffled(numbers, 4) : std::string(numbers)));
}

void Array::finish(DatasetPlace& place, const Json& attributes) const {
    Json shape = Json::array({pings_}), chunks = Json::array({1});
    for (const std::size_t size : shape_) shape.push_back(size), chunks.push_back(size);
    const bool levels = type_ == Type::float32;
    const Json array{{"zarr_format", 2},
                     {"shape", shape},
                     {"chunks", chunks},
                     {"dtype", levels ? "<f4" : "<u2"},
                     {"order", "C"},
                     {"fill_value", levels ? Json("NaN") : Json(0)},
                     {"filters", levels ? Json::array({{{"id", "shuffle"}, {"elementsize", 4}}}) : Json()},
                     {"compressor", {{"id", "zlib"}, {"level", 1}}}};
    place.put(name_ + "/.zarray", text_of(array));
    place.put(name_ + "/.zattrs", text_of(attributes));
}

}  // namespace echoloop::zarr
