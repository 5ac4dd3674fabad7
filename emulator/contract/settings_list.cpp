#include "emulator/contract/settings_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "emulator/contract/options.h"
#include "emulator/contract/random_key.h"
#include "emulator/contract/receiver_notation.h"

namespace echoloop {
namespace {

Option row(std::string_view name, std::string_view unit, OptionValue value, std::string_view help,
           std::string_view source) {
    return {std::string(name), std::string(unit),   std::move(value),
            std::string(help), std::string(source), {}};
}

/// As it was written before it became radians: the conversion there and back costs the last bits.
double rounded(double degrees) { return std::round(degrees * 1e9) / 1e9; }

constexpr std::array<std::string_view, 3> shapes{"line", "hamming", "piston"};  // as in ApertureShape
constexpr std::array<std::string_view, 3> rules{"mean", "peak", "sample"};      // as in BinRule

/// The place of the profile's word among `words`; without a profile `at`, and a row is gathered.
std::size_t chosen_figure(const Profile* profile, std::vector<FigureRow>& rows, std::size_t at,
                          const std::string& name, std::span<const std::string_view> words,
                          const std::string& help) {
    if (profile != nullptr)
        return static_cast<std::size_t>(std::ranges::find(words, figure_of<std::string>(*profile, name)) -
                                        words.begin());
    rows.push_back({name, "", help, 0, 0, false, {words.begin(), words.end()}});
    return at;
}

}  // namespace

void OptionList::flag(bool& member, std::string_view name, std::string_view help, std::string_view source) {
    if (values_ != nullptr)
        member = echoloop::flag(*values_, name);
    else
        rows_.push_back(row(name, "", member, help, source));
}

void OptionList::text(std::string& member, std::string_view name, std::string_view help,
                      std::string_view source) {
    if (values_ != nullptr)
        member = echoloop::text(*values_, name);
    else
        rows_.push_back(row(name, "", member, help, source));
}

void OptionList::number(double& member, std::string_view name, std::string_view unit, double low, double high,
                        std::string_view help, std::string_view source) {
    if (values_ != nullptr) {
        member = echoloop::number(*values_, name);
        return;
    }
    rows_.push_back(row(name, unit, member, help, source));
    rows_.back().minimum = low;
    rows_.back().maximum = high;
}

void OptionList::degrees(double& member, std::string_view name, double low, double high,
                         std::string_view help, std::string_view source) {
    double value = rounded(rad_to_deg(member));
    number(value, name, "deg", low, high, help, source);
    member = deg_to_rad(value);
}

std::int64_t OptionList::integer(std::int64_t value, std::string_view name, std::string_view unit, double low,
                                 double high, std::string_view help, std::string_view source) {
    if (values_ != nullptr) return echoloop::integer(*values_, name);
    rows_.push_back(row(name, unit, value, help, source));
    rows_.back().minimum = low;
    rows_.back().maximum = high;
    return value;
}

void OptionList::choice(std::string& member, std::string_view name,
                        std::initializer_list<std::string_view> words, std::string_view help,
                        std::string_view source) {
    const auto at = static_cast<std::size_t>(std::ranges::find(words, member) - words.begin());
    member = words.begin()[place(at, name, words, help, source)];
}

std::size_t OptionList::place(std::size_t at, std::string_view name, std::span<const std::string_view> words,
                              std::string_view help, std::string_view source) {
    std::string word(words[at]);
    text(word, name, help, source);
    if (values_ == nullptr) rows_.back().choices.assign(words.begin(), words.end());
    const auto found = std::ranges::find(words, word);
    if (found == words.end())
        throw std::invalid_argument("option '" + std::string(name) + "': '" + word + "' is no choice");
    return static_cast<std::size_t>(found - words.begin());
}

void FigureList::number(double& member, std::string_view name, std::string_view unit, double low, double high,
                        std::string_view help) {
    if (values_ != nullptr)
        member = figure(*values_, name);
    else
        rows_.push_back({std::string(name), std::string(unit), std::string(help), low, high});
}

void FigureList::degrees(double& member, std::string_view name, double low, double high,
                         std::string_view help) {
    double value = 0;
    number(value, name, "deg", low, high, help);
    member = deg_to_rad(value);
}

void FigureList::integer(double& member, std::string_view name, double low, double high,
                         std::string_view help) {
    number(member, name, "", low, high, help);
    if (values_ == nullptr) rows_.back().whole = true;
}

void FigureList::pattern(AxisPattern& member, const std::string& axis, const std::string& across) {
    member.shape = static_cast<ApertureShape>(
        chosen_figure(values_, rows_, static_cast<std::size_t>(member.shape), axis + "_aperture", shapes,
                      "shape of the aperture across " + across));
    whole(member.ways, axis + "_ways", 1, 2,
          "2: the same aperture sends and hears; 1: only one is directive");
}

void FigureList::stave_errors(ArrayErrors& errors, std::string_view serial_number) {
    errors.unit = random_key(0, serial_number);
    number(errors.amplitude, "stave_amplitude_error", "dB", 0, 6,
           "standard deviation of the gains of the receiver's staves");
    degrees(errors.phase, "stave_phase_error", 0, 60, "the same of their phases");
}

void FigureList::common(AxisPattern& horizontal, AxisPattern& vertical, Receiver& receiver) {
    pattern(horizontal, "horizontal", "a beam");
    pattern(vertical, "vertical", "the fan");
    number(receiver.directivity_index, "directivity_index", "dB", 0, 60,
           "of the receiver against isotropic noise");
    number(receiver.self_noise, "self_noise", "dB re 1 uPa^2/Hz", -100, 200,
           "of the receiver, beside the thermal noise of the water");
    number(receiver.saturation_level, "saturation_level", "dB re 1 uPa", 50, 300,
           "at the receiver, where its input clips");
    whole(receiver.converter_bits, "converter_bits", 0, 32, "of the amplitude up to saturation; 0: no steps");
    whole(receiver.staves, "staves", 1, 4096,
          "converters from whose outputs a beam is formed; 1: one behind the beam");
    receiver.bins =
        static_cast<BinRule>(chosen_figure(values_, rows_, static_cast<std::size_t>(receiver.bins),
                                           "bin_rule", rules, "what a bin keeps of the looks in it"));
    notation(receiver.ring_down, "ring_down", "ms: dB re source level",
             "what the receiver hears of its own pulse, as points of a curve", read_ring_down,
             [](std::string_view text) { read_ring_down(text); });
    notation(receiver.interference, "interference", "", "what electronics near by leave in it",
             read_interference, [](std::string_view text) { read_interference(text); });
}

}  // namespace echoloop
