// A file of a survey, opened by GDAL, and the layer of it that holds heights. Only drivers that read nothing
// but the file itself and what lies beside it under the same name.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <string>

namespace echoloop::worlds {

class Raster {
  public:
    /// `layer`: of several; "": the one whose name says that it holds heights. Throws TerrainError.
    Raster(const std::filesystem::path& file, const std::string& layer);

    GDALDataset& data() const { return *data_; }
    GDALRasterBand& band() const { return *data_->GetRasterBand(1); }
    /// What GDAL complained of last.
    static std::string complaint();

  private:
    GDALDatasetUniquePtr open(const std::string& name) const;
    std::string layer_name(const std::string& layer) const;

    std::filesystem::path file_;
    GDALDatasetUniquePtr data_;
};

}  // namespace echoloop::worlds
