// The --json lines of `echoloop run`: one at the start, one at the end.
#pragma once

#include <string>
#include <vector>

#include "emulator/capture/recording.h"
#include "emulator/dataset/dataset.h"
#include "emulator/pose/input.h"
#include "emulator/run/runtime.h"
#include "emulator/truth/truth.h"
#include "tools/bag/bag.h"

namespace echoloop::cli {

/// All ports are bound when it is printed: what a driver says from then on is heard. `view`: link of the
/// page, `foxglove`: where its programs connect; "": none.
std::string run_started_json(const Runtime& runtime, const std::string& view, const std::string& foxglove);
/// Of a run that has ended; `recording`, `truth`, `labels`, `dataset`, `bag`: nullptr if there is none.
std::string run_summary_json(const std::vector<SessionSummary>& sessions, const Runtime& runtime,
                             const Recording* recording, const TruthFile* truth, const BackgroundFile* labels,
                             const Dataset* dataset, const bag::Bag* bag);

}  // namespace echoloop::cli
