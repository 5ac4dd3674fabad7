// The page of `echoloop run --view`: what is asked for on the command line, and the server that it becomes.
#pragma once

#include <memory>
#include <string>

#include "emulator/run/runtime.h"
#include "tools/echoloop/verb.h"
#include "tools/view/server.h"

namespace echoloop::cli {

/// --view, --view-at and --view-control.
class LiveView {
  public:
    /// Throws StartError (usage) where the options do not fit each other.
    explicit LiveView(const Arguments& arguments);

    /// For the run, before it is made; nullptr without --view.
    Watch* watch() { return wanted_ ? &feed_ : nullptr; }
    bool control() const { return control_; }
    /// Once the run is made; it ends before the run does. Throws StartError.
    std::unique_ptr<view::Server> serve(Runtime& runtime);

  private:
    bool wanted_, control_;
    Address address_;
    view::Feed feed_;
};

}  // namespace echoloop::cli
