#include "tools/echoloop/example_files.h"

#include <algorithm>
#include <fstream>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/section.h"

namespace echoloop::cli {
namespace fs = std::filesystem;
namespace {

fs::path folder_of_examples() {
    std::error_code ec;
    const fs::path program = fs::read_symlink("/proc/self/exe", ec);
    return (program.parent_path().parent_path() / "share/echoloop/examples").lexically_normal();
}

/// Of the comment that a file begins with.
std::string first_sentence(const fs::path& file) {
    std::ifstream stream(file);
    std::string text, line;
    while (std::getline(stream, line) && line.starts_with("# "))
        text += (text.empty() ? "" : " ") + line.substr(2);
    return text.substr(0, text.find(". "));
}

Example example(const fs::path& file) { return {file.stem().string(), file, first_sentence(file)}; }

std::string suggestion(const std::string& name) {
    const auto known = examples();
    std::vector<std::string_view> names;
    for (const Example& example : known) names.push_back(example.name);
    return known.empty() ? "" : scenario::suggestion(name, names);
}

}  // namespace

std::vector<Example> examples() {
    std::vector<Example> found;
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(folder_of_examples(), ec))
        if (entry.path().extension() == ".yaml") found.push_back(example(entry.path()));
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return found;
}

fs::path file_or_example(const fs::path& given) {
    std::error_code ec;
    if (given.has_extension() || given.has_parent_path() || fs::is_regular_file(given, ec)) return given;
    const fs::path file = folder_of_examples() / (given.string() + ".yaml");
    if (fs::is_regular_file(file, ec)) return file;
    if (fs::exists(given, ec)) return given;
    throw StartError(Exit::no_input, given.string() + ": no such file, and no example is called so" +
                                         suggestion(given.string()));
}

Example example_called(const std::string& name) {
    const auto known = examples();
    for (const Example& example : known)
        if (example.name == name) return example;
    if (known.empty())
        throw StartError(Exit::no_input,
                         "no examples in " + folder_of_examples().string() +
                             "; install the program again, or give a scenario file of your own");
    throw StartError(Exit::usage, "no example is called " + scenario::in_quotes(name) + suggestion(name));
}

}  // namespace echoloop::cli
