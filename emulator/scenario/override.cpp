#include "emulator/scenario/override.h"

#include <string_view>

#include "emulator/scenario/number.h"
#include "emulator/scenario/yaml.h"

namespace echoloop::scenario {
namespace {

/// Every value of the tree is at the --set argument, for the messages.
void place_all(Value& value, const Place& place) {
    value.place = place;
    value.key_place = place;
    for (auto& item : value.items) place_all(item, place);
}

Value* member(Value& map, std::string_view key, const Place& place) {
    if (Value* found = map.find(key)) return found;
    Value made;
    made.key = key;
    made.key_place = place;
    made.place = place;
    map.items.push_back(std::move(made));
    return &map.items.back();
}

std::string_view name_of(const Value& element) {
    const Value* name = element.find("name");
    return name != nullptr && name->is_scalar() ? std::string_view(name->text) : std::string_view();
}

Value* element(Value& list, std::string_view wanted, const std::string& path, const Place& place,
               Problems& problems) {
    std::vector<std::string_view> names;
    for (auto& item : list.items) {
        names.push_back(name_of(item));
        if (!wanted.empty() && names.back() == wanted) return &item;
    }
    if (const auto index = parse_as<std::size_t>(wanted)) {
        if (*index < list.items.size()) return &list.items[*index];
        problems.add(place, path + " has no element " + std::string(wanted) + "; it has " +
                                std::to_string(list.items.size()) + ", counted from 0");
        return nullptr;
    }
    problems.add(place, path + " has no element named " + in_quotes(wanted) + suggestion(wanted, names));
    return nullptr;
}

Value* step(Value& at, std::string_view key, const std::string& path, const Place& place,
            Problems& problems) {
    if (at.is_sequence()) return element(at, key, path, place, problems);
    if (at.kind == Value::Kind::null) at.kind = Value::Kind::map;
    if (at.is_map()) return member(at, key, place);
    problems.add(place, path + " is " + describe(at) + " and has no keys below it");
    return nullptr;
}

/// The value that the path names, made if need be; nullptr after adding a problem.
Value* walk(Value& root, std::string_view path, const Place& place, Problems& problems) {
    Value* at = &root;
    std::string walked;
    while (true) {
        const auto key = path.substr(0, path.find('.'));
        if (key.empty()) {
            problems.add(place, "the path has an empty part; write e.g. devices.micron.options.replies=1");
            return nullptr;
        }
        at = step(*at, key, walked.empty() ? "the scenario" : walked, place, problems);
        if (at == nullptr || key.size() == path.size()) return at;
        walked += (walked.empty() ? "" : ".") + std::string(key);
        path.remove_prefix(key.size() + 1);
    }
}

void apply(Value& root, std::string_view argument, const Place& place, Problems& problems) {
    const auto equals = argument.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        problems.add(place, "write it as path=value, e.g. --set water.temperature=4");
        return;
    }
    Value value;
    try {
        value = parse_yaml(std::string(argument.substr(equals + 1)));
    } catch (const YamlError& error) {
        problems.add(place, error.message);
        return;
    }
    Value* target = walk(root, argument.substr(0, equals), place, problems);
    if (target == nullptr) return;
    value.key = target->key;
    place_all(value, place);
    *target = std::move(value);
}

}  // namespace

void apply_overrides(Value& root, const std::vector<std::string>& set_arguments, Problems& problems) {
    for (std::size_t i = 0; i < set_arguments.size(); ++i)
        apply(root, set_arguments[i], {0, 0, static_cast<int>(i)}, problems);
}

}  // namespace echoloop::scenario
