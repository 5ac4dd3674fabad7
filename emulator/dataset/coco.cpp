#include "emulator/dataset/coco.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "emulator/dataset/bytes.h"

namespace echoloop {
namespace {

/// One object's pixels: lengths of stretches down the columns, from the left, that are not its own and that
/// are, in turn (COCO's uncompressed RLE).
struct Stretches {
    std::vector<std::size_t> counts;
    std::size_t end = 0, area = 0;  ///< of the last stretch; pixels
    std::size_t left = 0, top = 0, right = 0, bottom = 0;

    void add(std::size_t begin, std::size_t length, std::size_t height) {
        const std::size_t column = begin / height, row = begin % height;
        if (counts.empty()) left = column, top = row;
        if (!counts.empty() && begin == end) {
            counts.back() += length;
        } else {
            counts.push_back(begin - end);
            counts.push_back(length);
        }
        end = begin + length, area += length;
        top = std::min(top, row), bottom = std::max(bottom, row + length), right = column + 1;
    }
};

/// By object.
std::map<std::uint16_t, Stretches> stretches_of(const LabelPicture& picture) {
    std::map<std::uint16_t, Stretches> all;
    for (std::size_t x = 0; x < picture.width; ++x)
        for (std::size_t y = 0; y < picture.height;) {
            const std::uint16_t label = picture.labels[y * picture.width + x];
            const std::size_t begin = y;
            while (y < picture.height && picture.labels[y * picture.width + x] == label) ++y;
            if (label != 0) all[label].add(x * picture.height + begin, y - begin, picture.height);
        }
    return all;
}

}  // namespace

Coco::Coco(DatasetPlace& place) : file_(place, "coco.json") { file_.append("{\"annotations\": ["); }

void Coco::add(const LabelPicture& picture, const Visibility& visible, const nlohmann::ordered_json& more) {
    nlohmann::ordered_json image{{"id", ++pictures_},
                                 {"file_name", picture.file},
                                 {"width", picture.width},
                                 {"height", picture.height}};
    image.update(more);
    images_ += (pictures_ > 1 ? ",\n" : "\n") + image.dump();
    std::string text;
    for (auto& [object, own] : stretches_of(picture)) {
        auto counts = own.counts;
        counts.push_back(picture.width * picture.height - own.end);
        if (counts.back() == 0) counts.pop_back();
        nlohmann::ordered_json entry{
            {"id", ++annotations_},
            {"image_id", pictures_},
            {"category_id", object},
            {"iscrowd", 0},
            {"area", own.area},
            {"bbox", {own.left, own.top, own.right - own.left, own.bottom - own.top}},
            {"visible_share", nullptr}};
        const auto found = visible.find(object);
        if (found != visible.end() && found->second.whole > 0)
            entry["visible_share"] = found->second.seen / found->second.whole;
        text += annotations_ > 1 ? ",\n" : "\n";
        text += entry.dump();
        text.back() = ',';
        text += "\"segmentation\":{\"size\":[" + std::to_string(picture.height) + "," +
                std::to_string(picture.width) + "],\"counts\":[";
        append_numbers(text, counts);
        text += "]}}";
    }
    file_.append(text);
}

void Coco::finish(const Scene& scene) {
    std::vector<std::string> materials(scene.objects().size());
    for (const SceneChunk& chunk : scene.chunks())
        if (materials[chunk.object].empty()) materials[chunk.object] = scene.materials()[chunk.material].name;
    auto categories = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < materials.size(); ++i)
        categories.push_back({{"id", i + 1}, {"name", scene.objects()[i]}, {"supercategory", materials[i]}});
    const auto lenient = nlohmann::ordered_json::error_handler_t::replace;
    file_.append("\n],\n\"images\": [" + images_ + "\n],\n\"categories\": " +
                 categories.dump(1, ' ', false, lenient) + ",\n\"info\": {\"description\": \"echoloop\"}}\n");
}

}  // namespace echoloop
