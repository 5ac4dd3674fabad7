// One of the two captures that are compared: its messages with their fields as numbers and texts, by
// direction and type. Holds a bounded part of a capture; compares nothing.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tools/capture/messages.h"

namespace echoloop::diff {

/// Fields of the elements of a list are one array: "points[].angle".
using Value = std::variant<double, std::string, std::vector<double>>;

struct NamedValue {
    std::string name;
    std::string unit;
    Value value;
    std::size_t width = 0;  ///< B of one number
};

struct Place {
    std::uint64_t packet = 0;  ///< from 1; 0: the file has no packets
    double time = 0;           ///< s since the first event of the file
    std::size_t message = 0;   ///< of all of the file, from 1
};

struct Message {
    Place place;
    std::vector<NamedValue> fields;
    std::optional<double> own_time{};  ///< s, as the message itself says

    /// `hint`: where it may be. nullptr if there is none.
    const NamedValue* find(const std::string& name, std::size_t hint) const;
};

/// What one side of a line, a connection or a pair of addresses says.
struct Direction {
    std::vector<capture::Way> ways;  ///< one, or those of a driver that came back from another port
    const inspect::Family* family = nullptr;
    std::map<std::string, std::vector<Message>> types;   ///< by name, each in order
    std::vector<std::pair<double, std::string>> spoken;  ///< time and name of all, in order
    std::size_t undecoded_bytes = 0;

    std::string text() const;  ///< "micron line, sent", "127.0.0.1:65500 -> 127.0.0.1:65400"
    bool answers(const Direction& other) const;
};

struct Side {
    std::string file;
    std::vector<Direction> directions;
    std::size_t messages = 0;
    std::size_t undecoded_bytes = 0;
    bool has_times = true;
    bool is_cut = false;                ///< it holds more than is compared
    std::vector<std::string> troubles;  ///< while it was read
};

struct SideSettings {
    const inspect::Family* family = nullptr;  ///< nullptr: guessed
    std::string port;                         ///< number, line or address that one end must have; "": all
    std::size_t most_bytes = std::size_t{256} << 20;  ///< of memory for the messages
};

/// Adds what the capture holds.
void read_events(capture::CaptureReader& capture, const SideSettings& settings, Side& side);

/// The fields of a message; those of the elements of a list as one array.
std::vector<NamedValue> named_values(const inspect::Message& message);

/// `port`: as in SideSettings.
bool fits(const capture::Way& way, const std::string& port);

/// A capture or a file of bytes. Throws StartError if it cannot be read or holds no known message.
Side read_side(const std::string& file, const SideSettings& settings);

}  // namespace echoloop::diff
