#include "plugins/detectors/ground/partition.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "plaza/math/assignment.h"

namespace plaza {
namespace {

using Groups = std::vector<MeasurementGroup>;

// Improvements below this are rounding; taking them could go round in circles.
constexpr double kLeastGain = 1e-9;

double total_evidence(const Groups& groups) {
  double sum = 0;
  for (const MeasurementGroup& g : groups) sum += g.log_evidence;
  return sum;
}

class Search {
 public:
  Search(std::span<const ViewMeasurement> measurements, std::size_t cameras, double density_per_m2)
      : measurements_(measurements), density_per_m2_(density_per_m2), of_camera_(cameras) {
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      of_camera_.at(measurements[i].camera).push_back(i);
    }
  }

  Groups best() const {
    Groups best;
    double best_evidence = -std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < of_camera_.size(); ++first) {
      if (of_camera_[first].empty()) continue;
      Groups groups;
      for (std::size_t k = 0; k < of_camera_.size(); ++k) {
        groups = with_view(groups, (first + k) % of_camera_.size());
      }
      groups = improved(std::move(groups));
      const double evidence = total_evidence(groups);
      if (evidence > best_evidence + kLeastGain) {
        best_evidence = evidence;
        best = std::move(groups);
      }
    }
    std::sort(best.begin(), best.end(),
              [](const auto& a, const auto& b) { return a.members.front() < b.members.front(); });
    return best;
  }

 private:
  MeasurementGroup group(std::vector<std::size_t> members) const {
    return make_group(measurements_, std::move(members), density_per_m2_);
  }

  MeasurementGroup joined(const MeasurementGroup& a, std::span<const std::size_t> b) const {
    std::vector<std::size_t> members = a.members;
    members.insert(members.end(), b.begin(), b.end());
    std::sort(members.begin(), members.end(), [&](std::size_t i, std::size_t k) {
      return measurements_[i].camera < measurements_[k].camera;
    });
    return group(std::move(members));
  }

  /// Assigns one view's measurements to groups that hold none of it; those that fit none stand
  /// alone.
  Groups with_view(Groups groups, std::size_t camera) const {
    const std::vector<std::size_t>& view = of_camera_[camera];
    if (view.empty()) return groups;
    const auto rows = static_cast<Eigen::Index>(view.size());
    const auto others = static_cast<Eigen::Index>(groups.size());
    Eigen::MatrixXd cost =
        Eigen::MatrixXd::Constant(rows, others + rows, std::numeric_limits<double>::infinity());
    for (Eigen::Index r = 0; r < rows; ++r) {
      const std::size_t member = view[static_cast<std::size_t>(r)];
      for (Eigen::Index c = 0; c < others; ++c) {
        const MeasurementGroup& g = groups[static_cast<std::size_t>(c)];
        const double gain = joined(g, {&member, 1}).log_evidence - g.log_evidence;
        if (gain > 0) cost(r, c) = -gain;
      }
      cost(r, others + r) = 0;  // alone
    }
    const std::vector<int> column = assign_minimum_cost(cost);
    for (std::size_t r = 0; r < view.size(); ++r) {
      if (column[r] < others) {
        MeasurementGroup& g = groups[static_cast<std::size_t>(column[r])];
        g = joined(g, {&view[r], 1});
      } else {
        groups.push_back(group({view[r]}));
      }
    }
    return groups;
  }

  Groups without_view(const Groups& groups, std::size_t camera) const {
    Groups rest;
    for (const MeasurementGroup& g : groups) {
      std::vector<std::size_t> members = g.members;
      std::erase_if(members, [&](std::size_t i) { return measurements_[i].camera == camera; });
      if (!members.empty()) rest.push_back(group(std::move(members)));
    }
    return rest;
  }

  bool share_view(const MeasurementGroup& a, const MeasurementGroup& b) const {
    return std::any_of(a.members.begin(), a.members.end(), [&](std::size_t i) {
      return std::any_of(b.members.begin(), b.members.end(), [&](std::size_t k) {
        return measurements_[i].camera == measurements_[k].camera;
      });
    });
  }

  /// Joins the two groups that gain most by it; false when none do.
  bool join_best_pair(Groups& groups) const {
    double best_gain = kLeastGain;
    std::size_t best_a = 0, best_b = 0;
    MeasurementGroup best;
    for (std::size_t a = 0; a < groups.size(); ++a) {
      for (std::size_t b = a + 1; b < groups.size(); ++b) {
        if (share_view(groups[a], groups[b])) continue;
        MeasurementGroup both = joined(groups[a], groups[b].members);
        const double gain = both.log_evidence - groups[a].log_evidence - groups[b].log_evidence;
        if (gain > best_gain) {
          best_gain = gain;
          best_a = a;
          best_b = b;
          best = std::move(both);
        }
      }
    }
    if (best.members.empty()) return false;
    groups[best_a] = std::move(best);
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(best_b));
    return true;
  }

  /// Ends because the evidence of finitely many partitions rises with every change.
  Groups improved(Groups groups) const {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t camera = 0; camera < of_camera_.size(); ++camera) {
        if (of_camera_[camera].empty()) continue;
        Groups again = with_view(without_view(groups, camera), camera);
        if (total_evidence(again) > total_evidence(groups) + kLeastGain) {
          groups = std::move(again);
          changed = true;
        }
      }
      while (join_best_pair(groups)) changed = true;
    }
    return groups;
  }

  std::span<const ViewMeasurement> measurements_;
  double density_per_m2_;
  std::vector<std::vector<std::size_t>> of_camera_;
};

}  // namespace

MeasurementGroup make_group(std::span<const ViewMeasurement> measurements,
                            std::vector<std::size_t> members, double density_per_m2) {
  MeasurementGroup group;
  group.members = std::move(members);
  if (group.members.size() == 1) {  // exact, where inverting twice would round
    group.position_m = measurements[group.members[0]].position_m;
    group.covariance_m2 = measurements[group.members[0]].covariance_m2;
    return group;
  }
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
  for (const std::size_t i : group.members) {
    const Eigen::Matrix2d inverse = measurements[i].covariance_m2.inverse();
    information += inverse;
    weighted += inverse * measurements[i].position_m;
  }
  const Eigen::Matrix2d covariance = information.inverse();
  group.covariance_m2 = 0.5 * (covariance + covariance.transpose());
  group.position_m = covariance * weighted;

  const double log_two_pi = std::log(2 * std::numbers::pi);
  double log_likelihood = log_two_pi + 0.5 * std::log(group.covariance_m2.determinant());
  for (const std::size_t i : group.members) {
    const Eigen::Matrix2d& c = measurements[i].covariance_m2;
    const Eigen::Vector2d residual = measurements[i].position_m - group.position_m;
    log_likelihood -=
        log_two_pi + 0.5 * std::log(c.determinant()) + 0.5 * residual.dot(c.inverse() * residual);
  }
  const auto joins = static_cast<double>(group.members.size() - 1);
  group.log_evidence = log_likelihood - joins * std::log(density_per_m2);
  return group;
}

std::vector<MeasurementGroup> partition(std::span<const ViewMeasurement> measurements,
                                        std::size_t cameras, double density_per_m2) {
  return Search(measurements, cameras, density_per_m2).best();
}

}  // namespace plaza
