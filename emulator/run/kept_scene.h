// The scene that was loaded last and the plans of its views, for runs of one program that come one after the
// other.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "render/fan/plan_cache.h"
#include "render/scene/scene.h"

namespace echoloop {

class KeptScene {
  public:
    /// Loads it unless it is the one at hand. Throws as load_scene().
    std::shared_ptr<const Scene> scene_of(const Scenario& scenario);
    const std::shared_ptr<PlanCache>& plans() const { return plans_; }

  private:
    std::filesystem::path file_;
    bool animated_ = false;
    std::vector<std::string> nodes_;
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<PlanCache> plans_ = std::make_shared<PlanCache>();
};

}  // namespace echoloop
