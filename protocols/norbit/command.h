// The text commands of a Norbit WBMS, TCP port 2209: words of a line, lines of a stream. Knows no command by
// name and no device.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::norbit {

/// "set_range 0.5 30"; without arguments a question.
struct Command {
    std::string name;
    std::vector<std::string> arguments;

    friend bool operator==(const Command&, const Command&) = default;
};

/// The command on a line without its end; nothing if the line is blank, holds other than printable ASCII and
/// blanks, or more than 16 arguments. What follows '#' is a comment.
std::optional<Command> read_command(std::string_view line);

/// "name argument argument # comment" CR LF; no '#' without a comment.
std::string write_answer(const Command& command, std::string_view comment = {});

/// All of `word` as a finite number.
std::optional<double> read_number(std::string_view word);
/// As short as %g with six digits.
std::string write_number(double value);
/// The same with a decimal at least: "20.0".
std::string write_decimal(double value);

/// Cuts what a host sends into lines. A host may leave out the line's end: rest() is then a line when it has
/// waited long enough, which only its owner can know.
class LineFramer {
  public:
    static constexpr std::size_t longest = 512;  ///< characters; longer lines are skipped whole

    void feed(wire::ByteView bytes);
    /// The next line that has an end, without it; may be blank.
    std::optional<std::string> next();
    /// What waits for a line's end, and is forgotten by this; empty if nothing waits or it is too long.
    std::string rest();
    bool waits() const { return !buffer_.empty(); }

    std::uint64_t skipped_bytes() const { return skipped_; }

  private:
    std::string buffer_;
    bool too_long_ = false;  ///< the line at hand; its beginning has been skipped
    std::uint64_t skipped_ = 0;
};

}  // namespace echoloop::norbit
