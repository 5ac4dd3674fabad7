// Takes a body that comes in chunks off a byte stream. Bounded; knows no request.
#pragma once

#include <string>
#include <string_view>

namespace echoloop::http {

inline constexpr std::size_t longest_chunk_line = 256;  ///< B, its size and extensions, or a trailer

class ChunkReader {
  public:
    /// `limit`: B, of the whole body.
    explicit ChunkReader(std::size_t limit) : limit_(limit) {}

    enum class Progress { unfinished, whole, malformed, too_long };
    /// Takes what it can off the front of `buffer`; what is left is less than a line. `body` grows by what
    /// the chunks carry.
    Progress take(std::string& buffer, std::string& body);

  private:
    enum class Place { size, data, data_end, trailer };

    Progress take_line(std::string_view line, std::size_t have);

    std::size_t limit_;
    Place place_ = Place::size;
    std::size_t left_ = 0;      ///< B of the chunk at hand
    std::size_t trailers_ = 0;  ///< lines
};

}  // namespace echoloop::http
