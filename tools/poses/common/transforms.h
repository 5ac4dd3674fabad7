// What becomes of transforms where there is no tf2: the poses of the bodies that are wanted, once the chain
// to each is known. Knows no middleware.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tools/poses/common/feed.h"
#include "tools/poses/common/frames.h"
#include "tools/poses/common/say.h"

namespace echoloop::poses {

class Transforms {
  public:
    Transforms(const Options& options, Feed& feed) : options_(options), feed_(feed), frames_(options.world) {}

    /// The edges of one message. A topic whose name ends in "_static" tells fixed ones.
    void heard(const std::string& topic, const std::vector<BodyPose>& edges) {
        frames_.add(edges, topic.ends_with("_static"));
        for (const auto& source : options_.sources)
            if (source.topic == topic) look_up(source);
    }

  private:
    void look_up(const Source& source) {
        if (source.entry.empty())
            return feed_.refused(source.topic,
                                 "say which frame is the body, as in " + source.topic + "#base_link");
        std::string why;
        if (const auto body = frames_.newest(source.entry, why)) return feed_.heard(source, *body);
        if (!why.empty() && said_.insert(source.entry).second)
            say(source.topic + ": " + harmless(why) + "; waiting for it, --world names the root");
    }

    const Options& options_;
    Feed& feed_;
    Frames frames_;
    std::set<std::string> said_;  ///< frames that were waited for
};

}  // namespace echoloop::poses
