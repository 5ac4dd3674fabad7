#include "emulator/scenario/profile_section.h"

#include "emulator/scenario/yaml.h"

namespace echoloop::scenario {
namespace {

std::vector<std::string_view> names(const Model& model) {
    std::vector<std::string_view> all;
    for (const auto& row : model.figures) all.push_back(row.name);
    return all;
}

/// Leaves `figure` as it is after a problem.
void read_value(const Value& value, const std::string& path, const FigureRow& row, Figure& figure,
                Problems& problems) {
    Checker checker(problems);
    if (row.check != nullptr) {
        std::string text;
        if (!checker.text(value, path, text)) return;
        try {
            row.check(text);
            figure.value = text;
        } catch (const std::invalid_argument& fault) {
            problems.add(value.place, path + ": " + fault.what());
        }
        return;
    }
    if (!row.choices.empty()) {
        std::string word;
        if (checker.word(value, path, {row.choices.begin(), row.choices.end()}, word)) figure.value = word;
        return;
    }
    const Range range{row.minimum, row.maximum, row.unit};
    double number = 0;
    std::int64_t whole = 0;
    if (row.whole ? checker.whole(value, path, range, whole) : checker.number(value, path, range, number))
        figure.value = row.whole ? static_cast<double>(whole) : number;
}

void check_unit(const Section& section, const FigureRow& row, Problems& problems) {
    const auto unit = section.text("unit", "");
    const auto stated = section.get("unit");
    if (unit == row.unit) return;
    problems.add(stated == nullptr ? section.place() : stated->place,
                 section.path_of("unit") + ": expected " + in_quotes(row.unit) + ", got " +
                     (stated == nullptr ? "nothing" : describe(*stated)) + "; give the figure in this unit");
}

Figure read_figure(const Value& value, const std::string& path, const FigureRow& row, Problems& problems) {
    const Section section(&value, path, {"value", "unit", "source"}, problems);
    Figure figure;
    if (!value.is_map()) return figure;
    check_unit(section, row, problems);
    if (const Value* given = section.get("value")) {
        read_value(*given, section.path_of("value"), row, figure, problems);
    } else {
        problems.add(section.place(), section.path_of("value") + " is missing");
    }
    figure.source = section.text("source", "");
    if (figure.source.empty())
        problems.add(section.place(), section.path_of("source") +
                                          " is missing; name the document, or say \"own choice: \" and why");
    return figure;
}

void check_model(const Section& top, const Model& model, Problems& problems) {
    const auto name = top.text("model", "");
    if (name == model.name) return;
    const Value* given = top.get("model");
    problems.add(given == nullptr ? top.place() : given->place,
                 "model: expected " + in_quotes(model.name) + ", the model of the device, got " +
                     (given == nullptr ? "nothing" : describe(*given)));
}

void read_rows(const Value& root, const Model& model, Profile& profile, Problems& problems) {
    auto keys = names(model);
    keys.insert(keys.begin(), "model");
    const Section top(&root, "the profile", keys, problems);
    check_model(top, model, problems);
    for (const auto& row : model.figures) {
        if (const Value* given = top.get(row.name)) {
            profile[row.name] = read_figure(*given, row.name, row, problems);
        } else {
            problems.add(top.place(), "figure " + in_quotes(row.name) + " is missing; add " + row.name +
                                          ": {value: , unit: " + in_quotes(row.unit) + ", source: }");
        }
    }
}

}  // namespace

Profile read_profile(const std::string& text, const std::string& file, const Model& model,
                     Problems& problems) {
    Problems own(file, {});
    Profile profile;
    try {
        read_rows(parse_yaml(text), model, profile, own);
    } catch (const YamlError& error) {
        own.add(error.place, error.message);
    }
    problems.append(own);
    return profile;
}

void read_figures(const Value* value, const std::string& path, const Model& model, Profile& profile,
                  Problems& problems) {
    const Section section(value, path, names(model), problems);
    for (const auto& row : model.figures) {
        const Value* given = section.get(row.name);
        if (given == nullptr) continue;
        read_value(*given, section.path_of(row.name), row, profile[row.name], problems);
        profile[row.name].source = "scenario";
    }
}

void check_piston(const Profile& profile, const Place& place, const std::string& path, Problems& problems) {
    const auto is_disc = [&](const char* figure) {
        return profile.contains(figure) && figure_of<std::string>(profile, figure) == "piston";
    };
    const bool across = is_disc("horizontal_aperture"), along = is_disc("vertical_aperture");
    if (across != along)
        problems.add(place,
                     path +
                         ": horizontal_aperture and vertical_aperture: one of them is a piston, but a disc's "
                         "pattern is the same all round; make both a piston, or neither");
    for (const std::string channel : {"", "low_"}) {
        const auto width = profile.find(channel + "beam_width"),
                   height = profile.find(channel + "fan_height");
        if (!across || !along || width == profile.end() || height == profile.end()) continue;
        if (width->second.value != height->second.value)
            problems.add(place, path + ": " + width->first + " and " + height->first +
                                    " differ, but a piston's beam is round; give both the same width");
    }
}

}  // namespace echoloop::scenario

namespace echoloop {

Profile own_profile(const Model& model) {
    if (model.figures.empty()) return {};
    const auto file = "config/devices/" + model.name + ".yaml";
    scenario::Problems problems(file, {});
    auto profile = scenario::read_profile(std::string(model.profile), file, model, problems);
    problems.throw_if_any();
    return profile;
}

}  // namespace echoloop
