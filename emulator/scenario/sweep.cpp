#include "emulator/scenario/sweep.h"

#include <algorithm>
#include <optional>

#include "emulator/scenario/file.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/override.h"
#include "emulator/scenario/section.h"
#include "emulator/scenario/variation.h"
#include "emulator/scenario/yaml.h"
#include "emulator/scenario/yaml_text.h"

namespace echoloop {
namespace {

using namespace scenario;

constexpr std::size_t most_paths = 200;
constexpr std::uint64_t most_runs = 1'000'000'000;
constexpr Range any_number{-1e12, 1e12, ""};

std::string in_words(const std::vector<std::string_view>& names) {
    std::string text;
    for (const auto name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

class Reader {
  public:
    explicit Reader(Problems& problems) : problems_(problems) {}

    void read(const Value& section_value) {
        const Section section(&section_value, "sweep", {"runs", "seed", "vary"}, problems_);
        if (!section_value.is_map()) return;
        if (section.get("runs") != nullptr) runs = read_whole(section, "runs", 1, most_runs);
        if (section.get("seed") != nullptr) seed = read_whole(section, "seed", 0, std::int64_t{1} << 62);
        const Value* vary = section.get("vary");
        if (vary == nullptr || !vary->is_map() || vary->items.size() > most_paths) {
            problems_.add(vary == nullptr ? section.place() : vary->place,
                          "sweep.vary: expected up to 200 paths and how each varies, as in "
                          "{water.temperature: {uniform: [4, 20]}}");
            return;
        }
        for (const Value& value : vary->items) read_variation(value);
        if (runs) return;
        std::uint64_t product = 1;
        for (const Variation& v : variations)
            if (v.way == Way::grid)
                product *= std::min<std::uint64_t>(v.items.size(), most_runs / product + 1);
        const bool grid = std::ranges::any_of(variations, [](const auto& v) { return v.way == Way::grid; });
        if (!grid || product > most_runs)
            problems_.add(section.place(),
                          grid ? "sweep: the grid has more than 1000000000 runs; say how many by runs"
                               : "sweep: how many runs? add e.g. runs: 1000, or a grid");
        runs = product;
    }

    std::vector<Variation> variations;
    std::optional<std::uint64_t> runs, seed;

  private:
    std::optional<std::uint64_t> read_whole(const Section& section, std::string_view key, std::int64_t least,
                                            std::int64_t most) {
        std::int64_t whole = least;
        Checker(problems_).whole(*section.get(key), section.path_of(key),
                                 {static_cast<double>(least), static_cast<double>(most), ""}, whole);
        return static_cast<std::uint64_t>(whole);
    }

    void read_variation(const Value& value) {
        const std::string path = "sweep.vary." + value.key;
        std::vector<std::string_view> names;
        for (const WayRow& row : ways) names.push_back(row.name);
        const Value* given = value.is_map() && value.items.size() == 1 ? &value.items.front() : nullptr;
        const auto row = std::ranges::find_if(
            ways, [&](const WayRow& r) { return given != nullptr && r.name == given->key; });
        if (row == ways.end()) {
            problems_.add(value.place,
                          path + ": expected one of " + in_words(names) + ", as in {uniform: [4, 20]}");
            return;
        }
        Variation v;
        v.path = value.key;
        v.place = value.key_place;
        v.way = row->way;
        const bool of_items = v.way == Way::list || v.way == Way::grid || v.way == Way::choice;
        const std::string where = path + "." + given->key;
        if (of_items ? read_items(*given, where, v) : read_bounds(*given, where, v)) {
            if (v.way == Way::sobol) v.dimension = dimensions_++;
            variations.push_back(std::move(v));
        }
    }

    bool read_items(const Value& value, const std::string& where, Variation& v) {
        if (!value.is_sequence() || value.items.empty()) {
            problems_.add(value.place, where + ": expected a list of values, as in [1, 2, 3]");
            return false;
        }
        for (const Value& item : value.items) v.items.push_back(flow_text(item));
        return true;
    }

    bool read_bounds(const Value& value, const std::string& where, Variation& v) {
        const bool normal = v.way == Way::normal;
        if (!value.is_sequence() || value.items.size() != 2) {
            problems_.add(value.place, where + (normal ? ": expected [mean, standard deviation]"
                                                       : ": expected [least, most]"));
            return false;
        }
        Checker check(problems_);
        if (!check.number(value.items[0], where + ".0", any_number, v.first) ||
            !check.number(value.items[1], where + ".1", any_number, v.second))
            return false;
        std::string fault;
        if (normal && v.second < 0) fault = "the standard deviation is negative";
        if (!normal && v.second < v.first) fault = "the least is more than the most; swap them";
        if (v.way == Way::log_uniform && !(v.first > 0)) fault = "both bounds have to be above 0";
        if (!fault.empty()) problems_.add(value.place, where + ": " + fault);
        return fault.empty();
    }

    Problems& problems_;
    std::size_t dimensions_ = 0;
};

}  // namespace

struct Sweep::Impl {
    std::filesystem::path file;
    std::string text;
    std::vector<std::string> set_arguments;
    std::span<const Model> models;
    std::uint64_t runs = 1, seed = 1;
    std::vector<Variation> variations;

    std::size_t dimensions() const {
        return static_cast<std::size_t>(
            std::ranges::count_if(variations, [](const auto& v) { return v.way == Way::sobol; }));
    }

    std::vector<std::pair<std::string, std::string>> values(std::uint64_t index) const {
        std::vector<std::pair<std::string, std::string>> all;
        std::uint64_t rest = index;  // of the grid, whose first path changes slowest
        std::vector<std::uint64_t> digits(variations.size());
        for (std::size_t i = variations.size(); i-- > 0;) {
            if (variations[i].way != Way::grid) continue;
            digits[i] = rest % variations[i].items.size();
            rest /= variations[i].items.size();
        }
        bool seeded = false;
        for (std::size_t i = 0; i < variations.size(); ++i) {
            const Variation& v = variations[i];
            seeded = seeded || v.path == "seed";
            all.emplace_back(v.path, value_of_run(v, seed, index, digits[i], dimensions()));
        }
        if (!seeded) all.emplace_back("seed", std::to_string(bits_of_run(seed, "seed", index)));
        return all;
    }

    std::vector<std::string> all_arguments(std::uint64_t index) const {
        std::vector<std::string> all = set_arguments;
        for (const auto& [path, value] : values(index)) all.push_back(path + "=" + value);
        return all;
    }
};

Sweep::Sweep(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Sweep::Sweep(Sweep&&) noexcept = default;
Sweep::~Sweep() = default;

Sweep Sweep::load(const std::filesystem::path& file, const std::vector<std::string>& set_arguments,
                  std::span<const Model> models) {
    auto impl = std::make_unique<Impl>();
    impl->file = file;
    impl->text = read_scenario_file(file);
    impl->set_arguments = set_arguments;
    impl->models = models;
    Problems problems(file.string(), set_arguments);
    Value root;
    try {
        root = parse_yaml(impl->text);
    } catch (const YamlError& error) {
        problems.add(error.place, error.message);
        problems.throw_if_any();
    }
    apply_overrides(root, set_arguments, problems);
    Reader reader(problems);
    const Value* section = root.find("sweep");
    if (section == nullptr)
        problems.add(
            root.place,
            "the scenario has no sweep; add e.g. sweep: {runs: 100, vary: {water.temperature: {uniform: "
            "[4, 20]}}}");
    else
        reader.read(*section);
    problems.throw_if_any();
    if (const Value* seed = root.find("seed"); seed != nullptr && !reader.seed)
        reader.seed = parse_as<std::uint64_t>(seed->text);
    impl->runs = reader.runs.value_or(1);
    impl->seed = reader.seed.value_or(1);
    impl->variations = std::move(reader.variations);
    Sweep sweep(std::move(impl));
    sweep.scenario(0);
    return sweep;
}

std::uint64_t Sweep::runs() const { return impl_->runs; }
std::vector<std::pair<std::string, std::string>> Sweep::values(std::uint64_t index) const {
    return impl_->values(index);
}

Scenario Sweep::scenario(std::uint64_t index) const {
    const auto arguments = impl_->all_arguments(index);
    try {
        return parse_scenario(impl_->text, impl_->file, arguments, impl_->models);
    } catch (const ScenarioError& error) {
        std::vector<Problem> problems = error.problems();
        for (Problem& problem : problems)
            for (std::size_t i = 0; i < impl_->variations.size(); ++i) {
                const Variation& v = impl_->variations[i];
                if (problem.where != "--set " + printable(arguments[impl_->set_arguments.size() + i]))
                    continue;
                problem.where = impl_->file.string() + ":" + std::to_string(v.place.line) + ":" +
                                std::to_string(v.place.column) + ": sweep.vary." + v.path + ", run " +
                                std::to_string(index);
            }
        throw ScenarioError(std::move(problems));
    }
}

std::string Sweep::resolved(std::uint64_t index) const {
    Problems problems(impl_->file.string(), {});
    Value root = parse_yaml(impl_->text);
    apply_overrides(root, impl_->all_arguments(index), problems);
    problems.throw_if_any();
    std::erase_if(root.items, [](const Value& item) { return item.key == "sweep"; });
    return block_text(root);
}

}  // namespace echoloop
