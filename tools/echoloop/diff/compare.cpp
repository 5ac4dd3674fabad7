#include "tools/echoloop/diff/compare.h"

#include <algorithm>
#include <set>

#include "tools/echoloop/diff/align.h"
#include "tools/echoloop/diff/fields.h"
#include "tools/echoloop/diff/timing.h"

namespace echoloop::diff {
namespace {

using Match = std::pair<const Direction*, const Direction*>;

/// How much the two say alike: the share of messages whose type the other has, too; a little more for the
/// same name.
double likeness(const Direction& a, const Direction& b) {
    if (a.family != b.family) return 0;
    std::size_t common = 0;
    for (const auto& [name, messages] : a.types) {
        const auto other = b.types.find(name);
        if (other != b.types.end()) common += std::min(messages.size(), other->second.size());
    }
    const auto all = static_cast<double>(std::max<std::size_t>(a.spoken.size() + b.spoken.size(), 1));
    return common == 0 ? 0 : 2.0 * static_cast<double>(common) / all + (a.text() == b.text() ? 0.01 : 0);
}

/// Each direction with the most similar one that is left, best matches first; what has none stands alone.
std::vector<Match> matches(const Side& a, const Side& b) {
    std::vector<std::pair<double, Match>> candidates;
    for (const Direction& one : a.directions)
        for (const Direction& other : b.directions)
            if (const double likely = likeness(one, other); likely > 0)
                candidates.push_back({likely, {&one, &other}});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& one, const auto& other) { return one.first > other.first; });
    std::vector<Match> out;
    std::set<const Direction*> taken;
    for (const auto& [likely, match] : candidates) {
        if (taken.contains(match.first) || taken.contains(match.second)) continue;
        taken.insert({match.first, match.second});
        out.push_back(match);
    }
    for (const Direction& one : a.directions)
        if (!taken.contains(&one)) out.push_back({&one, nullptr});
    for (const Direction& one : b.directions)
        if (!taken.contains(&one)) out.push_back({nullptr, &one});
    return out;
}

TypeReport compare_type(const std::string& name, const std::vector<Message>& a, const std::vector<Message>& b,
                        const Rules& rules) {
    TypeReport out{.name = name, .a = a.size(), .b = b.size()};
    FieldComparison fields(name, rules);
    for (const Pair& pair : align(name, a, b, rules)) {
        if (pair.a && pair.b) {
            fields.add(a[*pair.a], b[*pair.b]);
            ++out.pairs;
        } else if (pair.a) {
            out.only_a.push_back(a[*pair.a].place);
        } else if (pair.b) {
            out.only_b.push_back(b[*pair.b].place);
        }
    }
    out.fields = fields.reports();
    for (FieldReport& field : out.fields) field.spreads = spreads_of(field.name, a, b);
    return out;
}

const Direction* answers_to(const Side& side, const Direction* direction) {
    if (direction == nullptr) return nullptr;
    const auto found = std::find_if(
        side.directions.begin(), side.directions.end(),
        [&](const Direction& other) { return &other != direction && other.answers(*direction); });
    return found == side.directions.end() ? nullptr : &*found;
}

/// A direction of one side, with whoever answers it there.
struct Speaker {
    const Direction* direction = nullptr;  ///< nullptr: this side has not got it
    const Direction* answers = nullptr;
    bool has_times = true;

    const std::vector<Message>& messages(const std::string& type) const {
        static const std::vector<Message> none;
        if (direction == nullptr) return none;
        const auto found = direction->types.find(type);
        return found == direction->types.end() ? none : found->second;
    }
    void add_times(const std::string& type, Spread& gap, Spread& own_gap, Spread& answer) const {
        if (direction == nullptr) return;
        own_gap = own_gaps(messages(type));
        if (!has_times) return;
        gap = gaps(messages(type));
        if (answers != nullptr) answer = answer_delays(*direction, *answers, type);
    }
};

std::set<std::string> types_of(const Match& match) {
    std::set<std::string> names;
    for (const auto* direction : {match.first, match.second})
        if (direction != nullptr)
            for (const auto& [name, messages] : direction->types) names.insert(name);
    return names;
}

DirectionReport compare_match(const Match& match, const Side& a, const Side& b, const Rules& rules) {
    const Speaker one{match.first, answers_to(a, match.first), a.has_times};
    const Speaker other{match.second, answers_to(b, match.second), b.has_times};
    const auto* family = (match.first != nullptr ? match.first : match.second)->family;
    DirectionReport out{.family = family == nullptr ? "" : std::string(family->name)};
    if (match.first != nullptr) out.a = match.first->text();
    if (match.second != nullptr) out.b = match.second->text();
    out.undecoded_a = match.first != nullptr ? match.first->undecoded_bytes : 0;
    out.undecoded_b = match.second != nullptr ? match.second->undecoded_bytes : 0;
    for (const std::string& name : types_of(match)) {
        TypeReport type = compare_type(name, one.messages(name), other.messages(name), rules);
        one.add_times(name, type.gap_a, type.own_gap_a, type.answer_a);
        other.add_times(name, type.gap_b, type.own_gap_b, type.answer_b);
        out.types.push_back(std::move(type));
    }
    return out;
}

void warn(const Side& side, std::vector<std::string>& warnings) {
    if (side.is_cut)
        warnings.push_back(side.file + ": only its first " + std::to_string(side.messages) +
                           " messages are compared; --port picks a device");
    for (const auto& trouble : side.troubles) warnings.push_back(side.file + ": " + trouble);
}

}  // namespace

Report compare(const Side& a, const Side& b, const Rules& rules) {
    Report out{.file_a = a.file, .file_b = b.file, .messages_a = a.messages, .messages_b = b.messages};
    for (const Match& match : matches(a, b)) out.directions.push_back(compare_match(match, a, b, rules));
    warn(a, out.warnings);
    warn(b, out.warnings);
    for (const std::string& name : rules.unused())
        out.warnings.push_back("no field is called " + name + "; --json lists them all");
    return out;
}

bool FieldReport::is_constant_once() const {
    const Spread &a = spreads.a, &b = spreads.b;
    return a.count > 1 && b.count > 1 && (a.distinct == 1) != (b.distinct == 1);
}

bool TypeReport::differs() const {
    return !only_a.empty() || !only_b.empty() ||
           std::any_of(fields.begin(), fields.end(),
                       [](const FieldReport& field) { return field.verdict == Verdict::different; });
}

bool DirectionReport::differs() const {
    return undecoded_a != undecoded_b ||
           std::any_of(types.begin(), types.end(), [](const TypeReport& type) { return type.differs(); });
}

bool Report::differs() const {
    return std::any_of(directions.begin(), directions.end(),
                       [](const DirectionReport& direction) { return direction.differs(); });
}

}  // namespace echoloop::diff
