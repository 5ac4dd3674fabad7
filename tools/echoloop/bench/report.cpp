#include "tools/echoloop/bench/report.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <optional>
#include <utility>

#include "tools/echoloop/common.h"

namespace echoloop::bench {
namespace {

constexpr double most_start_up = 1, most_memory = 200, most_growth = 2, most_bending = 1.2;
/// Of two million triangles.
constexpr double most_long_start_up = 2, most_peak = 400;

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
    char buffer[512];
    std::va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
    va_end(arguments);
    return buffer;
}

const Row* find(const Report& report, const std::string& name, EchoRule rule) {
    for (const Row& row : report.rows)
        if (row.the_case.name() == name && row.rule == rule && row.figures.failure[0] == '\0') return &row;
    return nullptr;
}

void add_start_up(const Report& report, std::vector<Limit>& limits) {
    double start_up = 0, peak = 0;
    for (const Row& row : report.rows) {
        if (row.the_case.scene != "big2m" && row.the_case.scene != "one2m") continue;
        start_up = std::max(start_up, row.figures.start_up);
        peak = std::max(peak, row.figures.peak);
    }
    if (!(peak > 0)) return;
    limits.push_back({"start-up with two million triangles, the slowest", start_up, most_long_start_up, "s"});
    limits.push_back({"peak memory with two million triangles, the most", peak, most_peak, "MB"});
}

/// The time of a ping of `more` over that of `less`, turn by turn; none where they took none.
std::optional<double> growth(const Row* less, const Row* more, double Turn::*time) {
    if (less == nullptr || more == nullptr) return {};
    if (less->turns.empty() || less->turns.size() != more->turns.size()) return {};
    std::vector<double> ratios;
    for (std::size_t i = 0; i < less->turns.size(); ++i)
        ratios.push_back(more->turns[i].*time / less->turns[i].*time);
    return spread_of(std::move(ratios)).median;
}

void add_growth(const Report& report, const std::string& sonar, std::vector<Limit>& limits) {
    const auto row = [&](const char* scene) { return find(report, sonar + scene, EchoRule::radiometric); };
    const auto add = [&](const char* what, const std::optional<double>& times) {
        if (times) limits.push_back({sonar + what, *times, most_growth, "times"});
    };
    const Row *simple = row("-simple"), *many = row("-big2m");
    add(": time with twenty times the triangles", growth(row("-big100k"), many, &Turn::wall));
    add(": CPU, two million triangles in two meshes", growth(simple, many, &Turn::cpu));
    add(": CPU, two million triangles in one mesh", growth(simple, row("-one2m"), &Turn::cpu));
}

std::string line_of(const char* label, const Spread& s, const std::string& rest = {}) {
    return format("    %-8s%10.3f%10.3f%10.3f", label, s.minimum, s.median, s.p99) + rest + "\n";
}

std::string target_text(const Row& row) {
    if (!row.the_case.target) return {};
    const Target& target = *row.the_case.target;
    return format("%10s%10s%10s   (%s)", cli::plain(target.aim, 2).c_str(),
                  cli::plain(target.least, 2).c_str(), reached(row).c_str(), target.reference.c_str());
}

/// Why the aim was missed: what a rasteriser needs at least, and what takes longest of the rest.
std::string miss_text(const Row& row) {
    if (reached(row) != "least" && reached(row) != "no") return {};
    const Figures& f = row.figures;
    const std::array rest{std::pair{f.bins, "bins"}, std::pair{f.acoustics, "acoustics"},
                          std::pair{f.paths, "paths"}, std::pair{f.cull, "cull"}};
    const auto& [time, name] = *std::ranges::max_element(rest);
    return format(
        "    %.2f over the aim: draw and read-back alone, a rasteriser's floor, take %.2f, %s %.2f\n",
        f.wall.median - row.the_case.target->aim, f.draw + f.read_back, name, time);
}

std::string text_of(const Row& row) {
    const Figures& f = row.figures;
    std::string text = cli::padded(row.the_case.name(), 24) + rule_name(row.rule) + "\n";
    if (f.failure[0] != '\0') return text + "    failed: " + f.failure + "\n";
    text += line_of("wall", f.wall, target_text(row)) + line_of("cpu", f.cpu);
    text += format("    cull %.3f, draw %.3f, read-back %.3f, bins %.3f, paths %.3f, acoustics %.3f\n",
                   f.cull, f.draw, f.read_back, f.bins, f.paths, f.acoustics);
    text += format(
        "    %.0f triangles drawn, %.0f in the scene; %.0f pixels; start-up %.2f s (CPU %.2f); memory %.0f "
        "MB, peak "
        "%.0f MB\n",
        f.triangles, f.scene_triangles, f.pixels, f.start_up, f.start_up_cpu, f.resident, f.peak);
    text += miss_text(row);
    return text;
}

}  // namespace

std::string rule_name(EchoRule rule) {
    return rule == EchoRule::radiometric ? "radiometric, every effect on" : "cerqueira2016";
}

std::string reached(const Row& row) {
    if (!row.the_case.target || row.figures.failure[0] != '\0') return {};
    if (row.figures.wall.median <= row.the_case.target->aim) return "aim";
    return row.figures.wall.median <= row.the_case.target->least ? "least" : "no";
}

std::vector<Limit> limits_of(const Report& report) {
    std::vector<Limit> limits;
    double start_up = 0, memory = 0;
    for (const Row& row : report.rows) {
        if (row.the_case.scene != "big100k" || !row.the_case.profile.empty()) continue;
        start_up = std::max(start_up, row.figures.start_up);
        memory = std::max(memory, row.figures.resident);
    }
    if (memory > 0) {
        limits.push_back({"start-up with big100k, the slowest", start_up, most_start_up, "s"});
        limits.push_back({"resident memory with big100k, the most", memory, most_memory, "MB"});
    }
    add_start_up(report, limits);
    add_growth(report, "fls", limits);
    add_growth(report, "scanning", limits);
    for (const Row& row : report.rows)
        if (row.figures.straight_cpu > 0)
            limits.push_back({row.the_case.name() + ": time over that of straight rays",
                              row.figures.cpu.median / row.figures.straight_cpu, most_bending, "times"});
    return limits;
}

std::string text_of(const Report& report) {
    std::string text =
        format("ms per ping of %zu       minimum    median       p99       aim  at least   reached\n",
               report.settings.pings);
    for (const Row& row : report.rows) text += text_of(row);
    for (const Limit& limit : limits_of(report))
        text += cli::padded(limit.what + ":", 60) +
                format("%.2f %s, at most %s: %s\n", limit.ours, limit.unit.c_str(),
                       cli::plain(limit.most, 2).c_str(), limit.met() ? "yes" : "no");
    if (!report.rows.empty())
        text += std::string("rendered by ") + report.rows.front().figures.context + "\n";
    return text;
}

}  // namespace echoloop::bench
