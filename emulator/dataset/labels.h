// Which object each bin shows: what most of its direct echo comes from, where the beam's main lobe looks at
// it.
#pragma once

#include "emulator/truth/truth.h"
#include "render/fan/visible_objects.h"

namespace echoloop {

/// m, the end of the ping's window.
double end_range(const Echogram& echo);

/// rad, that the sonar turns while echoes of this ping arrive, at most.
double turn_within(const PingTruth& ping);

/// Takes the labels of what no beam's main lobe looks at there out of ping.echo.objects: side lobes hear it.
/// A bin may be off by two, and by what the sonar's speed shifts an echo.
void keep_main_lobes(const Look& look, PingTruth& ping);

}  // namespace echoloop
