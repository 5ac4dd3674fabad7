#include "emulator/scenario/section.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <set>
#include <sstream>

#include "emulator/scenario/number.h"

namespace echoloop::scenario {
namespace {

std::string plain(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(12);
    text << number;
    return text.str();
}

void report_keys(const Value& map, const std::string& path, const std::vector<std::string_view>& known,
                 Problems& problems) {
    std::set<std::string_view> seen;
    for (const auto& item : map.items) {
        if (!seen.insert(item.key).second)
            problems.add(item.key_place, "key " + in_quotes(item.key) + " is given twice in " + path);
        else if (std::ranges::find(known, item.key) == known.end())
            problems.add(item.key_place,
                         "unknown key " + in_quotes(item.key) + " in " + path + suggestion(item.key, known));
    }
}

}  // namespace

std::string text_of(const Range& range) {
    const auto unit = range.unit.empty() ? std::string() : " " + std::string(range.unit);
    if (range.minimum <= -1e300) return "up to " + plain(range.maximum) + unit;
    if (range.maximum >= 1e300) return plain(range.minimum) + unit + " or more";
    return plain(range.minimum) + " to " + plain(range.maximum) + unit;
}

bool Checker::fail(const Value& value, const std::string& path, const std::string& message) {
    problems_.add(value.place, path + ": " + message);
    return false;
}

bool Checker::expected(const Value& value, const std::string& path, const std::string& what) {
    return fail(value, path, "expected " + what + ", got " + describe(value));
}

bool Checker::number(const Value& value, const std::string& path, const Range& range, double& result) {
    const auto parsed = value.is_scalar() && !value.quoted ? parse_number(value.text) : std::nullopt;
    if (!parsed)
        return expected(value, path,
                        range.unit.empty() ? "a number" : "a number in " + std::string(range.unit));
    if (!std::isfinite(*parsed)) return fail(value, path, in_quotes(value.text) + " is not a finite number");
    if (*parsed < range.minimum || *parsed > range.maximum)
        return fail(value, path, plain(*parsed) + " is out of range; allowed is " + text_of(range));
    result = *parsed;
    return true;
}

bool Checker::whole(const Value& value, const std::string& path, const Range& range, std::int64_t& result) {
    const auto parsed = value.is_scalar() && !value.quoted ? parse_whole(value.text) : std::nullopt;
    if (!parsed) return expected(value, path, "a whole number, " + text_of(range));
    const auto as_number = static_cast<double>(*parsed);
    if (as_number < range.minimum || as_number > range.maximum)
        return fail(value, path, plain(as_number) + " is out of range; allowed is " + text_of(range));
    result = *parsed;
    return true;
}

bool Checker::truth(const Value& value, const std::string& path, bool& result) {
    if (!value.is_scalar() || value.quoted || (value.text != "true" && value.text != "false"))
        return expected(value, path, "true or false");
    result = value.text == "true";
    return true;
}

bool Checker::text(const Value& value, const std::string& path, std::string& result) {
    if (!value.is_scalar()) return expected(value, path, "text");
    if (value.text.find('\0') != std::string::npos) return fail(value, path, "holds a zero character");
    result = value.text;
    return true;
}

bool Checker::word(const Value& value, const std::string& path, const std::vector<std::string_view>& words,
                   std::string& result) {
    std::string given;
    if (!text(value, path, given)) return false;
    if (std::ranges::find(words, given) == words.end())
        return fail(value, path, "unknown value " + in_quotes(given) + suggestion(given, words));
    result = given;
    return true;
}

bool Checker::triple(const Value& value, const std::string& path, const Range& range, Vec3& result) {
    if (!value.is_sequence() || value.items.size() != 3)
        return expected(value, path, "three numbers in " + std::string(range.unit) + ", as in [0, 0, -3]");
    Vec3 read;
    bool good = number(value.items[0], path + ".0", range, read.x);
    good = number(value.items[1], path + ".1", range, read.y) && good;
    good = number(value.items[2], path + ".2", range, read.z) && good;
    if (good) result = read;
    return good;
}

Section::Section(const Value* value, std::string path, const std::vector<std::string_view>& keys,
                 Problems& problems)
    : path_(std::move(path)), problems_(problems) {
    if (value == nullptr) return;
    place_ = value->place;
    if (value->is_map()) {
        map_ = value;
        report_keys(*value, path_.empty() ? "the scenario" : path_, keys, problems);
    } else if (value->kind != Value::Kind::null) {
        problems.add(value->place, (path_.empty() ? "the scenario" : path_) +
                                       ": expected keys and values, got " + describe(*value));
    }
}

const Value* Section::get(std::string_view key) const { return map_ == nullptr ? nullptr : map_->find(key); }

std::string Section::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

Place Section::place() const { return place_; }

double Section::number(std::string_view key, double fallback, const Range& range) const {
    if (const Value* value = get(key)) Checker(problems_).number(*value, path_of(key), range, fallback);
    return fallback;
}

std::string Section::text(std::string_view key, std::string fallback) const {
    if (const Value* value = get(key)) Checker(problems_).text(*value, path_of(key), fallback);
    return fallback;
}

std::string Section::word(std::string_view key, std::string fallback,
                          const std::vector<std::string_view>& words) const {
    if (const Value* value = get(key)) Checker(problems_).word(*value, path_of(key), words, fallback);
    return fallback;
}

Vec3 Section::triple(std::string_view key, const Range& range) const {
    Vec3 result;
    if (const Value* value = get(key)) Checker(problems_).triple(*value, path_of(key), range, result);
    return result;
}

}  // namespace echoloop::scenario
