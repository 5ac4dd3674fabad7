#include "tools/echoloop/bench/bars.h"

namespace echoloop::bench {
namespace {

std::string with_pings(const char* what, std::size_t pings) {
    return std::string(what) + ", ms (median of " + std::to_string(pings) + ")";
}

}  // namespace

draw::Bars bars_of(const Report& report) {
    draw::Bars bars{"echoloop bench: where the time of a ping goes",
                    with_pings("wall time of a ping", report.settings.pings),
                    {"cull", "draw", "read-back", "bins", "paths", "acoustics"},
                    "",
                    {}};
    for (const Row& row : report.rows) {
        const Figures& f = row.figures;
        if (f.failure[0] != '\0') continue;
        draw::Bar bar{row.the_case.name(), {f.cull, f.draw, f.read_back, f.bins, f.paths, f.acoustics}};
        if (row.rule == EchoRule::cerqueira2016) bar.label += ", cerqueira2016";
        if (row.the_case.target) bar.mark = row.the_case.target->aim, bars.mark = "aim";
        bars.bars.push_back(std::move(bar));
    }
    return bars;
}

draw::Bars bars_of(const std::vector<WireFigures>& figures, std::size_t pings) {
    draw::Bars bars{"echoloop bench --wire: from an echogram to its bytes",
                    with_pings("processor time of a ping", pings),
                    {"median"},
                    "99 of 100 take less",
                    {}};
    for (const WireFigures& f : figures) bars.bars.push_back({f.name, {f.median}, f.p99});
    return bars;
}

draw::Bars bars_of(const std::vector<FansFigures>& figures) {
    draw::Bars bars{
        "echoloop bench --fans: multibeams at once", "pings a second", {"in time", "late"}, "", {}};
    for (const FansFigures& f : figures) {
        const double late = f.pings > 0 ? f.pings_a_second() * f.late / f.pings : 0;
        bars.bars.push_back({std::to_string(f.fans), {f.pings_a_second() - late, late}});
    }
    return bars;
}

}  // namespace echoloop::bench
