// The options that every SeaNet head has, whatever it measures: start, line, identity and user blocks. Data
// only.
#pragma once

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/tritech/boot.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"

namespace echoloop::tritech {

struct HeadSettings {
    std::uint8_t node = seanet::nodes::imaging;
    bool dst = true;  ///< DST family: its user block and the FPGA messages behind it
    BootRules boot;
    int replies = 2;              ///< mtHeadData per mtSendData
    bool queue_requests = false;  ///< else surplus requests merge into one
    bool answers_early = false;   ///< mtSendData without parameters or while centring is answered later
    bool refuse_while_centring = false;
    seanet::Framer::Lengths frame_lengths = seanet::Framer::Lengths::trusted;
    seanet::HeadDataRemaining head_data_remaining = seanet::HeadDataRemaining::zero;
    seanet::VersionData version;
    seanet::BBUserData user_block;
    seanet::FpgaCalData fpga_cal;
    seanet::FpgaVersionData fpga_version;
    std::uint16_t hd_ctrl_set = 0, hd_ctrl_clear = 0;  ///< bits forced in replies
    double line_rate = 115200;                         ///< bit/s; 0: not paced
};

inline constexpr const char* specification = "SeaNet specification notes";

/// std::invalid_argument with a sentence for the user if a text is no hex. What is left to the endpoints: the
/// line rate of a real serial port.
void describe(HeadSettings& settings, OptionList& options);

/// "5D, 4D" or the name of a file with such text: bytes. Anything after # in a line of a file is a comment.
/// std::invalid_argument naming `option` if it is neither.
std::vector<std::uint8_t> hex_bytes(const std::string& text, const std::string& option);

/// HdCtrl as replies show it: the command's, with the bits that options force.
std::uint16_t shown_hd_ctrl(std::uint16_t commanded, const HeadSettings& settings);

}  // namespace echoloop::tritech
