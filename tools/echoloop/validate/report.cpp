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
    if (!coloured) return q.passed() ? "pass" : "FAIL";
    return q.passed() ? "\033[32mpass\033[0m" : "\033[1;31mFAIL\033[0m";
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
           cell(tolerance_text(q)) + cell(q.passed() ? "yes" : "**no**") + cell(q.source) + "\n";
}

std::string summary(const Findings& findings) {
    const std::size_t all = findings.quantities().size(), failed = findings.failed();
    return std::to_string(all - failed) + " of " + std::to_string(all) +
           " quantities are within their tolerance";
}

std::string markdown_of(const Findings& findings, const std::string& pictures) {
    std::string text =
        "# Validation\n\n"
        "Written by `echoloop validate --report docs/validation.md`. Published values are literals in "
        "`tools/echoloop/validate`;\nours come from the parts that the emulator itself uses, on the machine "
        "that "
        "wrote this file.\n" +
        summary(findings) + ".\n";
    for (const Group& group : groups()) {
        text += "\n## " + std::string(group.id) + " " + std::string(group.title) + "\n\n" +
                "| | quantity | unit | published | ours | tolerance | pass | source |\n"
                "|---|---|---|---|---|---|---|---|\n";
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
    std::string text = "  " + cli::padded("quantity", width) + cli::padded("published", 14) +
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
