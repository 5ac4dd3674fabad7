// What is wrong with a world: the place, the reason and the remedy in one text.
#pragma once

#include <stdexcept>
#include <string>

#include "tools/import/text.h"

namespace echoloop::worlds {

class Fault : public std::runtime_error {
  public:
    Fault(const std::string& place, const std::string& reason, const std::string& remedy)
        : std::runtime_error(place + (place.empty() ? "" : ": ") + reason + "; " + remedy) {}
};

}  // namespace echoloop::worlds
