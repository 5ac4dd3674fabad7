#include "tools/import/heightmap.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include "tools/import/fault.h"
#include "tools/import/terrain/placing.h"
#include "tools/import/terrain/triangulation.h"

namespace echoloop::worlds {
namespace {

constexpr int most_samples = 2048;
constexpr std::size_t most_triangles = 1'000'000;

struct Picture {
    int columns = 0, rows = 0;
    std::vector<float> values{};  ///< rows from north to south
};

using Data = std::unique_ptr<GDALDataset>;

/// Nothing where the file is no image, or is a map in the form of one.
Data open_image(const std::filesystem::path& file) {
    GDALAllRegister();
    const char* const drivers[] = {"PNG", "JPEG", "BMP", "GTiff", nullptr};
    Data image(GDALDataset::FromHandle(GDALOpenEx(file.c_str(), GDAL_OF_RASTER, drivers, nullptr, nullptr)));
    if (!image || image->GetRasterCount() < 1) return nullptr;
    const GDALDataType type = image->GetRasterBand(1)->GetRasterDataType();
    double place[6];
    const bool is_map =
        std::string_view(image->GetDriverName()) == "GTiff" && image->GetGeoTransform(place) == CE_None;
    return is_map || (type != GDT_Byte && type != GDT_UInt16) ? nullptr : std::move(image);
}

Picture read_image(const std::filesystem::path& file, GDALDataset& image) {
    const std::string place = printable(file.string());
    GDALRasterBand* band = image.GetRasterBand(1);
    Picture out{std::min(band->GetXSize(), most_samples), std::min(band->GetYSize(), most_samples)};
    if (out.columns < 2 || out.rows < 2)
        throw Fault(place, "has fewer than 2 x 2 samples", "give a larger image");
    out.values.resize(static_cast<std::size_t>(out.columns) * out.rows);
    if (band->RasterIO(GF_Read, 0, 0, band->GetXSize(), band->GetYSize(), out.values.data(), out.columns,
                       out.rows, GDT_Float32, 0, 0, nullptr) != CE_None)
        throw Fault(place, "cannot be read: " + printable(CPLGetLastErrorMsg()), "export the image again");
    return out;
}

/// m, of the grid in its middle, from the first sample to the last.
struct Extent {
    double width, height;
};
Extent extent_of(const std::filesystem::path& file, const Survey& survey) {
    const auto& a = survey.affine;
    if (survey.crs.empty())
        return {std::hypot(a[1], a[4]) * survey.metres * (survey.heights.width - 1),
                std::hypot(a[2], a[5]) * survey.metres * (survey.heights.height - 1)};
    const Placing placing(file, survey, std::nullopt);
    const std::int32_t right = survey.heights.width - 1, bottom = survey.heights.height - 1;
    const std::array<GridPoint, 4> ends{
        {{0, bottom / 2}, {right, bottom / 2}, {right / 2, 0}, {right / 2, bottom}}};
    auto at = placing.place(survey.heights, ends);
    for (Vec3& p : at) p.z = 0;
    return {norm(at[1] - at[0]), norm(at[3] - at[2])};
}

/// As Gazebo's renderer has it: the lowest sample stays where it is.
void stretch(Heights& heights, double size) {
    const auto known = [](float a, float b) { return !std::isnan(a) && (std::isnan(b) || a < b); };
    const auto low = *std::ranges::min_element(heights.values, known);
    float high = low;
    for (const float z : heights.values)
        if (z > high) high = z;
    if (!(high > low)) return;
    for (float& z : heights.values) z = static_cast<float>(low + (z - low) * size / (high - low));
}

Shape read_terrain(const std::filesystem::path& file, std::optional<Vec3> size, Vec3 position,
                   std::vector<std::string>& notes) {
    const std::string name = printable(file.string());
    Survey survey = read_survey(file, {.positive = "up", .local_if_unknown = true});
    for (const std::string& note : survey.notes) notes.push_back(name + ": " + printable(note));
    Extent extent = extent_of(file, survey);
    if (size) extent = {size->x, size->y}, stretch(survey.heights, size->z);
    const Triangulation mesh = triangulate(survey.heights, {.most = most_triangles});
    if (mesh.triangles.empty())
        throw Fault(name, "has too many holes for a surface", "fill them with gdal_fillnodata.py");
    ShapeSurface out;
    for (const GridPoint& corner : mesh.corners) {
        const double u = double(corner.x) / (survey.heights.width - 1),
                     v = double(corner.y) / (survey.heights.height - 1);
        out.positions.push_back(
            position + Vec3{(u - 0.5) * extent.width, (0.5 - v) * extent.height, survey.heights.at(corner)});
    }
    // Rows go to the south here, so that what was counter-clockwise is not.
    for (const auto& [a, b, c] : mesh.triangles) out.indices.insert(out.indices.end(), {a, c, b});
    return {std::move(out)};
}

}  // namespace

Shape read_heightmap(const std::filesystem::path& file, std::optional<Vec3> given, Vec3 position,
                     std::vector<std::string>& notes) {
    const Data image = open_image(file);
    if (!image) return read_terrain(file, given, position, notes);
    const Vec3 size = given.value_or(Vec3{1, 1, 1});  // SDF's own
    const Picture heights = read_image(file, *image);
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
