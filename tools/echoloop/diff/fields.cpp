#include "tools/echoloop/diff/fields.h"

#include <algorithm>
#include <cmath>

#include "tools/echoloop/diff/align.h"
#include "tools/echoloop/diff/spread.h"

namespace echoloop::diff {
namespace {

using Numbers = std::vector<double>;

std::string text_of(const Value& value) {
    constexpr std::size_t shown = 6, most_text = 80;
    if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
    if (const auto* text = std::get_if<std::string>(&value)) return text->substr(0, most_text);
    const auto& numbers = std::get<Numbers>(value);
    std::string out = '[' + std::to_string(numbers.size()) + ']';
    for (std::size_t i = 0; i < std::min(shown, numbers.size()); ++i) out += ' ' + number_text(numbers[i]);
    return numbers.size() > shown ? out + " ..." : out;
}

/// Neighbours among the floating-point numbers of so many bytes. Whole numbers are never taken for such.
bool are_neighbours(double a, double b, std::size_t width) {
    if (std::trunc(a) == a && std::trunc(b) == b) return false;
    if (width == sizeof(float)) {
        const auto first = static_cast<float>(a), second = static_cast<float>(b);
        return std::nextafter(first, second) == second;
    }
    return width == sizeof(double) && std::nextafter(a, b) == b;
}

/// Not a number is the same as not a number. `width`: B of a floating-point number whose last bit does not
/// count; 0: it does.
double distance(double a, double b, std::size_t width) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    const double size = std::abs(a - b);
    if (std::isnan(size)) return HUGE_VAL;
    return are_neighbours(a, b, width) ? 0 : size;
}

/// Greatest distance of the numbers; infinite if there is not the same number of them, or if a text differs.
double distance(const Value& a, const Value& b, std::size_t width) {
    if (a.index() != b.index()) return HUGE_VAL;
    if (const auto* number = std::get_if<double>(&a)) return distance(*number, std::get<double>(b), width);
    if (const auto* text = std::get_if<std::string>(&a))
        return *text == std::get<std::string>(b) ? 0 : HUGE_VAL;
    const auto &first = std::get<Numbers>(a), &second = std::get<Numbers>(b);
    if (first.size() != second.size()) return HUGE_VAL;
    double most = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        most = std::max(most, distance(first[i], second[i], width));
    return most;
}

void add_squares(const Value& value, double& squares, std::size_t& count) {
    for (const double one : std::get<Numbers>(value)) {
        if (!std::isfinite(one)) continue;
        squares += one * one;
        ++count;
    }
}

double rms(double squares, std::size_t count) {
    return count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
}

}  // namespace

FieldComparison::Sums& FieldComparison::sums_of(const NamedValue& field) {
    const auto [place, is_new] = by_name_.try_emplace(field.name, fields_.size());
    if (is_new) {
        fields_.emplace_back();
        fields_.back().report.name = field.name;
        fields_.back().report.unit = field.unit;
        fields_.back().rule = rules_.of(type_, field.name);
    }
    return fields_[place->second];
}

void FieldComparison::add(const Message& a, const Message& b) {
    for (std::size_t i = 0; i < a.fields.size(); ++i) {
        const NamedValue& field = a.fields[i];
        const NamedValue* other = b.find(field.name, i);
        if (other != nullptr)
            compare(sums_of(field), field, *other, a, b);
        else
            absent(field, a, b, true);
    }
    for (std::size_t i = 0; i < b.fields.size(); ++i)
        if (a.find(b.fields[i].name, i) == nullptr) absent(b.fields[i], a, b, false);
}

void FieldComparison::absent(const NamedValue& field, const Message& a, const Message& b, bool in_a) {
    Sums& sums = sums_of(field);
    ++sums.report.compared;
    ++sums.report.different;
    sums.report.absent = true;
    const std::string there = text_of(field.value), nothing = "(not there)";
    if (!sums.report.first)
        sums.report.first = Difference{a.place, b.place, in_a ? there : nothing, in_a ? nothing : there};
}

void FieldComparison::compare(Sums& sums, const NamedValue& a, const NamedValue& b, const Message& in_a,
                              const Message& in_b) {
    FieldReport& report = sums.report;
    ++report.compared;
    const bool exact = sums.rule.has_limit && sums.rule.limit == 0;
    const bool samples =
        a.value.index() == b.value.index() && (is_samples(a.value) || is_samples(b.value)) && !exact;
    const double far = distance(a.value, b.value, exact ? 0 : a.width);
    if (samples) {
        report.samples = true;
        add_squares(a.value, sums.squares_a, sums.numbers_a);
        add_squares(b.value, sums.squares_b, sums.numbers_b);
        if (std::get<Numbers>(a.value).size() != std::get<Numbers>(b.value).size()) sums.same_length = false;
    }
    if (far <= (samples ? 0 : sums.rule.limit)) return;
    ++report.different;
    if (std::isfinite(far)) report.largest = std::max(report.largest, far);
    if (!report.first) report.first = Difference{in_a.place, in_b.place, text_of(a.value), text_of(b.value)};
}

std::vector<FieldReport> FieldComparison::reports() const {
    std::vector<FieldReport> out;
    for (const Sums& sums : fields_) {
        FieldReport report = sums.report;
        report.rms_a = rms(sums.squares_a, sums.numbers_a);
        report.rms_b = rms(sums.squares_b, sums.numbers_b);
        const double limit = sums.rule.has_limit ? sums.rule.limit : usual_rms_tolerance;
        const double most = limit * std::max(report.rms_a, report.rms_b);
        const bool alike = report.samples && !report.absent && sums.same_length &&
                           std::abs(report.rms_a - report.rms_b) <= most;
        if (sums.rule.ignored || sums.rule.varies)
            report.verdict = Verdict::not_compared;
        else if (report.different > 0)
            report.verdict = alike ? Verdict::alike : Verdict::different;
        out.push_back(std::move(report));
    }
    return out;
}

}  // namespace echoloop::diff
