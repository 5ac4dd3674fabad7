#include "emulator/water/render_thread.h"

#include <pthread.h>

#include <algorithm>
#include <future>
#include <ranges>
#include <set>
#include <utility>

#include "emulator/machine/punctual.h"
#include "emulator/water/scheduling.h"
#include "render/renderer.h"
#include "render/workers.h"

namespace echoloop {
namespace {

/// Rendering gives way to the wire, and fans to single beams; but hardly to other programs, which would
/// starve it on a busy machine. The name is what top and gdb show.
void begin_thread(RenderThread::Lane lane, bool real_time) {
    using Lane = RenderThread::Lane;
    const char* name = lane == Lane::every          ? "render"
                       : lane == Lane::single_beams ? "render beams"
                                                    : "render urgent";
    ::pthread_setname_np(::pthread_self(), name);
    constexpr int while_patient = 10;
    give_way(real_time ? while_patient : lane == Lane::every ? 2 : 1);
    if (real_time)
        claim_real_time(lane == Lane::every          ? Turn::fans
                        : lane == Lane::single_beams ? Turn::single_beams
                                                     : Turn::urgent_fans);
}

/// A ping of a single beam is rendered at the turn of its kind, whoever does it.
class Place {
  public:
    explicit Place(bool better) : better_(better) {
        if (better_) claim_real_time(Turn::single_beams);
    }
    ~Place() {
        if (better_) claim_real_time(Turn::fans);
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

  private:
    bool better_;
};

Echogram silence(Shot shot, const Pose& world_from_sonar) {
    Echogram echogram;
    echogram.world_from_sonar = world_from_sonar;
    echogram.values.assign(shot.beams() * shot.bins, 0.0F);
    echogram.truth.resize(shot.beams());
    echogram.shot = std::move(shot);
    return echogram;
}

}  // namespace

RenderThread::Crew RenderThread::useful(std::size_t sonars, std::size_t fans, bool real_time) {
    const std::size_t threads = std::clamp<std::size_t>(sonars, 1, Workers::useful());
    return {threads, sonars > threads, fans > threads, real_time};
}

std::size_t RenderThread::drawing_threads(std::size_t sonars) {
    return std::max<std::size_t>(1, Workers::useful() / useful(sonars, 0).threads);
}

RenderThread::RenderThread(const Make& make, Crew crew)
    : real_time_(crew.real_time), urgent_fans_(crew.urgent_fans), every_(crew.threads) {
    keep_rasterisers_on_their_threads();
    std::vector<std::future<void>> ready;
    for (std::size_t i = 0; i < crew.threads; ++i) threads_.push_back(start(make, Lane::every, ready));
    if (crew.single_beams) threads_.push_back(start(make, Lane::single_beams, ready));
    if (crew.urgent_fans) threads_.push_back(start(make, Lane::urgent_fans, ready));
    for (auto& renderer : ready) renderer.wait();
    for (auto& renderer : ready) renderer.get();
}

std::jthread RenderThread::start(const Make& make, Lane lane, std::vector<std::future<void>>& ready) {
    std::promise<void> started;
    ready.push_back(started.get_future());
    return std::jthread(
        [this, make, lane, &own = sleepers_.emplace_back(), started = std::move(started)]() mutable {
            std::unique_ptr<Renderer> renderer;
            try {
                begin_thread(lane, real_time_);
                renderer = make(lane);
            } catch (...) {
                started.set_exception(std::current_exception());
                return;
            }
            started.set_value();
            serve(*renderer, lane, own);
        });
}

RenderThread::End::~End() {
    std::unique_lock lock(crew.mutex_);
    crew.ending_ = true;
    crew.call_all(std::move(lock));
}

void RenderThread::call_all(std::unique_lock<PriorityMutex> lock) {
    const auto asleep = std::exchange(asleep_, {});
    lock.unlock();
    for (Sleeper* sleeper : asleep) sleeper->call();
}

RenderThread::Ticket RenderThread::submit(Claim claim, Shot shot, Situation situation, Done done) {
    std::unique_lock lock(mutex_);
    const Ticket ticket = ++last_ticket_;
    const auto later =
        std::ranges::upper_bound(jobs_, claim.needed, {}, [](const Job& job) { return job.claim.needed; });
    jobs_.insert(later, {claim, std::move(shot), std::move(situation), std::move(done), ticket});
    share_turns();
    call_all(std::move(lock));  // not every thread takes every job
    return ticket;
}

void RenderThread::hurry(Ticket ticket) {
    std::unique_lock lock(mutex_);
    const auto job = std::ranges::find(jobs_, ticket, &Job::ticket);
    if (job != jobs_.end()) job->claim.patient = false;
    const auto begun = std::ranges::find(under_way_, ticket, &UnderWay::ticket);
    if (begun != under_way_.end()) begun->claim.patient = false;
    share_turns();
    if (job != jobs_.end()) call_all(std::move(lock));  // it may be urgent
}

void RenderThread::withdraw(Ticket ticket) {
    Jobs withdrawn;  // its end may take long
    std::unique_lock lock(mutex_);
    const auto job = std::ranges::find(jobs_, ticket, &Job::ticket);
    if (job != jobs_.end()) return withdrawn.splice(withdrawn.end(), jobs_, job);
    if (std::erase_if(busy_, [ticket](const auto& one) { return one.second == ticket; }) > 0)
        call_all(std::move(lock));
}

/// The first of the jobs that are the first ones of sonars that have none under way.
RenderThread::Jobs::iterator RenderThread::most_urgent(Lane lane) {
    std::set<std::size_t> seen;
    return std::ranges::find_if(jobs_, [&](const Job& job) {
        const std::size_t sonar = job.claim.sonar;
        return !busy_.contains(sonar) && seen.insert(sonar).second && is_for(lane, job);
    });
}

bool RenderThread::is_for(Lane lane, const Job& job) const {
    const bool single_beam = is_single_beam(job.shot);
    if (lane == Lane::single_beams) return single_beam;
    if (!leaves_a_thread(job.shot)) return false;
    if (lane == Lane::every) return true;
    const auto needed = [](const UnderWay& one) { return one.claim.needed; };
    return !single_beam && !job.claim.patient && under_way_.size() == every_ &&
           job.claim.needed < std::ranges::max(under_way_ | std::views::transform(needed));
}

void RenderThread::begin(const Job& job, Lane lane) {
    if (lane == Lane::every)
        under_way_.push_back({::pthread_self(), job.claim, !is_single_beam(job.shot), job.ticket});
    share_turns();
}

void RenderThread::end(Ticket ticket) {
    if (std::erase_if(under_way_, [ticket](const UnderWay& one) { return one.ticket == ticket; }) == 0)
        return;
    if (real_time_) give_turn(::pthread_self(), Turn::fans);  // for the next one
    share_turns();
}

bool RenderThread::someone_hurries() const {
    return std::ranges::any_of(
        jobs_, [](const Job& job) { return !job.claim.patient && !is_single_beam(job.shot); });
}

/// A patient fan leaves processors to other programs while nobody waits for its thread. An urgent fan takes
/// the processor of the fan that is needed last.
void RenderThread::share_turns() const {
    if (!real_time_) return;
    const bool hurry = someone_hurries();
    const UnderWay* last = nullptr;
    for (const UnderWay& one : under_way_)
        if (one.fan && (last == nullptr || one.claim.needed > last->claim.needed)) last = &one;
    for (const UnderWay& one : under_way_) {
        if (!one.fan) continue;
        const bool leaves_processor = urgent_fans_ && &one == last && under_way_.size() > 1;
        give_turn(one.thread, one.claim.patient && !hurry ? Turn::ordinary
                              : leaves_processor          ? Turn::less_urgent_fans
                                                          : Turn::fans);
    }
}

void RenderThread::serve(Renderer& renderer, Lane lane, Sleeper& own) {
    while (true) {
        std::unique_lock lock(mutex_);
        auto next = most_urgent(lane);
        for (; !ending_ && next == jobs_.end(); next = most_urgent(lane)) {
            asleep_.push_back(&own);
            lock.unlock();
            own.sleep();
            lock.lock();
        }
        if (ending_) return;
        Job job = std::move(*next);
        jobs_.erase(next);
        busy_[job.claim.sonar] = job.ticket;
        const std::size_t images = job.shot.rows() > 1 ? 1 : 0;
        images_ += images;
        begin(job, lane);
        // One of those that wait may have become urgent.
        urgent_fans_ && !jobs_.empty() ? call_all(std::move(lock)) : lock.unlock();
        try {
            const Place place(real_time_ && lane == Lane::every && is_single_beam(job.shot));
            job.done(renderer.render(job.shot, job.situation), {});
        } catch (const std::exception& error) {
            job.done(silence(std::move(job.shot), job.situation.world_from_sonar), error.what());
        }
        lock = std::unique_lock(mutex_);
        std::erase_if(busy_, [&job](const auto& one) { return one.second == job.ticket; });  // or withdrawn
        images_ -= images;
        end(job.ticket);
        if (!jobs_.empty()) call_all(std::move(lock));
    }
}

}  // namespace echoloop
