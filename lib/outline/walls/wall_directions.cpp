#include "outline/walls/wall_directions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace d2b::outline {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

}  // namespace

double angle_between(double from, double to) {
    const double turn = to - from;
    return turn - std::round(turn / quarter_turn) * quarter_turn;
}

void DirectionHistogram::add(const std::vector<Stretch>& stretches,
                             std::initializer_list<DirectionHistogram*> to) {
    constexpr double min_length = 2.5;   // cells
    constexpr double wall_length = 5;    // cells
    constexpr double long_stretch = 8;   // cells; its weight per cell is 1
    constexpr double max_weight = 1.5;   // per cell
    constexpr double half_a_cell = 0.5;  // lateral error at the ends of a stretch
    for (const Stretch& stretch : stretches) {
        if (stretch.length < min_length)
            continue;
        const double spread = std::clamp(half_a_cell / stretch.length / degree, 1.2, 8.0);  // degrees
        const double weight = stretch.length * std::min(stretch.length / long_stretch, max_weight) / spread;
        const double at =
            (stretch.angle - std::floor(stretch.angle / quarter_turn) * quarter_turn) / degree * 2;
        for (DirectionHistogram* histogram : to)
            histogram->walls_[static_cast<std::size_t>(at) % bins] += stretch.length >= wall_length ? 1 : 0;
        const int reach = static_cast<int>(std::ceil(6 * spread));  // three standard deviations
        for (int k = -reach; k <= reach; ++k) {
            const double bin = std::floor(at) + k;
            const double away = (bin - at) / 2 / spread;
            const auto i = static_cast<std::size_t>(bin + 2.0 * bins) % bins;
            const double share = weight * std::exp(-away * away / 2);
            for (DirectionHistogram* histogram : to)
                histogram->weights_[i] += share;
        }
    }
}

void DirectionHistogram::add(const DirectionHistogram& other, double weight) {
    for (std::size_t i = 0; i < bins; ++i)
        weights_[i] += weight * other.weights_[i];
}

double DirectionHistogram::total() const {
    return std::accumulate(weights_.begin(), weights_.end(), 0.0);
}

std::vector<double> DirectionHistogram::frames(std::size_t most) const {
    constexpr double min_share = 0.06;
    constexpr int apart = 16;  // bins
    constexpr int half_width = 8;
    constexpr int wall_width = 13;  // half of it
    std::array<double, bins> left = weights_;
    const auto bin = [&](std::size_t at, int k) {
        return static_cast<std::size_t>(static_cast<int>(at) + k + static_cast<int>(bins)) % bins;
    };
    const double all = total();
    std::vector<double> found;
    while (found.size() < most) {
        const auto at = static_cast<std::size_t>(std::ranges::max_element(left) - left.begin());
        if (!(left[at] > 0))
            break;
        double share = 0;
        for (int k = 1 - half_width; k < half_width; ++k)
            share += left[bin(at, k)];
        if (!found.empty() && share < min_share * all)
            break;
        double sum = 0;
        double moment = 0;
        for (int k = -3; k <= 3; ++k) {
            sum += left[bin(at, k)];
            moment += k * left[bin(at, k)];
        }
        int walls = 0;
        for (int k = 1 - wall_width; k < wall_width; ++k)
            walls += walls_[bin(at, k)];
        if (found.empty() || walls > 1)
            found.push_back((static_cast<double>(at) + moment / sum) / 2 * degree);
        for (int k = 1 - apart; k < apart; ++k)
            left[bin(at, k)] = 0;
    }
    if (found.empty())
        found.push_back(0);
    return found;
}

void align_frames(const std::vector<Stretch>& stretches, std::vector<double>& frames) {
    constexpr double near = 6 * degree;
    constexpr double min_length = 5;  // cells
    for (double& frame : frames) {
        double turns = 0;
        double weights = 0;
        for (const Stretch& stretch : stretches) {
            const double turn = angle_between(frame, stretch.angle);
            if (stretch.length < min_length || std::abs(turn) > near)
                continue;
            // The certainty of the direction of a stretch grows with the cube of its length.
            const double weight = stretch.length * stretch.length * stretch.length;
            turns += weight * turn;
            weights += weight;
        }
        if (weights > 0)
            frame += turns / weights;
    }
}

std::vector<double> single_directions(std::vector<Stretch> stretches, const std::vector<double>& frames,
                                      double min_length, std::size_t most) {
    constexpr double apart = 7 * degree;
    constexpr double max_offset = 1.5;  // cells by which the end of a wall may leave its direction
    std::ranges::stable_sort(stretches, std::greater{}, &Stretch::length);
    std::vector<double> found;
    for (const Stretch& stretch : stretches) {
        if (stretch.length < min_length || found.size() == most)
            break;
        const auto explains = [&](double direction) {
            return std::abs(angle_between(direction, stretch.angle)) <
                   std::min(apart, max_offset / stretch.length);
        };
        if (std::ranges::none_of(frames, explains) && std::ranges::none_of(found, explains) &&
            !explains(frames.front() + quarter_turn / 2))
            found.push_back(stretch.angle);
    }
    return found;
}

}  // namespace d2b::outline
