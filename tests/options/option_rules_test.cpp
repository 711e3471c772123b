#include <algorithm>
#include <regex>

#include <gtest/gtest.h>

#include "options/option_cases.hpp"
#include "options/option_checks.hpp"

namespace d2b::test {
namespace {

/// Cases of an option that a rule means.
std::vector<OptionCase> cases_of(const OptionCondition& use) {
    std::vector<OptionCase> found;
    for (const OptionCase& option : option_cases()) {
        if (option.name != use.name)
            continue;
        const std::string value = option.values.empty() ? "yes" : option.values.front();
        if (use.match == Match::any || (use.match == Match::equal && value == use.value) ||
            (use.match == Match::other && value != use.value) ||
            (use.match == Match::names && value.starts_with(use.value)))
            found.push_back(option);
    }
    return found;
}

Texts both(const OptionCase& one, const OptionCase& other) {
    Texts words = one.words();
    for (const std::string& word : other.words())
        words.push_back(word);
    return words;
}

bool is_a_sentence(const std::string& text) {
    return std::regex_match(text, std::regex("-[a-z_0-9]+ [^\n]*[^.]\\."));
}

/// Without a value in option_cases.cpp an option would be tried with nothing.
TEST(OptionRules, knowACaseOfEveryOption) {
    for (const OptionRow& row : option_table())
        if (!row.hidden && row.name != "help" && row.name != "version") {
            EXPECT_FALSE(cases_of({row.name}).empty()) << row.name;
        }
}

TEST(OptionRules, nameOptionsThatThereAre) {
    for (const OptionRule& rule : option_rules()) {
        EXPECT_FALSE(cases_of(rule.one).empty()) << rule.one.name;
        EXPECT_FALSE(cases_of(rule.other).empty()) << rule.other.name;
        EXPECT_TRUE(rule.unless.name.empty() || find_option(rule.unless.name) != nullptr) << rule.unless.name;
    }
    for (const OptionDependency& need : option_dependencies()) {
        EXPECT_NE(find_option(need.name), nullptr) << need.name;
        EXPECT_NE(find_option(need.needed), nullptr) << need.needed;
    }
}

TEST(OptionRules, refuseInEitherOrderWithOneSentence) {
    for (const OptionRule& rule : option_rules())
        for (const OptionCase& one : cases_of(rule.one))
            for (const OptionCase& other : cases_of(rule.other)) {
                const std::string message = refusal_of(both(one, other));
                EXPECT_NE(message, "") << one.text() << " " << other.text();
                EXPECT_EQ(refusal_of(both(other, one)), message);
            }
}

TEST(OptionRules, sayWhichTwoAndWhatToDo) {
    for (const auto& [words, message] : std::vector<std::pair<Texts, std::string>>{
             {{"-arcs", "-regularize", "off"},
              "-arcs has no effect with -regularize off; round walls come from -regularize auto alone."},
             {{"-wall_inset", "0.3", "-regularize", "off"},
              "-wall_inset has no effect with -regularize off; it moves straight walls."},
             {{"-disjoint", "-layers", "buildings"},
              "-disjoint has no effect with -layers buildings; contours alone become bands, with -layers "
              "contours or both."},
             {{"-simplify", "0.5", "-regularize", "right"},
              "-simplify 0.5 cannot be used together with -regularize right; straight walls need no "
              "simplification."},
             {{"-max_building_width", "40", "-ground", "dtm.tif"},
              "-max_building_width has no effect with -ground dtm.tif; it helps to find the ground, which is "
              "given."},
             {{"-sweep", "lod=1..3,nf=2", "-lod", "2"},
              "-lod has no effect with -sweep lod=...; the sweep names the values itself."},
             {{"-sweep", "detail=1", "-detail", "2"},
              "-detail has no effect with -sweep detail=...; the sweep names the values itself."},
             {{"-mask_layer", "roofs"},
              "-mask_layer needs -mask <raster or polygons>; it names the layer of its polygons."},
             {{"-split_width", "2"},
              "-split_width needs -split_by <polygons or lines>; it is the width of what parcels cut off."},
             {{"-split_by", "p.gpkg", "-split_field", "no", "-layers", "contours"},
              "-split_field has no effect with -layers contours; only buildings say whose parcel they are."}})
        EXPECT_EQ(refusal_of(words), message);
}

/// Also where it says again what the default is.
TEST(OptionRules, refuseWhatHasNoMeaningInAPreset) {
    const std::string end =
        " has no effect with -preset thesis; it detects no buildings, so leave one of them out.";
    int tried = 0;
    for (const OptionCase& option : option_cases()) {
        const OptionRow& row = *find_option(option.name);
        if (row.has_meaning(Preset::thesis))
            continue;
        Texts words = option.words();
        words.insert(words.end(), {"-preset", "thesis"});
        const std::string value = option.values.empty() ? "yes" : option.values.front();
        const bool any = row.scope.elsewhere.empty();
        if (value == row.scope.elsewhere)
            EXPECT_EQ(refusal_of(words), "");
        else if (option.with.empty())
            EXPECT_EQ(refusal_of(words), "-" + row.name + (any ? "" : " " + value) + end);
        else
            EXPECT_NE(refusal_of(words), "");
        ++tried;
    }
    EXPECT_GT(tried, 16);
    for (const char* name : {"min_height", "min_confidence", "max_building_width"})
        EXPECT_EQ(refusal_of({"-preset", "thesis", "-" + std::string(name), find_option(name)->standard}),
                  "-" + std::string(name) + end);
}

TEST(OptionRules, leaveWhatMakesSense) {
    for (const Texts& words : std::vector<Texts>{{"-arcs", "-regularize", "auto"},
                                                 {"-arcs", "-preset", "thesis", "-regularize", "auto"},
                                                 {"-arcs", "-simplify", "0"},
                                                 {"-simplify", "1", "-regularize", "off"},
                                                 {"-disjoint", "-layers", "both"},
                                                 {"-fields", "own", "-layers", "contours"},
                                                 {"-fields", "osm", "-layers", "contours", "-write_doubtful"},
                                                 {"-preset", "thesis", "-ground", "none"},
                                                 {"-preset", "thesis", "-split_height", "0"},
                                                 {"-preset", "thesis", "-levels", "global"},
                                                 {"-max_building_width", "40", "-ground", "auto"},
                                                 {"-sweep", "lod=1..3", "-nf", "2"},
                                                 {"-sweep", "lod=1..3", "-overwrite", "-preview", "p.png"},
                                                 {"-cutline", "a.gpkg", "-cutline_layer", "town"}})
        EXPECT_EQ(refusal_of(words), "") << words.front();
}

/// Whatever stands beside whatever else is taken, or refused by a sentence, in whatever order.
TEST(OptionRules, everyPairIsTakenOrRefusedByASentence) {
    const std::vector<OptionCase> cases = option_cases();
    for (const OptionCase& one : cases) {
        EXPECT_EQ(refusal_of(one.words()), "") << one.text();
        for (const OptionCase& other : cases) {
            if (one.name == other.name)
                continue;
            const std::string message = refusal_of(both(one, other));
            EXPECT_EQ(message, refusal_of(both(other, one))) << one.text() << " " << other.text();
            EXPECT_TRUE(message.empty() || is_a_sentence(message)) << message;
        }
    }
}

}  // namespace
}  // namespace d2b::test
