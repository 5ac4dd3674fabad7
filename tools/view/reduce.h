// What pictures for the page have in common: fewer beams and bins, a byte for each level, JSON in front.
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace echoloop::view {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t most_bins = 512, most_beams = 1024;
inline constexpr int byte_steps = 254;

/// How a picture's beams and bins lie in those that there are. Rows of several are kept.
struct Grouping {
    std::size_t rows, columns, all_bins;  ///< that there are
    std::size_t beams, bins;              ///< of one row of the picture
    std::size_t per_beam, per_bin;

    Grouping(std::size_t rows_, std::size_t columns_, std::size_t bins_)
        : rows(rows_),
          columns(columns_),
          all_bins(bins_),
          beams(columns_),
          bins(bins_),
          per_beam(rows_ == 1 ? (columns_ + most_beams - 1) / most_beams : 1),
          per_bin((bins_ + most_bins - 1) / most_bins) {
        if (per_beam > 0) beams = (columns + per_beam - 1) / per_beam;
        if (per_bin > 0) bins = (all_bins + per_bin - 1) / per_bin;
    }

    /// Calls `each` with the place of the greatest `value(place)` of each group, beam by beam; one that is no
    /// number is less than all others.
    template <class Value, class Each>
    void for_each(const Value& value, const Each& each) const {
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t beam = 0; beam < beams; ++beam)
                for (std::size_t bin = 0; bin < bins; ++bin) each(greatest(value, row, beam, bin));
    }

  private:
    template <class Value>
    std::size_t greatest(const Value& value, std::size_t row, std::size_t beam, std::size_t bin) const {
        const std::size_t first = (row * columns + beam * per_beam) * all_bins + bin * per_bin;
        std::size_t best = first;
        for (std::size_t c = beam * per_beam; c < std::min(columns, (beam + 1) * per_beam); ++c)
            for (std::size_t b = bin * per_bin; b < std::min(all_bins, (bin + 1) * per_bin); ++b) {
                const std::size_t at = (row * columns + c) * all_bins + b;
                if (!(value(at) <= value(best))) best = std::isnan(value(at)) ? best : at;
            }
        return best;
    }
};

/// 0 for what lies below `floor` or is no number.
inline char to_byte(float level, float floor, float step) {
    if (!(level >= floor)) return 0;
    return static_cast<char>(std::min(static_cast<int>((level - floor) / step + 1), byte_steps + 1));
}

inline void put_le(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// The middle one of every `every` of them.
inline Json rounded(const std::vector<double>& values, std::size_t every) {
    Json all = Json::array();
    for (std::size_t i = every / 2; i < values.size(); i += every)
        all.push_back(std::round(values[i] * 1e5) / 1e5);
    return all;
}

/// Four bytes of length (little endian), that much JSON, then `bytes`.
inline std::string with_head(const Json& head, const std::string& bytes) {
    const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string message;
    message.reserve(4 + text.size() + bytes.size());
    put_le(message, static_cast<std::uint32_t>(text.size()), 4);
    return message + text + bytes;
}

}  // namespace echoloop::view
