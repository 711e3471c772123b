// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace d2b::mesh {

/// JSON of a file, with sentences about its faults.
class CityJson {
  public:
    using Json = nlohmann::json;

    /// @throws InputError not JSON, or nested deeper than any CityJSON is
    CityJson(const std::string& text, std::string name);

    [[nodiscard]] const Json& root() const { return root_; }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// "'x.city.json' <what>." @throws InputError always
    [[noreturn]] void refuse(const std::string& what) const;
    /// The member of an object. @param where "building_7" @throws InputError where there is none of this kind
    [[nodiscard]] const Json& array(const Json& object, const std::string& key,
                                    const std::string& where) const;
    [[nodiscard]] const Json& object(const Json& object, const std::string& key,
                                     const std::string& where) const;
    /// "" where it is not there. @throws InputError where it is no text
    [[nodiscard]] std::string text(const Json& object, const std::string& key,
                                   const std::string& where) const;
    /// A whole number from 0 on. @throws InputError
    [[nodiscard]] std::size_t index(const Json& value, std::size_t end, const std::string& where) const;

  private:
    [[nodiscard]] const Json& member(const Json& object, const std::string& key,
                                     const std::string& where) const;

    std::string name_;
    Json root_;
};

}  // namespace d2b::mesh
