// A sonar that things go wrong with: a decorator around the device that its driver believes to meet. The
// device itself never knows.
#pragma once

#include <functional>

#include "emulator/faults/faults.h"

namespace echoloop {

class FaultyDevice final : public Device {
  public:
    using Make = std::function<std::unique_ptr<Device>()>;

    /// `make`: one as it comes from its factory; called again after each loss of power. `faults` outlives
    /// this.
    FaultyDevice(Make make, DeviceFaults& faults);

    /// Without power until started() is called again, which then starts one that knows nothing of before.
    void cut_power();

    std::vector<Port> ports() const override { return ports_; }
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    /// Comes before each heard(), on the thread of everything else.
    void about_to_hear(Time now);
    /// On any thread while no other calls. What it returns goes through answered(), on the thread of
    /// everything else.
    Actions heard(const Echogram& echogram, Time now) override;
    Actions answered(Actions actions, Time now) { return with_faults(std::move(actions), now); }
    Actions woken(Time now) override;
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t port) override;
    Actions connected(std::size_t port, Address peer, Time now) override;
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  private:
    /// What is wrong with the ping that the device asks for.
    Actions with_faults(Actions actions, Time now);
    void stick(Shot& shot, Time now);

    Make make_;
    DeviceFaults& faults_;
    std::unique_ptr<Device> device_;  ///< nullptr: without power
    std::vector<Port> ports_;
    std::map<std::size_t, double> rates_;  ///< of the lines, as last told
    DeviceCounters before_;                ///< of those that lost their power
    std::uint64_t pings_ = 0;
    std::optional<double> last_pan_, stuck_at_;
    enum class Image { passed, kept, frozen };
    Image shown_ = Image::passed;    ///< of what is heard next
    std::optional<Echogram> image_;  ///< the one that is frozen, or the last
};

}  // namespace echoloop
