// The chosen ports of a capture as a source for a player: who said what and when, read from the file piece by
// piece. Sends nothing.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/replay/message_reader.h"
#include "emulator/replay/player.h"
#include "tools/capture/open.h"
#include "tools/capture/ports.h"

namespace echoloop::cli {

/// A port that is played: one of the capture, or several that share an end.
struct PlayedPort {
    std::map<capture::PortKey, bool> keys;  ///< and whether the played side is `first` there
    const inspect::Family* family = nullptr;
    double byte_time = 0;  ///< s on a paced line; 0: none
    /// Of several drivers at a port of an emulated device, one is played at a time: the first, and when it
    /// was heard last, as said here, the next. s, as in the events.
    std::map<Address, double> drivers{};
};

struct SourceSettings {
    std::string file;
    std::vector<PlayedPort> ports;
    double from = 0, until = 1e18;  ///< s since the first event of the capture
    bool whole_messages = false;    ///< streams are cut into messages
    double speed = 1;               ///< of the player, for the time that a line takes
    capture::OpenSettings open;
};

class CaptureSource final : public replay::Source {
  public:
    /// Throws StartError if the file cannot be read.
    explicit CaptureSource(SourceSettings settings);

    std::optional<replay::Said> next() override;
    void rewind() override;

  private:
    using Way = std::pair<capture::PortKey, bool>;  ///< port of the capture and side

    bool read_more();
    void add(const capture::CaptureEvent& event);
    bool is_played(const PlayedPort& port, const capture::PortKey& key, const capture::CaptureEvent& event);
    void say(replay::Said said);
    void finish_ways();

    SourceSettings settings_;
    std::unique_ptr<capture::Input> input_;
    std::unique_ptr<capture::CaptureReader> capture_;
    std::map<Way, replay::MessageReader> readers_;
    /// Whose words are played, and the last of them or to it.
    struct Talk {
        Address driver;
        Bytes last;
    };
    std::map<capture::PortKey, Talk> talks_;
    std::deque<replay::Said> waiting_;
    std::optional<double> begin_;   ///< of the capture
    std::optional<double> origin_;  ///< of what is played
    Time last_{};
    bool ended_ = false;
};

}  // namespace echoloop::cli
