// Small questions to a file of XML, and the changes of single elements that libsdformat needs in a copy of
// it.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tools/import/shape.h"

namespace echoloop::worlds {

std::string trimmed(const std::string& text);
/// Trimmed; "" where there is none.
std::string text_of(const tinyxml2::XMLElement* element);
std::string name_of(const tinyxml2::XMLElement& element);
/// File and line, for messages.
std::string place_of(const std::filesystem::path& file, const tinyxml2::XMLElement& element);

/// In the copies, a plugin of this name in a model stands for a sensor or a plugin that was left out; its
/// file name says which.
inline constexpr const char* trace_name = "echoloop_trace";
bool is_trace(const tinyxml2::XMLElement& element);
/// The model around a sensor or a plugin keeps a word of it.
void leave_trace(tinyxml2::XMLElement& element);

/// libsdformat takes what it cannot read for zero, so a pose that holds no numbers is refused here.
/// Parameters in a text are left to it. Throws Fault.
void check_pose(const std::filesystem::path& file, const tinyxml2::XMLElement& pose);

/// libsdformat forgets links of a URDF that have no mass.
void add_inertia(tinyxml2::XMLElement& link);
/// libsdformat melts links of a URDF that are joined for good into one; afterwards it keeps them and the
/// joint.
void keep_fixed_joints(tinyxml2::XMLElement& robot);

/// A cone, or the outlines of a geometry, neither of which libsdformat 12 reads; nothing for other
/// geometries. `shape` is the geometry's child. Throws Fault.
std::optional<Shape> drawn_shape(const std::filesystem::path& file, const tinyxml2::XMLElement& shape);

}  // namespace echoloop::worlds
