#include "tools/import/model_paths.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_uri = 4096;

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    std::erase(parts, "");
    return parts;
}

std::optional<std::string> after(const std::string& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return std::nullopt;
    return text.substr(prefix.size());
}

std::string percent_decoded(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && i + 2 < text.size() &&
                            std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
                            std::isxdigit(static_cast<unsigned char>(text[i + 2]));
        out += escape ? static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)) : text[i];
        if (escape) i += 2;
    }
    return out;
}

bool is_within(const fs::path& folder, const fs::path& file) {
    const fs::path way = file.lexically_relative(folder);
    return !way.empty() && *way.begin() != "..";
}

bool is_number(const std::string& text) {
    return !text.empty() && text.size() < 9 &&
           std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

/// The folder of the newest version below the folder of a model in a cache.
std::optional<fs::path> newest_version(const fs::path& model) {
    std::optional<fs::path> best;
    int highest = -1;
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(model, ec)) {
        const std::string name = entry.path().filename();
        if (is_number(name) && std::stoi(name) > highest) highest = std::stoi(name), best = entry.path();
    }
    return best;
}

}  // namespace

ModelPaths::ModelPaths(const fs::path& world, const std::vector<std::string>& folders,
                       std::vector<fs::path> fuel_caches)
    : caches_(std::move(fuel_caches)) {
    for (const std::string& list : folders)
        for (const std::string& folder : split(list, ':')) {
            std::error_code ec;
            const fs::path path = fs::canonical(folder, ec);
            if (ec || !fs::is_directory(path))
                throw Fault("--model-path " + printable(folder), "is no folder",
                            "name one that holds models");
            folders_.push_back(path);
        }
    folders_.push_back(fs::canonical(world).parent_path());
    for (fs::path& cache : caches_) cache = fs::canonical(cache);
}

bool ModelPaths::holds(const fs::path& file) const {
    std::error_code ec;
    const fs::path path = fs::canonical(file, ec);
    if (ec) return false;
    const auto within = [&](const fs::path& folder) { return is_within(folder, path); };
    return std::ranges::any_of(folders_, within) || std::ranges::any_of(caches_, within);
}

std::vector<fs::path> ModelPaths::in_folders(const std::string& rest) const {
    std::vector<fs::path> out;
    const std::string package = rest.substr(0, rest.find('/'));
    for (const fs::path& folder : folders_) {
        out.push_back(folder / rest);
        // A package's own folder was named, not the one above it.
        if (folder.filename() == package)
            out.push_back(rest.size() > package.size() ? folder / rest.substr(package.size() + 1) : folder);
    }
    return out;
}

/// https://fuel.gazebosim.org/1.0/OWNER/models/NAME[/VERSION][/files/...]; a cache has
/// SERVER/owner/models/name/VERSION.
std::vector<fs::path> ModelPaths::in_caches(const std::string& uri) const {
    const auto parts = split(percent_decoded(uri.substr(uri.find("://") + 3)), '/');
    if (parts.size() < 5 || parts[3] != "models") return {};
    std::size_t next = 5;
    std::string version;
    if (parts.size() > next && is_number(parts[next])) version = parts[next++];
    if (parts.size() > next && parts[next] == "tip") ++next;
    if (parts.size() > next && parts[next] == "files") ++next;
    std::vector<fs::path> out;
    for (const fs::path& cache : caches_)
        for (const char* server : {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"}) {
            const fs::path model = cache / server / lower_case(parts[2]) / "models" / lower_case(parts[4]);
            auto place = version.empty() ? newest_version(model) : std::optional(model / version);
            if (!place) continue;
            for (std::size_t i = next; i < parts.size(); ++i) *place /= parts[i];
            out.push_back(*place);
        }
    return out;
}

std::vector<fs::path> ModelPaths::candidates(const std::string& uri, const fs::path& from) const {
    for (const char* scheme : {"model://", "package://"})
        if (const auto rest = after(uri, scheme)) return in_folders(*rest);
    if (uri.starts_with("https://") || uri.starts_with("http://")) return in_caches(uri);
    const std::string path = after(uri, "file://").value_or(uri);
    if (path.find("://") != std::string::npos) return {};
    std::vector<fs::path> out{from / path};  // an absolute one as it is
    if (!fs::path(path).is_absolute())
        for (const fs::path& folder : in_folders(path)) out.push_back(folder);
    return out;
}

std::string ModelPaths::advice(const std::string& uri) const {
    if (uri.starts_with("http"))
        return "is not in Fuel's caches of this machine; fetch it: gz fuel download -u \"" +
               printable(uri.substr(0, uri.find("/files/"))) + "\"";
    const bool known = uri.find("://") == std::string::npos || uri.starts_with("model://") ||
                       uri.starts_with("package://") || uri.starts_with("file://");
    if (!known) return "is a kind of address that is not known; use model://, file:// or a path";
    std::string all;
    for (const fs::path& folder : folders_) all += (all.empty() ? "" : ", ") + folder.string();
    return "is in none of " + printable(all, 1000) + "; name its folder with --model-path";
}

fs::path ModelPaths::find(const std::string& uri, const fs::path& from, Kind kind) const {
    if (uri.size() > longest_uri) throw Missing("is an address of more than 4096 characters; shorten it");
    fs::path outside;
    for (const fs::path& candidate : candidates(uri, from)) {
        std::error_code ec;
        const fs::path path = fs::canonical(candidate, ec);
        if (ec) continue;
        if (!fs::is_regular_file(path, ec) && !(kind == Kind::folder_or_file && fs::is_directory(path, ec)))
            continue;
        if (holds(path)) return path;
        outside = path;
    }
    if (!outside.empty())
        throw Fault(printable(uri),
                    "leads to " + printable(outside.string()) + ", out of the folders of models",
                    "name that folder with --model-path if it may be read");
    throw Missing(advice(uri));
}

std::vector<fs::path> local_fuel_caches() {
    std::vector<fs::path> out;
    std::error_code ec;
    const auto add = [&](const fs::path& path) {
        if (fs::is_directory(path, ec)) out.push_back(path);
    };
    for (const char* name : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"})
        if (const char* path = std::getenv(name)) add(path);
    if (const char* home = std::getenv("HOME")) {
        add(fs::path(home) / ".gz" / "fuel");
        add(fs::path(home) / ".ignition" / "fuel");
    }
    return out;
}

std::vector<std::string> folders_of_environment() {
    std::vector<std::string> out;
    std::error_code ec;
    for (const char* name : {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"})
        if (const char* list = std::getenv(name))
            for (const std::string& folder : split(list, ':'))
                if (fs::is_directory(folder, ec))
                    out.push_back(folder);  // of many, some are usually not there
    return out;
}

}  // namespace echoloop::worlds
