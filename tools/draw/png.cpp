#include "tools/draw/canvas.h"
#include "tools/draw/draw.h"
#include "tools/draw/file.h"

namespace echoloop::draw {
namespace {

cairo_status_t write(void* file, const unsigned char* data, unsigned size) {
    const auto written = std::fwrite(data, 1, size, static_cast<std::FILE*>(file));
    return written == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
    Image pixels = image;  // cairo takes nothing constant
    OutputFile file(path);
    if (cairo_surface_write_to_png_stream(surface_of(pixels).get(), write, file.get()) !=
        CAIRO_STATUS_SUCCESS)
        file.fail();
    file.close();
}

}  // namespace echoloop::draw
