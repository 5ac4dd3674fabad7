#include "tools/import/terrain/raster.h"

#include <cpl_conv.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>

#include "tools/import/terrain/delaunay.h"
#include "tools/import/terrain/survey.h"

namespace echoloop::worlds {
namespace {

// VRT and its like are not among them: they name files that lie anywhere.
constexpr std::array drivers{"GTiff", "AAIGrid", "netCDF", "GMT", "GSAG",
                             "GSBG",  "GS7BG",   "XYZ",    "BAG", static_cast<const char*>(nullptr)};
constexpr const char* formats = "GeoTIFF, .asc, .grd, .nc, .xyz and .bag can be read";
constexpr std::array height_names{"elevation", "z",     "depth",      "height", "altitude",
                                  "topo",      "Band1", "bathymetry", "dem",    "bottom"};
constexpr std::int64_t most_samples = std::int64_t{1} << 26;

void set_up() {
    static const bool done = [] {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        for (const auto& [key, value] : {std::pair{"GDAL_CACHEMAX", "128"},
                                         {"GDAL_NUM_THREADS", "1"},
                                         {"CPL_VSIL_CURL_ALLOWED_EXTENSIONS", ".none"}})
            CPLSetConfigOption(key, value);
        OSRSetPROJEnableNetwork(0);
        GDALAllRegister();
        return true;
    }();
    static_cast<void>(done);
}

/// The name of a layer in GDAL's name of it: NETCDF:"file.nc":elevation.
std::string last_part(const std::string& name) { return name.substr(name.rfind(':') + 1); }

std::vector<std::string> layers_of(GDALDataset& data) {
    std::vector<std::string> out;
    const CPLStringList items(CSLDuplicate(data.GetMetadata("SUBDATASETS")), TRUE);
    for (int i = 1;; ++i) {
        const char* const name = items.FetchNameValue(("SUBDATASET_" + std::to_string(i) + "_NAME").c_str());
        if (name == nullptr) return out;
        out.emplace_back(name);
    }
}

std::string list_of(const std::vector<std::string>& layers) {
    std::string out;
    for (const auto& layer : layers) out += (out.empty() ? "" : ", ") + last_part(layer);
    return out;
}

}  // namespace

std::string Raster::complaint() {
    std::string text = CPLGetLastErrorMsg();
    std::ranges::replace(text, '\n', ' ');
    return text.empty() ? "GDAL does not say why" : text.substr(0, 300);
}

GDALDatasetUniquePtr Raster::open(const std::string& name) const {
    CPLErrorReset();
    GDALDatasetUniquePtr data(
        GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data()));
    if (data) return data;
    throw TerrainError(file_, "is no grid that can be read (" + complaint() + ")",
                       std::string(formats) +
                           "; soundings that are no regular grid: make one of them with "
                           "GDAL's gdal_grid");
}

std::string Raster::layer_name(const std::string& layer) const {
    const auto layers = layers_of(*data_);
    const auto named = [&](const std::string& wanted) {
        return std::ranges::find(layers, wanted, last_part);
    };
    if (!layer.empty()) {
        if (const auto found = named(layer); found != layers.end()) return *found;
        throw TerrainError(
            file_, "has no layer \"" + layer + "\"",
            layers.empty() ? "it has one only: leave out --layer" : "it has " + list_of(layers));
    }
    if (data_->GetRasterCount() > 0) return {};
    for (const char* const name : height_names)
        if (const auto found = named(name); found != layers.end()) return *found;
    throw TerrainError(file_, "holds no layer that is called as heights are",
                       layers.empty() ? std::string(formats) : "choose one with --layer: " + list_of(layers));
}

Raster::Raster(const std::filesystem::path& file, const std::string& layer) : file_(file) {
    set_up();
    std::error_code fault;
    const auto path = std::filesystem::canonical(file, fault);
    if (fault || !std::filesystem::is_regular_file(path))
        throw TerrainError(file, "is not there, or is no file", "name the file of a survey");
    data_ = open(path.string());
    if (const std::string name = layer_name(layer); !name.empty()) data_ = open(name);
    const std::int64_t width = data_->GetRasterXSize(), height = data_->GetRasterYSize();
    if (data_->GetRasterCount() < 1 || width < 2 || height < 2)
        throw TerrainError(file, "holds no grid of 2 x 2 samples or more", formats);
    int block_width = 0, block_height = 0;
    band().GetBlockSize(&block_width, &block_height);
    if (width * height > most_samples || std::max(width, height) > GridDelaunay::most_samples ||
        std::int64_t{block_width} * block_height > most_samples)
        throw TerrainError(file,
                           "has " + std::to_string(width) + " x " + std::to_string(height) +
                               " samples, more than 67 million or 28,000 on a side",
                           "cut out what is needed with gdal_translate -projwin, or make it coarser with "
                           "gdalwarp -tr");
}

}  // namespace echoloop::worlds
