#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// Surroundings and gradients of an object, summed over its border cells.
class BorderSums {
  public:
    /// Adds a border cell.
    /// @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, std::int32_t c);

    /// Mean height above the ground of cells within two cells of the border that belong to no object; 0 if
    /// there are none.
    [[nodiscard]] double height_beside() const;
    /// Rectangularity: 1 if all gradients at the border follow two perpendicular directions, as the walls of
    /// a rectangle do, about 0 for round objects. It is the length of the mean of the gradients at four times
    /// their angle, weighted by their size.
    [[nodiscard]] double right_angles() const;

  private:
    void add_gradient(const MetreGrid& surface, std::int32_t r, std::int32_t c);

    double heights_ = 0;
    double cells_ = 0;  // number of cells summed in heights_
    double cosine_ = 0;
    double sine_ = 0;
    double gradients_ = 0;
};

}  // namespace d2b
