// Lines of the control socket: what is understood, and what is refused with which words.
#include "emulator/faults/control_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "emulator/contract/options.h"
#include "emulator/scenario/control_place.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using What = ControlRequest::What;

class ControlLineTest : public testing::Test {
  protected:
    ControlLineTest() {
        ScenarioDevice micron;
        micron.name = "micron";
        micron.model = find_model("tritech-micron");
        micron.config.name = "micron";
        micron.config.endpoints = parse_endpoints(micron.model->default_endpoints);
        micron.config.options = default_options(*micron.model);
        devices_.push_back(micron);
    }
    ControlLine parse(std::string_view line) const { return parse_control_line(line, devices_, 10s); }
    Fault fault(std::string_view line) const {
        const ControlLine read = parse(line);
        EXPECT_TRUE(read.request) << line << ": " << read.reason;
        return read.request ? read.request->fault : Fault{};
    }
    std::string reason(std::string_view line) const {
        const ControlLine read = parse(line);
        EXPECT_FALSE(read.request) << line;
        return read.reason;
    }

    std::vector<ScenarioDevice> devices_;
};

TEST_F(ControlLineTest, FaultsBeginNowUnlessTheySayWhen) {
    const Fault now = fault(R"({"fault":{"device":"micron","kind":"bit_flips","rate":1e-3,"for":2}})");
    EXPECT_EQ(now.kind, FaultKind::bit_flips);
    EXPECT_EQ(std::get<double>(now.parameters.at("rate")), 1e-3);
    EXPECT_EQ(now.from, Time(10s));
    EXPECT_EQ(now.on_until(11s), Time(12s));
    const Fault later =
        fault(R"({"fault": {"device": "micron", "kind": "reboot", "at": 60.5, "every": 10}})");
    EXPECT_EQ(later.from, Time(60500ms));
    EXPECT_EQ(later.every, Time(10s));
}

TEST_F(ControlLineTest, OtherRequests) {
    EXPECT_EQ(parse(R"({"clear": 3})").request->id, 3);
    EXPECT_FALSE(parse(R"({"clear": "all"})").request->id);
    EXPECT_EQ(parse(R"({"clear": "all"})").request->what, What::clear);
    EXPECT_EQ(parse(R"({"list": true})").request->what, What::list);
    EXPECT_EQ(parse(" {\"status\":true}\r").request->what, What::status);
}

TEST_F(ControlLineTest, RefusalsSayWhatWouldBeRight) {
    EXPECT_THAT(reason(R"({"fault": {"device": "micro", "kind": "loss"}})"),
                HasSubstr("did you mean 'micron'?"));
    EXPECT_THAT(reason(R"({"fault": {"device": "micron", "kind": "loss", "rate": 2}})"),
                HasSubstr("fault.rate: 2 is out of range; allowed is 0 to 1"));
    EXPECT_THAT(reason(R"({"fault": {"device": "micron", "kind": "wrong_checksum"}})"),
                HasSubstr("has none"));
    EXPECT_THAT(reason(R"({"fault": "loss"})"), HasSubstr("expected keys and values"));
    EXPECT_THAT(reason(R"({"clear": "some"})"), HasSubstr("number of a fault or \"all\""));
    EXPECT_THAT(reason(R"({"list": 1})"), HasSubstr("expected true"));
    EXPECT_THAT(reason(R"({"stop": true})"), HasSubstr("unknown request 'stop'; known are"));
    EXPECT_THAT(reason(R"({"list": true, "status": true})"), HasSubstr("one request"));
    EXPECT_THAT(reason("[1, 2]"), HasSubstr("JSON object"));
    EXPECT_THAT(reason(R"({"list": )"), HasSubstr("no JSON"));
    EXPECT_THAT(reason(std::string(5000, ' ')), HasSubstr("longer than 4096"));
    EXPECT_FALSE(reason(std::string(4000, '[')).empty());
}

TEST(ControlPlace, IsASocketFileOrAPortOfThisMachine) {
    EXPECT_EQ(parse_control_place("unix:/tmp/echoloop/control").path, "/tmp/echoloop/control");
    EXPECT_EQ(parse_control_place("tcp-listen://127.0.0.1:9600").address.port, 9600);
    EXPECT_THROW(parse_control_place("unix:control"), std::invalid_argument);
    EXPECT_THROW(parse_control_place("unix:/" + std::string(120, 'a')), std::invalid_argument);
    EXPECT_THROW(parse_control_place("tcp-listen://192.168.2.1:9600"), std::invalid_argument);
    EXPECT_THROW(parse_control_place("tcp-listen://0.0.0.0:9600"), std::invalid_argument);
    EXPECT_THROW(parse_control_place("pty:/tmp/x"), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop
