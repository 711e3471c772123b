#include "diagnose/empty_result.hpp"

#include "diagnose/place_doubt.hpp"

namespace d2b {

std::string empty_result(const LevelPlan& plan, std::size_t buildings, const DemInfo& dem,
                         const RunReport& report) {
    if (report.valid_points == 0)
        return "'" + report.input + "' has no valid point; the layers are empty";
    if (report.minimum == report.maximum && buildings == 0)
        return "all valid points of '" + report.input + "' have the same elevation; no building was found";
    if (plan.footprints || buildings > 0)
        return {};
    if (plan.level_count() == 1)
        return "no threshold lies between the lowest and the highest elevation; no building was found";
    if (const std::string picture = picture_doubt(dem); !picture.empty())
        return "no building was found: " + picture;
    return "no building was found; a smaller -nf or -min_area, or more levels, may show some";
}

}  // namespace d2b
