// Labels as COCO has them: pictures, what is seen in them, pixel by pixel, and the objects of the scene.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/dataset/place.h"
#include "render/fan/visible_objects.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Of objects, by their number in the labels, which counts from 1.
using Visibility = std::map<std::uint32_t, ObjectInView>;

/// One picture of labels, its rows from the top; 0: nothing.
struct LabelPicture {
    std::string file;  ///< of the picture
    std::size_t width = 0, height = 0;
    std::vector<std::uint16_t> labels;
};

class Coco {
  public:
    explicit Coco(DatasetPlace& place);

    /// `more`: what its entry holds beside the usual keys. Throws DatasetFault.
    void add(const LabelPicture& picture, const Visibility& visible, const nlohmann::ordered_json& more);
    /// The end of the file. Throws DatasetFault.
    void finish(const Scene& scene);

  private:
    DatasetStream file_;
    std::string images_;
    std::size_t pictures_ = 0, annotations_ = 0;
};

}  // namespace echoloop
