// Frames that real hosts sent: every vector parses and is written back byte for byte.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "tests/protocols/data.h"

namespace echoloop::seanet {
namespace {

nlohmann::json vectors(const std::filesystem::path& path) {
    return nlohmann::json::parse(std::ifstream(path));
}

wire::Bytes vector_of(const nlohmann::json& all, const std::string& name) {
    for (const auto& v : all["vectors"]) {
        if (v["name"].get<std::string>().find(name) != std::string::npos) {
            return from_hex(v["hex"].get<std::string>());
        }
    }
    ADD_FAILURE() << "no vector named " << name;
    return {};
}

Message parsed(const wire::Bytes& bytes) {
    Framer framer;
    framer.feed(bytes);
    const auto frame = framer.next();
    if (!frame) throw std::runtime_error("no frame");
    const auto message = parse(*frame);
    if (!message) throw std::runtime_error(message.error().what());
    return *message;
}

TEST(SeanetVectors, EveryVectorParsesAndIsWrittenBackByteForByte) {
    ECHOLOOP_NEED_DATA(path, "tritech/vectors.json");
    std::size_t seen = 0;
    const auto all = vectors(*path);
    for (const auto& v : all["vectors"]) {
        SCOPED_TRACE(v["name"].get<std::string>());
        const wire::Bytes bytes = from_hex(v["hex"].get<std::string>());
        Framer framer;
        framer.feed(bytes);
        const auto frame = framer.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(framer.skipped_bytes(), 0U);
        EXPECT_EQ(to_hex(encode(*frame)), to_hex(bytes));
        const auto message = parse(*frame);
        ASSERT_TRUE(message) << message.error().what();
        EXPECT_EQ(to_hex(encode(*message, {.sonar_node = frame->header.rx_node})), to_hex(bytes));
        ++seen;
    }
    EXPECT_EQ(seen, 22U);
}

TEST(SeanetVectors, FieldsOfKnownCommandsHaveTheValuesInTheirNames) {
    ECHOLOOP_NEED_DATA(path, "tritech/vectors.json");
    const auto all = vectors(*path);

    const auto mcgill =
        std::get<HeadCommand>(parsed(vector_of(all, "McGill 10 m/400 bins/step 32/2400..3999"))).parameters;
    EXPECT_EQ(mcgill.hd_ctrl, hd_ctrl::adc8on | hd_ctrl::cont | hd_ctrl::scanright | hd_ctrl::raw |
                                  hd_ctrl::hasmot | hd_ctrl::reply_asl);
    EXPECT_EQ(mcgill.hd_type, 0x11);
    EXPECT_EQ(mcgill.range_scale, 100);
    EXPECT_EQ(mcgill.left_limit, 2400);
    EXPECT_EQ(mcgill.right_limit, 3999);
    EXPECT_EQ(mcgill.ad_span, 255);
    EXPECT_EQ(mcgill.step_size, 32);
    EXPECT_EQ(mcgill.bins, 400);
    EXPECT_EQ(mcgill.max_ad_buffer, 500);
    EXPECT_EQ(mcgill.lockout, 100);
    EXPECT_EQ(mcgill.minor_axis_direction, 1600);
    EXPECT_EQ(mcgill.major_axis_pan, 1);
    // 10 m in 400 bins at 1500 m/s: 2 * 10 / 1500 / 400 / 640 ns = 52.08, cut or rounded up to 53 by the
    // driver
    EXPECT_EQ(mcgill.ad_interval, 53);

    const auto dual =
        std::get<HeadCommandDual>(parsed(vector_of(all, "5 m/200 bins/step 32/1..6399, V3B filled")));
    EXPECT_EQ(dual.parameters.tx_n1, 0x02999999U);
    EXPECT_EQ(dual.parameters.tx_n2, 0x05666666U);
    EXPECT_EQ(dual.parameters.range_scale, 50);
    EXPECT_EQ(dual.parameters.left_limit, 1);
    EXPECT_EQ(dual.parameters.right_limit, 6399);
    EXPECT_EQ(dual.parameters.bins, 200);
    EXPECT_EQ(dual.parameters.lockout, 919);
    EXPECT_EQ(dual.v3b.ad_span2, 0x51);
    EXPECT_EQ(dual.v3b.adv_slope2, 0x7D);

    const auto gain = std::get<HeadCommandGain>(parsed(vector_of(all, "0x1E gain (50 %"))).v3b;
    EXPECT_EQ(gain.ad_span1, 95);  // 255 * 30 / 80
    EXPECT_EQ(gain.ad_low1, 31);   // 255 * 10 / 80
    EXPECT_EQ(gain.initial_gain1, 105);

    EXPECT_TRUE(std::holds_alternative<HeadCommandReverse>(parsed(vector_of(all, "0x0F scan reverse"))));
    EXPECT_EQ(std::get<SendData>(parsed(vector_of(all, "t=0x03B064CA"))).time_ms, 0x03B064CAU);
}

TEST(SeanetVectors, ARealBBUserBlockHasTheDstMarkerAndPortSettings) {
    ECHOLOOP_NEED_DATA(path, "tritech/vectors.json");
    auto hex = vectors(*path)["bbuser_block_micron_modem"]["hex"].get<std::string>();
    hex.resize(hex.find("XX"));
    Frame frame = make_frame(BBUserData{});
    const wire::Bytes block = from_hex(hex);
    std::copy(block.begin(), block.end(), frame.payload.begin());
    const auto message = parse(frame);
    ASSERT_TRUE(message);
    const auto& bb = std::get<BBUserData>(*message);
    EXPECT_EQ(bb.surface_control, 0xFF);
    EXPECT_EQ(bb.clock, 0x1234);
    EXPECT_EQ(bb.length, 0x0040);
    EXPECT_EQ(bb.device_marker, dst_marker);
    EXPECT_EQ(bb.reserved20, 6);
    EXPECT_EQ(bb.lan_baud_low, 5);
    EXPECT_EQ(bb.lan_baud_high, 4);
    EXPECT_EQ(bb.lan_sensitivity_low, 2);
    EXPECT_EQ(bb.lan_timeout, 3);
    EXPECT_EQ(bb.a0.baud_low, 3);
    EXPECT_EQ(bb.a0.baud_high, 6);
    EXPECT_EQ(bb.a1.baud_low, 3);
    EXPECT_EQ(encode(frame)[19], 0x0F);
}

}  // namespace
}  // namespace echoloop::seanet
