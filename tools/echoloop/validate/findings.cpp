#include "tools/echoloop/validate/findings.h"

#include <algorithm>
#include <cmath>

namespace echoloop::validation {

bool Quantity::passed() const {
    switch (bound) {
        case Bound::within:
            return std::abs(ours - published) <= tolerance;
        case Bound::at_most:
            return ours <= published;
        case Bound::at_least:
            return ours >= published;
    }
    return false;
}

void Findings::within(std::string name, std::string unit, double published, double tolerance, double ours) {
    quantities_.push_back(
        {id_, std::move(name), std::move(unit), source_, Bound::within, published, tolerance, ours});
}

void Findings::at_most(std::string name, std::string unit, double limit, double ours) {
    quantities_.push_back({id_, std::move(name), std::move(unit), source_, Bound::at_most, limit, 0, ours});
}

void Findings::at_least(std::string name, std::string unit, double limit, double ours) {
    quantities_.push_back({id_, std::move(name), std::move(unit), source_, Bound::at_least, limit, 0, ours});
}

std::size_t Findings::failed() const {
    return static_cast<std::size_t>(
        std::count_if(quantities_.begin(), quantities_.end(), [](const Quantity& q) { return !q.passed(); }));
}

}  // namespace echoloop::validation
