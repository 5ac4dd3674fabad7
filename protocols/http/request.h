// Cuts a byte stream into HTTP/1.1 requests and writes responses. Bounded; knows no path, opens nothing,
// keeps no clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "protocols/http/chunks.h"
#include "protocols/wire/bytes.h"

namespace echoloop::http {

inline constexpr std::size_t longest_head = 8192;   ///< B, request line and headers
inline constexpr std::size_t longest_body = 65536;  ///< B

struct Request {
    std::string method;  ///< "GET"
    std::string target;  ///< "/api/v1?x=1", as it came
    std::string host;    ///< the header Host; "" without one
    std::string origin;  ///< the header Origin: the page that asks, which browsers tell
    std::string body;
};

/// Whether a web page asks that did not come from here: Origin is another than Host (RFC 6454), or Host is a
/// name, which whoever owns it may let point to this machine at any time (DNS rebinding). Addresses and
/// localhost are no such names.
bool is_of_foreign_page(const Request& request);

/// Bytes that are no request: everything pending is forgotten, and the host should be told.
struct Refusal {
    int status = 400;
};

class RequestReader {
  public:
    using Next = std::optional<std::variant<Request, Refusal>>;

    void feed(wire::ByteView bytes);
    /// The next complete request or fault, or nothing until more bytes come.
    Next next();
    /// Bytes of an unfinished request.
    std::size_t pending_bytes() const;
    /// Forgets them.
    void clear();

  private:
    /// A request whose body comes in chunks.
    struct Chunked {
        Request request;
        ChunkReader chunks;
    };

    Refusal refuse(int status);
    Next next_of_chunks();

    std::string buffer_;
    std::optional<Chunked> chunked_;
};

/// A whole response with its length; `body` is JSON, or empty. It asks the host to close the connection.
wire::Bytes response(int status, std::string_view body = {});

}  // namespace echoloop::http
