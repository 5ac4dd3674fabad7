#include "tools/import/sdf_world.h"

#include <sdf/sdf.hh>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "tools/import/fault.h"
#include "tools/import/materials.h"
#include "tools/import/meshes.h"
#include "tools/import/shapes.h"
#include "tools/import/xml.h"

namespace echoloop::worlds {
namespace {

Pose pose(const ignition::math::Pose3d& p) {
    return {{p.Pos().X(), p.Pos().Y(), p.Pos().Z()}, {p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()}};
}

class Converter {
  public:
    Converter(const Sources& sources, const ModelPaths& paths, SdfChoices& choices, World& world,
              Report& report, Stage& stage, const Told& told)
        : sources_(sources),
          choices_(choices),
          world_(world),
          report_(report),
          stage_(stage),
          told_(told),
          shapes_(sources, paths, report.notes),
          meshes_(world, report, choices.rules) {}

    void convert() {
        ::unsetenv("SDF_PATH");  // libsdformat looks there by itself
        sdf::Console::Instance()->SetQuiet(true);
        stage_.set(original(sources_.world.string()));
        sdf::Root root;
        check(root.Load(sources_.world));
        shapes_all_ = shapes_of(root);
        if (root.WorldCount() > 0) {
            if (root.WorldCount() > 1) report_.notes.push_back("only the first of the file's worlds is read");
            add_world(*root.WorldByIndex(0));
        } else if (root.Model() != nullptr) {
            add_model(*root.Model(), "", pose(root.Model()->RawPose()), std::nullopt);
        }
        for (const auto& [option, names] :
             {std::pair("--without ", &choices_.without), std::pair("--keep ", &choices_.keep)})
            for (const std::string& name : *names)
                if (!is_asked_for(seen_, name))
                    throw Fault(option + printable(name, 64), "no model has this name",
                                "use one of " + all_seen());
    }

  private:
    using Place = std::optional<std::size_t>;  ///< node above

    static std::size_t shapes_of(const sdf::Model& model) {
        std::size_t count = 0;
        for (std::uint64_t i = 0; i < model.LinkCount(); ++i) count += model.LinkByIndex(i)->VisualCount();
        for (std::uint64_t i = 0; i < model.ModelCount(); ++i) count += shapes_of(*model.ModelByIndex(i));
        return count;
    }
    static std::size_t shapes_of(const sdf::Root& root) {
        if (root.WorldCount() == 0) return root.Model() == nullptr ? 0 : shapes_of(*root.Model());
        std::size_t count = 0;
        const sdf::World& world = *root.WorldByIndex(0);
        for (std::uint64_t i = 0; i < world.ModelCount(); ++i) count += shapes_of(*world.ModelByIndex(i));
        return count;
    }

    /// Names of copies in a message become those of the user's files.
    std::string original(std::string text) const {
        for (const auto& [folder, file] : sources_.originals)
            for (std::size_t at; (at = text.find(folder + "/model.sdf")) != std::string::npos;)
                text.replace(at, folder.size() + 10, file);
        return printable(text, 1000);
    }

    std::string all_seen() const {
        std::string out;
        for (const std::string& name : seen_) out += (out.empty() ? "" : ", ") + printable(name, 64);
        return out.empty() ? "none" : out;
    }

    void check(const sdf::Errors& errors) const {
        if (errors.empty()) return;
        std::string all;
        for (std::size_t i = 0; i < errors.size() && i < 5; ++i) {
            const std::string file = errors[i].FilePath() ? original(*errors[i].FilePath()) + ": " : "";
            all += file + original(errors[i].Message()) + "\n";
        }
        if (!choices_.allow_missing)
            throw Fault("", all + std::to_string(errors.size()) + " faults of the world",
                        "mend them, or try with --allow-missing");
        report_.notes.push_back("libsdformat found " + std::to_string(errors.size()) +
                                " faults, the first: " + all.substr(0, all.find('\n')));
    }

    Pose resolved(const sdf::SemanticPose& semantic, const std::string& name) const {
        ignition::math::Pose3d out;
        const sdf::Errors errors = semantic.Resolve(out);
        if (!errors.empty())
            throw Fault(printable(name), "has no pose: " + original(errors[0].Message()),
                        "mend its <pose> and relative_to");
        if (!out.IsFinite()) throw Fault(printable(name), "has a pose that is not finite", "mend its <pose>");
        return pose(out);
    }

    std::size_t add_node(const std::string& name, const Pose& at, Place above) {
        world_.nodes.push_back({.name = name, .pose = at});
        const std::size_t index = world_.nodes.size() - 1;
        (above ? world_.nodes[*above].children : world_.roots).push_back(index);
        return index;
    }

    void add_world(const sdf::World& world) {
        const Pose turn = place_on_earth(world.SphericalCoordinates());
        for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
            const sdf::Model& model = *world.ModelByIndex(i);
            add_model(model, "", turn * resolved(model.SemanticPose(), model.Name()), std::nullopt);
        }
    }

    /// Takes the origin; what is returned turns the world so that its x is east. With a heading x points so
    /// far from east to north, as Gazebo's satellite sensors have it (LOCAL2 of its spherical coordinates).
    Pose place_on_earth(const ignition::math::SphericalCoordinates* place) {
        if (place == nullptr) return {};
        world_.origin = Origin{place->LatitudeReference().Degree(), place->LongitudeReference().Degree(),
                               place->ElevationReference()};
        const double heading = choices_.heading.value_or(place->HeadingOffset().Degree());
        if (heading == 0) return {};
        char text[160];
        std::snprintf(
            text, sizeof text,
            "the world is turned by its heading of %g deg, so that x is east; poses in Gazebo's own "
            "axes have to be turned as well, or --heading 0 keeps its axes",
            heading);
        report_.notes.emplace_back(text);
        return {{}, axis_angle({0, 0, 1}, deg_to_rad(heading))};
    }

    bool is_asked_for(const std::vector<std::string>& names, const std::string& name) const {
        return std::ranges::find(names, name) != names.end();
    }

    /// What the copies' traces say: a sensor other than one of contacts.
    static std::string sensor_of(const sdf::Model& model) {
        for (auto plugin = model.Element()->FindElement("plugin"); plugin;
             plugin = plugin->GetNextElement("plugin")) {
            const auto what = plugin->Get<std::string>("filename");
            if (plugin->Get<std::string>("name") == trace_name && what.starts_with("sensor ") &&
                what != "sensor contact")
                return what;
        }
        return {};
    }

    /// Why a model is taken for the robot itself; empty: it is not.
    std::string sign_of_robot(const sdf::Model& model, const std::string& name, Place above) const {
        if (sources_.is_urdf || above || model.Static() || is_asked_for(choices_.keep, name)) return {};
        if (const std::string sensor = sensor_of(model); !sensor.empty()) return "a " + sensor;
        return is_name_of_robot(name) ? "its name" : "";
    }

    void add_model(const sdf::Model& model, const std::string& outer, const Pose& at, Place above) {
        const std::string name = outer + model.Name();
        seen_.push_back(name);
        if (is_asked_for(choices_.without, name)) {
            report_.left_out.push_back(printable(name) + ": --without");
            return;
        }
        if (is_name_of_axes(name) && !is_asked_for(choices_.keep, name)) {
            report_.left_out.push_back(printable(name) + ": a drawing of axes, by its name (guessed)");
            return;
        }
        if (const std::string sign = sign_of_robot(model, name, above); !sign.empty()) {
            report_.left_out.push_back(printable(name) + ": the robot itself, by " + sign +
                                       " (guessed); --keep " + printable(name) + " keeps it");
            return;
        }
        ++report_.models;
        const std::size_t node = add_node(name, at, above);
        if (!model.Static() && !above) report_.movers.push_back(name);
        for (std::uint64_t i = 0; i < model.LinkCount(); ++i)
            add_link(model, *model.LinkByIndex(i), name, node);
        for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
            const sdf::Model& inner = *model.ModelByIndex(i);
            add_model(inner, name + "::", resolved(inner.SemanticPose(), name + "::" + inner.Name()), node);
        }
        add_joints(model, name);
    }

    void add_link(const sdf::Model& model, const sdf::Link& link, const std::string& model_name,
                  std::size_t above) {
        const std::string name = model_name + "::" + link.Name();
        const std::size_t node = add_node(name, resolved(link.SemanticPose(), name), above);
        links_[name] = node;
        for (std::uint64_t i = 0; i < link.VisualCount(); ++i)
            add_visual(model, link, *link.VisualByIndex(i), model_name, node);
    }

    /// A joint is a node of the link that it moves.
    void add_joints(const sdf::Model& model, const std::string& model_name) {
        for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
            const sdf::Joint& joint = *model.JointByIndex(i);
            const std::string name = model_name + "::" + joint.Name();
            std::string child;
            ignition::math::Pose3d at;
            if (!joint.ResolveChildLink(child).empty()) continue;  // as to the world
            const auto link = links_.find(model_name + "::" + child);
            if (link == links_.end() || !joint.SemanticPose().Resolve(at, joint.ChildLinkName()).empty())
                continue;
            add_node(name, pose(at), link->second);
        }
    }

    static Clues clues_of(const sdf::Model& model, const std::string& model_name, const sdf::Link& link,
                          const sdf::Visual& visual) {
        Clues out{.model = model_name, .link = link.Name(), .visual = visual.Name()};
        if (const auto* material = visual.Material()) out.script = material->ScriptName();
        const auto* mesh = visual.Geom()->MeshShape();
        if (mesh && !mesh->Uri().starts_with(drawn_address))
            out.mesh = std::filesystem::path(mesh->Uri()).filename();
        if (visual.HasLaserRetro()) out.laser_retro = visual.LaserRetro();
        out.terrain = visual.Geom()->HeightmapShape() != nullptr;
        for (const sdf::ElementPtr& element : {visual.Element(), link.Element(), model.Element()})
            if (out.property.empty() && element && element->HasElement("surface_props:material"))
                out.property = element->Get<std::string>("surface_props:material");
        return out;
    }

    void add_visual(const sdf::Model& model, const sdf::Link& link, const sdf::Visual& visual,
                    const std::string& model_name, std::size_t above) {
        told_(++shapes_done_, shapes_all_);
        if (!visual.Geom() || visual.Geom()->Type() == sdf::GeometryType::EMPTY) return;
        const std::string name = model_name + "::" + link.Name() + "::" + visual.Name();
        stage_.set(printable(name, 500));
        Clues clues = clues_of(model, model_name, link, visual);
        const std::string water = sign_of_water(clues);
        if (!water.empty() && !is_asked_for(choices_.keep, model_name) && !rule_for(clues, choices_.rules)) {
            report_.left_out.push_back(printable(name) + ": water, by " + water + " (guessed)");
            return;
        }
        const std::string key = key_of(*visual.Geom());
        if (const auto* mesh = visual.Geom()->MeshShape()) stage_.set(printable(mesh->Uri(), 1000));
        try {
            const Shape& shape = shapes_.get(*visual.Geom(), key);
            const auto mesh = meshes_.mesh_of(key, shape, clues);
            if (!mesh) {
                report_.left_out.push_back(printable(name) + ": a rule says so");
                return;
            }
            const std::size_t node = add_node(name, resolved(visual.SemanticPose(), name), above);
            world_.nodes[node].mesh = mesh;
        } catch (const Fault& fault) {
            if (!choices_.allow_missing) throw;
            report_.left_out.push_back(printable(name) + ": " + fault.what());
        }
    }

    const Sources& sources_;
    SdfChoices& choices_;
    World& world_;
    Report& report_;
    Stage& stage_;
    const Told& told_;
    std::size_t shapes_done_ = 0, shapes_all_ = 0;
    Shapes shapes_;
    Meshes meshes_;
    std::map<std::string, std::size_t> links_;
    std::vector<std::string> seen_;
};

}  // namespace

void require_sdf(const std::filesystem::path&) {}

void add_sdf(const Sources& sources, const ModelPaths& paths, SdfChoices& choices, World& world,
             Report& report, Stage& stage, const Told& told) {
    report.left_out.insert(report.left_out.end(), sources.left_out.begin(), sources.left_out.end());
    report.notes.insert(report.notes.end(), sources.notes.begin(), sources.notes.end());
    Converter(sources, paths, choices, world, report, stage, told).convert();
}

}  // namespace echoloop::worlds
