// The rows of Water Linked's DVLs in the table of models.
#pragma once

#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::waterlinked_dvl {

std::vector<Model> models();

}  // namespace echoloop::waterlinked_dvl
