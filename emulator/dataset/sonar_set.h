// What a data set has of one sonar: its arrays, its pictures, the bytes that it said, its lines of the index.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emulator/dataset/coco.h"
#include "emulator/dataset/picture.h"
#include "emulator/dataset/zarr.h"
#include "emulator/truth/truth.h"

namespace echoloop {

/// Files that all sonars of a data set share.
struct SharedFiles {
    explicit SharedFiles(DatasetPlace& files)
        : place(files), coco(files), index(files, "index.jsonl"), truth(files, "truth.jsonl") {}
    DatasetPlace& place;
    Coco coco;
    DatasetStream index, truth;
    std::uint64_t truth_lines = 0;
};

class SonarSet {
  public:
    /// `turns`: it is a scanning head.
    SonarSet(SharedFiles& files, std::string name, bool turns)
        : files_(files), name_(std::move(name)), turns_(turns) {}

    /// `ping.echo` has values and labels. Throws DatasetFault, as everything here.
    void heard(PingTruth ping, const Look& look);
    /// What the device says for the ping that it has heard last.
    void said(std::size_t port, std::string_view bytes);
    void finish();

  private:
    /// A picture is of one ping of a fan, and of many of a sonar of one beam.
    enum class Kind { fan, head, line, rows };
    /// Pings with the same beams and bins, which share an array.
    struct Settings {
        std::vector<double> bearings, elevations;
        double first_bin_time = 0, bin_interval = 0;
        std::size_t bins = 0;
        friend bool operator==(const Settings&, const Settings&) = default;
    };
    struct Arrays {
        Settings settings;
        zarr::Array levels, objects;
        nlohmann::ordered_json attributes;
        RangeAxis axis;
    };
    /// A picture that is being gathered.
    struct Gathered {
        std::string number;  ///< of its first ping
        Scan scan;
        Visibility visible;
        double last_pan = 0, travelled = 0;
    };
    /// A ping whose bytes are still being said.
    struct Pending {
        nlohmann::ordered_json line;
        std::vector<float> levels;
        std::vector<std::uint16_t> labels;
        std::string wire;
        std::vector<std::size_t> messages;  ///< port and bytes of each, in turn
    };

    void begin_arrays(const PingTruth& ping);
    void finish_arrays();
    nlohmann::ordered_json draw(const PingTruth& ping, const std::vector<std::uint16_t>& counts,
                                const Look& look);
    nlohmann::ordered_json draw_scan(const PingTruth& ping);
    nlohmann::ordered_json draw_rows(const PingTruth& ping, const std::vector<std::uint16_t>& counts);
    void gather(const PingTruth& ping, const std::vector<std::uint16_t>& counts);
    bool goes_on(double pan) const;
    nlohmann::ordered_json places(const PingTruth& ping, std::size_t column);
    const CartesianMap& map();
    void finish_picture();
    void put_picture(const char* kind, const CountPicture& picture, nlohmann::ordered_json more);
    void finish_ping();
    std::string file_of(const char* kind) const;

    SharedFiles& files_;
    std::string name_;
    bool turns_;
    Kind kind_ = Kind::fan;
    std::size_t settings_ = 0, pings_ = 0;
    std::optional<Arrays> arrays_;
    std::optional<Gathered> gathered_;
    std::optional<CartesianMap> map_;
    std::vector<double> map_bearings_;
    EchoRule rule_ = EchoRule::radiometric;
    double beam_width_ = 0;
    std::optional<Pending> pending_;
    std::unique_ptr<DatasetStream> wire_;
};

}  // namespace echoloop
