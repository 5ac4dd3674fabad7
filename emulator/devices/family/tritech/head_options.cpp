#include "emulator/devices/family/tritech/head_options.h"

#include <algorithm>
#include <iterator>

#include "emulator/devices/family/tritech/user_block.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::tritech {
namespace {

std::vector<Option> start_rows() {
    return {
        number_row("first_alive", "s", 1.0, 0.1, 30, "first mtAlive after power-up or mtReBoot",
                   specification),
        integer_row("recentring_alives", "", 3, 0, 60,
                    "mtAlives sent while re-centring; one public driver needs 2", specification),
        text_row("homing", "5D, 4D",
                 "HeadInf of the mtAlives while re-centring, in hex; the last one repeats", specification),
        flag_row("alives_while_scanning", false, "keep sending mtAlive while lines are requested",
                 specification),
        choice_row("sent_cfg_by", {"both", "head-command", "bb-user"}, "which message sets the SentCfg bit",
                   specification),
        choice_row("early_request", {"ignore", "answer-later"},
                   "mtSendData without parameters or while centring", specification),
        choice_row("short_commands", {"drop", "by-id"}, "commands that claim more bytes than they have",
                   specification),
        flag_row("refuse_while_centring", false, "drop mtHeadCommand that comes while re-centring",
                 specification),
        number_row("motor_off_after", "s", 0, 0, 3600,
                   "the motor sleeps after so long without a ping; 0: never", specification),
        number_row("motor_start", "s", 1, 0, 10, "how much later the first ping of a sleeping motor comes",
                   "a public driver's comment: up to 1 s"),
    };
}

std::vector<Option> identity_rows() {
    return {
        integer_row("software_version", "", 2, 0, 255,
                    "first byte of mtVersionData; some hosts read it as a code of the frequency",
                    "free choice"),
        integer_row("serial_number", "", 1234, 0, 65535, "in mtVersionData", "free choice"),
        integer_row("program_length", "B", 0, 0, 4294967295.0, "in mtVersionData", "free choice"),
        integer_row("program_checksum", "", 0, 0, 65535, "in mtVersionData", "free choice"),
        choice_row("user_block_form", {"264", "175"}, "size of mtBBUserData in bytes; 175 is the older form",
                   specification),
        text_row(
            "user_block", "",
            "content of mtBBUserData from byte 13 on: hex digits or a file of them; the rest stays as it is",
            specification),
        flag_row("half_duplex", false,
                 "the line is RS-485: said in mtBBUserData, one mtHeadData per mtSendData", specification),
    };
}

std::vector<Option> fpga_rows() {
    return {
        text_row("fpga_cal_data", "", "content of mtFpgaCalData: hex digits or a file of them, zeros behind",
                 specification),
        text_row("fpga_version_data", "",
                 "content of mtFpgaVersionData: hex digits or a file of them, zeros behind", specification),
    };
}

std::vector<Option> reply_rows(int replies) {
    return {
        integer_row("replies", "", replies, 1, 2, "mtHeadData per mtSendData", specification),
        choice_row("surplus_requests", {"merge", "queue"}, "mtSendData that comes while lines are under way",
                   specification),
        choice_row("head_data_byte9", {"zero", "low-byte"},
                   "byte 9 of mtHeadData: one public driver takes only zero", specification),
        integer_row("hd_ctrl_set", "", 0, 0, 65535, "bits forced to 1 in the HdCtrl of replies",
                    specification),
        integer_row("hd_ctrl_clear", "", 0, 0, 65535, "bits forced to 0 in the HdCtrl of replies",
                    specification),
        number_row("baud", "bit/s", 115200, 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced",
                   specification),
    };
}

BootRules read_boot_rules(const Options& o) {
    BootRules rules;
    rules.first_alive = number(o, "first_alive");
    rules.recentring_alives = static_cast<int>(integer(o, "recentring_alives"));
    rules.homing = hex_bytes(text(o, "homing"), "homing");
    rules.alives_while_scanning = flag(o, "alives_while_scanning");
    rules.sent_cfg_by = text(o, "sent_cfg_by");
    rules.motor_off_after = number(o, "motor_off_after");
    rules.motor_start = number(o, "motor_start");
    return rules;
}

seanet::VersionData read_version(const Options& o, std::uint8_t node) {
    seanet::VersionData version;
    version.software_version = static_cast<std::uint8_t>(integer(o, "software_version"));
    version.info_bits = 1;  // board type sonar
    version.serial_number = static_cast<std::uint16_t>(integer(o, "serial_number"));
    version.program_length = static_cast<std::uint32_t>(integer(o, "program_length"));
    version.checksum = static_cast<std::uint16_t>(integer(o, "program_checksum"));
    version.node = node;
    return version;
}

}  // namespace

void append(std::vector<Option>& all, std::vector<Option> more) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
}

std::vector<Option> head_option_rows(int replies, bool dst) {
    std::vector<Option> all = start_rows();
    append(all, identity_rows());
    if (dst) append(all, fpga_rows());
    append(all, reply_rows(replies));
    return all;
}

HeadSettings read_head_settings(const DeviceConfig& config, std::uint8_t node, bool dst) {
    const Options& o = config.options;
    HeadSettings s;
    s.node = node;
    s.dst = dst;
    s.boot = read_boot_rules(o);
    s.replies = flag(o, "half_duplex") ? 1 : static_cast<int>(integer(o, "replies"));
    s.queue_requests = text(o, "surplus_requests") == "queue";
    s.answers_early = text(o, "early_request") == "answer-later";
    s.refuse_while_centring = flag(o, "refuse_while_centring");
    if (text(o, "short_commands") == "by-id") s.frame_lengths = seanet::Framer::Lengths::by_id;
    if (text(o, "head_data_byte9") == "low-byte") s.head_data_remaining = seanet::HeadDataRemaining::low_byte;
    s.version = read_version(o, node);
    s.user_block = read_user_block(o, dst);
    if (dst) {
        put_front(s.fpga_cal.content, hex_bytes(text(o, "fpga_cal_data"), "fpga_cal_data"), "fpga_cal_data");
        put_front(s.fpga_version.content, hex_bytes(text(o, "fpga_version_data"), "fpga_version_data"),
                  "fpga_version_data");
    }
    s.hd_ctrl_set = static_cast<std::uint16_t>(integer(o, "hd_ctrl_set"));
    s.hd_ctrl_clear = static_cast<std::uint16_t>(integer(o, "hd_ctrl_clear"));
    s.line_rate = line_rate(config.endpoints, number(o, "baud"));
    return s;
}

std::uint16_t shown_hd_ctrl(std::uint16_t commanded, const HeadSettings& settings) {
    return static_cast<std::uint16_t>((commanded | settings.hd_ctrl_set) & ~settings.hd_ctrl_clear);
}

}  // namespace echoloop::tritech
