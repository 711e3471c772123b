#include "features/problem_layer.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "attributes/attribute_table.hpp"
#include "core/stage_clock.hpp"

namespace d2b {

void ProblemLayer::note(std::vector<PlacedProblem> problems) {
    std::ranges::move(problems, std::back_inserter(problems_));
}

void ProblemLayer::write(FeatureSink& sink, Context& context) const {
    if (!layer_) {
        if (!problems_.empty())
            context.warn("-write_problems: the format holds one layer, which has no room for " +
                         std::to_string(problems_.size()) +
                         (problems_.size() == 1 ? " problem" : " problems") + "; write a GeoPackage.");
        return;
    }
    const StageClock clock(context.report, Stage::write);
    std::int64_t id = sink.first_id();
    for (const PlacedProblem& problem : problems_) {
        ProblemRecord record = problem.record;
        record.id = id++;
        sink.add(*layer_, {field_values(problem_attributes(), record), {}, 0, record, problem.place});
    }
}

}  // namespace d2b
