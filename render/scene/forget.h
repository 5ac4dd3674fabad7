// Gives memory back before its owner ends.
#pragma once

#include <vector>

namespace echoloop {

/// `values = {}` would only empty it: that assigns a list of none and keeps the room.
template <typename T>
void forget(std::vector<T>& values) {
    std::vector<T>().swap(values);
}

}  // namespace echoloop
