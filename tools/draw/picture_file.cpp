#include <cairo-pdf.h>
#include <cairo-svg.h>

#include "tools/draw/canvas.h"
#include "tools/draw/draw.h"
#include "tools/draw/file.h"
#include "tools/draw/palette.h"

namespace echoloop::draw {
namespace {

cairo_status_t write(void* file, const unsigned char* data, unsigned size) {
    const auto written = std::fwrite(data, 1, size, static_cast<std::FILE*>(file));
    return written == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

void write_vectors(const std::filesystem::path& path, decltype(&cairo_svg_surface_create_for_stream) create,
                   const Picture& picture) {
    OutputFile file(path);
    const Surface surface(create(write, file.get(), picture.pixels.width, picture.pixels.height),
                          cairo_surface_destroy);
    {
        Canvas canvas(surface.get());
        // Whoever scales it blends the edges of the pixels with what is behind.
        canvas.rectangle({0, 0}, picture.pixels.width, picture.pixels.height, background);
        canvas.image(picture.pixels);
        picture.lines(canvas);
    }
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) file.fail();
    file.close();
}

}  // namespace

Picture::operator Image() const {
    Image image = pixels;
    Canvas canvas(image);
    lines(canvas);
    return image;
}

std::optional<PictureFormat> picture_format_of(const std::filesystem::path& name) {
    const std::string ending = name.extension().string();
    if (ending == ".png") return PictureFormat::png;
    if (ending == ".svg") return PictureFormat::svg;
    if (ending == ".pdf") return PictureFormat::pdf;
    return {};
}

void write_picture(const std::filesystem::path& path, PictureFormat format, const Picture& picture) {
    if (format == PictureFormat::png) return write_png(path, picture);
    write_vectors(path,
                  format == PictureFormat::svg ? cairo_svg_surface_create_for_stream
                                               : cairo_pdf_surface_create_for_stream,
                  picture);
}

void write_png(const std::filesystem::path& path, const Image& image) {
    Image pixels = image;  // cairo takes nothing constant
    OutputFile file(path);
    if (cairo_surface_write_to_png_stream(surface_of(pixels).get(), write, file.get()) !=
        CAIRO_STATUS_SUCCESS)
        file.fail();
    file.close();
}

}  // namespace echoloop::draw
