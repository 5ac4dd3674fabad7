// The row of Nortek's Nucleus in the table of models.
#pragma once

#include "emulator/contract/model.h"

namespace echoloop::nortek_nucleus {

Model model();

}  // namespace echoloop::nortek_nucleus
