// Endpoint URIs: the forms that are accepted, the sentences for those that are not, and what clashes.
#include "emulator/contract/endpoint.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>

namespace echoloop {
namespace {

using Scheme = Endpoint::Scheme;

TEST(Endpoint, reads_every_form) {
    const auto pty = parse_endpoint("pty:/tmp/echoloop/micron");
    EXPECT_EQ(pty.scheme, Scheme::pty);
    EXPECT_EQ(pty.path, "/tmp/echoloop/micron");

    const auto serial = parse_endpoint("serial:///dev/ttyUSB0:115200");
    EXPECT_EQ(serial.scheme, Scheme::serial);
    EXPECT_EQ(serial.path, "/dev/ttyUSB0");
    EXPECT_EQ(serial.baud, 115200);
    EXPECT_EQ(parse_endpoint("serial:///dev/ttyUSB0").baud, 0);

    const auto listen = parse_endpoint("tcp-listen://localhost:9090");
    EXPECT_EQ(listen.scheme, Scheme::tcp_listen);
    EXPECT_EQ(listen.host, "127.0.0.1");
    EXPECT_EQ(listen.ip, 0x7F000001);
    EXPECT_EQ(listen.port, 9090);

    const auto udp = parse_endpoint("udp://10.0.1.102:65400?local_port=65502");
    EXPECT_EQ(udp.scheme, Scheme::udp);
    EXPECT_EQ(udp.ip, 0x0A000166);
    EXPECT_EQ(udp.local_port(), 65502);
}

TEST(Endpoint, several_slashes_in_front_of_a_path_are_one) {
    const auto one = parse_endpoint("pty:/tmp/a"), many = parse_endpoint("pty://////tmp/a");
    EXPECT_EQ(many.path, "/tmp/a");
    EXPECT_EQ(to_string(many), to_string(one));
    EXPECT_TRUE(clash(one, many)) << "they are one file";
}

TEST(Endpoint, prints_what_it_would_read_again) {
    for (const auto* uri : {"pty:/tmp/a", "pty:/tmp/a?group=dialout", "serial:///dev/ttyS0",
                            "serial:///dev/ttyS0:9600", "tcp://1.2.3.4:5", "tcp-listen://0.0.0.0:0",
                            "udp-listen://127.0.0.2:65500", "udp://127.0.0.1:1?local_port=2"}) {
        EXPECT_EQ(to_string(parse_endpoint(uri)), uri);
        EXPECT_EQ(parse_endpoint(to_string(parse_endpoint(uri))), parse_endpoint(uri));
    }
}

struct Refused {
    const char* uri;
    const char* why;
};

class BadEndpoint : public testing::TestWithParam<Refused> {};

TEST_P(BadEndpoint, is_refused_with_the_right_form) {
    try {
        parse_endpoint(GetParam().uri);
        FAIL() << GetParam().uri << " was accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(GetParam().why), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(
    Forms, BadEndpoint,
    testing::Values(
        Refused{"", "does not begin with a known scheme"}, Refused{"pty", "known scheme"},
        Refused{"telnet://1.2.3.4:5", "known scheme"}, Refused{"pty:tmp/x", "must be absolute"},
        Refused{"pty:/tmp/", "names a folder"}, Refused{"pty:/tmp/a b", "a space"},
        Refused{"serial:///dev/ttyS0:fast", "line rate"}, Refused{"serial:///dev/ttyS0:0", "line rate"},
        Refused{"tcp:1.2.3.4:5", "write it as in tcp://"}, Refused{"tcp://1.2.3.4", "port is missing"},
        Refused{"tcp://sonar.local:5", "host names are not looked up"},
        Refused{"udp://::1:5", "not an IPv4 address"}, Refused{"udp://1.2.3:5", "not an IPv4 address"},
        Refused{"udp://1.2.3.256:5", "not an IPv4 address"}, Refused{"udp://1.2.3.4.5:5", "not an IPv4"},
        Refused{"udp://1.2.3.4:65536", "number up to 65535"}, Refused{"udp://1.2.3.4:", "number up to"},
        Refused{"udp://1.2.3.4:0", "no destination"}, Refused{"tcp://0.0.0.0:5", "no destination"},
        Refused{"udp://1.2.3.4:5?localport=6", "unknown setting 'localport'"},
        Refused{"udp://1.2.3.4:5?local_port=0", "from 1 to 65535"},
        Refused{"tcp://1.2.3.4:5?local_port=6", "unknown setting"}));

TEST(Endpoint, clashes_only_where_both_would_claim_the_same) {
    const auto clashes = [](const char* a, const char* b) {
        return clash(parse_endpoint(a), parse_endpoint(b));
    };
    EXPECT_TRUE(clashes("pty:/tmp/a", "pty:/tmp/a"));
    EXPECT_FALSE(clashes("pty:/tmp/a", "pty:/tmp/b"));
    EXPECT_TRUE(clashes("serial:///dev/ttyS0", "serial:///dev/ttyS0:9600"));
    EXPECT_TRUE(clashes("tcp-listen://0.0.0.0:80", "tcp-listen://127.0.0.1:80"));
    EXPECT_FALSE(clashes("tcp-listen://127.0.0.2:80", "tcp-listen://127.0.0.1:80"));
    EXPECT_FALSE(clashes("tcp-listen://127.0.0.1:80", "udp-listen://127.0.0.1:80"));
    EXPECT_FALSE(clashes("udp-listen://127.0.0.1:0", "udp-listen://127.0.0.1:0"));
    EXPECT_FALSE(clashes("udp://127.0.0.1:80", "udp://127.0.0.1:80")) << "two sonars may feed one host";
    EXPECT_TRUE(clashes("udp://127.0.0.1:80?local_port=5", "udp://127.0.0.2:80?local_port=5"));
}

RC_GTEST_PROP(EndpointBytes, any_text_is_read_or_refused, (const std::string& text)) {
    for (const auto* start : {"", "pty:", "serial:", "udp://", "tcp-listen://1.2.3.4:", "udp://1.2.3.4:5?"}) {
        try {
            const auto parsed = parse_endpoint(start + text);
            RC_ASSERT(parse_endpoint(to_string(parsed)) == parsed);
        } catch (const std::invalid_argument&) {
        }
    }
}

}  // namespace
}  // namespace echoloop
