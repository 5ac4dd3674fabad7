// The row of the Tritech SeaKing, SeaPrince and MiniKing in the table of models.
#pragma once

#include "emulator/contract/model.h"

namespace echoloop::seaking {

Model model();

}  // namespace echoloop::seaking
