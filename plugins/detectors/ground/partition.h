#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace plaza {

/// One view's measurement of somebody's position on the ground.
struct ViewMeasurement {
  std::size_t camera = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  ///< positive definite
};

/// Measurements taken to be of one person, and where that person stands.
struct MeasurementGroup {
  std::vector<std::size_t> members;  ///< by rising camera, at most one per camera
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< information-weighted mean
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
  /// Log of how much better one person explains the members than as many people do, each standing
  /// anywhere: log of integral prod_i N(z_i; p, C_i) dp - (n - 1) log(density). 0 for one member.
  double log_evidence = 0;
};

/// The group of `members`, which are in order and of different cameras.
MeasurementGroup make_group(std::span<const ViewMeasurement> measurements,
                            std::vector<std::size_t> members, double density_per_m2);

/// Splits the measurements of several views into people: the groups whose evidence sums highest, as
/// far as the search finds them.
///
/// The exact problem (multi-dimensional assignment) is NP-hard beyond two views. Each view in turn
/// is assigned exactly to the groups of the others; then, until nothing gets better, each view is
/// taken out and assigned anew, and groups without a common view are joined. This starts once from
/// every view, and the best end counts. Every measurement is in exactly one group; groups are by
/// their first member.
///
/// `density_per_m2` > 0: people per square metre, which is how close two measurements of different
/// people come by chance.
std::vector<MeasurementGroup> partition(std::span<const ViewMeasurement> measurements,
                                        std::size_t cameras, double density_per_m2);

}  // namespace plaza
