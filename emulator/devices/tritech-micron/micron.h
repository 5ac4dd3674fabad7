// The row of the Tritech Micron DST in the table of models.
#pragma once

#include "emulator/contract/model.h"

namespace echoloop::micron {

Model model();

}  // namespace echoloop::micron
