#include "tools/import/terrain/survey.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/import/fault.h"
#include "tools/import/terrain/raster.h"

namespace echoloop::worlds {
namespace {

struct Unit {
    const char* name;
    double metres;
};
constexpr double foot = 0.3048, survey_foot = 1200.0 / 3937.0;  // the USA's NIST, Special Publication 811
constexpr Unit units[] = {{"m", 1},
                          {"metre", 1},
                          {"meter", 1},
                          {"metres", 1},
                          {"meters", 1},
                          {"ft", foot},
                          {"foot", foot},
                          {"feet", foot},
                          {"us-ft", survey_foot},
                          {"ftus", survey_foot},
                          {"us survey foot", survey_foot},
                          {"us_survey_foot", survey_foot},
                          {"foot_us", survey_foot},
                          {"fathom", 6 * foot},
                          {"fathoms", 6 * foot},
                          {"cm", 0.01},
                          {"centimetre", 0.01},
                          {"km", 1000},
                          {"kilometre", 1000}};
constexpr double highest = 12'000;  ///< m; the Challenger Deep has 10,994, Mount Everest 8,849
constexpr double usual_nodata[] = {-9999, -99999, -32768, -32767, 32767, 99999, 9999};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

class Reading {
  public:
    Reading(const std::filesystem::path& file, const SurveyOptions& options)
        : file_(file), options_(options), raster_(file, options.layer) {}

    Survey read() {
        refuse_pictures();
        read_place();
        read_unit();
        read_heights();
        turn_up();
        return std::move(out_);
    }

  private:
    [[noreturn]] void fail(const std::string& reason, const std::string& remedy) const {
        throw Fault(file_, reason, remedy);
    }
    void note(const std::string& text) { out_.notes.push_back(text); }

    void refuse_pictures() {
        const int bands = raster_.data().GetRasterCount();
        const auto colour = raster_.band().GetColorInterpretation();
        if (colour == GCI_RedBand || colour == GCI_PaletteIndex)
            fail("is a picture in colours, not a grid of heights", "name the grid that it was drawn from");
        if (GDALDataTypeIsComplex(raster_.band().GetRasterDataType()))
            fail("holds complex numbers", "name a grid of heights in metres");
        if (bands > 1) note("the first of its " + std::to_string(bands) + " bands is taken");
    }

    void read_place() {
        const bool placed = raster_.data().GetGeoTransform(out_.affine.data()) == CE_None;
        if (!placed)
            fail("does not say where its samples are", "give it a place with gdal_translate -a_ullr");
        const double area = out_.affine[1] * out_.affine[5] - out_.affine[2] * out_.affine[4];
        if (!std::isfinite(area) || area == 0)
            fail("has samples that are all in one place", "give it a place with gdal_translate -a_ullr");
        OGRSpatialReference crs;
        if (const auto* const own = raster_.data().GetSpatialRef()) crs = *own;
        if (!options_.crs.empty() &&
            crs.SetFromUserInput(options_.crs.c_str(),
                                 OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS) != OGRERR_NONE)
            fail("--crs " + options_.crs + " is no coordinate reference system",
                 "write for example --crs EPSG:32632");
        if (options_.local || (crs.IsLocal() && !crs.IsEmpty())) return read_local(crs);
        if (crs.IsEmpty() && has_axes_in_degrees()) {
            crs.importFromEPSG(4326);
            note("its axes are degrees, which are taken as those of WGS 84");
        }
        if (crs.IsEmpty() && options_.local_if_unknown) return read_local(crs);
        if (crs.IsEmpty()) fail("has no projection", projection_remedy());
        if (!options_.crs.empty() && raster_.data().GetSpatialRef() != nullptr)
            note("--crs is taken instead of the file's own");
        vertical_metres_ = crs.IsCompound() ? crs.GetTargetLinearUnits("VERT_CS") : 0;
        note(std::string("its coordinates are in ") +
             (crs.GetName() != nullptr ? crs.GetName() : "a projection"));
        crs.StripVertical();  // heights stay those of the file
        char* text = nullptr;
        crs.exportToWkt(&text);
        out_.crs = text != nullptr ? text : "";
        CPLFree(text);
    }

    void read_local(const OGRSpatialReference& crs) {
        if (crs.IsGeographic()) fail("--local: its coordinates are degrees", "leave out --local");
        out_.metres = crs.IsEmpty() ? 1 : crs.GetLinearUnits();
        note("its coordinates are taken as metres east and north in the world");
    }

    /// As netCDF's conventions have it: an axis whose unit is degrees_north.
    bool has_axes_in_degrees() const {
        const CPLStringList items(CSLDuplicate(raster_.data().GetMetadata()), TRUE);
        for (int i = 0; i < items.size(); ++i) {
            const std::string item = lower(items[i]);
            if (item.find("#units=degree") != std::string::npos && item.ends_with("north")) return true;
        }
        return false;
    }

    std::string projection_remedy() const {
        const auto& a = out_.affine;
        const bool degrees = std::abs(a[0]) <= 360 && std::abs(a[3]) <= 90 && std::abs(a[1]) < 1;
        return std::string("say which it has, for example --crs ") +
               (degrees ? "EPSG:4326, since they look like degrees" : "EPSG:32632") +
               ", or --local if they are metres east and north in the world";
    }

    void read_unit() {
        const std::string own = raster_.band().GetUnitType();
        const std::string name = lower(options_.units.empty() ? own : options_.units);
        if (name.empty()) {
            if (vertical_metres_ > 0) {
                metres_ = vertical_metres_;
                if (metres_ != 1) note("its heights are converted: one unit is " + number(metres_) + " m");
                return;
            }
            return note("its heights are taken as metres, for it does not say (--units ft else)");
        }
        const auto found = std::ranges::find(units, name, &Unit::name);
        if (found == std::end(units))
            fail("its heights are in \"" + name + "\"", "say --units m, ft, us-ft, fathom, cm or km");
        metres_ = found->metres;
        if (metres_ != 1)
            note("its heights are converted from " + name + " to metres, times " + number(metres_));
    }

    void read_heights() {
        GDALRasterBand& band = raster_.band();
        Heights& heights = out_.heights;
        heights.width = raster_.data().GetRasterXSize(), heights.height = raster_.data().GetRasterYSize();
        int has_nodata = 0;
        band.GetNoDataValue(&has_nodata);
        const bool declared = has_nodata != 0 || options_.nodata || band.GetMaskFlags() != GMF_ALL_VALID;
        const double scale = band.GetScale(), offset = band.GetOffset();
        const auto width = static_cast<std::size_t>(heights.width);
        heights.values.resize(width * static_cast<std::size_t>(heights.height));
        std::vector<double> row(width);
        std::vector<std::uint8_t> mask(width);
        for (int y = 0; y < heights.height; ++y) {
            read_row(band, y, row.data(), GDT_Float64, heights.width);
            read_row(*band.GetMaskBand(), y, mask.data(), GDT_Byte, heights.width);
            float* const to = &heights.values[static_cast<std::size_t>(y) * width];
            for (std::size_t x = 0; x < width; ++x)
                to[x] = mask[x] == 0 ? nothing : height_of(row[x], scale, offset, declared);
        }
        const auto holes = static_cast<std::size_t>(
            std::ranges::count_if(heights.values, [](float z) { return std::isnan(z); }));
        if (holes == heights.values.size())
            fail("holds no sample with a value", "look at it with gdalinfo -stats");
        note(std::to_string(heights.width) + " x " + std::to_string(heights.height) + " samples, " +
             std::to_string(holes) + " of them without a value, which are holes");
        if (undeclared_ > 0)
            note(std::to_string(undeclared_) + " samples have a value such as " + number(undeclared_value_) +
                 " that usually means \"nothing\", and are taken as holes (--nodata says which value it is)");
        if (too_far_ > 0)
            note(std::to_string(too_far_) +
                 " samples are above or below all of the Earth and are taken as holes");
    }

    void read_row(GDALRasterBand& band, int y, void* to, GDALDataType type, int width) {
        CPLErrorReset();
        if (band.RasterIO(GF_Read, 0, y, width, 1, to, width, 1, type, 0, 0, nullptr) != CE_None)
            fail("row " + std::to_string(y) + " cannot be read (" + Raster::complaint() + ")",
                 "the file is damaged: fetch it again");
    }

    float height_of(double value, double scale, double offset, bool declared) {
        if (options_.nodata && value == *options_.nodata) return nothing;
        if (!std::isfinite(value)) return nothing;
        if (!declared && std::ranges::find(usual_nodata, value) != std::end(usual_nodata)) {
            ++undeclared_, undeclared_value_ = value;
            return nothing;
        }
        const double z = (value * scale + offset) * metres_;
        if (std::abs(z) <= highest) return static_cast<float>(z);
        ++too_far_;
        return nothing;
    }

    /// What the file says of the direction, if anything: "up" or "down".
    std::string told_direction() const {
        GDALRasterBand& band = raster_.band();
        const auto item = [&band](const char* key) {
            const char* const text = band.GetMetadataItem(key);
            return lower(text != nullptr ? text : "");
        };
        if (const std::string told = item("positive"); told == "up" || told == "down") return told;
        const std::string words =
            item("standard_name") + " " + item("long_name") + " " + lower(band.GetDescription());
        for (const char* const word : {"height", "altitude", "elevation"})
            if (words.find(word) != std::string::npos) return "up";
        return words.find("depth") != std::string::npos ? "down" : "";
    }

    void turn_up() {
        auto& values = out_.heights.values;
        const auto level = static_cast<float>(options_.water_level);
        std::string direction = options_.positive, why = "as --positive says";
        if (direction.empty()) direction = told_direction(), why = "as the file says";
        if (direction.empty()) {
            const bool above = std::ranges::none_of(values, [level](float z) { return z < level; });
            direction = above ? "down" : "up";
            why = above ? "a guess, since none is below the water: --positive up if they are heights"
                        : "a guess, since some are below the water: --positive down if they are depths";
        }
        const bool down = direction == "down";
        note(std::string("its values are ") + (down ? "depths, positive down" : "heights, positive up") +
             " (" + why + ")");
        for (float& z : values) z = down ? -(z + level) : z - level;
    }

    static constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

    const std::filesystem::path& file_;
    const SurveyOptions& options_;
    Raster raster_;
    Survey out_;
    double metres_ = 1, vertical_metres_ = 0;
    std::size_t undeclared_ = 0, too_far_ = 0;
    double undeclared_value_ = 0;
};

}  // namespace

Survey read_survey(const std::filesystem::path& file, const SurveyOptions& options) {
    return Reading(file, options).read();
}

}  // namespace echoloop::worlds
