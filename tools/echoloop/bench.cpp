// echoloop bench: how long a ping takes, where the time goes, and what was to be reached.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/machine/scheduling.h"
#include "tools/echoloop/bench/bars.h"
#include "tools/echoloop/bench/fans.h"
#include "tools/echoloop/bench/report.h"
#include "tools/echoloop/bench/wire.h"
#include "tools/echoloop/example_files.h"
#include "tools/echoloop/json_line.h"
#include "tools/echoloop/json_output.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

bench::Settings settings_of(const Arguments& arguments) {
    bench::Settings settings;
    const double pings = arguments.number("--pings", 100, 1, 100'000);
    if (pings != std::floor(pings)) throw StartError(Exit::usage, "--pings: expected a whole number");
    settings.pings = static_cast<std::size_t>(pings);
    settings.pixel_density = arguments.number("--pixels", 1, 0.1, 64);
    settings.context = arguments.text("--context", "auto");
    settings.sampler = arguments.text("--sampler", "auto");
    settings.scene_file = arguments.text("--scene");
    return settings;
}

std::vector<bench::Case> cases_of(const Arguments& arguments, const bench::Settings& settings) {
    const auto cases = settings.scene_file.empty()
                           ? bench::all_cases()
                           : bench::cases_of_scene(settings.scene_file.stem().string());
    return bench::chosen(cases, arguments.text("--cases"));
}

/// Before an hour's work is done.
void require_picture(const Arguments& arguments) {
    if (!arguments.has("--picture")) return;
    const std::filesystem::path out = arguments.text("--picture");
    if (!draw::picture_format_of(out))
        throw StartError(Exit::usage, "--picture: the name must end with .png, .svg or .pdf");
    require_creatable(out);
}

/// Of figures that are all 0 there is no picture.
void draw_if_asked(const Arguments& arguments, const std::function<draw::Bars()>& bars) {
    if (!arguments.has("--picture")) return;
    const std::filesystem::path out = arguments.text("--picture");
    try {
        const draw::Picture picture = draw::bars_picture(bars());
        write_whole(out, [&](const auto& file) {
            draw::write_picture(file, *draw::picture_format_of(out), picture);
        });
    } catch (const std::invalid_argument&) {
        print_warning("--picture: nothing was measured that could be drawn");
    }
}

bench::Report measured(const bench::Settings& settings, const std::vector<bench::Case>& cases) {
    bench::Report report{settings, {}};
    std::vector<bench::Case> straight = cases;
    std::erase_if(straight, [](const bench::Case& c) { return !c.profile.empty(); });
    Progress progress("measuring", cases.size() + straight.size());
    std::size_t done = 0;
    const auto measure = [&](const std::vector<bench::Case>& of, EchoRule rule) {
        std::vector<bench::Row> rows(of.size());
        for (const auto& group : bench::groups_of(of)) {
            std::vector<bench::Case> together;
            for (const std::size_t i : group) together.push_back(of[i]);
            auto measured = bench::measure_in_turns(together, rule, settings);
            for (std::size_t n = 0; n < group.size(); ++n)
                rows[group[n]] = {of[group[n]], rule, measured[n].figures, std::move(measured[n].turns)};
            progress.done(done += group.size());
        }
        std::ranges::move(rows, std::back_inserter(report.rows));
    };
    measure(cases, EchoRule::radiometric);
    measure(straight, EchoRule::cerqueira2016);  // it knows no bent rays
    return report;
}

/// A case that could not be rendered ends the program with an error, after the others have been shown.
int status_of(const bench::Report& report) {
    for (const bench::Row& row : report.rows)
        if (row.figures.failure[0] != '\0')
            throw StartError(Exit::unavailable, row.the_case.name() + ": " + row.figures.failure);
    return 0;
}

/// Those whose names begin so.
std::vector<bench::WireCase> wire_cases_of(const std::string& beginning) {
    std::vector<bench::WireCase> cases = bench::wire_cases();
    std::erase_if(cases, [&](const bench::WireCase& c) { return !c.name.starts_with(beginning); });
    if (cases.empty())
        throw StartError(Exit::usage,
                         "--cases: no name begins with " + beginning + "; bench --wire shows them all");
    return cases;
}

/// ms for as many values as the largest images have.
double scaled(const bench::WireFigures& f) {
    constexpr double image = 512 * 1000;
    return f.median * image / static_cast<double>(f.beams * f.bins);
}

void print_wire(const bench::WireFigures& f) {
    std::printf("%-28s %5zu x %4zu %9zu %10zu %8.2f %8.2f %8.2f\n", f.name.c_str(), f.beams, f.bins,
                f.messages, f.bytes, f.median, f.p99, scaled(f));
}

nlohmann::ordered_json wire_json(const bench::WireFigures& f) {
    return {{"case", f.name},   {"beams", f.beams},      {"bins", f.bins},  {"messages", f.messages},
            {"bytes", f.bytes}, {"median_ms", f.median}, {"p99_ms", f.p99}, {"scaled_ms", scaled(f)}};
}

int run_wire(const Arguments& arguments) {
    const auto pings = settings_of(arguments).pings;
    const bool json = arguments.has("--json");
    nlohmann::ordered_json figures = nlohmann::ordered_json::array();
    if (!json)
        std::printf(
            "ms of processor time from an echogram to its bytes; the last column for 512 x 1000 values\n"
            "%-28s %12s %9s %10s %8s %8s %8s\n",
            "", "beams x bins", "messages", "bytes", "median", "p99", "scaled");
    std::vector<bench::WireFigures> all;
    const auto cases = wire_cases_of(arguments.text("--cases"));
    Progress progress("measuring", cases.size());
    for (const bench::WireCase& c : cases) {
        const bench::WireFigures& f = all.emplace_back(bench::measure_wire(c, pings));
        progress.clear();
        json ? figures.push_back(wire_json(f)) : print_wire(f);
        progress.done(all.size());
    }
    draw_if_asked(arguments, [&] { return bench::bars_of(all, pings); });
    if (json) std::printf("%s\n", line_of({{"pings", pings}, {"cases", figures}}).c_str());
    return 0;
}

void print_fans(const bench::FansFigures& f) {
    std::printf("%4zu %5zu %9.1f %10.2f %15.1f %6.0f %9.0f %9.0f %13.0f %7.0f\n", f.fans, f.heads,
                f.pings_a_second(), f.processors(), 1e3 * f.cpu_a_ping(),
                100 * f.late / std::max(f.pings, 1.0), 1e3 * f.p99_lateness, 1e3 * f.worst_lateness,
                100 * f.spared / std::max(f.pings, 1.0), 100 * f.coarse / std::max(f.pings, 1.0));
    std::fflush(stdout);
}

nlohmann::ordered_json fans_json(const bench::FansFigures& f) {
    return {{"fans", f.fans},
            {"heads", f.heads},
            {"seconds", f.seconds},
            {"pings", f.pings},
            {"head_pings", f.head_pings},
            {"late_head_pings", f.late_head_pings},
            {"cpu_s", f.cpu},
            {"cpu_s_a_ping", f.cpu_a_ping()},
            {"late_pings", f.late},
            {"p99_lateness_s", f.p99_lateness},
            {"spared_pings", f.spared},
            {"worst_lateness_s", f.worst_lateness},
            {"coarse_pings", f.coarse}};
}

/// 1, 2, 4, ... fans at once, and as many as asked for; beside single beams only those.
int run_fans(const Arguments& arguments) {
    const auto most = static_cast<std::size_t>(arguments.number("--fans", 16, 1, 64));
    const auto heads = static_cast<std::size_t>(arguments.number("--heads", 0, 0, 64));
    const std::size_t first = heads > 0 ? most : 1;
    const double seconds = arguments.number("--seconds", 10, 0.5, 3600);
    const auto example = file_or_example("demo");
    const bool json = arguments.has("--json");
    nlohmann::ordered_json figures = nlohmann::ordered_json::array();
    if (!json)
        std::printf(
            "%.1f s each. Processor time of a ping and lateness in ms; of the pings, in %%: late, without "
            "late "
            "echoes, coarse\n"
            "fans heads   pings/s processors  processor time   late       p99     worst  without late   "
            "coarse\n",
            seconds);
    std::vector<bench::FansFigures> all;
    Progress progress("measuring", heads > 0 ? 1 : std::bit_width(most - 1) + 1);
    for (std::size_t fans = first;; fans = std::min(2 * fans, most)) {
        const bench::FansFigures f = bench::measure_fans(fans, heads, seconds, example);
        if (f.failure[0] != '\0')
            throw StartError(Exit::unavailable, std::to_string(fans) + " fans: " + f.failure);
        progress.clear();
        json ? figures.push_back(fans_json(f)) : print_fans(f);
        all.push_back(f);
        progress.done(all.size());
        if (fans == most) break;
    }
    draw_if_asked(arguments, [&] { return bench::bars_of(all); });
    if (json) std::printf("%s\n", line_of({{"fans", figures}}).c_str());
    return 0;
}

int run_bench(const Arguments& arguments) {
    require_picture(arguments);
    keep_freed_memory();  // as `echoloop run` does; the processes of the cases inherit it
    if (arguments.has("--wire")) return run_wire(arguments);
    if (arguments.has("--fans")) return run_fans(arguments);
    if (arguments.has("--heads")) throw StartError(Exit::usage, "--heads: give --fans, too");
    const auto settings = settings_of(arguments);
    const auto report = measured(settings, cases_of(arguments, settings));
    draw_if_asked(arguments, [&] { return bench::bars_of(report); });
    const bool json = arguments.has("--json");
    std::printf("%s%s", (json ? bench_json(report) : bench::text_of(report)).c_str(), json ? "\n" : "");
    return status_of(report);
}

}  // namespace

Verb bench_verb() {
    using Kind = Argument::Kind;
    return {"bench",
            "measure how long a ping takes, case by case",
            {{Kind::value, "--cases", "NAME,...",
              "only these cases, sonars or scenes; with --wire: beginnings of model names"},
             {Kind::value, "--scene", "FILE", "measure every sonar over this scene (.gltf, .glb) instead"},
             {Kind::flag, "--wire", "", "measure the time from echogram to bytes instead, for each model"},
             {Kind::value, "--fans", "N",
              "measure 1, 2, 4 and so on up to N multibeams at once instead, as run serves them"},
             {Kind::value, "--heads", "N",
              "with --fans: N single beams beside them; then no fewer fans are tried"},
             {Kind::value, "--seconds", "S", "with --fans: how long each; default 10"},
             {Kind::value, "--pings", "N", "pings for each case, 1 to 100000; default 100"},
             {Kind::value, "--pixels", "FACTOR", "factor on the number of pixels, 0.1 to 64"},
             {Kind::value, "--picture", "OUT", "OUT.png, OUT.svg, OUT.pdf: draw the figures as bars, too"},
             {Kind::value, "--context", "NAME", "GL context: auto, osmesa, egl-surfaceless or egl-device"},
             {Kind::value, "--sampler", "NAME", "what finds surfaces: auto, raster, native or rays"},
             json_argument()},
            "  echoloop bench\n"
            "  echoloop bench --cases fls,scanning-simple --pings 1000\n"
            "  echoloop bench --wire --picture wire.svg\n"
            "  echoloop bench --fans 16\n"
            "  echoloop bench --fans 4 --heads 16\n"
            "  echoloop bench --scene config/scenes/tank.glb --json",
            run_bench};
}

}  // namespace echoloop::cli
