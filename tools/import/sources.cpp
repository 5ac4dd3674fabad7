#include "tools/import/sources.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "tools/import/fault.h"
#include "tools/import/xml.h"

namespace echoloop::worlds {
namespace fs = std::filesystem;
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t include_depth = 32;
constexpr std::size_t most_includes = 20'000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;

/// Nothing that a sonar hears, and nothing that is needed to find out where things are.
const std::set<std::string> dropped{"collision",    "sensor",
                                    "plugin",       "light",
                                    "gui",          "scene",
                                    "physics",      "state",
                                    "audio_sink",   "audio_source",
                                    "projector",    "battery",
                                    "atmosphere",   "particle_emitter",
                                    "wind",         "transmission",
                                    "gazebo",       "magnetic_field",
                                    "self_collide", "enable_wind",
                                    "gravity"};
/// They show something in Gazebo, but libsdformat does not read them.
const std::set<std::string> told{"actor", "population", "road"};
const std::set<std::string> shapes{"box",   "cylinder", "sphere",    "capsule", "ellipsoid",
                                   "plane", "mesh",     "heightmap", "empty"};

class Collector {
  public:
    Collector(const ModelPaths& paths, const fs::path& scratch, bool allow_missing)
        : paths_(paths), scratch_(scratch), allow_missing_(allow_missing) {}

    Sources collect(const fs::path& world) {
        const Copy& copy = copy_of(fs::canonical(world));
        out_.world = copy.file;
        out_.is_urdf = copy.is_urdf;
        if (!allow_missing_ && !out_.left_out.empty()) refuse_missing();
        return std::move(out_);
    }

  private:
    struct Copy {
        fs::path file;
        bool is_urdf = false;
        std::size_t includes = 1;  ///< itself, and all that come with it
    };

    [[noreturn]] void refuse_missing() const {
        std::string all;
        for (const std::string& line : out_.left_out) all += line + "\n";
        throw Fault("", all + std::to_string(out_.left_out.size()) + " things of the world cannot be had",
                    "or leave them out with --allow-missing");
    }

    const Copy& copy_of(const fs::path& file) {
        if (const auto known = copies_.find(file); known != copies_.end()) return known->second;
        refuse_cycle(file);
        if (fs::file_size(file) > most_bytes)
            throw Fault(printable(file.string()), "is larger than 64 MiB",
                        "split it, and put meshes into files of their own");
        stack_.push_back(file);
        tinyxml2::XMLDocument document;
        if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS)
            throw Fault(printable(file.string()) + ":" + std::to_string(document.ErrorLineNum()),
                        std::string("is no XML: ") + printable(document.ErrorStr()),
                        "export it again; files of xacro and erb are made into XML by their programs first");
        Copy copy = edit(file, document);
        const fs::path folder = scratch_ / std::to_string(next_folder_++);
        fs::create_directory(folder);
        copy.file = folder / "model.sdf";
        if (document.SaveFile(copy.file.c_str()) != tinyxml2::XML_SUCCESS)
            throw Fault(folder.string(), "cannot be written", "make room on this disk");
        std::ofstream(folder / "model.config")
            << "<?xml version=\"1.0\"?><model><name>m</name><sdf version=\"1.9\">model.sdf</sdf></model>\n";
        out_.originals[folder.string()] = file.string();
        stack_.pop_back();
        return copies_.emplace(file, std::move(copy)).first->second;
    }

    void refuse_cycle(const fs::path& file) const {
        const auto found = std::ranges::find(stack_, file);
        if (found == stack_.end()) {
            if (stack_.size() < include_depth) return;
            throw Fault(printable(file.string()), "is included over more than 32 files",
                        "include it nearer to the world");
        }
        std::string way;
        for (auto i = found; i != stack_.end(); ++i) way += printable(i->string()) + " includes ";
        throw Fault(way + printable(file.string()), "a model cannot hold itself",
                    "remove one of these includes");
    }

    Copy edit(const fs::path& file, tinyxml2::XMLDocument& document) {
        Copy copy;
        XMLElement* root = document.RootElement();
        const std::string kind = root ? root->Name() : "";
        if (kind != "sdf" && kind != "robot")
            throw Fault(printable(file.string()),
                        "is neither SDF nor URDF: its root is <" + printable(kind, 64) + ">",
                        "name an .sdf, .world or .urdf file");
        copy.is_urdf = kind == "robot";
        if (!copy.is_urdf) set_version(file, *root);
        file_ = file, current_ = &copy;
        edit_children(*root);
        if (copy.is_urdf) keep_fixed_joints(*root);
        if (copy.includes > most_includes)
            throw Fault(printable(file.string()), "includes more than 20,000 models", "split the world");
        return copy;
    }

    /// What is newer than libsdformat is read as the newest that it knows.
    void set_version(const fs::path& file, XMLElement& root) {
        const char* version = root.Attribute("version");
        const std::string text = version ? version : "";
        const auto dot = text.find('.');
        if (!text.starts_with("1.") || text.size() < 3 || dot == std::string::npos)
            return;  // libsdformat says why
        if (std::atoi(text.c_str() + 2) <= 9) return;
        root.SetAttribute("version", "1.9");
        note(printable(file.string()) + ": SDF " + printable(text, 16) + " is read as 1.9");
    }

    void note(const std::string& text) {
        if (std::ranges::find(out_.notes, text) == out_.notes.end()) out_.notes.push_back(text);
    }

    void edit_children(XMLElement& element) {
        for (XMLElement* child = element.FirstChildElement(); child;) {
            XMLElement* next = child->NextSiblingElement();
            if (!edit_element(*child)) element.DeleteChild(child);
            child = next;
        }
    }

    /// False: to be removed.
    bool edit_element(XMLElement& element) {
        const std::string name = element.Name();
        if (name == "sensor" || name == "plugin" || name == "gazebo") leave_trace(element);
        if (told.contains(name)) {
            note(place_of(file_, element) + ": <" + name +
                 "> is left out; put what it shows into the world as models");
            return false;
        }
        if (dropped.contains(name) || (name == "inertial" && !current_->is_urdf))
            return name == "plugin" && is_trace(element);
        if (name == "pose") check_pose(file_, element);
        if (name == "include") return edit_include(element);
        if (name == "visual") return edit_visual(element);
        if (name == "link" && current_->is_urdf) add_inertia(element);
        edit_children(element);
        return true;
    }

    /// The file of a folder of a model: of those that its model.config names the newest that can be read.
    fs::path model_file(const fs::path& folder) const {
        tinyxml2::XMLDocument config;
        std::string best = "model.sdf";
        int newest = -1;
        const XMLElement* model = config.LoadFile((folder / "model.config").c_str()) == tinyxml2::XML_SUCCESS
                                      ? config.FirstChildElement("model")
                                      : nullptr;
        if (model)
            for (auto* sdf = model->FirstChildElement("sdf"); sdf; sdf = sdf->NextSiblingElement("sdf")) {
                const std::string version = sdf->Attribute("version") ? sdf->Attribute("version") : "1.0";
                const int minor = version.size() > 2 ? std::atoi(version.c_str() + 2) : 0;
                if (minor > newest) newest = minor, best = text_of(sdf);
            }
        return paths_.find(best, folder, ModelPaths::Kind::file);
    }

    /// Gazebo's light, which almost every world includes.
    static bool is_sun(const std::string& uri) {
        const std::string name = lower_case(uri.substr(uri.rfind('/') + 1));
        return name == "sun";
    }

    bool edit_include(XMLElement& include) {
        XMLElement* uri = include.FirstChildElement("uri");
        const std::string text = text_of(uri);
        const std::string place = place_of(file_, include);
        if (is_sun(text)) return false;
        if (text.empty()) throw Fault(place, "<include> without a <uri>", "say what to include");
        const fs::path from = file_;
        Copy* const current = current_;
        try {
            fs::path model = paths_.find(text, file_.parent_path(), ModelPaths::Kind::folder_or_file);
            if (fs::is_directory(model)) model = model_file(model);
            const Copy& copy = copy_of(model);
            uri->SetText(copy.file.parent_path().c_str());
            current->includes = std::min(most_includes + 1, current->includes + copy.includes);
        } catch (const Missing& missing) {
            out_.left_out.push_back(place + ": model " + printable(text) + " " + missing.what());
            return false;
        }
        file_ = from, current_ = current;
        edit_children(include);
        return true;
    }

    bool edit_visual(XMLElement& visual) {
        XMLElement* geometry = visual.FirstChildElement("geometry");
        if (!geometry) return true;
        for (XMLElement* shape = geometry->FirstChildElement(); shape; shape = shape->NextSiblingElement()) {
            if (std::string_view(shape->Name()).find(':') != std::string_view::npos) continue;
            try {
                if (auto drawn = drawn_shape(file_, *shape)) {
                    put_drawn(*geometry, std::move(*drawn));
                    return true;
                }
            } catch (const Fault& fault) {
                out_.left_out.emplace_back(fault.what());
                return false;
            }
            if (!shapes.contains(shape->Name())) {
                out_.left_out.push_back(place_of(file_, *shape) + ": <" + printable(shape->Name(), 64) +
                                        "> is a geometry that is not known; make a mesh of it");
                return false;
            }
            if (!edit_file(*shape)) return false;
        }
        return true;
    }

    void put_drawn(XMLElement& geometry, Shape shape) {
        geometry.DeleteChildren();
        const std::string address = drawn_address + std::to_string(out_.drawn.size());
        geometry.InsertNewChildElement("mesh")->InsertNewChildElement("uri")->SetText(address.c_str());
        out_.drawn.push_back(std::move(shape));
    }

    /// Of a mesh or a heightmap.
    bool edit_file(XMLElement& shape) {
        const std::string name = shape.Name();
        if (name != "mesh" && name != "heightmap") return true;
        XMLElement* uri = shape.FirstChildElement("uri");
        const char* attribute = shape.Attribute("filename");  // URDF's
        const std::string text = attribute ? trimmed(attribute) : text_of(uri);
        const std::string place = place_of(file_, shape);
        try {
            if (text.empty()) throw Missing("is not named; give its <uri>");
            if (text.starts_with("unit_")) return true;  // one of Gazebo's own
            const fs::path found = paths_.find(text, file_.parent_path(), ModelPaths::Kind::file);
            if (uri)
                uri->SetText(found.c_str());
            else
                shape.SetAttribute("filename", found.c_str());
        } catch (const Missing& missing) {
            out_.left_out.push_back(place + ": " + name + " " + printable(text) + " " + missing.what());
            return false;
        }
        return true;
    }

    const ModelPaths& paths_;
    const fs::path& scratch_;
    const bool allow_missing_;
    Sources out_;
    std::size_t next_folder_ = 0;
    std::map<fs::path, Copy> copies_;
    std::vector<fs::path> stack_;
    fs::path file_;            ///< that is being edited
    Copy* current_ = nullptr;  ///< its copy
};

}  // namespace

Sources collect_sources(const fs::path& world, const ModelPaths& paths, const fs::path& scratch,
                        bool allow_missing) {
    return Collector(paths, scratch, allow_missing).collect(world);
}

}  // namespace echoloop::worlds
