#include <algorithm>

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

/// Figures of the profile that stand among the options, but for those that are options as well.
std::vector<std::string_view> misplaced_figures(const Value* value, const Model& model) {
    std::vector<std::string_view> found;
    for (const FigureRow& figure : model.figures)
        if (value != nullptr && value->find(figure.name) != nullptr &&
            std::ranges::find(model.options, figure.name, &Option::name) == model.options.end())
            found.push_back(figure.name);
    return found;
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
    const auto figures = misplaced_figures(value, model);
    known.insert(known.end(), figures.begin(), figures.end());
    const Section section(value, path, known, problems);
    for (const std::string_view figure : figures)
        problems.add(section.get(figure)->key_place,
                     section.path_of(figure) + " is a figure of the device's profile; write profile: {" +
                         std::string(figure) + ": ...} beside options");
    Options options;
    for (const auto& option : model.options) options[option.name] = read_option(option, section, problems);
    return options;
}

}  // namespace echoloop::scenario
