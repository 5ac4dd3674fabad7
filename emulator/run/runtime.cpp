#include "emulator/run/runtime.h"

#include <chrono>
#include <mutex>

#include "emulator/capture/recording.h"
#include "emulator/contract/error.h"
#include "emulator/dataset/dataset.h"
#include "emulator/machine/scheduling.h"
#include "emulator/machine/service_manager.h"
#include "emulator/machine/steal.h"
#include "emulator/pose/movers.h"
#include "emulator/pose/step_server.h"
#include "emulator/pose/vehicle.h"
#include "emulator/run/control.h"
#include "emulator/run/fleet.h"
#include "emulator/run/kept_scene.h"
#include "emulator/run/warm_up.h"
#include "emulator/scenario/scene.h"
#include "render/fan/plan_cache.h"
#include "render/renderer.h"

namespace echoloop {
namespace {

/// The first member is made from it: before there is another thread.
const Scenario& with_memory_at_hand(const Scenario& scenario) {
    keep_freed_memory();
    return scenario;
}

/// The scenario gets the scene's origin where it states none of its own.
std::shared_ptr<const Scene> loaded(Scenario& scenario, KeptScene* kept) {
    auto scene = kept != nullptr ? kept->scene_of(scenario) : load_scene(scenario);
    return_freed_memory();
    scenario.origin = origin_of(scenario, *scene);
    return scene;
}

/// The threads that are made behind it inherit it.
bool claim(Punctuality punctuality) {
    const bool real_time = punctuality == Punctuality::real_time;
    if (real_time) claim_real_time(Priority::rendering);
    return real_time;
}

std::unique_ptr<Clock> make_clock(const Scenario& scenario, asio::io_context& io) {
    if (scenario.clock == ClockMode::stepped || scenario.clock == ClockMode::free)
        return std::make_unique<SteppedClock>(io, *scenario.unix_start);
    return std::make_unique<RealClock>(io, scenario.clock_rate, scenario.unix_start);
}

SharedWater shared_water(const Scenario& scenario, const Scene& scene, const Movers& movers) {
    const bool knows_effects = scenario.render.rule == EchoRule::radiometric;
    const Effects effects = knows_effects ? scenario.render.effects : Effects::none();
    const bool by_the_clock = scenario.clock == ClockMode::real || scenario.clock == ClockMode::scaled;
    return {scenario.water,
            effects,
            scenario.seed,
            scene.bounds(),
            CrossTalk(scenario.water, effects),
            0,
            by_the_clock ? std::make_unique<DeviceThreads>() : nullptr,
            movers.reach()};
}

}  // namespace

class Runtime::Impl {
  public:
    Impl(const Scenario& scenario, const RunRecords& records, Punctuality punctuality, KeptScene* kept)
        : scenario_(with_memory_at_hand(scenario)),
          scene_(loaded(scenario_, kept)),
          plans_(kept != nullptr ? kept->plans() : std::make_shared<PlanCache>()),
          real_time_(claim(punctuality)),
          signals_(io_),
          end_(io_),
          watchdog_(io_),
          clock_(make_clock(scenario, io_)),
          stepped_(dynamic_cast<SteppedClock*>(clock_.get())),
          steps_(scenario.clock == ClockMode::stepped ? make_step_server() : nullptr),
          movers_(scenario_, scene_),
          vehicle_(scenario_, *clock_, steps_.get(), movers_.by_lines()),
          water_(shared_water(scenario, *scene_, movers_)),
          faults_(scenario.seed, scenario.file.string(), records.labels,
                  [this] { return clock_->unix_time(); }),
          desk_(
              *clock_, faults_, scenario.devices, [this] { return summary(); },
              [this] { return render_threads_.load(); }),
          render_threads_([this, &scenario] { return make_renderer(scenario); },
                          RenderThreads::useful(scenario.devices.size())) {
        // Before the first link is made: a signal from here on ends the run in order and removes the links.
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) signals_.add(signal);
        if (stepped_ != nullptr && records.recording != nullptr)
            records.recording->follow(
                [this, start = from_seconds(clock_->unix_start())] { return start + clock_->now(); });
        movers_.open_inputs(scenario_, *clock_, steps_.get());
        movers_.name_places(scenario_);
        vehicle_.name_places(scenario_);
        if (records.truth != nullptr) records.truth->begin(truth_header(scenario));
        dataset_ = records.dataset;
        if (records.watch != nullptr) faults_.show(*records.watch);
        const bool faulty = !scenario.faults.empty() || !scenario.control.empty() || records.live_faults;
        for (ScenarioDevice& device : scenario_.devices) fleet_.add(scenario_, device, records, faulty);
        for (const Fault& fault : scenario.faults) faults_.add(fault);
        if (scenario.control.empty()) return;
        control_ = std::make_unique<Control>(*clock_, parse_control_place(scenario.control), desk_);
        scenario_.control = control_->describe();
    }

    ~Impl() {
        fleet_.close();
        fleet_.join_threads();
        if (dataset_ != nullptr) dataset_->forget_run();
    }

    const Scenario& scenario() const { return scenario_; }
    std::vector<RunningDevice> devices() const { return fleet_.devices(); }

    void run(std::optional<double> duration) {
        signals_.async_wait([this](error_code ec, int) {
            if (ec) return;
            interrupted_ = true;
            stop();
        });
        wake_on_time();
        if (real_time_) {
            claim_real_time(Priority::wires);
            lock_memory();
        }
        stolen_ = echoloop::stolen_seconds();
        begin_dataset();
        clock_->begin();
        vehicle_.start();
        movers_.start();
        fleet_.start_mounts();
        stepped_ == nullptr ? begin(duration) : begin_with_first_step(duration);
        tell_service_manager("READY=1");
        if (const auto period = watchdog_period()) say_alive(*period);
        clock_->run();
        stolen_ = echoloop::stolen_seconds() - stolen_;
        fleet_.join_threads();
    }

    std::vector<SessionSummary> summary() const { return fleet_.summary(); }
    bool interrupted() const { return interrupted_; }
    std::string control_token() const { return control_ ? control_->token() : ""; }
    const std::map<std::string, FaultCounts>& faults() const { return faults_.labels().counts(); }
    std::optional<PoseSummary> poses() const { return vehicle_.summary(); }
    std::map<std::string, PoseSummary> objects() const {
        auto all = movers_.summary();
        all.merge(fleet_.mounts());
        return all;
    }
    std::optional<StepSummary> steps() const {
        return steps_ ? std::optional(steps_->summary()) : std::nullopt;
    }
    double stolen() const { return stepped_ == nullptr ? stolen_ : 0; }
    std::shared_ptr<const Scene> scene() const { return scene_; }
    void ask(std::string line, std::function<void(std::string)> answer) {
        asio::post(
            io_, [this, line = std::move(line), answer = std::move(answer)] { answer(desk_.answer(line)); });
    }
    const std::string& renderer_description() const { return renderer_description_; }

  private:
    void begin(std::optional<double> duration) {
        if (duration) {
            end_.expires_after(std::chrono::duration_cast<RealClock::Steady::duration>(
                std::chrono::duration<double>(*duration)));
            end_.async_wait([this](error_code ec) {
                if (!ec) stop();
            });
        }
        power_up();
    }

    void power_up() {
        fleet_.power_up();
        if (control_) control_->start();
    }

    /// Not before: who steps has the first word about where the vehicle is.
    void begin_with_first_step(std::optional<double> duration) {
        stepped_->on_step([this, powered = false](Time to) mutable {
            vehicle_.step(clock_->now(), to);
            movers_.step(clock_->now(), to);
            fleet_.step(clock_->now(), to);
            if (std::exchange(powered, true)) return;
            power_up();
        });
        const auto end = duration ? std::optional(from_seconds(*duration)) : std::nullopt;
        if (steps_ != nullptr) return steps_->start(end, [this] { stop(); });
        asio::co_spawn(io_, run_free(end.value_or(Time{})), Serving("clock"));
    }

    /// From moment to moment; a signal is heard between two of them.
    Task<void> run_free(Time end) {
        co_await stepped_->step(Time{});
        co_await stepped_->step(end);
        stop();
    }

    std::unique_ptr<StepServer> make_step_server() {
        return std::make_unique<StepServer>(*stepped_, [this] { return fleet_.sent(); });
    }

    /// On a render thread, several at once.
    std::unique_ptr<Renderer> make_renderer(const Scenario& scenario) {
        RendererOptions options = scenario.render;
        options.plans = plans_;
        options.drawing_threads = RenderThreads::drawing_threads(scenario.devices.size());
        auto renderer = std::make_unique<Renderer>(scene_, scenario.water, options);
        std::call_once(described_, [&] { renderer_description_ = renderer->context_description(); });
        warm_up(*renderer, scenario, water_);
        return renderer;
    }

    /// From the thread that serves the wires: while it is stuck, nothing is said.
    void say_alive(std::chrono::microseconds period) {
        tell_service_manager("WATCHDOG=1");
        watchdog_.expires_after(period);
        watchdog_.async_wait([this, period](error_code ec) {
            if (!ec) say_alive(period);
        });
    }

    void stop() {
        tell_service_manager("STOPPING=1");
        if (steps_) steps_->close();
        vehicle_.close();
        movers_.close();
        if (control_) control_->close();
        fleet_.close();
        error_code ignored;
        signals_.cancel(ignored);
        end_.cancel(ignored);
        watchdog_.cancel(ignored);
        io_.stop();
    }

    TruthHeader truth_header(const Scenario& scenario) const {
        TruthHeader header{.scenario = scenario.file.string(),
                           .scene = scenario.scene.string(),
                           .seed = scenario.seed,
                           .unix_start = clock_->unix_start(),
                           .objects = {scene_->objects().begin(), scene_->objects().end()},
                           .water = scenario.water};
        for (const SceneMover& mover : scene_->movers()) header.movers.push_back(mover.name);
        for (const ScenarioDevice& device : scenario.devices)
            header.devices.push_back({device.name, device.model->name, device.body_from_sonar});
        return header;
    }

    /// A run that nobody watches ends where its data set does.
    void begin_dataset() {
        if (dataset_ == nullptr) return;
        DatasetStart start{
            .header = truth_header(scenario_),
            .turns = {},
            .scene = scene_,
            .straight = water_.water.profile.empty() || !water_.effects.has(Effect::refraction),
            .waits = stepped_ != nullptr};
        for (const ScenarioDevice& device : scenario_.devices)
            start.turns.push_back(device.model->turn_steps > 1);
        if (scenario_.clock == ClockMode::free)
            start.failed = [this] { asio::post(io_, [this] { stop(); }); };
        dataset_->begin(std::move(start));
    }

    Scenario scenario_;  ///< as Runtime's
    std::shared_ptr<const Scene> scene_;
    const std::shared_ptr<PlanCache> plans_;
    const bool real_time_;
    bool interrupted_ = false;
    double stolen_ = 0;  ///< s, of the processors, by the host
    std::string renderer_description_;
    std::once_flag described_;
    asio::io_context io_;
    asio::signal_set signals_;
    asio::steady_timer end_, watchdog_;
    std::unique_ptr<Clock> clock_;
    SteppedClock* stepped_;              ///< the clock, if it is one
    std::unique_ptr<StepServer> steps_;  ///< if it is
    Movers movers_;
    Vehicle vehicle_;
    SharedWater water_;
    Faults faults_;
    Fleet fleet_{{io_, *clock_, water_, vehicle_, movers_, *scene_, faults_, steps_.get(), render_threads_}};
    ControlDesk desk_;
    std::unique_ptr<Control> control_;  ///< nullptr without a place
    Dataset* dataset_ = nullptr;        ///< nullptr: nobody asks
    RenderThreads
        render_threads_;  // last: joined first, so that no ping comes back to a session that is gone
};

Runtime::Runtime(const Scenario& scenario, RunRecords records, Punctuality punctuality, KeptScene* kept)
    : impl_(std::make_unique<Impl>(scenario, records, punctuality, kept)) {}
Runtime::~Runtime() = default;
const Scenario& Runtime::scenario() const { return impl_->scenario(); }
std::vector<RunningDevice> Runtime::devices() const { return impl_->devices(); }
std::shared_ptr<const Scene> Runtime::scene() const { return impl_->scene(); }
std::size_t Runtime::triangles() const { return impl_->scene()->triangles(); }
void Runtime::ask(std::string line, std::function<void(std::string)> answer) {
    impl_->ask(std::move(line), std::move(answer));
}
std::string Runtime::renderer() const { return impl_->renderer_description(); }
std::optional<PoseSummary> Runtime::poses() const { return impl_->poses(); }
std::map<std::string, PoseSummary> Runtime::objects() const { return impl_->objects(); }
std::optional<StepSummary> Runtime::steps() const { return impl_->steps(); }
double Runtime::stolen_seconds() const { return impl_->stolen(); }
std::map<std::string, FaultCounts> Runtime::faults() const { return impl_->faults(); }
std::string Runtime::control_token() const { return impl_->control_token(); }
void Runtime::run(std::optional<double> duration) { impl_->run(duration); }
bool Runtime::interrupted() const { return impl_->interrupted(); }
std::vector<SessionSummary> Runtime::summary() const { return impl_->summary(); }

}  // namespace echoloop
