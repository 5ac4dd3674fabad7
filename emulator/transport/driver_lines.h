// One port of a device with drivers on lines of their own, several or one that must hold nothing up. It
// understands no message.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "emulator/clock/clock.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class DriverLines final : public Transport {
  public:
    /// What a driver that does not read does to others: nothing, and loses what does not fit the memory that
    /// is kept for it; or it holds up everything that is written.
    enum class Slow { loses, holds_up };

    /// `lines`: one or more, each tells of its drivers and serves one at a time. `most_messages`: that wait
    /// for one of them, if the memory does not end before.
    DriverLines(Clock& clock, std::vector<std::unique_ptr<Transport>> lines, Slow slow,
                std::size_t most_messages = std::numeric_limits<std::size_t>::max());

    /// Before start(): puts something around each line.
    void put_around(const std::function<std::unique_ptr<Transport>(std::unique_ptr<Transport>)>& around);

    /// `received` says which driver spoke, and is never called for one that is not connected; there is no
    /// `reconnected`.
    void start(Events events) override;
    /// `to`: a driver; zero: all of them. With nobody there it goes to the first line, which loses it.
    Task<void> write(ByteView bytes, Address to) override;
    /// Behind all that was written, or where a driver does not take that, after 2 s with a reset.
    void hang_up(Address to) override;
    bool has_driver() const override;
    void annotate(const std::string& remark) override { remarks_.push_back(remark); }
    void close() override;
    void settle() override;
    std::string describe() const override { return lines_.front()->wire->describe(); }
    Wire wire() const override { return lines_.front()->wire->wire(); }
    std::vector<std::string> connected() const override;
    std::uint64_t bytes_in() const override;
    std::uint64_t bytes_out() const override;
    std::uint64_t bytes_lost() const override;
    std::uint64_t messages_dropped() const override { return dropped_; }

  private:
    /// What is to be said next on a line; no bytes: the connection ends here.
    struct Mail {
        std::shared_ptr<const Bytes> bytes;
        std::vector<std::string> remarks;
    };
    struct Line {
        Line(Clock& clock, std::unique_ptr<Transport> open)
            : wire(std::move(open)), mail(clock), idle(clock) {}
        bool busy() const { return !waiting.empty() || writing; }

        std::unique_ptr<Transport> wire;
        Address driver{};         ///< port 0: nobody
        std::uint64_t visit = 0;  ///< the how many-th driver it is
        std::deque<Mail> waiting;
        std::size_t memory = 0;  ///< of what waits
        bool writing = false;
        Alarm mail, idle;  ///< ring when there is something to say, and when all is said
    };

    std::vector<Line*> meant(Address to);
    void post(Line& line, std::shared_ptr<const Bytes> bytes);
    bool is_full(const Line& line, std::size_t more) const;
    Task<void> insist_on_end(Line& line);
    void leave(Line& line);
    Task<void> keep_writing(Line& line);

    Clock& clock_;
    std::vector<std::unique_ptr<Line>> lines_;
    Slow slow_;
    std::size_t most_messages_;
    Events events_;
    std::vector<std::string> remarks_;      ///< on what is written next
    std::uint64_t lost_ = 0, dropped_ = 0;  ///< bytes, messages
    bool closed_ = false;
};

}  // namespace echoloop
