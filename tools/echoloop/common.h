// What several verbs do first: load the scenario and its scene, with errors as the program reports them.
#pragma once

#include <exception>
#include <memory>

#include "emulator/scenario/scenario.h"
#include "render/scene/scene.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {

/// The scenario of the FILE and --set arguments against the table of models, at the beginning of its
/// trajectory. Throws StartError.
Scenario scenario_from(const Arguments& arguments);

/// Throws StartError with the scene's own message.
std::shared_ptr<const Scene> scene_of(const Scenario& scenario);

/// "127.0.0.1:65502"; ":53810" for every address of the machine.
std::string text_of(const Address& address);

/// "12.5", never in scientific notation, without trailing zeros.
std::string plain(double number, int decimals);

/// `text` with spaces up to `width`, and at least one.
std::string padded(std::string text, std::size_t width);

/// "1 ping", "3 pings".
std::string counted(std::uint64_t number, const std::string& noun);

/// Throws std::bad_alloc where the system had no memory for a thread, which tells it with an error of its
/// own.
void rethrow_lack_of_memory(const std::exception& error);

}  // namespace echoloop::cli
