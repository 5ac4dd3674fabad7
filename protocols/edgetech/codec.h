// EdgeTech messages to bytes and back, by the tables of the layouts, and found in a stream. Knows no state,
// time or device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/edgetech/messages.h"
#include "protocols/wire/framer.h"
#include "protocols/wire/result.h"

namespace echoloop::edgetech {

inline constexpr std::size_t longest_message = 262144;  ///< B: the buffer of a known reader
inline constexpr std::size_t longest_command = 128;     ///< B: own choice; those that are known have 28

/// The header at the start of `bytes`, if one of any type and at most `longest` bytes with what follows
/// stands there.
std::optional<Header> plausible_header(wire::ByteView bytes, std::size_t longest = longest_message);

/// All bytes of a message; its size follows from the body.
wire::Bytes encode(const Message& message);
/// The message that these bytes are, all of them. What is too short for its type is Unread, as a get is.
wire::Result<Message> parse(wire::ByteView bytes);

bool is_known(Type type);
/// "SonarData", or "message 86" of a type without a name.
std::string name_of(const Header& header);

/// How many samples a side has, with the bits that stand elsewhere.
std::size_t sample_count(const SonarData& data);
void set_sample_count(SonarData& data, std::size_t count);
/// Hz.
double start_frequency(const SonarData& data);
double end_frequency(const SonarData& data);
void set_frequencies(SonarData& data, double start, double end);

/// Levels, the samples times 2^-weighting: of analytic samples the magnitude. Empty where size, count and
/// format contradict each other, and of formats that no public program reads.
std::vector<float> levels(const SonarData& data);
std::vector<float> levels(const OldSideScan& data);

/// A message begins with its header and is as long as it says.
class MessageFinder {
  public:
    explicit MessageFinder(std::size_t longest = longest_message) : longest_(longest) {}
    wire::Found<wire::Bytes> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const { return {.before = longest_}; }

  private:
    std::size_t longest_;
};

using Framer = wire::Framer<wire::Bytes, MessageFinder>;

}  // namespace echoloop::edgetech
