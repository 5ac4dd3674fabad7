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

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::published:
            return "published";
        case Kind::closed_form:
            return "closed form";
        case Kind::recording:
            return "recording";
        case Kind::property:
            return "property";
    }
    return "";
}

void Findings::add(Quantity quantity) {
    quantity.id = id_, quantity.source = source_, quantity.kind = kind_, quantity.required = required_;
    quantities_.push_back(std::move(quantity));
}

void Findings::within(std::string name, std::string unit, double published, double tolerance, double ours) {
    add({.name = std::move(name),
         .unit = std::move(unit),
         .bound = Bound::within,
         .published = published,
         .tolerance = tolerance,
         .ours = ours});
}

void Findings::at_most(std::string name, std::string unit, double limit, double ours) {
    add({.name = std::move(name),
         .unit = std::move(unit),
         .bound = Bound::at_most,
         .published = limit,
         .ours = ours});
}

void Findings::at_least(std::string name, std::string unit, double limit, double ours) {
    add({.name = std::move(name),
         .unit = std::move(unit),
         .bound = Bound::at_least,
         .published = limit,
         .ours = ours});
}

std::size_t Findings::failed() const {
    return static_cast<std::size_t>(std::count_if(
        quantities_.begin(), quantities_.end(), [](const Quantity& q) { return q.required && !q.passed(); }));
}

}  // namespace echoloop::validation
