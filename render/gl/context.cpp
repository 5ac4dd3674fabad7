#include "render/gl/context.h"

#include <stdexcept>

#include "render/gl/osmesa.h"

namespace echoloop::gl {

std::unique_ptr<Context> make_context(std::string_view name) {
    if (name == "auto" || name == "osmesa") return make_osmesa_context();
    throw std::invalid_argument("unknown GL context \"" + std::string(name) + "\"; known are auto, osmesa");
}

}  // namespace echoloop::gl
