// Late echoes: what a ping still sends back when the next one of the same device listens already. Asks for
// the shot that hears them and adds them to the next ping; renders nothing and knows no device.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "render/echogram.h"
#include "render/effects.h"
#include "render/situation.h"
#include "render/water.h"

namespace echoloop {

/// The shot that listens to the echoes of `shot` in the window of the ping after it, or empty when they
/// cannot matter: the effect is off, `shot.interval` is 0, nothing within `farthest` m of the sonar is as far
/// away, or the echo of a target of +20 dB there would be below the thermal noise (100 dB below it where the
/// effect of noise is off).
///
/// It is cheaper than `shot`: at most 128 of its beams and 512 bins over the whole window. It hears no noise,
/// does not clip and has no converter, as the ping that it is added to has them all.
std::optional<Shot> late_shot(const Shot& shot, const Water& water, const Effects& effects, double farthest);

/// Situation::detail of a late shot: its echoes are a faint background, and come from far away.
inline constexpr double late_detail = 0.25;

/// Keeps the late echoes of one device until its next ping comes.
///
/// Where all of them are 20 dB below the noise of the ping that hears them (0.04 dB of it), they are left
/// out, and so are those of the next 31 pings, which need not be rendered: as long as the shot is the same,
/// and the sonar and all that moves are where they were within half a metre and a degree. The figures are our
/// own choice. Pings without noise hear all late echoes.
class SecondTimeAround {
  public:
    /// Whether the late echoes of ping `sequence`, counted by the caller, are to be rendered: by `late`, its
    /// late_shot(), in `situation`.
    bool asks(std::uint64_t sequence, const Shot& late, const Situation& situation);

    /// `late`: the echogram of late_shot() of the ping number `sequence`.
    void keep(std::uint64_t sequence, Echogram late);

    /// Adds what was kept of ping `sequence` - 1 to the levels of ping `sequence`: at its time less the
    /// interval between both, as power, in the beam whose bearing is nearest. What is older is forgotten.
    void add_to(std::uint64_t sequence, Echogram& echogram);

  private:
    /// How late echoes were asked for.
    struct View {
        Shot late;
        Situation situation;
    };
    static bool nearly_same(const View& one, const Shot& late, const Situation& situation);

    std::map<std::uint64_t, Echogram> late_;  ///< by the number of the ping whose late echoes they are
    std::map<std::uint64_t, View> asked_;     ///< the same
    std::optional<View> silent_;              ///< a view without a late echo above the noise
    int spared_ = 0;                          ///< pings since then that were not rendered
};

}  // namespace echoloop
