#include "render/scene/json_view.h"

#include <cmath>

#include "render/scene/fault.h"

namespace echoloop {

void JsonView::expect(bool good, const std::string& what) const {
    if (!good) scene_fault(place_, "must be " + what, "correct the value or export the scene again");
}

std::optional<JsonView> JsonView::find(const char* key) const {
    expect(value_->is_object(), "an object");
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return JsonView(*found, place_.empty() ? key : place_ + "." + key);
}

JsonView JsonView::need(const char* key) const {
    auto member = find(key);
    if (!member) scene_fault(place_ + "." + key, "is missing", export_again);
    return *member;
}

std::vector<JsonView> JsonView::elements(std::size_t most) const {
    expect(value_->is_array(), "an array");
    expect(value_->size() <= most, "an array of at most " + std::to_string(most) + " elements");
    std::vector<JsonView> out;
    out.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i)
        out.emplace_back((*value_)[i], place_ + "[" + std::to_string(i) + "]");
    return out;
}

std::vector<JsonView> JsonView::elements_of(const char* key, std::size_t most) const {
    const auto member = find(key);
    return member ? member->elements(most) : std::vector<JsonView>{};
}

std::uint64_t JsonView::integer(std::uint64_t least, std::uint64_t most) const {
    const bool good = value_->is_number_unsigned() && value_->get<std::uint64_t>() >= least &&
                      value_->get<std::uint64_t>() <= most;
    expect(good, "an integer within " + std::to_string(least) + ".." + std::to_string(most));
    return value_->get<std::uint64_t>();
}

std::uint64_t JsonView::index(std::size_t count, const char* what) const {
    const bool good = value_->is_number_unsigned() && value_->get<std::uint64_t>() < count;
    expect(good, "an index into the " + std::to_string(count) + " " + what);
    return value_->get<std::uint64_t>();
}

double JsonView::number() const {
    expect(value_->is_number() && std::isfinite(value_->get<double>()), "a finite number");
    return value_->get<double>();
}

bool JsonView::boolean() const {
    expect(value_->is_boolean(), "true or false");
    return value_->get<bool>();
}

const std::string& JsonView::text() const {
    expect(value_->is_string(), "a string");
    return value_->get_ref<const std::string&>();
}

std::vector<double> JsonView::numbers(std::size_t count) const {
    expect(value_->is_array() && value_->size() == count,
           "an array of " + std::to_string(count) + " numbers");
    std::vector<double> out;
    for (const auto& element : elements(count)) out.push_back(element.number());
    return out;
}

}  // namespace echoloop
