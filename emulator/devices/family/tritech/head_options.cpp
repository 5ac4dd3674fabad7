#include "emulator/devices/family/tritech/head_options.h"

#include "emulator/devices/family/tritech/user_block.h"

namespace echoloop::tritech {
namespace {

void describe_boot(BootRules& r, OptionList& o) {
    o.number(r.first_alive, "first_alive", "s", 0.1, 30, "first mtAlive after power-up or mtReBoot",
             specification);
    o.whole(r.recentring_alives, "recentring_alives", "", 0, 60,
            "mtAlives sent while re-centring; one public driver needs 2", specification);
    std::string homing = "5D, 4D";
    o.text(homing, "homing", "HeadInf of the mtAlives while re-centring, in hex; the last one repeats",
           specification);
    r.homing = hex_bytes(homing, "homing");
    o.flag(r.alives_while_scanning, "alives_while_scanning", "keep sending mtAlive while lines are requested",
           specification);
    o.choice(r.sent_cfg_by, "sent_cfg_by", {"both", "head-command", "bb-user"},
             "which message sets the SentCfg bit", specification);
}

void describe_start(HeadSettings& s, OptionList& o) {
    describe_boot(s.boot, o);
    o.choice(s.answers_early, "early_request", {"ignore", "answer-later"},
             "mtSendData without parameters or while centring", specification);
    o.choice(s.frame_lengths, "short_commands", {"drop", "by-id"},
             "commands that claim more bytes than they have", specification);
    o.flag(s.refuse_while_centring, "refuse_while_centring",
           "drop an mtHeadCommand that arrives while re-centring", specification);
    o.number(s.boot.motor_off_after, "motor_off_after", "s", 0, 3600,
             "the motor sleeps after this long without a ping; 0: never", specification);
    o.number(s.boot.motor_start, "motor_start", "s", 0, 10,
             "extra delay of the first ping after the motor has slept",
             "a public driver's comment: up to 1 s");
}

void describe_version(seanet::VersionData& v, OptionList& o) {
    v.info_bits = 1;  // board type sonar
    v.software_version = 2;
    v.serial_number = 21086;
    o.whole(v.software_version, "software_version", "", 0, 255,
            "first byte of mtVersionData; some hosts read it as a code of the frequency", "free choice");
    o.whole(v.serial_number, "serial_number", "", 0, 65535, "in mtVersionData",
            "free choice: five digits, as many as the word has room for");
    o.whole(v.program_length, "program_length", "B", 0, 4294967295.0, "in mtVersionData", "free choice");
    o.whole(v.checksum, "program_checksum", "", 0, 65535, "in mtVersionData", "free choice");
}

void describe_user_block(HeadSettings& s, bool& half_duplex, OptionList& o) {
    bool older = false;
    std::string content;
    o.choice(older, "user_block_form", {"264", "175"}, "size of mtBBUserData in bytes; 175 is the older form",
             specification);
    o.text(content, "user_block",
           "content of mtBBUserData from byte 13 on: hex digits or a file of them; the rest stays as it is",
           specification);
    o.flag(half_duplex, "half_duplex",
           "the line is RS-485: mtBBUserData says so, and there is one mtHeadData for each mtSendData",
           specification);
    s.user_block = make_user_block(s.dst, half_duplex, older, content);
}

/// What stands in front of a message's content, and zeros behind.
void describe_content(std::span<std::uint8_t> content, std::string_view name, std::string_view help,
                      OptionList& o) {
    std::string front;
    o.text(front, name, help, specification);
    put_front(content, hex_bytes(front, std::string(name)), std::string(name));
}

void describe_replies(HeadSettings& s, OptionList& o) {
    o.whole(s.replies, "replies", "", 1, 2, "mtHeadData per mtSendData", specification);
    o.choice(s.queue_requests, "surplus_requests", {"merge", "queue"},
             "what to do with mtSendData while lines are under way", specification);
    o.choice(s.head_data_remaining, "head_data_byte9", {"zero", "low-byte"},
             "byte 9 of mtHeadData: one public driver takes only zero", specification);
    o.whole(s.hd_ctrl_set, "hd_ctrl_set", "", 0, 65535, "bits forced to 1 in the HdCtrl of replies",
            specification);
    o.whole(s.hd_ctrl_clear, "hd_ctrl_clear", "", 0, 65535, "bits forced to 0 in the HdCtrl of replies",
            specification);
    o.number(s.line_rate, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced",
             specification);
}

}  // namespace

void describe(HeadSettings& s, OptionList& o) {
    bool half_duplex = false;
    describe_start(s, o);
    describe_version(s.version, o);
    describe_user_block(s, half_duplex, o);
    if (s.dst) {
        describe_content(s.fpga_cal.content, "fpga_cal_data",
                         "content of mtFpgaCalData: hex digits or a file of them, padded with zeros", o);
        describe_content(s.fpga_version.content, "fpga_version_data",
                         "content of mtFpgaVersionData: hex digits or a file of them, padded with zeros", o);
    }
    describe_replies(s, o);
    if (half_duplex) s.replies = 1;
}

std::uint16_t shown_hd_ctrl(std::uint16_t commanded, const HeadSettings& settings) {
    return static_cast<std::uint16_t>((commanded | settings.hd_ctrl_set) & ~settings.hd_ctrl_clear);
}

}  // namespace echoloop::tritech
