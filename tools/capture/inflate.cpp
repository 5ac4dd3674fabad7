#include "tools/capture/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace echoloop::capture {
namespace {

constexpr int gzip_window = 15 + 16;  // of zlib: the largest, and a gzip header

struct Gunzip {
    Bytes head;
    std::FILE* rest = nullptr;
    std::string* fault = nullptr;
    z_stream stream{};
    std::array<Bytes::value_type, 65536> buffer{};
    bool ended = false;

    ~Gunzip() {
        ::inflateEnd(&stream);
        if (rest != nullptr && rest != stdin) std::fclose(rest);
    }

    bool refill() {
        if (!head.empty()) {
            std::ranges::copy(head, buffer.begin());
            stream.avail_in = static_cast<uInt>(head.size());
            head.clear();
        } else {
            stream.avail_in = static_cast<uInt>(std::fread(buffer.data(), 1, buffer.size(), rest));
        }
        stream.next_in = buffer.data();
        return stream.avail_in > 0;
    }

    void fail(const char* why) {
        *fault = why;
        ended = true;
    }

    std::size_t read(std::uint8_t* to, std::size_t size) {
        stream.next_out = to;
        stream.avail_out = static_cast<uInt>(std::min<std::size_t>(size, 1U << 30));
        const std::size_t asked = stream.avail_out;
        while (stream.avail_out == asked && !ended) {
            if (stream.avail_in == 0 && !refill()) {
                fail("the compressed file is cut short");
                break;
            }
            const int result = ::inflate(&stream, Z_NO_FLUSH);
            if (result == Z_STREAM_END)
                next_member();
            else if (result != Z_OK && result != Z_BUF_ERROR)
                fail("the compressed file is damaged");
        }
        return asked - stream.avail_out;
    }

    /// Files that were joined are members one after the other.
    void next_member() {
        if (stream.avail_in == 0 && !refill()) {
            ended = true;
            return;
        }
        if (::inflateReset(&stream) != Z_OK) fail("the compressed file is damaged");
    }
};

ssize_t gunzip_read(void* cookie, char* buffer, std::size_t size) {
    return static_cast<ssize_t>(
        static_cast<Gunzip*>(cookie)->read(reinterpret_cast<std::uint8_t*>(buffer), size));
}

int gunzip_close(void* cookie) {
    const std::unique_ptr<Gunzip> gunzip(static_cast<Gunzip*>(cookie));
    return 0;
}

bool begins_with(ByteView bytes, std::string_view with) {
    return bytes.size() >= with.size() &&
           std::equal(with.begin(), with.end(), bytes.begin(),
                      [](char a, auto b) { return static_cast<std::uint8_t>(a) == b; });
}

}  // namespace

bool is_gzip(ByteView start) { return begins_with(start, "\x1F\x8B"); }

std::string other_compression(ByteView start) {
    if (begins_with(start, "BZh")) return "bzip2";
    if (begins_with(start,
                    "\xFD"
                    "7zXZ"))
        return "xz";
    if (begins_with(start, "\x28\xB5\x2F\xFD")) return "zstd";
    return begins_with(start, "PK\x03\x04") ? "zip" : "";
}

std::FILE* gunzipped(Bytes head, std::FILE* rest, std::string& fault) {
    auto gunzip = std::make_unique<Gunzip>();
    gunzip->head = std::move(head);
    gunzip->fault = &fault;
    if (::inflateInit2(&gunzip->stream, gzip_window) != Z_OK) return nullptr;
    std::FILE* stream = ::fopencookie(gunzip.get(), "rb", {gunzip_read, nullptr, nullptr, gunzip_close});
    if (stream == nullptr) return nullptr;
    gunzip->rest = rest;
    static_cast<void>(gunzip.release());  // gunzip_close owns it now
    return stream;
}

std::optional<Bytes> qt_uncompressed(ByteView bytes, std::size_t most) {
    if (bytes.size() < 4) return {};
    std::size_t size = 0;
    for (const auto byte : bytes.first(4)) size = size << 8 | byte;
    // zlib makes at most some thousand bytes of one.
    if (size > most || size > bytes.size() * 1100) return {};
    Bytes out(size);
    uLongf length = size;
    const auto result = ::uncompress(out.data(), &length, bytes.data() + 4, bytes.size() - 4);
    if (result != Z_OK || length != size) return {};
    return out;
}

}  // namespace echoloop::capture
