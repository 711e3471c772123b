#include "features/rejected_layer.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "attributes/attribute_table.hpp"
#include "core/stage_clock.hpp"
#include "outline/noding.hpp"

namespace d2b {
namespace {

std::string_view name_of(Reason reason) {
    return reason_names[static_cast<std::size_t>(reason)];
}

std::optional<Reason> reason_of(const FeaturePolygon& made) {
    if (made.status == OutlineStatus::kept_traced)
        return Reason::outline_kept_traced;
    if (made.status == OutlineStatus::repaired)
        return made.parts.empty() ? Reason::polygon_lost : Reason::polygon_repaired;
    return {};
}

}  // namespace

void RejectedLayer::note(std::size_t contour, LayerRole role, std::int64_t id, const FeaturePolygon& made) {
    const auto reason = reason_of(made);
    if (!reason)
        return;
    // A building and its contour of level 1 share one record.
    if (changed_.empty() || changed_.back().contour != contour ||
        changed_.back().record.reason != name_of(*reason)) {
        RejectedRecord record;
        record.reason = name_of(*reason);
        record.level = input_.contours.head(contour).key.level;
        changed_.push_back({contour, record});
    }
    RejectedRecord& record = changed_.back().record;
    (role == LayerRole::contours ? record.contour : record.building) = id;
}

RejectedLayer::Drawn RejectedLayer::draw(std::size_t i, PolygonMaker& maker) const {
    const auto rejected = input_.contours.rejected();
    Drawn drawn;
    if (i < rejected.size()) {
        drawn.record.reason = name_of(rejected[i].reason);
        drawn.record.level = rejected[i].key.level;
        drawn.made = maker.as_traced(input_.contours.fetch(rejected[i]));
    } else {
        const Changed& changed = changed_[i - rejected.size()];
        drawn.record = changed.record;
        drawn.made = maker.as_traced(traced_polygon(input_.contours.fetch(changed.contour)));
    }
    drawn.record.area_m2 = drawn.made.measure.area_m2;
    drawn.record.perimeter_m = drawn.made.measure.perimeter_m;
    return drawn;
}

void RejectedLayer::write(std::vector<PolygonMaker>& makers, FeatureSink& sink, RoundedPolygons* rounded,
                          Context& context) const {
    constexpr std::size_t piece = 64;
    const std::size_t count = input_.contours.rejected().size() + changed_.size();
    std::int64_t id = sink.first_id();
    context.threads->in_order((count + piece - 1) / piece,
                              [&](std::size_t k, std::size_t thread) {
                                  std::vector<Drawn> drawn;
                                  for (std::size_t i = k * piece; i < std::min(count, (k + 1) * piece); ++i)
                                      drawn.push_back(draw(i, makers[thread]));
                                  return drawn;
                              },
                              [&](std::size_t, std::vector<Drawn> drawn) {
                                  const StageClock clock(context.report, Stage::write);
                                  for (Drawn& one : drawn) {
                                      one.record.id = id++;
                                      if (one.made.parts.empty())
                                          continue;
                                      if (rounded != nullptr)
                                          rounded->round(
                                              RoundedPolygons::Layer::rejected, one.record.id, 0,
                                              "feature " + std::to_string(one.record.id) + " of the rejected",
                                              one.made.parts);
                                      sink.add(layer_, {field_values(rejected_attributes(), one.record),
                                                        std::move(one.made.parts), 0, one.record});
                                  }
                              });
}

}  // namespace d2b
