#include "render/scene/document_animations.h"

#include "render/scene/fault.h"
#include "render/scene/limits.h"

namespace echoloop {
namespace {

KeyTrack::Way way_of(const JsonView& sampler) {
    const auto named = sampler.find("interpolation");
    if (!named || named->text() == "LINEAR") return KeyTrack::Way::linear;
    if (named->text() == "STEP") return KeyTrack::Way::step;
    if (named->text() == "CUBICSPLINE") return KeyTrack::Way::cubic;
    scene_fault(named->place(), "is not LINEAR, STEP or CUBICSPLINE", export_again);
}

}  // namespace

std::vector<DocumentChannel> read_channels(const JsonView& root, const DocumentCounts& counts,
                                           std::size_t& left_out) {
    std::vector<DocumentChannel> out;
    std::size_t number = 0;
    for (const JsonView& animation : root.elements_of("animations", scene_limits::elements)) {
        const auto samplers = animation.elements_of("samplers", scene_limits::elements);
        for (const JsonView& channel : animation.elements_of("channels", scene_limits::elements)) {
            const JsonView target = channel.need("target");
            const auto node = target.find("node");
            const std::string path = target.need("path").text();
            const bool moves = path == "translation" || path == "rotation";
            if (!moves && node) ++left_out;
            if (!moves || !node) continue;  // without a node an extension knows what it means
            const JsonView& sampler = samplers.at(channel.need("sampler").index(samplers.size(), "samplers"));
            if (out.size() == scene_limits::elements)
                scene_fault("animations",
                            "have more than " + std::to_string(scene_limits::elements) + " channels",
                            "leave out what does not move");
            out.push_back({sampler.place(), number, node->index(counts.nodes, "nodes"), path == "rotation",
                           sampler.need("input").index(counts.accessors, "accessors"),
                           sampler.need("output").index(counts.accessors, "accessors"), way_of(sampler)});
        }
        ++number;
    }
    return out;
}

}  // namespace echoloop
