// echoloop render: one picture or table of what a device hears with its start-up settings.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "emulator/contract/random_key.h"
#include "emulator/pose/movers.h"
#include "emulator/pose/trajectory_file.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/scene.h"
#include "render/renderer.h"
#include "render/view.h"
#include "tools/draw/draw.h"
#include "tools/echoloop/channels.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_output.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {
namespace {

const ScenarioDevice& device_of(const Scenario& scenario, const Arguments& arguments) {
    if (!arguments.has("--device")) return scenario.devices.front();
    const auto name = arguments.text("--device");
    std::vector<std::string_view> known;
    for (const auto& device : scenario.devices) {
        if (device.name == name) return device;
        known.push_back(device.name);
    }
    throw StartError(Exit::usage, "the scenario has no device " + scenario::in_quotes(name) +
                                      scenario::suggestion(name, known));
}

/// The steps of the turn to render: [first, last).
std::pair<std::size_t, std::size_t> steps_of(const Model& model, const Arguments& arguments) {
    const auto steps = std::max<std::size_t>(1, model.turn_steps);
    if (!arguments.has("--step")) return {0, steps};
    const auto step = arguments.number("--step", 0, 0, static_cast<double>(steps) - 1);
    if (step != std::floor(step)) throw StartError(Exit::usage, "--step: expected a whole number");
    return {static_cast<std::size_t>(step), static_cast<std::size_t>(step) + 1};
}

/// How many pings to render: a turn of a head, unless it is said.
std::size_t pings_of(std::size_t steps, const Arguments& arguments) {
    constexpr double most = 10'000;
    const bool is_long = arguments.has("--waterfall") && steps == 1;
    const double pings = arguments.number("--pings", is_long ? 200 : static_cast<double>(steps), 1, most);
    if (pings != std::floor(pings)) throw StartError(Exit::usage, "--pings: expected a whole number");
    return static_cast<std::size_t>(pings);
}

/// What is drawn of a sonar with rows of beams: the row just above the middle, as a fan.
Shot in_one_plane(Shot shot) {
    if (shot.rows() > 1) shot.tilt += shot.elevations[shot.rows() / 2];
    shot.elevations.clear();
    return shot;
}

std::string extension_of(const Arguments& arguments) {
    auto extension = std::filesystem::path(arguments.text("--out")).extension().string();
    const bool channels = arguments.has("--channels");
    if (channels && extension != ".npy")
        throw StartError(Exit::usage, "--channels writes a NumPy array: end the name of --out with .npy");
    const bool picture = draw::picture_format_of(arguments.text("--out")).has_value();
    if (arguments.has("--waterfall") && !picture)
        throw StartError(Exit::usage,
                         "--waterfall draws a picture: end the name of --out with .png, .svg or .pdf");
    if (picture || extension == ".csv" || extension == ".npy") return extension;
    throw StartError(Exit::usage, "--out: the name must end with .png, .svg, .pdf, .csv or .npy");
}

class Job {
  public:
    explicit Job(const Arguments& arguments)
        : arguments_(arguments),
          extension_(extension_of(arguments)),
          out_(arguments.text("--out")),
          scenario_(scenario_from(arguments)),
          device_(device_of(scenario_, arguments)),
          steps_(steps_of(*device_.model, arguments)),
          count_(pings_of(steps_.second - steps_.first, arguments)),
          range_(arguments.number("--range", 0, 0.1, 10'000)),
          moment_(from_seconds(arguments.number("--at", 0, 0, 1e6))) {
        if (device_.model->default_shot == nullptr)
            throw StartError(Exit::usage,
                             device_.name + " is a " + device_.model->name +
                                 ", which is no sonar and sends no pings; name another with --device");
        check_size(shot(0));
        require_creatable(out_);
        if (arguments.has("--rule"))
            scenario_.render.rule =
                arguments.text("--rule") == "radiometric" ? EchoRule::radiometric : EchoRule::cerqueira2016;
    }

    RenderReport run() {
        const auto scene = scene_of(scenario_);
        scenario_.origin = origin_of(scenario_, *scene);
        Renderer renderer(scene, scenario_.water, scenario_.render);
        RenderReport report{
            out_.string(), device_.name, device_.model->name, renderer.context_description(), {}};
        Way way(scenario_, scene);
        if (arguments_.has("--channels")) {
            write_whole(out_, [&, image = renderer.render_channels(shot(0), situation(way, moment_))](
                                  const auto& file) { write_channels_npy(file, image); });
            return report;
        }
        report.pings = render(renderer, way);
        write_whole(out_, [&](const auto& file) { write(file, report.pings); });
        return report;
    }

  private:
    /// Where the vehicle and what else moves are.
    struct Way {
        Way(const Scenario& scenario, const std::shared_ptr<const Scene>& scene) : movers(scenario, scene) {
            if (!scenario.trajectory.empty())
                trajectory.emplace(read_trajectory(scenario.trajectory, scenario.origin));
        }
        std::optional<Track> trajectory;
        Movers movers;
    };

    /// `number`: of the ping, from 0 on; a head goes on round its turn.
    Shot shot(std::size_t number) const {
        const std::size_t turn = steps_.second - steps_.first, step = steps_.first + number % turn;
        Shot shot = in_one_plane(device_.model->default_shot(device_.config, step, range_));
        shot.ping += number - number % turn;
        shot.random_key = random_key(scenario_.seed, device_.name);  // as the session does
        return shot;
    }

    Situation situation(Way& way, Time moment) const {
        Pose world_from_body = scenario_.world_from_body;
        Motion moving;
        if (way.trajectory)
            world_from_body = way.trajectory->at(moment)->pose, moving = way.trajectory->motion(moment);
        Situation situation(world_from_body * device_.body_from_sonar);
        moving = together(world_from_body, moving, device_.body_from_sonar, {});
        situation.velocity = moving.velocity, situation.turning = moving.turning;
        situation.movers = way.movers.at(moment);
        situation.mover_motions = way.movers.motions(moment);
        return situation;
    }

    void check_size(const Shot& shot) const {
        constexpr std::size_t most = std::size_t{1} << 28;  // a gigabyte
        if (count_ * shot.beams() * shot.bins > most)
            throw StartError(Exit::usage, "--pings: that many of this sonar need more than 1 GB of memory");
        if (arguments_.has("--waterfall") && shot.beams() > 2)
            throw StartError(Exit::usage, "--waterfall draws sonars of one beam, or of one to each side; " +
                                              device_.name + " has " + std::to_string(shot.beams()) +
                                              ": leave it out to draw the fan");
    }

    /// A ping begins when the window of the one before is over, unless the sonar says when.
    std::vector<Echogram> render(Renderer& renderer, Way& way) {
        std::vector<Echogram> pings;
        Progress progress("rendering", count_);
        Time moment = moment_;
        for (std::size_t number = 0; number < count_; ++number) {
            const Shot next = shot(number);
            pings.push_back(renderer.render(next, situation(way, moment)));
            times_.push_back(to_seconds(moment));
            const double window = next.first_bin_time + static_cast<double>(next.bins) * next.bin_interval;
            moment += from_seconds(next.interval > 0 ? next.interval : window);
            progress.done(pings.size());
        }
        return pings;
    }

    draw::Waterfall waterfall(const std::vector<Echogram>& pings) const {
        draw::Waterfall out{pings, times_, {}, false};
        const Shot& shot = pings.front().shot;
        const bool turns = device_.model->turn_steps > 1;
        for (const double bearing : shot.bearings) {
            const Vec3 axis =
                rotate(device_.body_from_sonar.orientation * sonar_from_fan(shot.pan, shot.tilt),
                       {std::cos(bearing), -std::sin(bearing), 0});
            out.to_port.push_back(!turns && axis.y > 0.5);
            out.echogram = !turns && shot.beams() == 1 && axis.z < -0.7;
        }
        if (shot.beams() == 2) out.to_port = {true, false};
        return out;
    }

    void write(const std::filesystem::path& file, const std::vector<Echogram>& pings) const {
        if (extension_ == ".csv") return draw::write_csv(file, pings);
        if (extension_ == ".npy") return draw::write_npy(file, pings);
        draw::Style style;
        style.title = device_.name + " (" + device_.model->name + "), " + scenario_.scene.filename().string();
        style.width = static_cast<int>(arguments_.number("--width", style.width, 400, 4000));
        style.span = arguments_.number("--span", style.span, 1, 200);
        // Rounded, since the colour bar names it.
        style.absorption =
            std::round(absorption_db_per_km(scenario_.water, pings.front().shot.frequency)) / 1e3;
        draw::write_picture(file, *draw::picture_format_of(out_),
                            arguments_.has("--waterfall") ? draw::waterfall_picture(waterfall(pings), style)
                                                          : draw::polar_picture(pings, style));
    }

    const Arguments& arguments_;
    std::string extension_;
    std::filesystem::path out_;
    Scenario scenario_;
    const ScenarioDevice& device_;
    std::pair<std::size_t, std::size_t> steps_;
    std::size_t count_;
    double range_;
    Time moment_;
    std::vector<double> times_;  ///< s, of the pings
};

void print_report(const RenderReport& report) {
    std::printf("%s: %s (%s)", report.out.c_str(), report.device.c_str(), report.model.c_str());
    if (!report.pings.empty()) {
        const auto& first = report.pings.front();
        std::printf(", %zu pings, %zu beams, %zu bins, %s to %s m", report.pings.size(), first.beams(),
                    first.shot.bins, plain(first.bin_range(0), 3).c_str(),
                    plain(first.bin_range(first.shot.bins - 1), 2).c_str());
    }
    std::printf("\n");
}

int run_render(const Arguments& arguments) {
    try {
        const auto report = Job(arguments).run();
        if (arguments.has("--json")) {
            std::printf("%s\n", render_json(report).c_str());
        } else {
            print_report(report);
        }
    } catch (const StartError&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::config, error.what());
    } catch (const std::runtime_error& error) {
        rethrow_lack_of_memory(error);
        throw StartError(Exit::unavailable, error.what());
    }
    return 0;
}

}  // namespace

Verb render_verb() {
    using Kind = Argument::Kind;
    return {
        "render",
        "draw what a device hears, without running the emulator",
        {scenario_argument(),
         {Kind::value, "--device", "NAME", "device of the scenario; default: its first"},
         {Kind::value,
          "--out",
          "OUT",
          "OUT.png, OUT.svg, OUT.pdf: picture; OUT.csv, OUT.npy: beams x bins",
          {},
          true},
         {Kind::value, "--step", "N", "scanning head: only this step of the turn"},
         {Kind::value, "--pings", "N",
          "that many pings, one after the other; default: a turn of a head, 200 with --waterfall, else 1"},
         {Kind::flag, "--waterfall", "",
          "draw ping below ping over range, port to the left; of an echosounder, time to the right and depth "
          "down (.png, .svg, .pdf)"},
         {Kind::value, "--at", "SECONDS",
          "time of the run at which trajectories and animations are evaluated"},
         {Kind::value, "--range", "METRES", "range, instead of the device's own"},
         {Kind::value,
          "--rule",
          "RULE",
          "how rendered samples become echoes",
          {"radiometric", "cerqueira2016"}},
         {Kind::flag, "--channels", "", "write the image's intensity, range and bearing instead (.npy)"},
         {Kind::value, "--width", "PIXELS", "width of the picture, 400 to 4000"},
         {Kind::value, "--span", "DB", "dynamic range of the picture"},
         set_argument(),
         json_argument()},
        "  echoloop render demo --out turn.png\n"
        "  echoloop render demo --device sonar --out fan.npy --range 30\n"
        "  echoloop render demo --pings 400 --waterfall --out two-turns.png\n"
        "  echoloop render demo --device sonar --rule cerqueira2016 --channels --out channels.npy",
        run_render};
}

}  // namespace echoloop::cli
