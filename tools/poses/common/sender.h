// The way to the emulator: lines over UDP or TCP, and its answers to steps. Knows no pose. Bytes that come
// back are never trusted.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/contract/endpoint.h"
#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

class Sender {
  public:
    /// Throws StartError if there is no socket to be had. Whether the emulator is there shows later.
    explicit Sender(const Endpoint& to);
    ~Sender();
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;

    /// Never waits for the emulator: false if it is not there (TCP; nobody can know with UDP).
    bool send(const std::string& line);

    /// Sends the line, which holds "now", until the emulator has answered that it has got there. False if it
    /// answers that it will not, or if the program is to end before that.
    bool step(const std::string& line, Nanoseconds now);

    const std::string& place() const { return place_; }

  private:
    bool connect();
    void disconnect(const char* why);
    bool write(const std::string& line);
    bool answered(double now, int milliseconds);
    bool complain();
    void take(const char* bytes, std::size_t size);

    Endpoint to_;
    std::string place_;
    int socket_ = -1;
    bool tcp_;
    bool said_ = false;       ///< that nobody is there, since the last time that somebody was
    double reached_ = -1;     ///< s, the latest time that the emulator said
    std::string waiting_;     ///< the beginning of an answer
    std::string error_;       ///< what it last found wrong
    std::string said_error_;  ///< the same, that a person was told
    std::int64_t retry_ = 0;  ///< ms on the steady clock: not to be tried again before
};

}  // namespace echoloop::poses
