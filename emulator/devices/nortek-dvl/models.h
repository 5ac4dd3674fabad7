// The rows of Nortek's DVLs in the table of models.
#pragma once

#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::nortek_dvl {

std::vector<Model> models();

}  // namespace echoloop::nortek_dvl
