#include "options/sweep_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "dem2buildings/error.hpp"
#include "options/option_table.hpp"

namespace d2b {
namespace {

constexpr int most_by_themselves = 6;
constexpr std::size_t most_trials = 400;

[[noreturn]] void refuse(const std::string& text) {
    refuse_value("sweep", "such as lod=1..6,nf=5..60", text);
}

std::vector<std::string> parts_of(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (std::size_t at = 0; (at = text.find(separator, from)) != std::string::npos;
         from = at + separator.size())
        parts.push_back(text.substr(from, at - from));
    parts.push_back(text.substr(from));
    return parts;
}

std::vector<int> spread(std::int64_t first, std::int64_t last) {
    const std::int64_t values = std::min<std::int64_t>(last - first + 1, most_by_themselves);
    std::vector<int> spread;
    for (std::int64_t i = 0; i < values; ++i)
        spread.push_back(
            static_cast<int>(first + (values == 1 ? 0
                                                  : std::llround(static_cast<double>(i * (last - first)) /
                                                                 static_cast<double>(values - 1)))));
    return spread;
}

std::vector<int> values_of(const std::string& text, const NumberRange& range) {
    const std::vector<std::string> parts = parts_of(text, "..");
    if (parts.size() > 3)
        refuse(text);
    std::vector<int> numbers;
    numbers.reserve(parts.size());
    for (const std::string& part : parts)
        numbers.push_back(parse_whole("sweep", range, part));
    if (parts.size() == 1)
        return numbers;
    if (numbers[1] < numbers[0])
        refuse(text);
    if (parts.size() == 2)
        return spread(numbers[0], numbers[1]);
    if (numbers[2] < 1)
        refuse(text);
    std::vector<int> stepped;
    for (std::int64_t at = numbers[0]; at <= numbers[1] && stepped.size() <= most_trials; at += numbers[2])
        stepped.push_back(static_cast<int>(at));
    return stepped;
}

bool is_whole(double value) {
    return value == std::floor(value);
}

std::vector<double> reals_of(const std::string& text, const NumberRange& range) {
    std::vector<double> numbers;
    for (const std::string& part : parts_of(text, ".."))
        numbers.push_back(parse_number("sweep", range, part));
    if (numbers.size() == 1)
        return numbers;
    const double first = numbers[0];
    const double last = numbers[1];
    if (numbers.size() > 3 || last < first || (numbers.size() == 3 && !(numbers[2] > 0)))
        refuse(text);
    const bool all = is_whole(first) && is_whole(last) && last - first < most_by_themselves;
    const double step = numbers.size() == 3    ? numbers[2]
                        : all || last == first ? 1
                                               : (last - first) / (most_by_themselves - 1);
    // Add a tolerance, because ten times a tenth is less than one.
    const double steps = std::floor((last - first) / step + 1e-9);
    if (steps > static_cast<double>(most_trials))
        refuse(text);
    std::vector<double> values;
    for (int i = 0; i <= static_cast<int>(steps); ++i)
        values.push_back(std::min(last, first + i * step));
    return values;
}

}  // namespace

SweepPlan parse_sweep(const std::string& text) {
    SweepPlan plan;
    for (const std::string& part : parts_of(text, ",")) {
        if (part.starts_with("detail=") && plan.details.empty()) {
            plan.details = reals_of(part.substr(part.find('=') + 1), *find_option("detail")->numbers);
            continue;
        }
        const bool lod = part.starts_with("lod=");
        std::vector<int>& values = lod ? plan.lods : plan.noise_factors;
        if (!values.empty() || (!lod && !part.starts_with("nf=")))
            refuse(text);
        values = values_of(part.substr(part.find('=') + 1), *find_option(lod ? "lod" : "nf")->numbers);
    }
    const std::size_t trials = plan.trials();
    if (trials > most_trials)
        throw OptionError("-sweep names " + std::to_string(trials) + " trials or more; name at most " +
                          std::to_string(most_trials) + ".");
    return plan;
}

void require_legible(std::size_t trials, int longest) {
    const auto side = static_cast<std::size_t>(std::max(longest / legible_trial_px, 1));
    if (trials <= side * side)
        return;
    std::size_t needed = side;
    while (needed * needed < trials)
        ++needed;
    throw OptionError("-sweep names " + std::to_string(trials) + " trials, and a picture of " +
                      std::to_string(longest) + " pixels has room for " + std::to_string(side * side) +
                      " that can be read; name fewer values, or give -preview_size " +
                      std::to_string(needed * legible_trial_px) + ".");
}

}  // namespace d2b
