// HTTP requests wherever the stream is split, with a length or in chunks, and responses.
#include <gtest/gtest.h>

#include "protocols/http/inspect.h"
#include "protocols/http/request.h"
#include "protocols/stream_decoder.h"
#include "tests/protocols/data.h"

namespace echoloop::http {
namespace {

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/" + name + ".hex").bytes;
}

wire::Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// The status of the refusal, or 0.
int refusal_of(std::string_view text) {
    RequestReader reader;
    reader.feed(bytes_of(text));
    const auto next = reader.next();
    const auto* refusal = next ? std::get_if<Refusal>(&*next) : nullptr;
    return refusal ? refusal->status : 0;
}

/// What a port of that family is said to carry.
std::vector<inspect::Message> inspected(const std::string& family,
                                        std::initializer_list<wire::ByteView> parts) {
    inspect::StreamDecoder decoder(inspect::find_family(family));
    std::vector<inspect::Message> all;
    for (const auto part : parts)
        decoder.add(part, [&](const inspect::Family*, const inspect::Message& one, wire::ByteView) {
            all.push_back(one);
        });
    return all;
}

TEST(HttpMessages, HaveThePathAsNameAndTheValuesAsFieldsWhereverTheStreamIsSplit) {
    wire::Bytes stream = golden("http/post_range");
    const wire::Bytes get = bytes_of("GET /api/v1/config?speed=1480&mode=fast HTTP/1.1\r\nHost: x\r\n\r\n");
    stream.insert(stream.end(), get.begin(), get.end());
    for (std::size_t at = 8; at <= stream.size(); ++at) {
        const auto all =
            inspected("waterlinked", {wire::ByteView(stream).first(at), wire::ByteView(stream).subspan(at)});
        ASSERT_EQ(all.size(), 2U) << at;
        EXPECT_EQ(all[0].name, "POST /api/v1/integration/acoustics/range");
        EXPECT_EQ(all[0].offset + all[0].size, all[1].offset);
        ASSERT_EQ(all[0].fields.size(), 2U);
        EXPECT_EQ(all[0].fields[1].name, "max");
        EXPECT_EQ(all[0].fields[1].number, 3.0);
        EXPECT_EQ(all[1].name, "GET /api/v1/config");
        ASSERT_EQ(all[1].fields.size(), 2U);
        EXPECT_EQ(all[1].fields[0].text, "1480");
        EXPECT_EQ(all[1].fields[1].text, "fast");
    }
}

TEST(HttpMessages, OfAResponseAreItsStatusAndTheMembersOfItsBody) {
    const auto all =
        inspected("waterlinked", {response(200, R"({"range": 4.5, "mode": "fast"})"), response(404)});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "200 OK");
    ASSERT_EQ(all[0].fields.size(), 2U);
    EXPECT_EQ(all[0].fields[0].number, 4.5);
    EXPECT_EQ(all[1].name, "404 Not Found");
}

TEST(HttpMessages, ThatNeverEndOrAreNoneAreToldAsRefused) {
    const auto wrong = inspected("waterlinked", {bytes_of("GET /x HTTP/2\r\n\r\n")});
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_NE(wrong[0].reason, "");
    const auto endless =
        inspected("waterlinked", {bytes_of("HTTP/1.1 200 OK\r\nX: " + std::string(9000, 'a'))});
    ASSERT_EQ(endless.size(), 1U);
    EXPECT_NE(endless[0].reason, "");
    const auto huge = bytes_of("HTTP/1.1 200 OK\r\nContent-Length: 99999999999999999999\r\n\r\n");
    EXPECT_EQ(inspected("waterlinked", {huge}).size(), 1U);
}

TEST(HttpRequest, IsReadWhereverTheStreamIsSplit) {
    wire::Bytes stream = golden("http/post_range");
    const wire::Bytes get = golden("http/get_about");
    stream.insert(stream.end(), get.begin(), get.end());
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        RequestReader reader;
        std::vector<Request> requests;
        for (const auto part : {wire::ByteView(stream).first(at), wire::ByteView(stream).subspan(at)}) {
            reader.feed(part);
            while (const auto next = reader.next()) requests.push_back(std::get<Request>(*next));
        }
        ASSERT_EQ(requests.size(), 2U) << at;
        EXPECT_EQ(requests[0].method, "POST");
        EXPECT_EQ(requests[0].target, "/api/v1/integration/acoustics/range");
        EXPECT_EQ(requests[0].body, R"({"min": 2.0, "max": 3.0})");
        EXPECT_EQ(requests[1].method, "GET");
        EXPECT_EQ(requests[1].body, "");
        EXPECT_EQ(reader.pending_bytes(), 0U);
    }
}

TEST(HttpRequest, WhatIsNoneIsRefusedAndForgotten) {
    EXPECT_EQ(refusal_of("nonsense\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("GET / FTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("GET / HTTP/1.1\r\nno colon\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: 65537\r\n\r\n"), 413);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\n\r\n"), 501);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\nContent-Length: 1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of(std::string(longest_head + 1, 'x')), 431);
    RequestReader reader;
    reader.feed(bytes_of("nonsense\r\n\r\n"));
    reader.next();
    EXPECT_EQ(reader.pending_bytes(), 0U);
}

const std::string chunked_head = "POST / HTTP/1.1\r\ntransfer-encoding: Chunked\r\n\r\n";

TEST(HttpRequest, InChunksIsReadWhereverTheStreamIsSplit) {
    const auto stream = bytes_of(chunked_head +
                                 "4\r\n{\"a\"\r\n0003;name=value\r\n: 1\r\n1\r\n}\r\n0\r\n"
                                 "Trailer: x\r\n\r\nGET /next HTTP/1.1\r\n\r\n");
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        RequestReader reader;
        std::vector<Request> requests;
        for (const auto part : {wire::ByteView(stream).first(at), wire::ByteView(stream).subspan(at)}) {
            reader.feed(part);
            while (const auto next = reader.next()) requests.push_back(std::get<Request>(*next));
        }
        ASSERT_EQ(requests.size(), 2U) << at;
        EXPECT_EQ(requests[0].body, R"({"a": 1})");
        EXPECT_EQ(requests[1].target, "/next");
        EXPECT_EQ(reader.pending_bytes(), 0U);
    }
}

TEST(HttpRequest, InChunksThatAreNoneIsRefused) {
    for (const char* chunks : {"\r\n", "x\r\n", "-1\r\n", "0x1\r\n", "1\r\nab\r\n", "1x\r\n"})
        EXPECT_EQ(refusal_of(chunked_head + chunks), 400) << chunks;
    EXPECT_EQ(refusal_of(chunked_head + "10001\r\n"), 413) << "65537";
    EXPECT_EQ(refusal_of(chunked_head + "ffffffffffffffffffff\r\n"), 413);
    EXPECT_EQ(refusal_of(chunked_head + "1;" + std::string(300, 'x')), 400) << "a line without an end";
    std::string trailers = "0\r\n";
    for (int i = 0; i < 40; ++i) trailers += "A: b\r\n";
    EXPECT_EQ(refusal_of(chunked_head + trailers), 400);
}

TEST(HttpRequest, InChunksKeepsNoMoreThanItsBody) {
    RequestReader reader;
    reader.feed(bytes_of(chunked_head));
    int status = 0;
    for (std::size_t sent = 0; status == 0 && sent < 70'000; ++sent) {
        reader.feed(bytes_of("1;" + std::string(200, 'x') + "\r\na\r\n"));
        const auto next = reader.next();
        if (next) status = std::get<Refusal>(*next).status;
        ASSERT_LE(reader.pending_bytes(), longest_body + 10) << sent;
    }
    EXPECT_EQ(status, 413) << "behind 65536 bytes";
    EXPECT_EQ(reader.pending_bytes(), 0U);
}

TEST(HttpResponse, HasItsLengthAndNoneWithoutContent) {
    EXPECT_EQ(response(200, "21.0"), bytes_of("HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n"
                                              "Content-Length: 4\r\nConnection: close\r\n\r\n21.0"));
    EXPECT_EQ(response(204), bytes_of("HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n"));
    EXPECT_EQ(response(404),
              bytes_of("HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"));
}

}  // namespace
}  // namespace echoloop::http
