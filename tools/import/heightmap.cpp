#include "tools/import/heightmap.h"

#include <gdal_priv.h>

#include <algorithm>
#include <memory>

#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace {

constexpr int most_samples = 2048;

struct Heights {
    int columns = 0, rows = 0;
    std::vector<float> values{};  ///< rows from north to south
};

Heights read_image(const std::filesystem::path& file) {
    const std::string place = printable(file.string());
    GDALAllRegister();
    const char* const drivers[] = {"PNG", "JPEG", "BMP", "GTiff", nullptr};
    const std::unique_ptr<GDALDataset> image(
        GDALDataset::FromHandle(GDALOpenEx(file.c_str(), GDAL_OF_RASTER, drivers, nullptr, nullptr)));
    if (!image) throw Fault(place, "is no image that is read here", "make a .png of it");
    GDALRasterBand* band = image->GetRasterBand(1);
    const GDALDataType type = band ? band->GetRasterDataType() : GDT_Unknown;
    if (type != GDT_Byte && type != GDT_UInt16)
        throw Fault(place, "is a model of terrain in metres and no image of 8 or 16 bits",
                    "leave it out here, and import it as terrain of its own");
    Heights out{std::min(band->GetXSize(), most_samples), std::min(band->GetYSize(), most_samples)};
    if (out.columns < 2 || out.rows < 2)
        throw Fault(place, "has fewer than 2 x 2 samples", "give a larger image");
    out.values.resize(static_cast<std::size_t>(out.columns) * out.rows);
    if (band->RasterIO(GF_Read, 0, 0, band->GetXSize(), band->GetYSize(), out.values.data(), out.columns,
                       out.rows, GDT_Float32, 0, 0, nullptr) != CE_None)
        throw Fault(place, "cannot be read: " + printable(CPLGetLastErrorMsg()), "export the image again");
    return out;
}

}  // namespace

Shape read_heightmap(const std::filesystem::path& file, Vec3 size, Vec3 position) {
    const Heights heights = read_image(file);
    const double brightest = std::max(1.0F, *std::ranges::max_element(heights.values));
    ShapeSurface out;
    for (int row = 0; row < heights.rows; ++row)
        for (int column = 0; column < heights.columns; ++column) {
            const double value = heights.values[static_cast<std::size_t>(row) * heights.columns + column];
            out.positions.push_back(position + Vec3{(double(column) / (heights.columns - 1) - 0.5) * size.x,
                                                    (0.5 - double(row) / (heights.rows - 1)) * size.y,
                                                    value / brightest * size.z});
        }
    for (int row = 0; row + 1 < heights.rows; ++row)
        for (int column = 0; column + 1 < heights.columns; ++column) {
            const auto a = static_cast<std::uint32_t>(row * heights.columns + column), b = a + 1;
            const std::uint32_t c = a + static_cast<std::uint32_t>(heights.columns), d = c + 1;
            out.indices.insert(out.indices.end(), {a, c, d, a, d, b});
        }
    return {out};
}

}  // namespace echoloop::worlds
