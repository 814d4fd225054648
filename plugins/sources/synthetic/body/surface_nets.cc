#include "plugins/sources/synthetic/body/surface_nets.h"

#include <cmath>
#include <limits>

namespace plaza::synthetic {
namespace {

constexpr int kBlock = 4;  // cells; space farther from the surface than a block is skipped as one
// Distances of smooth unions and ellipsoids are too short or too long by up to this factor.
constexpr float kDistanceSlack = 2.5f;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Samples of the distance at the corners of cells.
class Samples {
 public:
  Samples(const std::function<float(const Eigen::Vector3f&)>& distance,
          const Eigen::AlignedBox3f& bounds, float cell_m)
      : origin_(bounds.min()), cell_(cell_m) {
    for (int k = 0; k < 3; ++k) {
      const int cells = static_cast<int>(std::ceil(bounds.sizes()[k] / cell_m));
      size_[k] = (cells / kBlock + 1) * kBlock + 1;
    }
    values_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 1.0f);
    const float far = kDistanceSlack * 0.87f * kBlock * cell_m;  // half a block's diagonal
    Eigen::Vector3i b;
    for (b[2] = 0; b[2] + 1 < size_[2]; b[2] += kBlock) {
      for (b[1] = 0; b[1] + 1 < size_[1]; b[1] += kBlock) {
        for (b[0] = 0; b[0] + 1 < size_[0]; b[0] += kBlock) {
          const float middle =
              distance(place(b) + Eigen::Vector3f::Constant(0.5f * kBlock * cell_m));
          fill(b, std::abs(middle) > far ? std::copysign(1.0f, middle) : 0.0f, distance);
        }
      }
    }
  }

  Eigen::Vector3f place(const Eigen::Vector3i& i) const {
    return origin_ + cell_ * i.cast<float>();
  }
  float at(const Eigen::Vector3i& i) const { return values_[index(i)]; }
  const Eigen::Vector3i& size() const { return size_; }
  float cell() const { return cell_; }
  std::size_t index(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i[2]) * size_[1] + i[1]) * size_[0] + i[0];
  }
  std::size_t count() const { return values_.size(); }

 private:
  /// `known`: the sign of the whole block, 0 when the surface may cross it.
  void fill(const Eigen::Vector3i& block, float known,
            const std::function<float(const Eigen::Vector3f&)>& distance) {
    Eigen::Vector3i i;
    for (i[2] = block[2]; i[2] <= block[2] + kBlock; ++i[2]) {
      for (i[1] = block[1]; i[1] <= block[1] + kBlock; ++i[1]) {
        for (i[0] = block[0]; i[0] <= block[0] + kBlock; ++i[0]) {
          float& value = values_[index(i)];
          if (known == 0) {
            value = distance(place(i));
          } else if (value == 1.0f) {  // the corner of a neighbour may be known exactly
            value = known;
          }
        }
      }
    }
  }

  Eigen::Vector3f origin_;
  float cell_;
  Eigen::Vector3i size_;
  std::vector<float> values_;
};

/// Where the surface passes through a cell: the mean of its crossings of the cell's edges.
bool crossing(const Samples& samples, const Eigen::Vector3i& cell, Eigen::Vector3f& vertex) {
  std::array<float, 8> corner;
  int inside = 0;
  for (int c = 0; c < 8; ++c) {
    corner[c] = samples.at(cell + Eigen::Vector3i(c & 1, (c >> 1) & 1, c >> 2));
    inside += corner[c] < 0 ? 1 : 0;
  }
  if (inside == 0 || inside == 8) return false;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int crossings = 0;
  for (int c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = c | (1 << axis);
      if (other == c || (corner[c] < 0) == (corner[other] < 0)) continue;
      Eigen::Vector3f p(static_cast<float>(c & 1), static_cast<float>((c >> 1) & 1),
                        static_cast<float>(c >> 2));
      p[axis] = corner[c] / (corner[c] - corner[other]);
      sum += p;
      ++crossings;
    }
  }
  vertex = samples.place(cell) + samples.cell() * sum / static_cast<float>(crossings);
  return true;
}

}  // namespace

ClosedSurface surface_nets(const std::function<float(const Eigen::Vector3f&)>& distance,
                           const Eigen::AlignedBox3f& bounds, float cell_m) {
  const Samples samples(distance, bounds, cell_m);
  ClosedSurface out;
  std::vector<std::uint32_t> vertex_of(samples.count(), kNone);
  const Eigen::Vector3i cells = samples.size() - Eigen::Vector3i::Ones();
  Eigen::Vector3i i;
  for (i[2] = 0; i[2] < cells[2]; ++i[2]) {
    for (i[1] = 0; i[1] < cells[1]; ++i[1]) {
      for (i[0] = 0; i[0] < cells[0]; ++i[0]) {
        Eigen::Vector3f vertex;
        if (!crossing(samples, i, vertex)) continue;
        vertex_of[samples.index(i)] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(vertex);
      }
    }
  }
  // around every edge that the surface crosses, four cells make two triangles
  for (i[2] = 1; i[2] < cells[2]; ++i[2]) {
    for (i[1] = 1; i[1] < cells[1]; ++i[1]) {
      for (i[0] = 1; i[0] < cells[0]; ++i[0]) {
        const bool inside = samples.at(i) < 0;
        for (int axis = 0; axis < 3; ++axis) {
          const Eigen::Vector3i u = Eigen::Vector3i::Unit((axis + 1) % 3);
          const Eigen::Vector3i v = Eigen::Vector3i::Unit((axis + 2) % 3);
          if (inside == (samples.at(i + Eigen::Vector3i::Unit(axis)) < 0)) continue;
          const std::array<std::uint32_t, 4> q = {
              vertex_of[samples.index(i - u - v)], vertex_of[samples.index(i - v)],
              vertex_of[samples.index(i)], vertex_of[samples.index(i - u)]};
          if (inside) {
            out.triangles.push_back({q[0], q[1], q[2]});
            out.triangles.push_back({q[0], q[2], q[3]});
          } else {
            out.triangles.push_back({q[0], q[2], q[1]});
            out.triangles.push_back({q[0], q[3], q[2]});
          }
        }
      }
    }
  }
  return out;
}

}  // namespace plaza::synthetic
