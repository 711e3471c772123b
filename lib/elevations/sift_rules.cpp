#include "elevations/sift_rules.hpp"

namespace d2b {

ElevationLimits elevation_limits(const ReadOptions& options, double metres) {
    if (const auto& range = options.elevation_range)
        return {(*range)[0], (*range)[1]};
    return on_land.times(1 / metres);
}

SiftRules sift_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info, double metres) {
    SiftRules rules{elevation_limits(options, metres), {}, metres, info.set_aside_nodata, {}};
    if (with_spikes)
        rules.spikes = {spikes_m.no_elevation / metres, spikes_m.no_roof / metres};
    return rules;
}

UndeclaredValues undeclared_values(DemSource& source, const Options& options, const SiftRules& rules,
                                   double cell_m, const BorderCells* border, const Context& context) {
    const Window& window = source.info().window;
    if (options.read.ignore_nodata || window.points() == 0)
        return {};
    const ReadValues read = [&](const Window& part, std::span<double> values) {
        context.check_stop();
        source.read(part, values);
        limit(values, rules);
    };
    const double side = cell_m > 0 ? cell_m : 1;
    return find_undeclared(window, border != nullptr ? *border : read_border(window, read),
                           {UndeclaredRules::step_m / rules.metres, options.ground.max_building_width / side},
                           read);
}

}  // namespace d2b
