#include <png.h>

#include "tools/draw/draw.h"
#include "tools/draw/file.h"

namespace echoloop::draw {

void write_png(const std::filesystem::path& path, const Image& image) {
    static_assert(sizeof(Color) == 3, "rows are handed over as they lie in memory");
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    OutputFile file(path);
    if (!png_image_write_to_stdio(&header, file.get(), 0, image.pixels.data(), 0, nullptr))
        throw std::runtime_error("cannot write " + path.string() + ": " + header.message);
    file.close();
}

}  // namespace echoloop::draw
