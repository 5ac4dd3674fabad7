#include "protocols/kmall/sound_text.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <span>
#include <string_view>

namespace echoloop::kmall {
namespace {

using wire::Error;
using wire::Reason;

constexpr std::size_t header_words = 7, sample_words = 4;
using Words = std::vector<std::string_view>;

/// Between commas; line ends count as nothing.
Words words_of(std::string_view text) {
    Words words;
    while (true) {
        const std::size_t end = std::min(text.find(','), text.size());
        std::string_view word = text.substr(0, end);
        const std::size_t first = std::min(word.find_first_not_of("\r\n"), word.size());
        word.remove_prefix(first);
        words.push_back(word);
        if (end == text.size()) return words;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> number(std::string_view word, double low, double high) {
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size() || !(value >= low && value <= high))
        return {};
    return value;
}

bool checksum_fits(std::string_view text) {
    const std::size_t star = text.rfind('*');
    if (star == text.npos || text.size() < star + 3) return false;
    std::uint8_t sum = 0, told = 0;
    for (const char c : text.substr(1, star - 1)) sum ^= static_cast<std::uint8_t>(c);
    const char* digits = text.data() + star + 1;
    const auto [end, fault] = std::from_chars(digits, digits + 2, told, 16);
    return fault == std::errc{} && end == digits + 2 && sum == told;
}

/// hhmmss, dd, mm, yyyy.
std::optional<std::uint32_t> unix_time(std::span<const std::string_view> words) {
    const auto clock = number(words[0], 0, 235959), day = number(words[1], 1, 31),
               month = number(words[2], 1, 12), year = number(words[3], 1970, 2105);
    if (!clock || !day || !month || !year) return {};
    const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(*year)),
                                           std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    const auto digits = static_cast<std::uint32_t>(*clock);
    const std::uint32_t hours = digits / 10000, minutes = digits / 100 % 100, seconds = digits % 100;
    if (!date.ok() || minutes > 59 || seconds > 59) return {};
    const auto days = std::chrono::sys_days(date).time_since_epoch().count();
    return static_cast<std::uint32_t>(days * 86400 + hours * 3600 + minutes * 60 + seconds);
}

/// "5924.00" and "N": degrees and minutes; not known if it is no such text.
std::optional<double> degrees(std::string_view word, std::string_view side, std::string_view sides) {
    const auto value = number(word, 0, 18000);
    if (!value || side.size() != 1 || sides.find(side) == sides.npos) return {};
    const double whole = std::floor(*value / 100);
    const double angle = whole + (*value - 100 * whole) / 60;
    return side[0] == sides[1] ? -angle : angle;
}

/// Bounds: what senders give, and what water can have.
std::optional<SoundSample> sample(std::span<const std::string_view> words, char kind) {
    const auto depth = number(words[0], 0, 12000);
    if (!depth) return {};
    SoundSample out{*depth, number(words[1], 1300, 1700), number(words[2], -5, 60), number(words[3], 0, 60)};
    const bool measured = out.temperature && out.salinity;
    if (kind == '2' ? !measured : !out.speed) return {};
    if (kind == '1' && !measured) return {};
    if (kind == '2') out.speed.reset();
    return out;
}

}  // namespace

wire::Result<SoundReading> read_sound_text(const SoundText& sound) {
    const std::string_view text = sound.text;
    const auto error = [](std::string_view field, Reason reason) {
        return Error{"sound speed text", field, 0, reason};
    };
    if (text.size() < 7) return error("", Reason::truncated);
    SoundReading out;
    out.format = text.substr(3, 3);
    // Only speeds; with temperature and salinity; these alone. S12 has what S01 has, S22 what S02 has.
    char kind = 0;
    if (out.format == "S00" || out.format == "S10") kind = '0';
    if (out.format == "S01" || out.format == "S12") kind = '1';
    if (out.format == "S02" || out.format == "S22") kind = '2';
    if (kind == 0) return error("format", Reason::unknown_message);
    if (!checksum_fits(text)) return error("checksum", Reason::wrong_constant);
    const Words words = words_of(text.substr(0, text.rfind('*')));
    if (words.size() < header_words) return error("", Reason::truncated);
    const auto count = number(words[2], 1, 1000);
    if (!count) return error("count", Reason::wrong_count);
    const std::size_t samples = static_cast<std::size_t>(*count),
                      place = header_words + samples * sample_words;
    if (words.size() < place + 4) return error("samples", Reason::wrong_count);
    const std::span all(words);
    const auto seconds = unix_time(all.subspan(3, 4));
    if (!seconds) return error("time", Reason::wrong_constant);
    out.seconds = *seconds;
    for (std::size_t i = 0; i < samples; ++i) {
        const auto one = sample(all.subspan(header_words + i * sample_words, sample_words), kind);
        if (!one || (i > 0 && one->depth <= out.samples.back().depth))
            return error("samples", Reason::wrong_constant);
        out.samples.push_back(*one);
    }
    out.latitude = degrees(words[place], words[place + 1], "NS");
    out.longitude = degrees(words[place + 2], words[place + 3], "EW");
    return out;
}

}  // namespace echoloop::kmall
