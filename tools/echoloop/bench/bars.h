// What the bench found, as bars to be drawn. Draws nothing itself.
#pragma once

#include <vector>

#include "tools/draw/bars.h"
#include "tools/echoloop/bench/fans.h"
#include "tools/echoloop/bench/report.h"
#include "tools/echoloop/bench/wire.h"

namespace echoloop::bench {

/// Where the time of a ping goes, and the aims. Cases that failed are left out.
draw::Bars bars_of(const Report& report);
/// Of each model, up to the slowest ping in a hundred.
draw::Bars bars_of(const std::vector<WireFigures>& figures, std::size_t pings);
/// Pings a second, those in time and those that were late.
draw::Bars bars_of(const std::vector<FansFigures>& figures);

}  // namespace echoloop::bench
