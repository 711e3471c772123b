#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/commit_list.hpp"

namespace d2b {

/// Change of a building between two surveys. Raised and lowered go before grown and shrunk.
enum class Change { built, gone, raised, lowered, grown, shrunk, same };
inline constexpr std::array<std::string_view, 7> change_names{"new",   "gone",   "raised", "lowered",
                                                              "grown", "shrunk", "same"};

/// Horizontal displacement of the new survey against the old one, in metres.
struct SurveyShift {
    double east_m = 0;
    double north_m = 0;
    std::size_t pairs = 0;  ///< buildings that agree on it; 0: too few, no shift is applied
};

/// Input of a comparison of surveys: two datasets of buildings, or two DSMs.
struct SurveyRequest {
    std::string old_survey;
    std::string new_survey;
    std::string destination;  ///< dataset of changes; "": none
    std::string format;       ///< OGR short name; deduced from the extension if empty
    bool overwrite = false;
    std::string page;    ///< HTML file that shows both surveys in a browser; "": none
    std::string title;   ///< of the page; "": the name of its file
    std::string credit;  ///< source and licence of the data, on the page
};

/// One of the compared surveys.
struct ComparedSurvey {
    std::string dataset;
    std::string layer;             ///< "" for a DSM
    std::size_t buildings = 0;     ///< all of them
    std::size_t outside = 0;       ///< not compared, because the other survey has no data there
    std::optional<double> cell_m;  ///< side of a cell; nothing if it is unknown
};

/// Result of a comparison of surveys.
struct SurveyComparison {
    ComparedSurvey old_survey;
    ComparedSurvey new_survey;
    std::string crs;  ///< CRS of the new survey; "" if there is none
    SurveyShift shift;
    std::array<std::size_t, change_names.size()> counts{};  ///< buildings per change
    std::string output;                                     ///< destination; "" if there is none
    std::string page;                                       ///< likewise
    std::vector<std::string> warnings;
};

/// Finds the buildings of two surveys, unless they are given, matches them and writes the changes. @param
/// reader gets the result before it is visible @throws InputError: a survey cannot be read, or a dataset and
/// a raster. @throws OptionError, OutputError as open_sink()
SurveyComparison compare_surveys(const SurveyRequest& request, const Callbacks& callbacks = {},
                                 const ReportReader<SurveyComparison>& reader = {});

}  // namespace d2b
