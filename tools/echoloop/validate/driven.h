// A sonar with the profile that ships, its renderer, and neither wires nor clock: what it sends, ping by
// ping. And the messages of a recording, read in the same way.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/contract/model.h"
#include "protocols/inspect.h"
#include "render/renderer.h"

namespace echoloop::validation {

struct Setup {
    std::string model;
    Options options{};          ///< other than their defaults
    std::vector<Bytes> once{};  ///< said on its first port as soon as a host is there
    std::vector<Bytes> asks{};  ///< said on its first port whenever it has no ping to make
    std::shared_ptr<const Scene> scene;
    Water water{};
    std::function<Pose(double)> pose;  ///< world_from_sonar at s since the start
};

/// The ping of a plain start over `range` m, as the renderer wants it.
Shot plain_shot(const Setup& setup, double range);

class Driven {
  public:
    explicit Driven(const Setup& setup);
    /// The messages of the next ping. Throws std::runtime_error if none comes.
    std::vector<inspect::Message> ping();

  private:
    void take(Actions actions);
    void await_ping();

    Setup setup_;
    std::unique_ptr<Device> device_;
    const inspect::Family* family_;
    Renderer renderer_;
    Time now_{}, wake_ = Time::max();
    std::optional<Ping> ping_;
    std::vector<Send> sent_;
};

/// All messages of that name in a file that `echoloop inspect` can read, at least one. Throws StartError.
std::vector<inspect::Message> recorded(const std::filesystem::path& file, std::string_view name);

bool has_field(const inspect::Message& message, std::string_view field);
/// A field's number, or its numbers where it is an array. Throws std::runtime_error if there is no such
/// field.
double number_in(const inspect::Message& message, std::string_view field);
const std::vector<double>& numbers_in(const inspect::Message& message, std::string_view field);

}  // namespace echoloop::validation
