// What `echoloop inspect` and the documentation are made from.
#include "protocols/inspect.h"

#include <gtest/gtest.h>

#include "protocols/r2sonic/codec.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/layouts.h"
#include "protocols/wire/print.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::inspect {
namespace {

const Field* field_of(const Message& message, const std::string& name) {
    for (const Field& field : message.fields) {
        if (field.name == name) return &field;
    }
    return nullptr;
}

void append(wire::Bytes& to, const wire::Bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

TEST(Inspect, FindsBothDirectionsAndTheNoiseBetween) {
    wire::Bytes stream{'@', 'x', '\n'};
    append(stream, seanet::encode(seanet::Message(seanet::SendData{5})));
    append(stream, {0, 1, '@', '@'});
    append(stream, seanet::encode(seanet::Message(seanet::Alive{.motor_position = 3200})));
    append(stream, {'@', '0', '0'});
    const auto messages = find_family("seanet")->decode(stream);
    ASSERT_EQ(messages.size(), 5U);
    EXPECT_EQ(messages[0].size, 3U);
    EXPECT_EQ(messages[0].reason, "no complete frame");
    EXPECT_EQ(messages[1].name, "SendData");
    EXPECT_EQ(messages[2].size, 4U);
    EXPECT_EQ(messages[3].name, "Alive");
    EXPECT_EQ(messages[3].offset, 3U + 18 + 4);
    EXPECT_EQ(messages[4].size, 3U);
    const Field* position = field_of(messages[3], "motor_position");
    ASSERT_NE(position, nullptr);
    EXPECT_EQ(position->number, 3200.0);
    EXPECT_EQ(position->unit, "1/16 grad");
    EXPECT_EQ(position->offset, 25U + 18);
    EXPECT_EQ(position->size, 2U);
    EXPECT_EQ(stream[position->offset], 0x80);
}

TEST(Inspect, AFrameThatCannotBeReadSaysWhyAndShowsItsHeader) {
    seanet::Frame frame;
    frame.header.id = seanet::Id::spect_data;
    frame.payload = {1, 2, 3};
    const auto messages = find_family("seanet")->decode(seanet::encode(frame));
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].name, "SpectData");
    EXPECT_EQ(messages[0].reason, "Frame.id at byte 10: no layout for this message");
    EXPECT_NE(field_of(messages[0], "id"), nullptr);
}

TEST(Inspect, ACutFrameHidesNoLaterOne) {
    wire::Bytes stream = seanet::encode(seanet::Message(seanet::HeadData{.bins = wire::Bytes(300)}));
    stream.resize(100);
    append(stream, seanet::encode(seanet::Message(seanet::ReBoot{})));
    const auto messages = find_family("seanet")->decode(stream);
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0].size, 100U);
    EXPECT_EQ(messages[1].name, "ReBoot");
}

TEST(Inspect, FieldsOfARealDatagramLieInOrderAndWithinIt) {
    ECHOLOOP_NEED_DATA(path, "r2sonic/r2sonic_bth0_20.pcap");
    const wire::Bytes bytes = read_pcap(*path).at(0);
    const auto message = find_family("r2sonic")->decode(bytes).at(0);
    std::size_t end = 0;
    for (const Field& field : message.fields) {
        EXPECT_GE(field.offset, end) << field.name;
        end = field.offset + field.size;
    }
    EXPECT_EQ(end, bytes.size());
    EXPECT_EQ(field_of(message, "r0.r")->offset, 136U);
    EXPECT_EQ(field_of(message, "r0.r")->numbers.size(), 256U);
    EXPECT_EQ(field_of(message, "i1.scale")->offset, 1196U + 4);
    EXPECT_EQ(field_of(message, "q0.flags")->offset, 1732U + 4);
    EXPECT_EQ(field_of(message, "h0.points")->offset, 12U + 114);
}

TEST(Inspect, SettingsAreReadByTheirNames) {
    using r2sonic::Command;
    r2sonic::Cmd0 packet{{Command::f32("ABS2", 80.5F), Command::u32("ENM0", 1), Command::u32("PTS0", 4100),
                          Command::u32("A\x1b\n0", 9)}};
    const auto message = find_family("r2sonic")->decode(r2sonic::serialise(packet)).at(0);
    EXPECT_EQ(field_of(message, "ABS2")->text, "80.5");
    EXPECT_EQ(field_of(message, "ABS2")->unit, "dB/km");
    EXPECT_EQ(field_of(message, "ENM0")->text, "1");
    EXPECT_EQ(field_of(message, "PTS0")->text, "4100");
    EXPECT_NE(field_of(message, "A\\x1b\\x0a0"), nullptr) << "control characters must not reach a terminal";
}

TEST(Inspect, GuessesOnlyWhatItIsSureOf) {
    EXPECT_EQ(guess_family({}), nullptr);
    EXPECT_EQ(guess_family(from_hex("40 30 30 31 30 10 00")), nullptr);
    EXPECT_EQ(guess_family(from_hex("24 47 50 47 47 41 2C")), nullptr);
    wire::Bytes noisy(5000, '@');
    append(noisy, seanet::encode(seanet::Message(seanet::ReBoot{})));
    EXPECT_EQ(guess_family(noisy), find_family("seanet"));
    EXPECT_EQ(find_family("nobody"), nullptr);
}

TEST(Describe, SaysNodesSizeAndFieldsOnOneLine) {
    const auto text = seanet::describe(seanet::make_frame(seanet::Alive{.time_ms = 5000}));
    EXPECT_EQ(text,
              "Alive 2->255, 22 bytes: will_send 0x00, time_ms 5000 ms, motor_position 0 x 1/16 grad, "
              "head_inf 0x00");
    EXPECT_EQ(seanet::describe(seanet::make_frame(seanet::ReBoot{})), "ReBoot 255->2, 14 bytes: no fields");
}

TEST(Print, ShowsOffsetsNamesValuesAndUnits) {
    EXPECT_EQ(wire::print(seanet::SendData{7}), "SendData\n    13  time_ms 7 ms\n");
}

TEST(Markdown, EveryTableHasARowPerFieldWithItsOffset) {
    const std::string text = markdown_tables(*find_family("seanet"));
    EXPECT_NE(text.find("| 40 | u16 | `bearing` | 1/16 grad |"), std::string::npos);
    EXPECT_NE(text.find("| 44 | u8[bins] | `bins` |"), std::string::npos);
    EXPECT_NE(text.find("| 0 | u8 | `start` |"), std::string::npos);
    const std::string multibeam = markdown_tables(*find_family("r2sonic"));
    EXPECT_NE(multibeam.find("| 114 | u16 | `points` |"), std::string::npos);
    EXPECT_NE(multibeam.find("| 36 | u8[beams * bins] | `data` |"), std::string::npos);
    EXPECT_NE(multibeam.find("| 4 | u32[ceil(points / 8)] | `flags` |"), std::string::npos);
    EXPECT_NE(multibeam.find("|  | f32 | `RNG0` | m |"), std::string::npos);
}

TEST(Tables, OffsetsAreThoseOfTheSpecifications) {
    const auto offset_of = [](const wire::Table& table, std::string_view name) {
        for (const auto& row : table.rows) {
            if (row.meta.name == name) return row.offset.value_or(99999);
        }
        return std::size_t{99999};
    };
    const auto head = wire::table_of<seanet::HeadParameters>();
    EXPECT_EQ(offset_of(head, "tx_pulse"), 33U);
    EXPECT_EQ(offset_of(head, "ad_interval"), 51U);
    EXPECT_EQ(offset_of(head, "scan_z"), 63U);
    const auto bb = wire::table_of<seanet::BBUserData>();
    EXPECT_EQ(offset_of(bb, "device_marker"), 19U);
    EXPECT_EQ(offset_of(bb, "a1"), 47U);
    EXPECT_EQ(offset_of(bb, "half_duplex"), 99U);
    EXPECT_EQ(offset_of(bb, "half_duplex_dst"), 146U);
}

TEST(Tables, EveryTableThatAFieldNamesExists) {
    for (const Family& family : families()) {
        std::vector<std::string> names;
        for (const auto& table : family.tables()) names.push_back(table.name);
        for (const auto& table : family.tables()) {
            for (const auto& row : table.rows) {
                for (const auto& name : row.tables) {
                    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace echoloop::inspect
