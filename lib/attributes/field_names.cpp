#include "attributes/field_names.hpp"

#include <array>

namespace d2b {
namespace {

struct Translation {
    FieldNames names;
    std::string_view own;
    std::string_view other;
};

// Field names of other programs. URock takes the height of a building from ROOF_HEIGHT by default and
// extrudes a block to it, so it gets p90 because the highest point may be a spire. City4CFD configures its
// attribute names; these are those of its own examples. OSM: tags of Simple 3D Buildings.
constexpr std::array translations{
    Translation{FieldNames::urock, "id", "ID_BUILD"},
    Translation{FieldNames::urock, "p90", "ROOF_HEIGHT"},
    Translation{FieldNames::city4cfd, "id", "unique_id"},
    Translation{FieldNames::city4cfd, "num_floors", "floors"},
    Translation{FieldNames::city4cfd, "min_height", "base_height"},
    Translation{FieldNames::osm, "num_floors", "building:levels"},
    Translation{FieldNames::osm, "ground", "ele"},
};

}  // namespace

std::string_view field_name(FieldNames names, std::string_view own) {
    for (const Translation& translation : translations)
        if (translation.names == names && translation.own == own)
            return translation.other;
    return own;
}

}  // namespace d2b
