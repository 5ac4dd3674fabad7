#include "emulator/pose/trajectory_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "emulator/contract/error.h"
#include "emulator/pose/limits.h"
#include "emulator/scenario/file.h"

namespace echoloop {
namespace {

constexpr std::size_t columns = 8, most_rows = 10'000'000;
constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30;

using Row = std::array<double, columns>;         // t x y z qw qx qy qz
using Order = std::array<std::size_t, columns>;  // place of each column of a file in a Row
constexpr Order csv_order{0, 1, 2, 3, 4, 5, 6, 7};
constexpr Order tum_order{0, 1, 2, 3, 5, 6, 7, 4};
using Names = std::array<std::string_view, columns>;
constexpr Names metric_names{"t", "x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr Names geographic_names{"t", "latitude", "longitude", "altitude", "qw", "qx", "qy", "qz"};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Words between commas, or between blanks.
std::vector<std::string_view> words(std::string_view line, bool commas) {
    std::vector<std::string_view> found;
    while (!line.empty()) {
        const auto end = commas ? line.find(',') : line.find_first_of(" \t");
        found.push_back(trimmed(line.substr(0, end)));
        line = end == std::string_view::npos ? std::string_view() : line.substr(end + 1);
        if (!commas) line = trimmed(line);
    }
    return found;
}

bool is_number(std::string_view text) {
    double value = 0;
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

class Parser {
  public:
    Parser(const std::string& name, const std::optional<GeoPlace>& origin) : name_(name), origin_(origin) {}

    void line(std::string_view text) {
        ++number_;
        text = trimmed(text.substr(0, text.find('#')));
        if (text.empty()) return;
        const bool commas = text.find(',') != std::string_view::npos;
        const auto fields = words(text, commas);
        if (!order_) {
            order_ = commas ? csv_order : tum_order;
            if (commas && !is_number(fields[0])) return read_header(fields);
        }
        add(row(fields));
    }

    Track finish() {
        if (track_.empty()) throw StartError(Exit::data, name_ + ": there are no poses in it");
        return std::move(track_);
    }

  private:
    [[noreturn]] void fail(const std::string& why) const {
        throw StartError(Exit::data, name_ + ":" + std::to_string(number_) + ": " + why);
    }

    void read_header(const std::vector<std::string_view>& fields) {
        on_globe_ = std::ranges::find(fields, "latitude") != fields.end();
        if (on_globe_ && !origin_)
            fail(
                "nothing says where the world lies on the Earth; add origin: {latitude: ..., longitude: ...} "
                "to the scenario");
        const Names& names = on_globe_ ? geographic_names : metric_names;
        if (fields.size() != columns)
            fail("the header must name the columns t,x,y,z,qw,qx,qy,qz and no others; it names " +
                 std::to_string(fields.size()));
        Order order{};
        for (std::size_t i = 0; i < columns; ++i) {
            const auto found = std::ranges::find(names, fields[i]);
            if (found == names.end() || std::ranges::count(fields, fields[i]) != 1)
                fail(std::string("the header must name each of ") +
                     (on_globe_ ? "t,latitude,longitude,altitude,qw,qx,qy,qz" : "t,x,y,z,qw,qx,qy,qz") +
                     " once; it has '" + std::string(fields[i].substr(0, 40)) + "'");
            order[i] = static_cast<std::size_t>(found - names.begin());
        }
        order_ = order;
    }

    Row row(const std::vector<std::string_view>& fields) const {
        if (fields.size() != columns)
            fail("expected 8 numbers (CSV: t,x,y,z,qw,qx,qy,qz; TUM: t x y z qx qy qz qw), found " +
                 std::to_string(fields.size()));
        Row row{};
        for (std::size_t i = 0; i < columns; ++i) {
            double& value = row[(*order_)[i]];
            const auto [end, error] =
                std::from_chars(fields[i].data(), fields[i].data() + fields[i].size(), value);
            if (error != std::errc() || end != fields[i].data() + fields[i].size() || !std::isfinite(value))
                fail("'" + std::string(fields[i].substr(0, 40)) + "' is not a finite number");
        }
        return row;
    }

    void add(const Row& row) {
        if (track_.empty()) start_ = row[0];
        const double time = row[0] - start_;
        const Vec3 position =
            on_globe_ ? enu_from_place(*origin_, {row[1], row[2], row[3]}) : Vec3{row[1], row[2], row[3]};
        const double length =
            std::sqrt(row[4] * row[4] + row[5] * row[5] + row[6] * row[6] + row[7] * row[7]);
        if (!track_.empty() && time <= last_) fail("the time must be later than that of the row before");
        if (time > farthest * 1e3) fail("the time is too far from that of the first row");
        if (!(norm(position) <= farthest)) fail("the position is more than 1000 km from the origin");
        if (std::abs(length - 1) > 0.01) fail("the quaternion's length is not 1");
        if (track_.size() >= most_rows) fail("more than ten million rows");
        last_ = time;
        track_.add(from_seconds(time),
                   {position, {row[4] / length, row[5] / length, row[6] / length, row[7] / length}});
    }

    const std::string& name_;
    const std::optional<GeoPlace>& origin_;
    bool on_globe_ = false;  ///< its places are latitude, longitude and altitude
    std::size_t number_ = 0;
    std::optional<Order> order_;
    double start_ = 0, last_ = 0;
    // Nothing is too old in a file, and what moves there may move as it likes.
    Track track_{{.extrapolation = 0,
                  .stale_after = std::numeric_limits<double>::infinity(),
                  .fastest = std::numeric_limits<double>::infinity(),
                  .most = most_rows,
                  .stretch = MotionStretch::around}};
};

}  // namespace

Track parse_trajectory(std::string_view text, const std::string& name,
                       const std::optional<GeoPlace>& origin) {
    Parser parser(name, origin);
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets write it
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    while (!text.empty()) {
        const auto end = text.find('\n');
        parser.line(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return parser.finish();
}

Track read_trajectory(const std::filesystem::path& file, const std::optional<GeoPlace>& origin) {
    if (const auto fault = scenario::file_fault(file))
        throw StartError(fault->kind == Problem::Kind::no_permission ? Exit::no_permission : Exit::no_input,
                         file.string() + ": " + fault->message);
    if (std::filesystem::file_size(file) > largest_file)
        throw StartError(Exit::data, file.string() + ": larger than 2 GiB; split it");
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return parse_trajectory(text.view(), file.string(), origin);
}

}  // namespace echoloop
