#include "tools/echoloop/diff/rules.h"

#include <algorithm>
#include <string_view>

namespace echoloop::diff {
namespace {

/// Last words of fields that tell when, which one in a row, or what the others add up to.
constexpr std::string_view varying[] = {"time_ms",      "ping_seconds", "ping_nanoseconds",
                                        "ping_number",  "ping",         "ping_id",
                                        "seconds",      "nanoseconds",  "nanos",
                                        "timestamp",    "timestamp_ms", "timestamp_msec",
                                        "utc_msec",     "pwr_up_msec",  "transmit_time",
                                        "send_time",    "start_time",   "sonar_time",
                                        "go_time",      "uptime",       "date",
                                        "hundredths",   "milliseconds", "gps_seconds",
                                        "gps_fraction", "sequence_id",  "frame_index",
                                        "checksum",     "crc",          "transmission",
                                        "ping_latency", "data_latency", "year",
                                        "day",          "hours",        "minutes",
                                        "session_id",   "file_id",      "rx_packets",
                                        "tx_packets",   "round_trip",   "time"};

std::string_view last_word(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

/// The name by which the user means this field; empty if none does.
template <class Names>
std::string match(const Names& names, const std::string& message, const std::string& field) {
    for (const std::string& one : {field, message + '.' + field, std::string(last_word(field))})
        if (names.contains(one)) return one;
    return {};
}

}  // namespace

Rule Rules::of(const std::string& message, const std::string& field) const {
    Rule rule;
    const std::string ignored = match(ignored_, message, field), limit = match(limits_, message, field);
    used_.insert({ignored, limit});
    rule.ignored = !ignored.empty();
    rule.has_limit = !limit.empty();
    if (rule.has_limit) rule.limit = limits_.at(limit);
    const bool known =
        std::find(std::begin(varying), std::end(varying), last_word(field)) != std::end(varying);
    rule.varies = known && !rule.has_limit && !everything_;
    if (everything_) rule.has_limit = true;
    return rule;
}

std::vector<std::string> Rules::unused() const {
    std::vector<std::string> out;
    for (const auto& name : ignored_)
        if (!used_.contains(name)) out.push_back(name);
    for (const auto& [name, limit] : limits_)
        if (!used_.contains(name)) out.push_back(name);
    return out;
}

}  // namespace echoloop::diff
