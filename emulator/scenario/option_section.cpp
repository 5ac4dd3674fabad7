#include "emulator/scenario/device_section.h"

namespace echoloop::scenario {
namespace {

struct ReadOption {
    const Option& option;
    const Value& value;
    const std::string& path;
    Checker& checker;

    Range range() const { return {option.minimum, option.maximum, option.unit}; }

    OptionValue operator()(bool fallback) const {
        checker.truth(value, path, fallback);
        return fallback;
    }
    OptionValue operator()(std::int64_t fallback) const {
        checker.whole(value, path, range(), fallback);
        return fallback;
    }
    OptionValue operator()(double fallback) const {
        checker.number(value, path, range(), fallback);
        return fallback;
    }
    OptionValue operator()(std::string fallback) const {
        if (option.choices.empty()) {
            checker.text(value, path, fallback);
        } else {
            checker.word(value, path, {option.choices.begin(), option.choices.end()}, fallback);
        }
        return fallback;
    }
};

/// Figures of the profile that stand among the options.
void refuse_figures(const Section& section, const Model& model, Problems& problems) {
    for (const FigureRow& figure : model.figures)
        if (const Value* given = section.get(figure.name))
            problems.add(given->key_place, section.path_of(figure.name) +
                                               " is a figure of the device's profile; write profile: {" +
                                               figure.name + ": ...} beside options");
}

}  // namespace

OptionValue read_option(const Option& option, const Section& section, Problems& problems) {
    const Value* given = section.get(option.name);
    if (given == nullptr) return option.default_value;
    const auto name = section.path_of(option.name);
    Checker checker(problems);
    return std::visit(ReadOption{option, *given, name, checker}, option.default_value);
}

Options read_options(const Value* value, const std::string& path, const Model& model, Problems& problems) {
    std::vector<std::string_view> known;
    for (const auto& option : model.options) known.push_back(option.name);
    for (const auto& figure : model.figures)
        if (value != nullptr && value->find(figure.name) != nullptr) known.push_back(figure.name);
    const Section section(value, path, known, problems);
    refuse_figures(section, model, problems);
    Options options;
    for (const auto& option : model.options) options[option.name] = read_option(option, section, problems);
    return options;
}

}  // namespace echoloop::scenario
