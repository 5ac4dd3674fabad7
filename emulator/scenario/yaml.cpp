#include "emulator/scenario/yaml.h"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <map>
#include <sstream>

namespace echoloop::scenario {
namespace {

Place place_of(const YAML::Mark& mark) { return {mark.line + 1, mark.column + 1, -1}; }

/// Builds Values from yaml-cpp's events. A container is open from its start event to its end event.
class Builder : public YAML::EventHandler {
  public:
    explicit Builder(const YamlLimits& limits) : limits_(limits) {}

    Value take() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        leaf({.place = place_of(mark)}, anchor);
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& text) override {
        refuse_tag(mark, tag);
        const bool plain_null = tag != "!" && (text == "~" || text == "null");
        leaf({.kind = plain_null ? Value::Kind::null : Value::Kind::scalar,
              .text = text,
              .quoted = tag == "!",
              .place = place_of(mark)},
             anchor);
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        open({.kind = Value::Kind::sequence, .place = place_of(mark)}, tag, mark, anchor);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        open({.kind = Value::Kind::map, .place = place_of(mark)}, tag, mark, anchor);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapEnd() override { close(); }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const auto found = anchored_.find(anchor);
        if (found == anchored_.end()) throw YamlError{place_of(mark), "an alias to a value that contains it"};
        Value copy = found->second;
        copy.place = place_of(mark);
        charge(copy, open_.size(), copy.place);
        attach(std::move(copy), 0);
    }

  private:
    struct Open {
        Value value;
        YAML::anchor_t anchor = 0;
        std::string pending_key;
        Place key_place;
        bool has_key = false;
    };

    static void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
        if (tag.empty() || tag == "?" || tag == "!") return;
        throw YamlError{place_of(mark), "YAML tags (" + in_quotes(tag) + ") have no meaning here; remove it"};
    }

    /// Counts a value and all below it; throws when the document has grown beyond its limits.
    void charge(const Value& value, std::size_t depth, const Place& place) {
        ++values_;
        text_ += value.text.size() + value.key.size();
        if (values_ > limits_.values)
            throw YamlError{place,
                            "more than " + std::to_string(limits_.values) + " values, aliases counted"};
        if (text_ > limits_.text) throw YamlError{place, "too much text, aliases counted"};
        if (depth > limits_.depth)
            throw YamlError{place, "nested deeper than " + std::to_string(limits_.depth) + " levels"};
        for (const auto& item : value.items) charge(item, depth + 1, place);
    }

    void open(Value value, const std::string& tag, const YAML::Mark& mark, YAML::anchor_t anchor) {
        refuse_tag(mark, tag);
        charge(value, open_.size(), value.place);
        open_.push_back({std::move(value), anchor, {}, {}, false});
    }

    void close() {
        Open done = std::move(open_.back());
        open_.pop_back();
        attach(std::move(done.value), done.anchor);
    }

    void leaf(Value value, YAML::anchor_t anchor) {
        charge(value, open_.size(), value.place);
        attach(std::move(value), anchor);
    }

    void attach(Value value, YAML::anchor_t anchor) {
        if (anchor != 0) {
            charge(value, open_.size(), value.place);
            anchored_[anchor] = value;
        }
        if (open_.empty()) {
            root_ = std::move(value);
            return;
        }
        Open& parent = open_.back();
        if (parent.value.is_map() && !parent.has_key) {
            take_key(parent, value);
            return;
        }
        value.key = std::move(parent.pending_key);
        value.key_place = parent.key_place;
        parent.pending_key.clear();
        parent.has_key = false;
        parent.value.items.push_back(std::move(value));
    }

    static void take_key(Open& parent, const Value& value) {
        if (!value.is_scalar()) throw YamlError{value.place, "a key must be a word, not " + describe(value)};
        parent.pending_key = value.text;
        parent.key_place = value.place;
        parent.has_key = true;
    }

    YamlLimits limits_;
    std::size_t values_ = 0;
    std::size_t text_ = 0;
    Value root_;
    std::vector<Open> open_;
    std::map<YAML::anchor_t, Value> anchored_;
};

/// The parser says of a tab what it makes of it, which few understand.
YamlError fault_of(const std::string& text, const YAML::Exception& error) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; number <= error.mark.line + 1 && std::getline(lines, line); ++number) {
        const std::size_t tab = line.find('\t');
        if (tab != line.npos && tab == line.find_first_not_of(' '))
            return {{number, static_cast<int>(tab) + 1, -1},
                    "not YAML: the line begins with a tab; YAML is indented with spaces only"};
    }
    return {place_of(error.mark), "not YAML: " + error.msg};
}

}  // namespace

Value parse_yaml(const std::string& text, const YamlLimits& limits) {
    try {
        std::istringstream stream(text);
        YAML::Parser parser(stream);
        Builder builder(limits);
        if (!parser.HandleNextDocument(builder)) return {.place = {1, 1, -1}};
        Value first = builder.take();
        if (parser.HandleNextDocument(builder))
            throw YamlError{builder.take().place,
                            "a second document begins here; a scenario is one document"};
        return first;
    } catch (const YAML::Exception& error) {
        throw fault_of(text, error);
    }
}

}  // namespace echoloop::scenario
