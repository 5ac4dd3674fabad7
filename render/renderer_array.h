// One array of a ping: what is drawn for it and what it hears, before the acoustics.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "render/fan/arrays.h"
#include "render/fan/ping_motion.h"
#include "render/fan/plan_cache.h"
#include "render/fan/reverberation.h"
#include "render/paths/paths.h"
#include "render/pixel.h"
#include "render/scene/scene.h"
#include "render/situation.h"

namespace echoloop {

struct HeardArray {
    ArrayShot array;
    PlanCache::Plan plan;
    std::vector<Pixel> pixels;
    std::vector<float> focus;  ///< as BinningInput::focus
    PathEchoes paths;
    std::optional<PingMotion> motion;
    std::optional<Reverberation> water;  ///< none: it is silent
    bool patchy = false;                 ///< materials are uneven

    const Shot& shot() const { return array.shot; }
    Pose world_from_fan() const;
    /// rad/s, about the fan's axes.
    Vec3 turning(const Situation& situation) const;
    /// See RendererOptions::jitter.
    SampleOffsets offset(bool jitter) const;
};

/// By Pixel::surface - 1: index into Scene::objects().
std::vector<std::uint32_t> objects_of_surfaces(const Scene& scene);
/// As PingMoves has it; empty where nothing moves.
std::vector<std::uint32_t> movers_of_surfaces(const Scene& scene);

/// Puts what one array hears behind what those before it did.
template <typename Value>
void append(std::vector<Value> part, std::vector<Value>& whole) {
    if (whole.empty()) {
        whole = std::move(part);
        return;
    }
    // g++ 14 takes insert() here for a copy into nothing (-Wstringop-overflow).
    whole.resize(whole.size() + part.size());
    std::ranges::copy(part, whole.end() - static_cast<std::ptrdiff_t>(part.size()));
}

}  // namespace echoloop
