// Takes a scene file apart into its JSON text and, for a .glb, its binary chunk, and checks the text before
// any parser sees it. Parses nothing itself.
#pragma once

#include <span>
#include <string_view>

namespace echoloop {

struct SceneContainer {
    std::string_view json;
    std::span<const unsigned char> binary;
    bool has_binary = false;
};

/// Views into `file`. Throws SceneFault for a broken or truncated .glb.
SceneContainer open_container(std::span<const unsigned char> file);

/// Throws SceneFault when the text is nested deeper or holds more values than scene_limits allow: parsers
/// that recurse would overflow the stack.
void check_json_shape(std::string_view json);

}  // namespace echoloop
