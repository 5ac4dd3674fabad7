#include "emulator/replay/exchanges.h"

#include <algorithm>

#include "emulator/contract/error.h"

namespace echoloop::replay {
namespace {

constexpr std::size_t most_messages = 5'000'000, most_different = 100'000;
/// So many of one kind behind one request are no answers but a stream.
constexpr std::size_t stream_from = 4;
/// A pause this much longer than the usual gap ends a run.
constexpr int long_pause = 3;

}  // namespace

Exchanges::Exchanges(Source& source) {
    while (const auto said = source.next()) {
        if (said_.size() + exchanges_.size() >= most_messages)
            throw StartError(Exit::data,
                             "the capture holds more than 5 million messages; choose a part of it with "
                             "--from and --until");
        if (said->by_device) {
            keep(*said);
        } else if (!said->command.key.empty()) {
            keep_request(*said);
        }
    }
    sort_out(unasked_kinds());
    find_usual_gap();
    find_runs();
}

void Exchanges::keep(const Said& said) {
    const auto kind = kinds_.try_emplace({said.port, said.name}, kinds_.size()).first->second;
    said_.push_back({said.time, said.port, kind, store_.keep(said.bytes)});
    following_.push_back(exchanges_.size());
    if (!exchanges_.empty()) exchanges_.back().end = said_.size();
}

void Exchanges::keep_request(const Said& said) {
    std::vector<double> values;
    for (const auto& [name, value] : said.command.values) values.push_back(value);
    SameRequests& same = by_key_[{said.port, said.command.key}][values];
    if (same.exchanges.empty()) {
        same.command = said.command;
        if (++different_ > most_different)
            throw StartError(Exit::data,
                             "the capture holds more than 100,000 different requests; choose a part of "
                             "it with --from and --until");
    }
    same.exchanges.push_back(exchanges_.size());
    exchanges_.push_back({said.time, said_.size(), said_.size(), {}});
}

/// Kinds that come before any request, or over and over behind one.
std::vector<bool> Exchanges::unasked_kinds() const {
    std::vector<bool> unasked(kinds_.size(), false);
    std::vector<std::size_t> count(kinds_.size(), 0), behind(kinds_.size(), 0);
    for (std::size_t i = 0; i < said_.size(); ++i) {
        const std::size_t kind = said_[i].kind;
        if (behind[kind] != following_[i]) count[kind] = 0;
        behind[kind] = following_[i];
        if (following_[i] == 0 || ++count[kind] >= stream_from) unasked[kind] = true;
    }
    return unasked;
}

void Exchanges::sort_out(const std::vector<bool>& unasked) {
    for (std::size_t i = 0; i < said_.size(); ++i) {
        said_[i].unasked = unasked[said_[i].kind];
        if (said_[i].unasked) unasked_.push_back(i);
    }
    begins_unasked_ = !unasked_.empty() && following_[unasked_.front()] == 0;
}

/// The parts of one ping come at once, so only gaps count that are not much shorter than the longest; a pause
/// that a request explains does not count either.
void Exchanges::find_usual_gap() {
    std::vector<Time> gaps;
    for (std::size_t i = 1; i < unasked_.size(); ++i)
        if (following_[unasked_[i]] == following_[unasked_[i - 1]])
            gaps.push_back(said_[unasked_[i]].time - said_[unasked_[i - 1]].time);
    usual_gap_ = std::chrono::seconds(1);
    if (gaps.empty()) return;
    const Time longest = *std::ranges::max_element(gaps);
    std::erase_if(gaps, [longest](Time gap) { return gap < longest / 4; });
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::ranges::nth_element(gaps, middle);
    usual_gap_ = std::max(*middle, Time(std::chrono::milliseconds(1)));
}

/// A run ends with a long pause that a request explains.
void Exchanges::find_runs() {
    const Time pause = long_pause * usual_gap_;
    const auto time = [this](std::size_t i) { return said_[unasked_[i]].time; };
    for (std::size_t i = 0; i < unasked_.size(); ++i) {
        const bool asked = i > 0 && following_[unasked_[i]] != following_[unasked_[i - 1]];
        if (i == 0 || (asked && time(i) - time(i - 1) > pause)) run_begins_.push_back(i);
    }
    std::size_t next = 0;
    for (std::size_t k = 0; k < exchanges_.size(); ++k) {
        Exchange& exchange = exchanges_[k];
        while (next < unasked_.size() && following_[unasked_[next]] <= k) ++next;
        const bool before = next > 0 && exchange.time - time(next - 1) <= pause;
        const bool in_segment = next < unasked_.size() && following_[unasked_[next]] == k + 1;
        const bool soon = next < unasked_.size() && time(next) - exchange.time <= pause;
        const bool after = in_segment || (before && soon);
        if (after) exchange.unasked_after = next;
        exchange.starts_unasked = after && !before;
        exchange.stops_unasked = before && !after;
    }
}

std::pair<std::size_t, std::size_t> Exchanges::run_of(std::size_t i) const {
    const auto end = std::ranges::upper_bound(run_begins_, i);
    const std::size_t last = end == run_begins_.end() ? unasked_.size() - 1 : *end - 1;
    return {*std::prev(end), last};
}

SameRequests* Exchanges::nearest(std::size_t port, const Command& command) {
    const auto found = by_key_.find({port, command.key});
    if (found == by_key_.end()) return nullptr;
    SameRequests* best = nullptr;
    double least = 0;
    for (auto& [values, same] : found->second) {
        const double d = distance(command, same.command);
        if (best != nullptr && d >= least) continue;
        best = &same;
        least = d;
    }
    return best;
}

}  // namespace echoloop::replay
