#include "tools/echoloop/validate/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "tools/draw/draw.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/validate/groups.h"

namespace echoloop::validation {
namespace {

/// Six significant figures, or what a small number needs.
std::string number(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.8g", value);
    return buffer;
}

/// As many decimals as the tolerance can use.
std::string ours_text(const Quantity& q) {
    const double scale = q.bound == Bound::within ? q.tolerance : std::abs(q.published) / 10;
    if (!(scale > 0)) return number(q.ours);
    const int decimals = std::clamp(static_cast<int>(std::ceil(1 - std::log10(scale))), 0, 7);
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.*f", decimals, q.ours);
    return buffer;
}

std::string verdict(const Quantity& q, bool coloured) {
    const std::string word = q.passed() ? "pass" : q.required ? "FAIL" : "missed";
    if (!coloured) return word;
    return (q.passed() ? "\033[32m" : q.required ? "\033[1;31m" : "\033[33m") + word + "\033[0m";
}

std::string row_text(const Quantity& q, std::size_t width, bool coloured) {
    return "  " + cli::padded(q.name, width) + cli::padded(published_text(q), 14) +
           cli::padded(ours_text(q), 14) + cli::padded(tolerance_text(q), 10) + cli::padded(q.unit, 16) +
           verdict(q, coloured) + "\n";
}

/// A bar would end the cell.
std::string cell(const std::string& text) {
    std::string out = " ";
    for (const char c : text) out += c == '|' ? "\\|" : std::string(1, c);
    return out + " |";
}

std::string row_markdown(const Quantity& q) {
    return "|" + cell(q.id) + cell(q.name) + cell(q.unit) + cell(published_text(q)) + cell(ours_text(q)) +
           cell(tolerance_text(q)) +
           cell(q.passed()   ? "yes"
                : q.required ? "**no**"
                             : "missed") +
           cell(std::string(name_of(q.kind))) + cell(q.source) + "\n";
}

std::string summary(const Findings& findings) {
    std::size_t required = 0, aims = 0, met = 0;
    for (const Quantity& q : findings.quantities()) q.required ? ++required : (++aims, met += q.passed());
    std::string text = std::to_string(required - findings.failed()) + " of " + std::to_string(required) +
                       " quantities are within their tolerance";
    if (aims > 0) text += "; " + std::to_string(met) + " of " + std::to_string(aims) + " aims are met";
    return text;
}

/// How many of each kind there are.
std::string kinds_of(const Findings& findings) {
    std::string text;
    for (const Kind kind : {Kind::published, Kind::closed_form, Kind::property, Kind::recording}) {
        std::size_t count = 0;
        for (const Quantity& q : findings.quantities()) count += q.kind == kind;
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(name_of(kind));
    }
    return text;
}

std::string markdown_of(const Findings& findings, const std::string& pictures) {
    std::string text =
        "# Validation\n\n"
        "Written by `echoloop validate --report docs/validation.md`. Values to meet are literals in "
        "`tools/echoloop/validate`;\nours come from the parts that the emulator itself uses, on the machine "
        "that wrote this file.\n" +
        summary(findings) + ".\n\nWhat a value to meet is (" + kinds_of(findings) +
        "):\n\n"
        "- **published**: printed by somebody else, computed or measured there, for the same quantity.\n"
        "- **closed form**: a formula of a textbook or paper, computed apart from the program. It shows that "
        "the program does\n  what the formula says, not that a sonar does.\n"
        "- **property**: what has to hold by itself, as that the same ping twice is the same.\n"
        "- **recording**: a figure of bytes that a real device sent; ours is the same figure of bytes that "
        "the "
        "shipped profile\n  makes under the recording's settings, through the device itself. These rows are "
        "aims: a miss is told as such and\n  fails nothing. Some were fitted on the very recording that they "
        "are held against, as the profiles' sources say.\n\n"
        "`echoloop validate --recordings ../shared/data` adds rows that read the recordings themselves.\n";
    for (const Group& group : groups()) {
        text += "\n## " + std::string(group.id) + " " + std::string(group.title) + "\n\n" +
                "| | quantity | unit | to meet | ours | tolerance | pass | kind | source |\n"
                "|---|---|---|---|---|---|---|---|---|\n";
        for (const Quantity& q : findings.quantities())
            if (q.id == group.id) text += row_markdown(q);
    }
    text += "\n## Pictures\n";
    for (const NamedPlot& named : findings.plots())
        text += "\n![" + named.plot.title + "](" + pictures + "/validation-" + named.name + ".png)\n";
    return text;
}

}  // namespace

std::string published_text(const Quantity& q) {
    const char* sign = q.bound == Bound::at_most ? "<= " : q.bound == Bound::at_least ? ">= " : "";
    return sign + number(q.published);
}

std::string tolerance_text(const Quantity& q) {
    return q.bound == Bound::within ? "+-" + number(q.tolerance) : "";
}

std::string text_of(const Findings& findings, bool coloured) {
    std::size_t width = 0;
    for (const Quantity& q : findings.quantities()) width = std::max(width, q.name.size() + 2);
    std::string text = "  " + cli::padded("quantity", width) + cli::padded("to meet", 14) +
                       cli::padded("ours", 14) + cli::padded("tolerance", 10) + "unit\n";
    for (const Group& group : groups()) {
        bool titled = false;
        for (const Quantity& q : findings.quantities()) {
            if (q.id != group.id) continue;
            if (!titled) text += std::string(group.id) + " " + std::string(group.title) + "\n";
            titled = true;
            text += row_text(q, width, coloured);
        }
    }
    return text + summary(findings) + "\n";
}

void write_report(const Findings& findings, const std::filesystem::path& file) {
    const auto pictures = file.parent_path() / "pictures";
    std::error_code ignored;
    std::filesystem::create_directories(pictures, ignored);
    for (const NamedPlot& named : findings.plots())
        cli::write_whole(pictures / ("validation-" + named.name + ".png"),
                         [&](const auto& path) { draw::write_png(path, draw::plot_picture(named.plot)); });
    cli::write_whole(file, [&](const auto& path) {
        std::ofstream out(path);
        out << markdown_of(findings, "pictures");
        if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
    });
}

}  // namespace echoloop::validation
