#pragma once
// Parameters of scene nodes as XML. Used by the peer Mitsuba only.
#include <pugixml.hpp>

#include "nacre/scene/xml/scene_node.h"

namespace nacre {

/// Appends `<tag name="name" value="value"/>`.
void append_value(pugi::xml_node parent, const char* tag, std::string_view name,
                  const std::string& value);
void append_transform(pugi::xml_node parent, std::string_view name, const Transform& transform);
void append_rgb(pugi::xml_node parent, std::string_view name, const Vec3f& rgb);
/// A parameter as it was read.
void append_value(pugi::xml_node parent, const SceneValue& value);
/// Appends `<tag type="type" name="name">`; without the name if that is empty.
pugi::xml_node append_object(pugi::xml_node parent, std::string_view tag, std::string_view type,
                             std::string_view name = {});

}  // namespace nacre
