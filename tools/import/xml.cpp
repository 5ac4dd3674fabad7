#include "tools/import/xml.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "render/scene/limits.h"
#include "tools/import/fault.h"
#include "tools/import/outline.h"
#include "tools/import/primitives.h"

namespace echoloop::worlds {
namespace {

using tinyxml2::XMLElement;

XMLElement* model_around(XMLElement& element) {
    for (auto* parent = element.Parent(); parent; parent = parent->Parent())
        if (XMLElement* found = parent->ToElement())
            for (const char* name : {"model", "include"})
                if (std::string_view(found->Name()) == name) return found;
    return nullptr;
}

/// The numbers in an element, as many as are asked for.
std::vector<double> numbers_of(const std::filesystem::path& file, const XMLElement& element,
                               std::size_t count) {
    std::istringstream words(text_of(&element));
    std::vector<double> out;
    std::string word;
    while (words >> word) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end != 0 || !(std::abs(value) <= scene_limits::extent)) break;
        out.push_back(value);
    }
    if (out.size() != count || words)
        throw Fault(place_of(file, element),
                    std::string("<") + element.Name() + "> holds " + printable(text_of(&element), 40),
                    "give " + std::to_string(count) + (count == 1 ? " number" : " numbers") + ", in m");
    return out;
}

double length_of(const std::filesystem::path& file, const XMLElement& shape, const char* name) {
    const XMLElement* element = shape.FirstChildElement(name);
    if (element == nullptr)
        throw Fault(place_of(file, shape), std::string("<") + shape.Name() + "> without a <" + name + ">",
                    "give it, in m");
    const double value = numbers_of(file, *element, 1)[0];
    if (!(value > 0))
        throw Fault(place_of(file, *element), std::string("<") + name + "> is not above 0", "give it, in m");
    return value;
}

std::vector<Outline> outlines_of(const std::filesystem::path& file, const XMLElement& first) {
    std::vector<Outline> out;
    for (auto* line = &first; line; line = line->NextSiblingElement("polyline")) {
        out.emplace_back();
        for (auto* point = line->FirstChildElement("point"); point;
             point = point->NextSiblingElement("point")) {
            const auto p = numbers_of(file, *point, 2);
            out.back().push_back({p[0], p[1]});
        }
    }
    return out;
}

}  // namespace

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string text_of(const XMLElement* element) {
    return trimmed(element && element->GetText() ? element->GetText() : "");
}

std::string name_of(const XMLElement& element) {
    const char* name = element.Attribute("name");
    return name ? printable(name, 64) : "";
}

std::string place_of(const std::filesystem::path& file, const XMLElement& element) {
    return printable(file.string()) + ":" + std::to_string(element.GetLineNum());
}

bool is_trace(const XMLElement& element) { return name_of(element) == trace_name; }

void leave_trace(XMLElement& element) {
    if (is_trace(element)) return;
    XMLElement* model = model_around(element);
    if (!model) return;
    const char* kind = element.Attribute(std::string_view(element.Name()) == "sensor" ? "type" : "filename");
    XMLElement* trace = model->InsertNewChildElement("plugin");
    trace->SetAttribute("name", trace_name);
    trace->SetAttribute("filename",
                        (std::string(element.Name()) + " " + printable(kind ? kind : "", 64)).c_str());
}

void check_pose(const std::filesystem::path& file, const XMLElement& pose) {
    std::istringstream words(text_of(&pose));
    std::string word;
    while (words >> word) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end != 0 || !(std::abs(value) <= 1e6))
            throw Fault(place_of(file, pose), "<pose> holds " + printable(word, 40) + ", which is no place",
                        "give six numbers, in m and rad");
    }
}

void add_inertia(XMLElement& link) {
    if (link.FirstChildElement("inertial") || name_of(link) == "world") return;  // which is no link
    XMLElement* inertial = link.InsertNewChildElement("inertial");
    inertial->InsertNewChildElement("mass")->SetAttribute("value", "1");
    XMLElement* inertia = inertial->InsertNewChildElement("inertia");
    for (const char* axis : {"ixx", "iyy", "izz"}) inertia->SetAttribute(axis, "1");
    for (const char* axis : {"ixy", "ixz", "iyz"}) inertia->SetAttribute(axis, "0");
}

void keep_fixed_joints(XMLElement& robot) {
    std::vector<std::string> names;
    for (auto* joint = robot.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint"))
        if (const char* name = joint->Attribute("name"); name && joint->Attribute("type", "fixed"))
            names.emplace_back(name);
    for (const std::string& name : names) {
        XMLElement* wish = robot.InsertNewChildElement("gazebo");
        wish->SetAttribute("reference", name.c_str());
        wish->InsertNewChildElement("preserveFixedJoint")->SetText("true");
    }
}

std::optional<Shape> drawn_shape(const std::filesystem::path& file, const XMLElement& shape) {
    const std::string_view name = shape.Name();
    if (name == "cone") return cone(length_of(file, shape, "radius"), length_of(file, shape, "length"));
    if (name != "polyline") return std::nullopt;
    try {
        return drawn_up(outlines_of(file, shape), length_of(file, shape, "height"));
    } catch (const Fault&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Fault(place_of(file, shape), std::string("<polyline> ") + error.what(), "make a mesh of it");
    }
}

}  // namespace echoloop::worlds
