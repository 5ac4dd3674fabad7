#include "emulator/truth/truth.h"

#include <memory>

namespace echoloop {

void TruthFile::add(PingTruth ping) {
    const Echogram& echo = ping.echo;
    const std::size_t bytes = sizeof ping + echo.objects.size() * sizeof echo.objects[0] +
                              echo.beams() * (sizeof echo.truth[0] + sizeof echo.shot.bearings[0]);
    const auto kept = std::make_shared<PingTruth>(std::move(ping));
    file_.add(bytes, [kept](std::string& text) { append_truth_line(*kept, text); });
}

}  // namespace echoloop
