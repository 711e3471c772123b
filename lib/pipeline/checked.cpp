#include "pipeline/checked.hpp"

namespace d2b {

std::vector<WorldPolygon> checked(std::vector<WorldPolygon> drawn,
                                  const std::function<std::vector<WorldPolygon>()>& traced, Geos& geos,
                                  OutlineStatus& status, Tally& tally) {
    if (drawn.empty() || geos.invalidity(drawn).empty())
        return drawn;
    if (status == OutlineStatus::simplified || status == OutlineStatus::regularized) {
        status = OutlineStatus::kept_traced;
        tally.count(Reason::outline_kept_traced);
        drawn = traced();
        if (geos.invalidity(drawn).empty())
            return drawn;
    }
    status = OutlineStatus::repaired;
    tally.count(Reason::polygon_repaired);
    drawn = geos.repaired(drawn);
    if (drawn.empty())
        tally.count(Reason::polygon_lost);
    return drawn;
}

}  // namespace d2b
