#include "options/option_values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <utility>

#include "core/number_from_chars.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_table.hpp"

namespace d2b {
namespace {

/// number_from_chars() rejects a plus sign, which atof, and therefore every GDAL tool, accepts.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    return text;
}

template <class Number>
std::optional<Number> parse_all(std::string_view text) {
    return parse_number<Number>(without_plus(text));
}

constexpr int max_default_values = 6;
constexpr std::size_t max_trials = 400;

[[noreturn]] void refuse(const std::string& text) {
    refuse_value("sweep", "such as lod=1..6,nf=5..60", text);
}

[[noreturn]] void refuse_values(const std::string& name, const std::string& text) {
    throw OptionError("-sweep cannot take '" + text + "' for " + name +
                      "; give one value, first..last, or "
                      "first..last..step with a step above 0 and at most " +
                      std::to_string(max_trials) + " values.");
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
    const std::int64_t values = std::min<std::int64_t>(last - first + 1, max_default_values);
    std::vector<int> spread;
    for (std::int64_t i = 0; i < values; ++i)
        spread.push_back(
            static_cast<int>(first + (values == 1 ? 0
                                                  : std::llround(static_cast<double>(i * (last - first)) /
                                                                 static_cast<double>(values - 1)))));
    return spread;
}

std::vector<int> values_of(const std::string& name, const std::string& text, const NumberRange& range) {
    const std::vector<std::string> parts = parts_of(text, "..");
    if (parts.size() > 3)
        refuse_values(name, text);
    std::vector<int> numbers;
    numbers.reserve(parts.size());
    for (const std::string& part : parts)
        numbers.push_back(parse_integer(name, range, part));
    if (parts.size() == 1)
        return numbers;
    if (numbers[1] < numbers[0])
        refuse_values(name, text);
    if (parts.size() == 2)
        return spread(numbers[0], numbers[1]);
    if (numbers[2] < 1)
        refuse_values(name, text);
    std::vector<int> stepped;
    for (std::int64_t at = numbers[0]; at <= numbers[1] && stepped.size() <= max_trials; at += numbers[2])
        stepped.push_back(static_cast<int>(at));
    return stepped;
}

bool is_whole(double value) {
    return value == std::floor(value);
}

/// Rounds to 12 significant digits, because three times a tenth is more than 0.3.
double without_rounding_error(double value) {
    std::array<char, 32> buffer{};
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 12);
    return *parse_all<double>({buffer.data(), end});
}

std::vector<double> reals_of(const std::string& name, const std::string& text, const NumberRange& range) {
    std::vector<double> numbers;
    for (const std::string& part : parts_of(text, ".."))
        numbers.push_back(parse_number(name, range, part));
    if (numbers.size() == 1)
        return numbers;
    const double first = numbers[0];
    const double last = numbers[1];
    if (numbers.size() > 3 || last < first || (numbers.size() == 3 && !(numbers[2] > 0)))
        refuse_values(name, text);
    const bool all = is_whole(first) && is_whole(last) && last - first < max_default_values;
    const double step = numbers.size() == 3    ? numbers[2]
                        : all || last == first ? 1
                                               : (last - first) / (max_default_values - 1);
    // Add a tolerance, because ten times a tenth is less than one.
    const double steps = std::floor((last - first) / step + 1e-9);
    if (steps > static_cast<double>(max_trials))
        refuse_values(name, text);
    std::vector<double> values;
    for (int i = 0; i <= static_cast<int>(steps); ++i)
        values.push_back(std::min(last, without_rounding_error(first + i * step)));
    return values;
}

/// Returns an option that changes buildings or contours and takes one number.
const OptionRow& variable_option(const std::string& name, const std::string& text) {
    if (name.empty())
        refuse(text);
    const OptionRow* const row = find_option(name);
    const bool shapes =
        row != nullptr && (row->group == OptionGroup::buildings || row->group == OptionGroup::levels ||
                           row->group == OptionGroup::contours);
    // A sweep takes its levels from -lod.
    if (!shapes || !row->numbers || row->name == "i" || row->name == "off")
        throw OptionError("-sweep cannot vary '" + name +
                          "'; it varies options that change buildings or contours and take one number, such "
                          "as min_area or lod.");
    return *row;
}

SweptOption parse_swept(const std::string& part, const std::string& text) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
        refuse(text);
    const std::string name = part.substr(0, equals);
    const OptionRow& row = variable_option(name, text);
    SweptOption option{row.name, {}};
    const std::string values = part.substr(equals + 1);
    if (row.kind == OptionKind::whole)
        for (const int value : values_of(row.name, values, *row.numbers))
            option.values.push_back(std::to_string(value));
    else
        for (const double value : reals_of(row.name, values, *row.numbers))
            option.values.push_back(number_text(value));
    return option;
}

}  // namespace

bool NumberRange::holds(double value) const {
    return std::isfinite(value) && (above_lowest ? value > lowest : value >= lowest) && value <= highest;
}

std::string NumberRange::text(std::string_view noun) const {
    std::string text(noun);
    if (std::isinf(lowest))
        return text;
    if (!std::isinf(highest) && above_lowest)
        return text + " above " + number_text(lowest) + " and at most " + number_text(highest);
    if (!std::isinf(highest))
        return text + " from " + number_text(lowest) + " to " + number_text(highest);
    return text + (above_lowest ? " above " : " of at least ") + number_text(lowest);
}

void refuse_value(std::string_view name, std::string_view range, std::string_view text) {
    throw OptionError("-" + std::string(name) + " must be " + std::string(range) + ", not '" +
                      std::string(text) + "'.");
}

bool looks_like_number(std::string_view text) {
    text = without_plus(text);
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = number_from_chars(text.data(), end, value);
    return error != std::errc::invalid_argument && stop == end;
}

std::optional<double> read_number(const NumberRange& range, std::string_view text) {
    const auto value = parse_all<double>(text);
    return value && range.holds(*value) ? value : std::nullopt;
}

double parse_number(std::string_view name, const NumberRange& range, std::string_view text) {
    const auto value = read_number(range, text);
    if (!value)
        refuse_value(name, range.text("a number"), text);
    return *value;
}

int parse_integer(std::string_view name, const NumberRange& range, std::string_view text) {
    const auto value = parse_all<int>(text);
    if (!value || !range.holds(*value))
        refuse_value(name, range.text("a whole number"), text);
    return *value;
}

std::string alternatives(std::span<const std::string> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0)
            text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

std::string joined(std::span<const std::string> words, std::string_view separator) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? std::string() : std::string(separator)) + words[i];
    return text;
}

SweepPlan parse_sweep(const std::string& text) {
    SweepPlan plan;
    for (const std::string& part : parts_of(text, ",")) {
        SweptOption option = parse_swept(part, text);
        if (std::ranges::find(plan.options, option.name, &SweptOption::name) != plan.options.end())
            throw OptionError("-sweep varies '" + option.name + "' twice; name it once.");
        plan.options.push_back(std::move(option));
        if (plan.trials() > max_trials)
            throw OptionError("-sweep names " + std::to_string(plan.trials()) +
                              " trials or more; name at most " + std::to_string(max_trials) + ".");
    }
    return plan;
}

std::vector<std::vector<std::string>> sweep_values(const SweepPlan& plan) {
    std::vector<std::vector<std::string>> trials{{}};
    for (const SweptOption& option : plan.options) {
        std::vector<std::vector<std::string>> longer;
        for (const std::vector<std::string>& trial : trials)
            for (const std::string& value : option.values) {
                longer.push_back(trial);
                longer.back().push_back(value);
            }
        trials = std::move(longer);
    }
    return trials;
}

int legible_side(std::size_t trials) {
    std::size_t side = 1;
    while (side * side < trials)
        ++side;
    return static_cast<int>(side) * min_trial_px;
}

void require_legible(std::size_t trials, int longest) {
    const auto side = static_cast<std::size_t>(std::max(longest / min_trial_px, 1));
    if (trials <= side * side)
        return;
    throw OptionError("-sweep names " + std::to_string(trials) + " trials, and a picture of " +
                      std::to_string(longest) + " pixels has room for " + std::to_string(side * side) +
                      " that can be read; name fewer values, or give -preview_size " +
                      std::to_string(legible_side(trials)) + ".");
}

}  // namespace d2b
