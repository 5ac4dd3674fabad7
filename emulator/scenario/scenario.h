// What a scenario file says, checked and complete. Loading reads the file and the profiles that it names, and
// nothing else: no scene, no port.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/contract/driver_script.h"
#include "emulator/contract/model.h"
#include "emulator/scenario/fault.h"
#include "emulator/scenario/problems.h"
#include "render/geographic.h"
#include "render/pose.h"
#include "render/renderer.h"
#include "render/water.h"

namespace echoloop {

/// A mount that turns to and fro about an axis of its own, as a sine: angle x sin(2 pi t / period).
struct MountSwing {
    enum class Axis { roll, pitch, yaw };
    Axis axis = Axis::pitch;
    double angle = 0;   ///< rad, to either side; 0: it does not
    double period = 1;  ///< s
};

struct ScenarioDevice {
    std::string name;
    const Model* model = nullptr;
    Pose body_from_sonar;                    ///< where the sonar is mounted, or is before it moves
    MountSwing mount_swing;                  ///< at most one of this and the next two moves it
    std::filesystem::path mount_trajectory;  ///< of body_from_sonar; as Scenario::scene; empty: none
    std::string mount_input;                 ///< endpoint that body_from_sonar comes from; "": none
    std::vector<DriverLine> script;          ///< in a free run: what its driver says
    DeviceConfig config;  ///< options and endpoints complete; what the file leaves out has its default
    int line = 0;         ///< where the device begins in the file; 0: from --set
    int column = 0;
};

/// A node of the scene that moves. With none of the three, the lines of vehicle.input say where it is.
struct ScenarioObject {
    std::string node;
    std::optional<Pose> pose;          ///< world_from_object; with an input: until its first message
    std::filesystem::path trajectory;  ///< as Scenario::scene; empty: none
    std::string input;                 ///< endpoint that poses come from; "": none
    int line = 0;                      ///< of its name in the file; 0: from --set
    int column = 0;
};

/// What the scene's own animations do.
enum class Animations { loop, once, off };

enum class ClockMode {
    real,
    scaled,   ///< Scenario::clock_rate seconds of the run pass in one real second
    stepped,  ///< time stands still until somebody outside moves it on
    free      ///< nobody is outside: time runs as fast as the machine renders
};

struct Scenario {
    std::filesystem::path file;      ///< as given
    std::filesystem::path scene;     ///< absolute, or relative to the working directory as `file` is
    std::optional<GeoPlace> origin;  ///< of the world on the Earth; empty: as the scene says, if it does
    std::uint64_t seed = 1;
    Water water;           ///< depth defaults to the vehicle's depth below the surface
    Pose world_from_body;  ///< with an input: until its first message; with a trajectory: nothing yet
    std::filesystem::path trajectory;     ///< as `scene`; empty: none
    std::string pose_input;               ///< endpoint that poses come from; "": none
    std::vector<ScenarioObject> objects;  ///< that move
    Animations animations = Animations::loop;
    ClockMode clock = ClockMode::real;
    double clock_rate = 1;
    std::optional<double> duration;    ///< s; free: how long the run is, unless the command line says it
    std::string step_input;            ///< stepped: endpoint that steps come from beside pose_input; "": none
    std::optional<double> unix_start;  ///< s; Unix time at run time 0. Empty: when the run really begins
    RendererOptions render;  ///< from `render: {rule, context, pixels}`, `effects` and `water.surface`
    std::vector<ScenarioDevice> devices;
    std::vector<Network> peers;  ///< that devices on the network may send to; none: the interfaces' own
    std::string control;         ///< place that the run is controlled from, "": none
    std::vector<Fault> faults;   ///< what goes wrong on the wires and in the devices, and when
};

/// Reads a scenario file after applying `set_arguments` ("devices.micron.options.gain=50", "seed=7") to it.
/// Throws ScenarioError with every problem that can be found: YAML faults, unknown and repeated keys, wrong
/// types, numbers out of range, unknown models and options, endpoints that are malformed or claimed twice, a
/// scene file that is not there. Files over 1 MiB are refused.
Scenario load_scenario(const std::filesystem::path& file, const std::vector<std::string>& set_arguments,
                       std::span<const Model> models);

/// The same from text that stands for the content of `file`.
Scenario parse_scenario(const std::string& text, const std::filesystem::path& file,
                        const std::vector<std::string>& set_arguments, std::span<const Model> models);

}  // namespace echoloop
