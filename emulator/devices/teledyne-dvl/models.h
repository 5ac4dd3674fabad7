// The rows of Teledyne's DVLs in the table of models.
#pragma once

#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::teledyne_dvl {

std::vector<Model> models();

}  // namespace echoloop::teledyne_dvl
