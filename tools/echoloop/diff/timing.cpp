#include "tools/echoloop/diff/timing.h"

#include <algorithm>
#include <cmath>

namespace echoloop::diff {
namespace {

/// Seconds since 1970 have no finer resolution in a double than a microsecond, others have.
Spread spread_of_times(std::vector<double> values, double ticks_per_second = 1e6) {
    for (double& value : values) value = std::round(value * ticks_per_second) / ticks_per_second;
    return spread_of(values);
}

}  // namespace

Spread gaps(const std::vector<Message>& messages) {
    std::vector<double> values;
    for (std::size_t i = 1; i < messages.size(); ++i)
        values.push_back(messages[i].place.time - messages[i - 1].place.time);
    return spread_of_times(std::move(values));
}

Spread own_gaps(const std::vector<Message>& messages) {
    constexpr double since_start = 1e7;  // s; later times are counted from 1970
    std::vector<double> values;
    double latest = 0;
    for (std::size_t i = 1; i < messages.size(); ++i) {
        if (!messages[i - 1].own_time || !messages[i].own_time) return {};
        latest = std::max(latest, *messages[i].own_time);
        values.push_back(*messages[i].own_time - *messages[i - 1].own_time);
    }
    return spread_of_times(std::move(values), latest < since_start ? 1e9 : 1e6);
}

Spread answer_delays(const Direction& asking, const Direction& answering, const std::string& name) {
    std::vector<double> values;
    std::size_t next = 0;
    const auto& answers = answering.spoken;
    for (std::size_t i = 0; i < asking.spoken.size(); ++i) {
        const double asked = asking.spoken[i].first;
        while (next < answers.size() && answers[next].first < asked) ++next;
        if (next == answers.size()) break;
        const bool in_time =
            i + 1 == asking.spoken.size() || answers[next].first <= asking.spoken[i + 1].first;
        if (in_time && asking.spoken[i].second == name) values.push_back(answers[next].first - asked);
    }
    return spread_of_times(std::move(values));
}

}  // namespace echoloop::diff
