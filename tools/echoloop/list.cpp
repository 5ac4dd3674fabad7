// echoloop list: the sonars that can be emulated; of one or all, the options and the acoustic figures with
// sources.
#include <cstdio>

#include "emulator/scenario/problems.h"
#include "emulator/scenario/profile_section.h"
#include "emulator/scenario/section.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/faults_output.h"
#include "tools/echoloop/json_output.h"

namespace echoloop::cli {
namespace {

struct ValueText {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return plain(v, 9); }
    std::string operator()(const std::string& v) const { return v.empty() ? "''" : v; }
};

std::string allowed(const Option& option) {
    if (!option.choices.empty()) {
        std::string words;
        for (const auto& choice : option.choices) words += (words.empty() ? "" : " | ") + choice;
        return words;
    }
    if (option.default_value.index() == 0) return "true | false";
    if (option.default_value.index() == 3) return "text";
    if (option.minimum <= -1e300 && option.maximum >= 1e300)
        return option.unit.empty() ? "number" : option.unit;
    return scenario::text_of({option.minimum, option.maximum, option.unit});
}

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

void print_option(const Option& option, std::size_t width) {
    std::printf("    %s%s%s\n", padded(option.name, width).c_str(),
                padded(std::visit(ValueText{}, option.default_value), 14).c_str(), allowed(option).c_str());
    std::printf("    %s%s%s%s\n", padded("", width).c_str(), option.help.c_str(),
                option.source.empty() ? "" : " -- ", option.source.c_str());
}

std::string text_of(const Figure& figure) {
    const auto* number = std::get_if<double>(&figure.value);
    return number == nullptr ? std::get<std::string>(figure.value) : plain(*number, 9);
}

void print_figures(const Model& model) {
    std::size_t width = 0;
    for (const auto& row : model.figures) width = std::max(width, row.name.size() + 2);
    const Profile profile = own_profile(model);
    std::printf("  profile       (figure, value, unit)\n");
    for (const auto& row : model.figures) {
        const Figure& figure = profile.at(row.name);
        const auto value = row.unit.empty() ? text_of(figure) : padded(text_of(figure), 14) + row.unit;
        std::printf("    %s%s\n", padded(row.name, width).c_str(), value.c_str());
        std::printf("    %s%s -- %s\n", padded("", width).c_str(), row.help.c_str(), figure.source.c_str());
    }
}

void print_model(const Model& model) {
    std::printf("%s%s\n", padded(model.name, 18).c_str(), model.title.c_str());
    std::printf("  protocol      %s\n", model.protocol.c_str());
    std::printf("  endpoints     %s\n", joined(model.default_endpoints, "  ").c_str());
    std::printf("  schemes       %s\n", joined(model.endpoint_schemes, ", ").c_str());
    std::size_t width = 0;
    for (const auto& option : model.options) width = std::max(width, option.name.size() + 2);
    if (!model.options.empty()) std::printf("  options       (name, default, allowed)\n");
    for (const auto& option : model.options) print_option(option, width);
    if (!model.figures.empty()) print_figures(model);
}

/// One line per model, and the way to more.
void print_names(std::span<const Model> shown) {
    std::size_t name = 0, title = 0;
    for (const auto& model : shown) {
        name = std::max(name, model.name.size() + 2);
        title = std::max(title, model.title.size() + 2);
    }
    for (const auto& model : shown)
        std::printf("%s%s%s\n", padded(model.name, name).c_str(), padded(model.title, title).c_str(),
                    model.protocol.c_str());
    std::printf(
        "\n`echoloop list MODEL` shows the options and acoustic figures of one, with their sources.\n");
}

std::span<const Model> wanted(const Arguments& arguments) {
    if (!arguments.has("MODEL")) return models();
    const auto name = arguments.text("MODEL");
    std::vector<std::string_view> known;
    for (const auto& model : models()) {
        if (model.name == name) return {&model, 1};
        known.push_back(model.name);
    }
    throw StartError(Exit::usage,
                     "unknown model " + scenario::in_quotes(name) + scenario::suggestion(name, known));
}

int run_list(const Arguments& arguments) {
    if (arguments.has("--faults")) {
        if (arguments.has("--json")) {
            std::printf("%s\n", fault_kinds_json().c_str());
        } else {
            print_fault_kinds();
        }
        return 0;
    }
    const auto shown = wanted(arguments);
    if (arguments.has("--json")) {
        std::printf("%s\n", list_json(shown).c_str());
        return 0;
    }
    if (!arguments.has("MODEL") && !arguments.has("--all")) {
        print_names(shown);
        return 0;
    }
    for (const auto& model : shown) {
        print_model(model);
        if (&model != &shown.back()) std::printf("\n");
    }
    return 0;
}

}  // namespace

Verb list_verb() {
    return {"list",
            "list the sonars, their options and their acoustic figures",
            {{Argument::Kind::optional, "MODEL", "", "show the options and figures of this model"},
             {Argument::Kind::flag, "--all", "", "show the options and figures of every model"},
             {Argument::Kind::flag, "--faults", "", "show the faults that a run can make"},
             json_argument()},
            "  echoloop list\n"
            "  echoloop list tritech-micron\n"
            "  echoloop list --all\n"
            "  echoloop list --faults\n"
            "  echoloop list --json | jq -r '.models[].name'",
            run_list};
}

}  // namespace echoloop::cli
