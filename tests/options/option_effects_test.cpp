#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "options/option_scene.hpp"

namespace d2b::test {
namespace {

/// An option that repeats another's effect is taken: it misleads nobody.
bool says_again(const std::string& one, const std::string& other) {
    static const std::map<std::string, std::set<std::string>> implied{
        {"-preset thesis",
         {"-ground none", "-levels global", "-trace points", "-regularize off",
          "-surface s.obj -surface_of contours"}},
        {"-simplify 1.2", {"-regularize off"}}};
    const auto found = implied.find(other);
    return found != implied.end() && found->second.contains(one);
}

/// The scene has one object of each kind: where the second takes it away, the first has nothing to show.
bool takes_its_object(const std::string& one, const std::string& other) {
    // The rubble of both begins at 4 m, so that -min_height 4 leaves holes in it. Without the rough house the
    // limits of smoothness are stricter, and miss the ruin.
    static const std::set<std::string> of_ruin{"-b",          "-srcwin",   "-cutline_layer", "-zunit",
                                               "-mask_layer", "-min_area", "-min_height",    "-ndvi"};
    static const std::set<std::string> of_rough{"-zunit", "-ndvi", "-min_confidence", "-min_height"};
    static const std::set<std::string> of_tower{"-cutline_layer", "-split_height", "-fl",
                                                "-max_building_width"};
    static const std::set<std::string> high{"-zrange"};
    // Outlines that are simplified have none, and so have the few objects that are high enough in feet;
    // blocks of the thesis are too small for their steps, or stand at the border; with one direction, or one
    // price for all, the scene's walls are long. Walls that -min_wall makes longer need no -flow_ready.
    static const std::set<std::string> of_short_walls{"-simplify", "-zunit", "-preset", "-regularize",
                                                      "-min_wall"};
    // The walls that are not at right angles are high.
    static const std::set<std::string> of_oblique_walls{"-zrange"};
    // The flat house, which lacks cells, is no building, or is not cut, because its parts would be too small.
    static const std::set<std::string> of_flat{"-zrange", "-exclude", "-exclude_buffer",
                                               "-corrections_layer"};
    static const std::set<std::string> of_cut{"-split_width", "-min_area", "-exclude", "-exclude_buffer"};
    // So are the two houses that share a wall, one of which has a spike.
    static const std::set<std::string> of_pair{"-zrange", "-exclude_buffer"};
    static const std::string excluded = "-exclude /vsimem/scene/exclusions.gpkg";
    static const std::string corrected = "-corrections /vsimem/scene/corrections.gpkg";
    static const std::map<std::string, std::set<std::string>> of{
        {"-min_confidence 0", of_ruin},
        {"-min_confidence 0.97", of_rough},
        {"-ndvi /vsimem/scene/ndvi.tif", of_rough},
        {"-nf 50", of_tower},
        {"-max_building_width 5", high},
        {"-split_height 3", high},
        {"-arcs", {"-zrange", "-off"}},
        {"-flow_ready 5", of_short_walls},
        {"-min_wall 4", of_short_walls},
        {"-regularize right", of_oblique_walls},
        {"-regularize free", of_oblique_walls},
        {"-roofs -roof_min_area 200", high},
        {"-snodata 16", of_pair},
        {excluded, {"-corrections_layer"}},
        {excluded + " -exclude_buffer 3", {"-exclude_layer"}},
        {corrected, {"-exclude", "-exclude_buffer"}},
        {corrected + " -corrections_layer points", of_cut},
        {"-split_by /vsimem/scene/parcels.gpkg "
         "-split_width 30",
         {"-zunit"}},
        {"-inodata", of_flat}};
    const auto found = of.find(one);
    return found != of.end() && found->second.contains(other);
}

Texts joined(const Texts& one, const Texts& other) {
    Texts all = one;
    for (std::size_t i = 0; i < other.size();) {
        // Words that both need are given once.
        std::size_t end = i + 1;
        while (end < other.size() && (other[end][0] != '-' || end == i))
            ++end;
        if (std::ranges::find(one, other[i]) == one.end())
            all.insert(all.end(), other.begin() + static_cast<std::ptrdiff_t>(i),
                       other.begin() + static_cast<std::ptrdiff_t>(end));
        i = end;
    }
    return all;
}

/// The same with every tier of the scene, which has few that are worth their borders.
Texts with_all_tiers(const Texts& words) {
    Texts all = words;
    for (const Texts& more : {Texts{"-levels", "building"}, Texts{"-detail", "0"}})
        if (const Texts both = joined(more, all);
            std::ranges::find(words, more.front()) == words.end() && refusal_of(both).empty())
            all = both;
    return all;
}

class OptionEffects : public OptionScene {
  protected:
    const Outcome& outcome(const Texts& words) {
        std::string key;
        for (const std::string& word : words)
            key += word + " ";
        const auto known = known_.find(key);
        return known != known_.end() ? known->second
                                     : known_.emplace(key, outcome_of(with_all_tiers(words))).first->second;
    }
    /// Whether a case changes the result of the other words.
    bool shows(const OptionCase& option, const Texts& others) {
        return outcome(joined(others, option.words())) != outcome(joined(others, option.with));
    }
    /// Whether it shows by itself, and may so be expected to show beside the other.
    bool may_show(const OptionCase& one, const OptionCase& other) {
        const bool same = one.name == other.name || one.is_given_with(other) || other.is_given_with(one);
        return !same && !says_again(one.text(), other.text()) &&
               !takes_its_object(one.text(), "-" + other.name) && shows(one, {});
    }
    /// Both beside each other in one run; returns how many of the two were tried.
    int expect_both_show(const OptionCase& one, const OptionCase& other) {
        const Texts words = joined(other.words(), one.words());
        if (!refusal_of(words).empty())
            return 0;
        int tried = 0;
        for (const auto& [shown, beside] : {std::pair{&one, &other}, std::pair{&other, &one}})
            if (may_show(*shown, *beside)) {
                ++tried;
                EXPECT_TRUE(outcome(words) != outcome(joined(beside->words(), shown->with)))
                    << shown->text() << " beside " << beside->text();
            }
        return tried;
    }
    std::map<std::string, Outcome> known_;
};

/// Else the scene is too poor to tell anything.
TEST_F(OptionEffects, eachOptionShowsByItself) {
    for (const OptionCase& option : option_cases()) {
        const OptionRow& row = *find_option(option.name);
        Request request;
        apply_option(row, request, option.values);
        const bool standard = row.show(request) == row.standard;
        const std::set<std::string> of_the_preset{"-ground auto",
                                                  "-levels building",
                                                  "-detail 0",
                                                  "-trace cells",
                                                  "-regularize auto",
                                                  "-layers both",
                                                  "-surface s.obj -surface_of buildings"};
        if (shapes_the_result(option.name) && !standard && !of_the_preset.contains(option.text())) {
            EXPECT_TRUE(shows(option, {})) << option.text();
        }
    }
}

/// A share of the options, so that no test takes long.
class EachOption : public OptionEffects, public ::testing::WithParamInterface<std::size_t> {};
constexpr std::size_t shares = 4;

/// An option that changes nothing beside another would be ignored in silence: it is refused.
TEST_P(EachOption, showsBesideEachOther) {
    std::vector<OptionCase> cases;
    for (const OptionCase& option : option_cases())
        if (shapes_the_result(option.name))
            cases.push_back(option);
    // A sixteenth of the pairs, in which each option is; all of them if D2B_ALL_PAIRS is set, as in .ci/long.
    const std::size_t one_in = std::getenv("D2B_ALL_PAIRS") != nullptr ? 1 : 16;
    int tried = 0;
    for (std::size_t i = GetParam(); i < cases.size(); i += shares)
        for (std::size_t j = 0; j < i; ++j)
            if ((i + j) % one_in == 0)
                tried += expect_both_show(cases[i], cases[j]);
    EXPECT_GT(tried, 20);
}

INSTANTIATE_TEST_SUITE_P(Shares, EachOption, ::testing::Range(std::size_t{0}, shares));

}  // namespace
}  // namespace d2b::test
