// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/city_json.hpp"

#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b::mesh {
namespace {

/// Boundaries of a solid are eight levels down; attributes may have some of their own.
constexpr int most_levels = 64;

}  // namespace

CityJson::CityJson(const std::string& text, std::string name) : name_(std::move(name)) {
    const auto not_too_deep = [&](int depth, Json::parse_event_t, const Json&) {
        if (depth > most_levels)
            refuse("is nested deeper than any CityJSON of buildings; give a file that -surface wrote");
        return true;
    };
    try {
        root_ = Json::parse(text, not_too_deep);
    } catch (const Json::exception&) {
        refuse("is not complete JSON; give a file that -surface wrote");
    }
}

void CityJson::refuse(const std::string& what) const {
    throw InputError("'" + name_ + "' " + what + ".");
}

const CityJson::Json& CityJson::member(const Json& object, const std::string& key,
                                       const std::string& where) const {
    if (!object.is_object() || !object.contains(key))
        refuse("has no '" + key + "' in " + where + "; give a file that -surface wrote");
    return object.at(key);
}

const CityJson::Json& CityJson::array(const Json& object, const std::string& key,
                                      const std::string& where) const {
    const Json& value = member(object, key, where);
    if (!value.is_array())
        refuse("has a '" + key + "' in " + where + " that is not a list; give a file that -surface wrote");
    return value;
}

const CityJson::Json& CityJson::object(const Json& object, const std::string& key,
                                       const std::string& where) const {
    const Json& value = member(object, key, where);
    if (!value.is_object())
        refuse("has a '" + key + "' in " + where + " that is not an object; give a file that -surface wrote");
    return value;
}

std::string CityJson::text(const Json& object, const std::string& key, const std::string& where) const {
    if (!object.is_object() || !object.contains(key))
        return {};
    const Json& value = object.at(key);
    if (!value.is_string())
        refuse("has a '" + key + "' in " + where + " that is not a text; give a file that -surface wrote");
    return value.get<std::string>();
}

std::size_t CityJson::index(const Json& value, std::size_t end, const std::string& where) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= end)
        refuse("has an index in " + where + " that is out of range; the file is damaged");
    return value.get<std::size_t>();
}

}  // namespace d2b::mesh
