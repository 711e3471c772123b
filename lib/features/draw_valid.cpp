#include "features/draw_valid.hpp"

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// @return the reason why the parts are invalid; "" if they are valid
std::string draw(const DrawParts& drawn, Geos& geos, std::vector<WorldPolygon>& parts) {
    try {
        parts = drawn();
        return parts.empty() ? "" : geos.invalidity(parts);
    } catch (const GeometryError& error) {
        parts.clear();
        return error.what();
    }
}

std::vector<WorldPolygon> repaired(const std::vector<WorldPolygon>& parts, Geos& geos) {
    try {
        return geos.repaired(parts);
    } catch (const GeometryError&) {
        return {};
    }
}

}  // namespace

ValidParts draw_valid(const DrawParts& drawn, const DrawParts& traced, Geos& geos, OutlineStatus& status,
                      Tally& tally) {
    ValidParts result;
    result.trouble = draw(drawn, geos, result.parts);
    if (result.trouble.empty())
        return result;
    const bool redrawn = status == OutlineStatus::simplified || status == OutlineStatus::regularized;
    if (redrawn || result.parts.empty()) {
        if (draw(traced, geos, result.parts).empty()) {
            status = OutlineStatus::kept_traced;
            tally.count(Reason::outline_kept_traced);
            return result;
        }
    }
    status = OutlineStatus::repaired;
    tally.count(Reason::polygon_repaired);
    result.parts = repaired(result.parts, geos);
    if (result.parts.empty())
        tally.count(Reason::polygon_lost);
    return result;
}

}  // namespace d2b
