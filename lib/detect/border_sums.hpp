#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// What lies at the border of an object, summed over the cells of its border.
class BorderSums {
  public:
    /// Adds a cell of an object's border. @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, std::int32_t c);

    /// Mean height above the ground of the cells within two cells of the border that are no object's; 0 where
    /// there is none.
    [[nodiscard]] double height_beside() const;
    /// How well the surface at the border keeps to two directions at right angles: 1 for the walls of a
    /// rectangle, about 0 for what is round. The mean of its gradients, at four times their angle, by their
    /// size.
    [[nodiscard]] double right_angles() const;

  private:
    void add_gradient(const MetreGrid& surface, std::int32_t r, std::int32_t c);

    double heights_ = 0;
    double cells_ = 0;  // that are summed in heights_
    double cosine_ = 0;
    double sine_ = 0;
    double gradients_ = 0;
};

}  // namespace d2b
