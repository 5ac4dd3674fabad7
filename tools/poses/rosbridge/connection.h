// A WebSocket to a rosbridge server: whole messages of text in and out. Knows nothing of what they say; what
// comes is bounded in size.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace echoloop::poses {

class Connection {
  public:
    /// `url`: ws://host:port/path; port 9090 and no path if it does not say. Throws StartError (usage).
    explicit Connection(const std::string& url);
    ~Connection();

    /// False with why() if nobody answers.
    bool open();
    bool is_open() const;
    /// Why the last one failed or ended.
    const std::string& why() const;

    void write(const std::string& text);
    /// The next message, if one comes within the time.
    std::optional<std::string> read(int milliseconds);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace echoloop::poses
