// The channels of a glTF document's animations that move nodes, checked as JSON. Reads no accessor.
#pragma once

#include <string>
#include <vector>

#include "render/scene/document_parts.h"
#include "render/scene/motion.h"

namespace echoloop {

struct DocumentChannel {
    std::string place;  ///< of its sampler, for complaints
    std::size_t animation = 0, node = 0;
    bool turns = false;                 ///< a rotation; else a translation
    std::size_t input = 0, output = 0;  ///< accessors
    KeyTrack::Way way = KeyTrack::Way::linear;
};

/// Channels of other paths (scale, weights of morph targets) are counted in `left_out`. Throws SceneFault.
std::vector<DocumentChannel> read_channels(const JsonView& root, const DocumentCounts& counts,
                                           std::size_t& left_out);

}  // namespace echoloop
