// The options and figures of a sonar, listed once. A sonar writes
//
//     void describe(Settings& s, OptionList& o, FigureList& f) {
//         o.whole(s.gain, "gain", "", 0, 6, "gain setting at power-up", own);
//         o.choice(s.hang_up, "hang_up_on_fire", {"never", "first", "always"}, "on a fire", spec);
//         f.degrees(s.beam_width, "beam_width", 0.1, 60, "horizontal -3 dB full width");
//     }
//
// Run on settings as they are initialised, it gathers the rows of the model; a row's default is what the
// member holds. Run with the configuration of a device, it fills the members.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "emulator/contract/model.h"
#include "emulator/contract/sensors.h"

namespace echoloop {

/// A word of a choice and the value that it stands for.
template <class T>
struct Word {
    std::string_view word;
    T value;
};

/// Options in the order in which they are listed. Bounds are inclusive; `source` says where the default comes
/// from.
class OptionList {
  public:
    /// Gathers rows.
    OptionList() = default;
    /// Fills members. `values` are complete and outlive the list.
    explicit OptionList(const Options& values) : values_(&values) {}

    void flag(bool& member, std::string_view name, std::string_view help, std::string_view source);
    void text(std::string& member, std::string_view name, std::string_view help, std::string_view source);
    void number(double& member, std::string_view name, std::string_view unit, double low, double high,
                std::string_view help, std::string_view source);
    /// The option is in degrees, the member in radians.
    void degrees(double& member, std::string_view name, double low, double high, std::string_view help,
                 std::string_view source);
    template <class T>
    void whole(T& member, std::string_view name, std::string_view unit, double low, double high,
               std::string_view help, std::string_view source) {
        member =
            static_cast<T>(integer(static_cast<std::int64_t>(member), name, unit, low, high, help, source));
    }
    /// The words stand for the values of T from 0 on: of a bool or an enumeration.
    template <class T>
    void choice(T& member, std::string_view name, std::initializer_list<std::string_view> words,
                std::string_view help, std::string_view source) {
        member = static_cast<T>(place(static_cast<std::size_t>(member), name, words, help, source));
    }
    void choice(std::string& member, std::string_view name, std::initializer_list<std::string_view> words,
                std::string_view help, std::string_view source);
    /// Where the words are in another order than the values, or these are numbers.
    template <class T>
    void words(T& member, std::string_view name, std::initializer_list<Word<std::type_identity_t<T>>> words,
               std::string_view help, std::string_view source) {
        std::vector<std::string_view> names;
        std::size_t at = 0;
        for (const auto& [word, value] : words) {
            if (value == member) at = names.size();
            names.push_back(word);
        }
        member = words.begin()[place(at, name, names, help, source)].value;
    }

    std::vector<Option> take_rows() { return std::move(rows_); }

  private:
    std::int64_t integer(std::int64_t value, std::string_view name, std::string_view unit, double low,
                         double high, std::string_view help, std::string_view source);
    /// The place of the chosen word; `at` is that of the default.
    std::size_t place(std::size_t at, std::string_view name, std::span<const std::string_view> words,
                      std::string_view help, std::string_view source);

    const Options* values_ = nullptr;
    std::vector<Option> rows_;
};

/// Figures of a profile in the order in which they are listed. They have no defaults: the profile gives each.
class FigureList {
  public:
    /// Gathers rows.
    FigureList() = default;
    /// Fills members. `values` are complete and outlive the list.
    explicit FigureList(const Profile& values) : values_(&values) {}

    void number(double& member, std::string_view name, std::string_view unit, double low, double high,
                std::string_view help);
    /// The figure is in degrees, the member in radians.
    void degrees(double& member, std::string_view name, double low, double high, std::string_view help);
    template <class T>
    void whole(T& member, std::string_view name, double low, double high, std::string_view help) {
        auto value = static_cast<double>(member);
        integer(value, name, low, high, help);
        member = static_cast<T>(value);
    }
    /// What all models have: apertures and receiver, whose bandwidth is left to the pulse, with its ring-down
    /// and interference.
    void common(AxisPattern& horizontal, AxisPattern& vertical, Receiver& receiver);

    /// What arrays have besides: how their staves differ, in the unit of that serial number. Another one has
    /// other staves; the same number has the same, whatever the scenario's seed and the device's name.
    void stave_errors(ArrayErrors& errors, std::string_view serial_number);

    std::vector<FigureRow> take_rows() { return std::move(rows_); }

  private:
    void integer(double& member, std::string_view name, double low, double high, std::string_view help);
    /// A text in the notation that `read` knows, which makes T of it.
    template <class T>
    void notation(T& member, std::string_view name, std::string_view unit, std::string_view help,
                  T (*read)(std::string_view), void (*check)(std::string_view)) {
        if (values_ != nullptr) {
            member = read(figure_of<std::string>(*values_, name));
            return;
        }
        rows_.push_back({std::string(name), std::string(unit), std::string(help)});
        rows_.back().check = check;
    }
    /// The rows of one axis: "horizontal" or "vertical".
    void pattern(AxisPattern& member, const std::string& axis, const std::string& across);

    const Profile* values_ = nullptr;
    std::vector<FigureRow> rows_;
};

/// The rows of a model from describe(Settings&, OptionList&, FigureList&, more...).
template <class Settings, class... More>
void list_settings(Model& model, const More&... more) {
    Settings settings;
    OptionList options;
    FigureList figures;
    describe(settings, options, figures, more...);
    model.options = options.take_rows();
    model.figures = figures.take_rows();
}

/// Settings that describe() has filled from complete options and a complete profile. A member `sensors`
/// becomes those of this unit.
template <class Settings, class... More>
Settings fill_settings(const DeviceConfig& config, const More&... more) {
    Settings settings;
    OptionList options(config.options);
    FigureList figures(config.profile);
    describe(settings, options, figures, more...);
    if constexpr (requires { settings.sensors; })
        settings.sensors = Sensors(config.random_key, config.effects);
    return settings;
}

}  // namespace echoloop
