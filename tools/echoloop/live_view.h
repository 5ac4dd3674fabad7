// The page of `echoloop run --view`, `replay --view` and `view`: what is asked for on the command line, and
// the server that it becomes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/capture/recording.h"
#include "emulator/run/runtime.h"
#include "protocols/inspect.h"
#include "tools/echoloop/verb.h"
#include "tools/view/server.h"

namespace echoloop::cli {

/// A port of a capture that is shown.
struct ShownPort {
    std::string name;                         ///< as Watch is told it as the device
    const inspect::Family* family = nullptr;  ///< nullptr: not known
};

/// --view, --view-at, --view-control and --view-record.
class LiveView {
  public:
    /// `always`: the verb is nothing but a page. Throws StartError (usage) where the options do not fit each
    /// other, and where the folder for recordings is none.
    explicit LiveView(const Arguments& arguments, bool always = false);

    /// For the run, before it is made; nullptr without a page.
    Watch* watch() { return wanted_ ? &feed_ : nullptr; }
    bool control() const { return control_; }
    /// For the run: records nothing until the page asks for it; nullptr without --view-record.
    Recording* recording() { return recording_.get(); }
    bool is_looked_at() const { return feed_.viewers() > 0; }

    /// Once the run is made; it ends before the run does. Throws StartError.
    std::unique_ptr<view::Server> serve(Runtime& runtime);
    /// The same of a capture.
    std::unique_ptr<view::Server> serve(const std::string& file, const std::vector<ShownPort>& ports);

  private:
    view::ServerOptions options();
    std::string switch_recording(bool on);

    bool wanted_, control_;
    Address address_;
    std::string folder_;  ///< for recordings; "" without
    std::string name_;    ///< of what is recorded
    std::unique_ptr<Recording> recording_;
    view::Feed feed_;
};

/// The options that every verb with a page has.
std::vector<Argument> view_arguments(const std::string& what);

}  // namespace echoloop::cli
