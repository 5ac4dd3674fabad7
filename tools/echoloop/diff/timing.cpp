#include "tools/echoloop/diff/timing.h"

#include <algorithm>

namespace echoloop::diff {
namespace {

Statistics statistics(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t last = values.size() - 1;
    return {values.size(), values[last / 2], values[last * 95 / 100]};
}

}  // namespace

Statistics gaps(const std::vector<Message>& messages) {
    std::vector<double> values;
    for (std::size_t i = 1; i < messages.size(); ++i)
        values.push_back(messages[i].place.time - messages[i - 1].place.time);
    return statistics(std::move(values));
}

Statistics answer_delays(const Direction& asking, const Direction& answering, const std::string& name) {
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
    return statistics(std::move(values));
}

}  // namespace echoloop::diff
