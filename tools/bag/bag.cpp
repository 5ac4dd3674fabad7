#include "tools/bag/bag.h"

#include <spdlog/spdlog.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "emulator/contract/error.h"
#include "tools/bag/mcap.h"
#include "tools/bag/schemas.h"

namespace echoloop::bag {
namespace {

constexpr std::size_t most_waiting = 256 << 20, kept_back = 4 << 20;  // bytes

}  // namespace

class BagFile::Impl {
  public:
    Impl(std::filesystem::path file, std::uint64_t keep_free)
        : disk(std::move(file), mcap_magic),
          mcap(
              [this, keep_free](std::string_view bytes) {
                  const std::string why = disk.append(bytes, keep_free);
                  if (!why.empty()) throw std::runtime_error(why);
              },
              "ros2", "echoloop " ECHOLOOP_VERSION) {}

    /// Makes it at the first call.
    std::uint16_t channel(const std::string& topic, const std::string& type) {
        const auto known = channels.find(topic);
        if (known != channels.end()) return known->second;
        auto schema = schemas.find(type);
        if (schema == schemas.end())
            schema = schemas.emplace(type, mcap.add_schema(type, "ros2msg", definition_of(type))).first;
        return channels[topic] = mcap.add_channel(schema->second, topic, "cdr");
    }

    DiskFile disk;
    McapWriter mcap;
    std::map<std::string, std::uint16_t> schemas{}, channels{};
};

BagFile::BagFile(std::filesystem::path file, std::uint64_t keep_free)
    : impl_(std::make_unique<Impl>(std::move(file), keep_free)) {}
BagFile::~BagFile() = default;

void BagFile::put(const Topics::Offer& offer, const Topics::Make& make) {
    impl_->mcap.message(impl_->channel(offer.topic, offer.type), offer.time, make());
}

void BagFile::attach(const std::filesystem::path& file, const std::string& media_type) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    impl_->mcap.attachment(file.filename().string(), media_type, 0, bytes.view());
}

void BagFile::note(const std::map<std::string, std::string>& entries) {
    impl_->mcap.metadata("echoloop", entries);
}
void BagFile::flush() { impl_->mcap.flush(); }
void BagFile::finish() {
    impl_->mcap.finish();
    impl_->disk.close();
}
std::uint64_t BagFile::messages() const { return impl_->mcap.messages(); }
std::uint64_t BagFile::size() const { return impl_->mcap.size(); }

Bag::~Bag() {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.clear();
    }
    if (thread_.joinable()) thread_.request_stop(), thread_.join();
}

void Bag::begin(BagStart start) {
    {
        const std::scoped_lock lock(mutex_);
        waits_ = start.waits;
        begun_ = true;
    }
    thread_ = std::jthread(
        [this, start = std::move(start)](const std::stop_token& stop) { keep_writing(stop, start); });
}

void Bag::ping(const SeenPing& seen) {
    auto copy = std::make_shared<const Ping>(kept(seen));
    const std::size_t bytes =
        sizeof *copy + copy->echogram.values.size() * (sizeof(float) + sizeof(std::uint16_t));
    if (add(bytes, [copy](Topics& topics) { topics.ping(*copy); })) return;
    add(
        sizeof *copy, [copy = course_of(seen)](Topics& topics) { topics.course(copy); }, Room::kept_back);
}

void Bag::bytes(const SeenBytes& seen) {
    Wire wire{.device = std::string(seen.device),
              .port = std::string(seen.port),
              .sent = seen.sent,
              .packets = seen.packets,
              .unix_time = seen.unix_time};
    add(seen.bytes.size(),
        [wire = std::move(wire), copy = Bytes(seen.bytes.begin(), seen.bytes.end())](Topics& topics) mutable {
            wire.bytes = copy;
            topics.bytes(wire);
        });
}

void Bag::fault(const SeenFault& seen) {
    add(
        seen.text.size(),
        [fault = Fault{std::string(seen.device), std::string(seen.port), seen.unix_time, seen.text,
                       seen.on_message, seen.sent}](Topics& topics) { topics.fault(fault); },
        Room::kept_back);
}

bool Bag::add(std::size_t bytes, Work work, Room room) {
    std::unique_lock lock(mutex_);
    const std::size_t most = most_waiting + (room == Room::kept_back ? kept_back : 0);
    const auto full = [&] {
        return !summary_.stopped && waiting_bytes_ > 0 && waiting_bytes_ + bytes > most;
    };
    if (waits_) room_.wait(lock, [&] { return !full(); });
    if (summary_.stopped) return true;
    if (full()) {
        if (summary_.lost++ == 0)
            spdlog::warn(
                "{}: writing is slower than the sonars; messages are left out, and the end of the run says "
                "how many",
                path_.string());
        return false;
    }
    waiting_bytes_ += bytes;
    waiting_.push_back({bytes, std::move(work)});
    more_.notify_one();
    return true;
}

void Bag::keep_writing(std::stop_token stop, const BagStart& start) {
    take_no_signals_for_files();
    try {
        file_.note(start.notes);
        if (!start.scene.empty())
            file_.attach(start.scene,
                         start.scene.extension() == ".glb" ? "model/gltf-binary" : "model/gltf+json");
        if (!start.scenario.empty()) file_.attach(start.scenario, "application/yaml");
        Topics topics(start.about, [this](const Topics::Offer& offer, const Topics::Make& make) {
            file_.put(offer, make);
        });
        auto flushed = std::chrono::steady_clock::now();
        std::unique_lock lock(mutex_);
        while (true) {
            more_.wait_for(lock, stop, longest_wait, [this] { return !waiting_.empty(); });
            const bool last = waiting_.empty() && stop.stop_requested();
            const auto work = std::exchange(waiting_, {});
            lock.unlock();
            std::size_t bytes = 0;
            for (const Waiting& one : work) {
                one.work(topics);
                bytes += one.bytes;
            }
            if (last) topics.finish();
            const auto now = std::chrono::steady_clock::now();
            if (last || now - flushed >= longest_wait) file_.flush(), flushed = now;
            if (last) file_.finish();
            lock.lock();
            waiting_bytes_ -= std::min(bytes, waiting_bytes_);
            summary_.messages = file_.messages(), summary_.bytes = file_.size();
            room_.notify_all();
            if (last) return;
        }
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void Bag::fail(const std::string& why) {
    spdlog::error("{}: the bag has stopped: {}", path_.string(), why);
    const std::scoped_lock lock(mutex_);
    summary_.stopped = true;
    fault_ = why;
    waiting_.clear();
    waiting_bytes_ = 0;
    room_.notify_all();
}

void Bag::finish() {
    if (thread_.joinable()) thread_.request_stop(), thread_.join();
    if (!fault_.empty())
        throw StartError(Exit::io,
                         path_.string() + ": " + fault_ +
                             "; what was written until then can be read (mcap recover); make room on that "
                             "disk and start again");
}

BagSummary Bag::summary() const {
    const std::scoped_lock lock(mutex_);
    return summary_;
}

}  // namespace echoloop::bag
