// Sound speed texts for a sounder. The whole example and its checksum are the specification notes'; forms and
// bounds are theirs, too.
#include "protocols/kmall/codec.h"
#include "protocols/kmall/sound_text.h"
#include "tests/protocols/data.h"

namespace echoloop::kmall {
namespace {

const std::string example =
    "$MVS01,00000,0003,221320,14,11,2023,0.00,1500.0,10.00,35.00,\r\n10.00,1498.0,9.50,35.00,\r\n"
    "12000.00,1700.0,2.00,34.70,\r\n5924.00,N,1030.00,E,0.0,,Source: echoloop,*57\\\r\n";

/// With its right checksum.
std::string text(const std::string& format, const std::string& count, const std::string& samples) {
    const std::string body =
        "XX" + format + ",00000," + count + ",221320,14,11,2023," + samples + "5924.00,S,01030.00,W,0.0,,me,";
    unsigned sum = 0;
    for (const char c : body) sum ^= static_cast<unsigned char>(c);
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02X", sum);
    return "$" + body + '*' + digits + "\\\r\n";
}

TEST(KmallSoundText, TheExampleIsRead) {
    const auto datagram = parse(wire::Bytes(example.begin(), example.end()));
    ASSERT_TRUE(datagram);
    EXPECT_EQ(name_of(*datagram), "S01");
    EXPECT_EQ(serialise(*datagram), wire::Bytes(example.begin(), example.end()));
    const auto reading = read_sound_text(std::get<SoundText>(*datagram));
    ASSERT_TRUE(reading) << reading.error().what();
    EXPECT_EQ(reading->seconds, 1700000000U);
    EXPECT_NEAR(*reading->latitude, 59.4, 1e-9);
    EXPECT_NEAR(*reading->longitude, 10.5, 1e-9);
    ASSERT_EQ(reading->samples.size(), 3U);
    EXPECT_EQ(reading->samples[1], (SoundSample{10, 1498, 9.5, 35}));
}

TEST(KmallSoundText, FormsSayWhatTheyHold) {
    const auto plain = read_sound_text({text("S00", "0002", "0.00,1500.0,,,\r\n20.00,1490.0,,,\r\n")});
    ASSERT_TRUE(plain) << plain.error().what();
    EXPECT_EQ(plain->samples[1], (SoundSample{20, 1490, {}, {}}));
    EXPECT_NEAR(*plain->latitude, -59.4, 1e-9);
    EXPECT_NEAR(*plain->longitude, -10.5, 1e-9);
    const auto measured = read_sound_text({text("S02", "0001", "\r\n0.00,,10.0,35.0,\r\n")});
    ASSERT_TRUE(measured) << measured.error().what();
    EXPECT_EQ(measured->samples[0], (SoundSample{0, {}, 10, 35}));
    EXPECT_TRUE(read_sound_text({text("S12", "0001", "0.00,1500,10.0,35.0,\r\n")}));
}

TEST(KmallSoundText, WhatIsWrongIsRefusedWhole) {
    std::string lower = example, wrong = example;
    lower[lower.rfind('*') + 1] = '6';
    EXPECT_FALSE(read_sound_text({lower})) << "another checksum";
    EXPECT_FALSE(read_sound_text({text("S11", "0001", "0.00,1500,10.0,35.0,\r\n")})) << "unknown form";
    EXPECT_FALSE(read_sound_text({text("S00", "0003", "0.00,1500.0,,,\r\n20.00,1490.0,,,\r\n")})) << "count";
    EXPECT_FALSE(read_sound_text({text("S00", "0000", "")}));
    EXPECT_FALSE(read_sound_text({text("S00", "0002", "20.00,1500.0,,,\r\n20.00,1490.0,,,\r\n")}))
        << "depths";
    EXPECT_FALSE(read_sound_text({text("S00", "0001", "0.00,150.0,,,\r\n")})) << "no water";
    EXPECT_FALSE(read_sound_text({text("S00", "0001", "12001,1500.0,,,\r\n")})) << "too deep";
    EXPECT_FALSE(read_sound_text({text("S00", "0001", "nan,1500.0,,,\r\n")}));
    EXPECT_FALSE(read_sound_text({text("S02", "0001", "0.00,1500.0,,,\r\n")})) << "nothing measured";
    for (std::size_t size = 0; size < example.size() - 4; ++size)
        EXPECT_FALSE(read_sound_text({example.substr(0, size)})) << size;
}

}  // namespace
}  // namespace echoloop::kmall
